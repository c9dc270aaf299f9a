# A full disk: exit 3, a clear sentence, every finished block kept, resumable. Needs a small disk of its own.
. "$(dirname "$0")/common.sh"
if [ "$(id -u)" != 0 ]; then echo "skipped: only root can mount a small disk"; exit $skip; fi
mkdir disk
if ! mount -t tmpfs -o size=400k reedvalve-test disk 2>/dev/null; then
   echo "skipped: a tmpfs cannot be mounted here"
   exit $skip
fi
cleanup='umount "$work/disk"'
sweep_deck 200 1.0e-6 >deck.nml
expect 0 'none failed' run deck.nml -o whole

expect 3 'No space left on device' run deck.nml -o disk/results
holds "it says how many blocks are kept and how to go on" grep -q 'blocks are finished and kept in .*--resume' err.txt
kept=$(ls disk/results/parts | grep -c 'part$')
if [ "$kept" -gt 0 ]; then pass "$kept blocks are kept"; else wrong "no block is kept"; fi
fails "no half of a part is left" sh -c 'ls disk/results/parts | grep new'
fails "no half of a result is left" test -e disk/results/results.nc
expect 3 'No space left on device' run deck.nml -o disk/results --resume
now=$(ls disk/results/parts | grep -c 'part$')
if [ "$now" -ge "$kept" ]; then pass "$now blocks after one more try"; else wrong "only $now of $kept blocks are left"; fi

# room for the parts and half of results.nc; then for all of it and a part of the summary
kilobytes() { du -k "$1" | cut -f 1; }
block=$(kilobytes disk/results/parts/block_000000001.part)
netcdf=$(kilobytes whole/results.nc)
csv=$(kilobytes whole/summary.csv)
for room in $((netcdf/2)) $((netcdf + csv/4)) $((netcdf + csv/2)) $((netcdf + 3*csv/4)); do
   mount -o remount,size=$((16*block + room))k disk
   expect 3 "No space left|disk is full" run deck.nml -o disk/results --resume
   fails "no half of a result is left" sh -c 'ls disk/results | grep -E "results|summary"'
done
all=$(ls disk/results/parts | grep -c 'part$')
if [ "$all" = 16 ]; then pass "all blocks are kept"; else wrong "$all of 16 blocks are kept"; fi

mount -o remount,size=20m disk
expect 0 'none failed' run deck.nml -o disk/results --resume
same whole disk/results

# not even room for the folder
mount -t tmpfs -o size=4k,nr_inodes=1 reedvalve-test disk
cleanup='umount "$work/disk"; umount "$work/disk"'
expect 3 'No space left' run deck.nml -o disk/results
fails "no folder is left" test -e disk/results
finish
