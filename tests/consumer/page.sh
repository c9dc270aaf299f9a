# page.sh PAGE HEADING BUILD WORK PREFIX [EXPECTED [RUNNER...]]
# Run the block of shell commands below a heading of a page as it is printed, in the folder WORK, where the build tree is
# build/release; $HOME/reedvalve is PREFIX. With EXPECTED, the last command is a program that prints what stands in this
# file and uses the library of PREFIX; RUNNER, valgrind for one, runs it.
set -eu
page=$1 heading=$2 build=$3 work=$4 prefix=$5 expected=${6:-}
if [ $# -gt 6 ]; then shift 6; else set --; fi

mkdir -p "$work/build"
cd "$work"
ln -sfn "$build" build/release
export CFLAGS="-Wall -Wextra -Werror" CXXFLAGS="-Wall -Wextra -Werror" FFLAGS="-Wall -Wextra -Werror"
awk -v heading="## $heading" '
   /^## / {here = $0 == heading}
   /^```/ {if (inside) exit; inside = here && $0 == "```sh"; next}
   inside {print}' "$page" | sed "s|\$HOME/reedvalve|$prefix|g" >block.sh
[ -s block.sh ] || { echo "$page has no commands below '$heading'" >&2; exit 1; }
cat block.sh
if grep -q '^module ' block.sh; then
   modules=/usr/share/modules/init/sh
   [ -r $modules ] || { echo "skipped: Environment Modules are not installed"; exit 77; }
   . $modules
fi
if [ -z "$expected" ]; then
   . ./block.sh
   exit
fi

sed '$d' block.sh >build.sh
program=$(tail -n 1 block.sh)
. ./build.sh
ldd "$program" | grep -F 'libreedvalve.so' | grep -F "$prefix/" || { echo "not with the library of $prefix" >&2; exit 1; }
"$@" "$program" >printed.txt
diff "$expected" printed.txt
