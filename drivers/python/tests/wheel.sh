#!/bin/sh
# pip install . in a new virtual environment, from a copy of the sources that is gone afterwards: the package takes the
# library that it has inside, and the quick start prints what stands beside it. pip takes NumPy and scikit-build-core
# from its index; compiling takes a minute.
set -eu
root=$(cd "$(dirname "$0")/../../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset REEDVALVE_LIBRARY PYTHONPATH

mkdir "$work/source"
tar -C "$root" --exclude=./build --exclude=./results --exclude=./.git -c . | tar -C "$work/source" -x
python3 -m venv "$work/venv"
"$work/venv/bin/python" -m pip install -q --disable-pip-version-check "$work/source"
cp "$work/source/drivers/examples/python/"quick_start.* "$work"
rm -rf "$work/source"

cd "$work"
loaded=$(venv/bin/python -c 'import reedvalve; print(reedvalve._library.LIB._name)')
case $loaded in
"$work"/venv/lib/*/site-packages/reedvalve/libreedvalve.so) ;;
*) echo "the library is not the package's own: $loaded" >&2; exit 1 ;;
esac
venv/bin/python -W error quick_start.py >printed.txt
diff quick_start.txt printed.txt
echo "the installed package prints what quick_start.txt says"
