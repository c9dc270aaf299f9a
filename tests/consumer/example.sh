# example.sh ROUTE EXAMPLE PREFIX WORK [RUNNER...]: build an example against what is installed under PREFIX, in the folder
# WORK, and compare what it prints with what stands beside its source. ROUTE is the way it is built: by `cmake`, by a
# compiler with `pkg-config`, or by a `bare` compiler. RUNNER, valgrind for one, runs the program.
set -eu
route=$1 example=$2 prefix=$3 work=$4
shift 4
rm -rf "$work"
mkdir -p "$work"
export CFLAGS="-Wall -Wextra -Werror" CXXFLAGS="-Wall -Wextra -Werror"

# what a compiler and the program at its start are told of a prefix that they do not know
flags="-I$prefix/include -L$(dirname "$(find "$prefix" -name libreedvalve.so)")"
LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name libreedvalve.so)")${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}

for expected in "$example"/*.txt; do
   [ "$(basename "$expected")" != CMakeLists.txt ] || continue
   name=$(basename "$expected" .txt)
   source=$(ls "$example/$name".*[!t])
   case $route in
   cmake)
      [ -f "$work/CMakeCache.txt" ] || cmake -S "$example" -B "$work" -DCMAKE_PREFIX_PATH="$prefix"
      cmake --build "$work" --target "$name"
      ;;
   esac
done
