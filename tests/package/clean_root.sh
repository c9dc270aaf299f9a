# clean_root.sh DEBS TESTS DOCS: install the packages in the folder DEBS into a Debian of its own that has nothing else, run
# the programs there, simulate an FMU and build the examples as the pages in DOCS say, by the scripts in TESTS. FMPy, which
# Debian has not, is that of python3 here.
set -eu
PATH=$PATH:/usr/sbin:/sbin
debs=$1 tests=$2 docs=$3
skip() {
   echo "skipped: $1"
   [ -z "${2:-}" ] || tail -n 5 "$2"
   exit 77
}
[ "$(id -u)" = 0 ] || skip "only root makes a root"
command -v debootstrap >/dev/null || skip "debootstrap is not installed"
unshare --mount true 2>/dev/null || skip "no mounts of one's own here"
. /etc/os-release
[ "${ID:-}" = debian ] || skip "this is not Debian"
mirror=$(cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | awk '$1 == "deb" || $1 == "URIs:" {print $2; exit}')

work=$(mktemp -d /var/tmp/reedvalve-root.XXXXXX)
trap 'rm -rf --one-file-system "$work"' EXIT
trap 'exit 1' INT TERM
root=$work/root
debootstrap --variant=minbase "$VERSION_CODENAME" "$root" "$mirror" >"$work/log" 2>&1 || skip "debootstrap has no mirror" "$work/log"
# how this machine reaches its mirror
for file in /etc/apt/apt.conf.d/* /etc/resolv.conf /etc/hosts /etc/ssl/certs/ca-certificates.crt; do
   case $file in
   *docker*) ;;
   *) [ ! -f "$file" ] || { mkdir -p "$root$(dirname "$file")" && cp -L "$file" "$root$file"; } ;;
   esac
done
mkdir "$root/debs"
cp "$debs"/*.deb "$tests/page.sh" "$tests/fmu.sh" "$docs/install.md" "$docs/fmu.md" "$(dirname "$0")/in_root.sh" "$root/debs"
mkdir "$root/importer"
cp -r "$(python3 -c 'import fmpy; print(fmpy.__path__[0])')" "$root/importer"

unshare --mount sh -c "mount -t proc proc $root/proc && mount --rbind /dev $root/dev && chroot $root sh -eu /debs/in_root.sh"
