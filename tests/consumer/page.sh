# page.sh commands|example PAGE HEADING BUILD WORK PREFIX [RUNNER...]
# Run the block of shell commands below a heading of a page as it is printed, in the folder WORK, where the build tree is
# build/release; $HOME/reedvalve is PREFIX. Those of an example end in a call of its program: RUNNER, valgrind for one,
# runs it, it uses the library, and in Python the package, of PREFIX, and prints what stands beside its source.
set -eu
kind=$1 page=$2 heading=$3 build=$4 work=$5 prefix=$6
shift 6

mkdir -p "$work/build"
cd "$work"
ln -sfn "$build" build/release
export PYTHONDONTWRITEBYTECODE=1   # which would name PREFIX
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
if grep -q '^python3 ' block.sh; then
   python3 -c 'import numpy' || { echo "skipped: python3 has no NumPy"; exit 77; }
fi
if [ "$kind" = commands ]; then
   . ./block.sh
   exit
fi

example=$(grep -o '[^ ]*/examples/[a-z0-9]*' block.sh | head -n 1)
sed '$d' block.sh >build.sh
program=$(tail -n 1 block.sh)
. ./build.sh
case $program in
python3\ *)
   set --   # valgrind would tell of what the interpreter keeps
   used=$(python3 -c 'import reedvalve
words = open("/proc/self/maps").read().split()
print(reedvalve.__file__, next(word for word in words if "libreedvalve" in word))')
   ;;
*) used=$(ldd "$program" | awk '$1 ~ /^libreedvalve/ {print $3}') ;;
esac
# shellcheck disable=SC2086 # one file or two
used=$(realpath $used)
for file in $used; do
   case $file in
   "$prefix"/*) ;;
   *) echo "with $file and not that of $prefix" >&2; exit 1 ;;
   esac
done
# shellcheck disable=SC2086 # python3 and its script
"$@" $program >printed.txt
diff "$(find "$example" -name '*.txt' ! -name CMakeLists.txt)" printed.txt
