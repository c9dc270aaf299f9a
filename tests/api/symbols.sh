# symbols.sh LIST LIBRARY HEADER CC NM
# The list of symbols is what the library exports, no more and no less, and what the header declares, but for the names
# of the Fortran 77 interface, which end in an underscore.
set -eu
list=$1 library=$2 header=$3 cc=$4 nm=$5
export LC_ALL=C
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

sort -u "$list" >"$work/sorted"
diff "$list" "$work/sorted" || { echo "$list is not in order"; failed=1; }
if grep -vE '^rv_[a-z0-9_]+$' "$list"; then echo "$list: these do not begin with rv_"; failed=1; fi

# an absolute symbol is the name of the version itself
"$nm" --dynamic --defined-only --without-symbol-versions "$library" | awk '$2 != "A" {print $3}' | sort >"$work/exported"
diff "$list" "$work/exported" || { echo "< only in $list, > only in $library"; failed=1; }

grep -v '_$' "$list" >"$work/listed"
"$cc" -E -P "$header" | grep -oE '\<rv_[a-z0-9_]+ *\(' | tr -d ' (' | sort -u >"$work/declared"
diff "$work/listed" "$work/declared" || { echo "< only in $list, > only in $header"; failed=1; }
exit $failed
