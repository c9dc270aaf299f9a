# fmu.sh PAGE WORK PREFIX: in the folder WORK the program of PREFIX packs FMUs by the first commands of PAGE, each with the
# library of PREFIX inside, and FMPy simulates each by the first example in Python; all print what the page says.
set -eu
page=$1 work=$2 prefix=$3
python3 -c 'import fmpy' || { echo "skipped: python3 has no FMPy"; exit 77; }

rm -rf "$work"
mkdir -p "$work"
cd "$work"
# block CONDITION: the first block of the page that an awk condition picks
block() { awk -v RS='```' "$1"' {printf "%s", $0; exit}' "$page"; }
block 'sub(/^\n\$/, "$")' >session.txt
block 'sub(/^python\n/, "")' >example.py
block '/^python\n/ {seen = 1} seen && sub(/^text\n/, "")' >example.txt

PATH=$prefix/bin:$PATH
sed -n 's/^\$ //p' session.txt >session.sh
sh -eu session.sh >printed.txt
grep -v '^\$' session.txt | diff - printed.txt
for fmu in *.fmu; do
   sed "s/valve\.fmu/$fmu/" example.py | python3 - >printed.txt
   diff example.txt printed.txt
   python3 -m zipfile -e "$fmu" "unpacked/$fmu"
   cmp "$(find "$prefix"/lib* -path '*/reedvalve/reedvalve.so')" "unpacked/$fmu"/binaries/*/reedvalve.so
done
