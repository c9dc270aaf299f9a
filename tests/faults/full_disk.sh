# A full disk: refused before anything is computed where that can be foreseen; else exit 3, a clear sentence, every
# finished block kept, resumable. Needs a small disk of its own.
. "$(dirname "$0")/common.sh"
if [ "$(id -u)" != 0 ]; then echo "skipped: only root can mount a small disk"; exit $skip; fi
mkdir disk
if ! mount -t tmpfs -o size=400k reedvalve-test disk 2>/dev/null; then
   echo "skipped: a tmpfs cannot be mounted here"
   exit $skip
fi
cleanup='umount "$work/disk"'
# every case has a message, which no estimate counts: so the disk fills up in the middle of a run
{ sweep_deck 200 1.0e-6; echo "&fluid viscosity_pa_s = 0.002 /"; } >deck.nml
expect 0 'are marked' run deck.nml -o whole

if [ -e "$(dirname "$program")/fmu" ]; then
   echo "&film gap_mm = 0.05 /" >one.nml
   expect 3 'No space left on device' fmu one.nml -o disk/valve.fmu
   fails "no half of an FMU is left" sh -c 'ls disk | grep fmu'
fi
expect 3 'no room for this run' run deck.nml -o disk/results
fails "nothing was computed" test -e disk/results/parts
mount -o remount,size=590k disk
expect 3 'No space left on device' run deck.nml -o disk/results --slice 1/1
holds "it says how many blocks are kept and how to go on" grep -q 'blocks are finished and kept in .*--resume' err.txt
kept=$(ls disk/results/parts | grep -c 'part$')
if [ "$kept" -gt 0 ]; then pass "$kept blocks are kept"; else wrong "no block is kept"; fi
fails "no half of a part is left" sh -c 'ls disk/results/parts | grep new'
expect 3 'No space left on device|no room for this run' run deck.nml -o disk/results --slice 1/1 --resume
now=$(ls disk/results/parts | grep -c 'part$')
if [ "$now" -ge "$kept" ]; then pass "$now blocks after one more try"; else wrong "only $now of $kept blocks are left"; fi
mount -o remount,size=20m disk
expect 0 'All blocks of the run are finished' run deck.nml -o disk/results --slice 1/1 --resume

# half the room for results.nc; then for all of it and a part of the summary
kilobytes() { du -k "$1" | cut -f 1; }
parts=$(du -sk disk/results | cut -f 1)
netcdf=$(kilobytes whole/results.nc)
csv=$(kilobytes whole/summary.csv)
for room in $((netcdf/2)) $((netcdf + csv/4)) $((netcdf + csv/2)) $((netcdf + 3*csv/4)); do
   mount -o remount,size=$((parts + room))k disk
   expect 3 "No space left|disk is full" merge disk/results
   fails "no half of a result is left" sh -c 'ls disk/results | grep -E "results|summary"'
done
all=$(ls disk/results/parts | grep -c 'part$')
if [ "$all" = 16 ]; then pass "all blocks are kept"; else wrong "$all of 16 blocks are kept"; fi

mount -o remount,size=20m disk
expect 0 'are marked' run deck.nml -o disk/results --resume
same whole disk/results

# not even room for the folder
mount -t tmpfs -o size=4k,nr_inodes=1 reedvalve-test disk
cleanup='umount "$work/disk"; umount "$work/disk"'
expect 3 'No space left' run deck.nml -o disk/results
fails "no folder is left" test -e disk/results
finish
