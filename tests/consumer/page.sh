# page.sh commands|example PAGE HEADING BUILD WORK PREFIX [RUNNER...]
# Run the block of shell commands below a heading of a page as it is printed, in the folder WORK, where the build tree is
# build/release; $HOME/reedvalve is PREFIX. Those of an example end in a call of its program: RUNNER, valgrind for one,
# runs it, it uses the library of PREFIX, and prints what stands beside its source.
set -eu
kind=$1 page=$2 heading=$3 build=$4 work=$5 prefix=$6
shift 6

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
if [ "$kind" = commands ]; then
   . ./block.sh
   exit
fi

example=$(grep -o '[^ ]*/examples/[a-z0-9]*' block.sh | head -n 1)
sed '$d' block.sh >build.sh
program=$(tail -n 1 block.sh)
. ./build.sh
library=$(realpath "$(ldd "$program" | awk '$1 ~ /^libreedvalve/ {print $3}')")
case $library in
"$prefix"/*) ;;
*) echo "with the library $library and not that of $prefix" >&2; exit 1 ;;
esac
"$@" "$program" >printed.txt
diff "$(find "$example" -name '*.txt' ! -name CMakeLists.txt)" printed.txt
