# In a bare Debian with the packages in /debs: first the program alone, then all of them with compilers.
export LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin
cd /debs
install() {
   echo "== install $*"
   apt-get -q -y install --no-install-recommends "$@" >log 2>&1 || { tail -n 20 log; exit 1; }
}
apt-get -q update >log 2>&1 || { tail -n 20 log; exit 1; }

install ./reedvalve_*.deb
reedvalve --version
reedvalve run /usr/share/reedvalve/inputs/response.nml -o alone | grep 'none failed'
install python3-attr python3-lxml python3-numpy
echo "== fmu.md"
PYTHONPATH=/importer sh fmu.sh /debs/fmu.md /trial/fmu /usr || exit 1   # where a skip is a failure

install ./*.deb gcc g++ gfortran libc6-dev cmake make pkg-config openmpi-bin
mpirun --allow-run-as-root --oversubscribe -n 2 reedvalve_mpi run /usr/share/reedvalve/inputs/response.nml -o ranks |
   grep 'none failed'
cmp alone/results.nc ranks/results.nc

awk '/^## / {heading = substr($0, 4)} /\/examples\// && heading != last {print last = heading}' install.md >headings
built=0
while read -r heading; do
   echo "== $heading"
   sh page.sh example /debs/install.md "$heading" /nowhere "/trial/$built" /usr || exit 1
   built=$((built + 1))
done <headings
[ $built -ge 7 ]
python3 -c 'import reedvalve'

echo "== purge"
apt-get -q -y purge reedvalve reedvalve-mpi python3-reedvalve 'libreedvalve*' >log 2>&1 || { tail -n 20 log; exit 1; }
left=$(find / -xdev -path /debs -prune -o -path /trial -prune -o -name '*reedvalve*' -print)
[ -z "$left" ] || { echo "left behind: $left"; exit 1; }
