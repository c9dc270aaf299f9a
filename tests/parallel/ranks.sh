# MPI ranks: the same words and the same bytes as on threads; what fails for one ends all; stopped ranks can be resumed.
# sh ranks.sh PROGRAM RTOL MPI_PROGRAM MPIEXEC
. "$(dirname "$0")/ranks_common.sh"
mixed_deck 20 1.0e-6 | sed '1s/block_size/traces = .true., trace_dt_ms = 1.0, block_size/' >deck.nml
expect 0 'none failed' run deck.nml -o one --threads 1
expect 0 'none failed' run deck.nml -o two --threads 2
same one two
for ranks in 1 2 3 5; do
   with_ranks $ranks
   expect 0 '320 cases, none failed' run deck.nml -o ranks$ranks --threads $((ranks % 2 + 1))
   same one ranks$ranks
   fails "no parts are left" test -e ranks$ranks/parts
   fails "no lock is left" test -e ranks$ranks/run.lock
done
holds "each case was computed once" grep -q 'cases computed: 320,' ranks5/run.log
holds "the log tells of them" grep -q 'processes: 5, threads of each: 2' ranks5/run.log

# one tells, once
with_ranks 3
expect 0 'finished before; nothing was run' run deck.nml -o ranks3 --resume
expect 2 "'ranks3' holds results" run deck.nml -o ranks3
told=$(grep -c "holds results" err.txt)
if [ "$told" = 1 ]; then pass "one of three tells"; else wrong "$told of three tell"; fi
expect 0 '' run deck.nml -o ranks3 --force --quiet
if [ -s out.txt ]; then wrong "--quiet prints"; else pass "--quiet prints nothing"; fi
same one ranks3
echo "&film gap_mm = -0.05 /" >bad.nml
expect 2 'bad.nml:1:.*must be >= 0' run bad.nml
expect 0 'SUNDIALS' --version
told=$(grep -c SUNDIALS out.txt)
if [ "$told" = 1 ]; then pass "and one has a version"; else wrong "$told of three tell the version"; fi
sed 's/rtol/max_steps = 150, rtol/' deck.nml >failing.nml
expect 1 'failed \([0-9]+ too_many_steps\)' run failing.nml -o failing
program=$own
expect 1 'failed \([0-9]+ too_many_steps\)' run failing.nml -o failing1
same failing failing1

# slices of ranks, and what is left by threads
with_ranks 2
expect 0 'Slice 2/3: .* none failed' run deck.nml -o sliced --slice 2/3
expect 3 'blocks are not finished' merge sliced
program=$own
expect 0 'Slice 1/3: .* none failed' run deck.nml -o sliced --slice 1/3
with_ranks 2
expect 0 'of them were run now, the others before' run deck.nml -o sliced --resume
same one sliced

# a folder that others work in, one that cannot be written, a rank that sees another deck
with_ranks 2
"$own" run deck.nml -o busy --slice 1/2 --threads 1 --quiet &
first=$!
while kill -0 $first 2>/dev/null && [ ! -e busy/parts/manifest ]; do :; done
kill -STOP $first
expect 3 "another run is at work in 'busy'" run deck.nml -o busy --resume
kill -CONT $first
wait $first
expect 3 "there is no folder 'no/such'" run deck.nml -o no/such/place
mkdir other
sed 's/0.30/0.31/' deck.nml >other/deck.nml
cat >split.sh <<'END'
if [ "${OMPI_COMM_WORLD_RANK:-${PMI_RANK:-0}}" = 1 ]; then cd other || exit 9; fi
exec "$@"
END
"$mpiexec" -n 2 sh ./split.sh "$mpi" run deck.nml -o "$work/split" >out.txt 2>err.txt
got=$?
if [ $got = 2 ]; then pass "a rank with another deck: exit status 2"; else wrong "exit status $got instead of 2"; cat err.txt; fi
holds "the rank is named" grep -q "rank 1 on .*: cannot resume the run .*the deck was edited" err.txt
fails "nothing is left of it" test -e split

# stopped by the scheduler's words to mpiexec, and by a signal to one rank; a long run of short blocks, never finished here
sweep_deck 4000 1.0e-10 | sed "s/block_size = 4000/block_size = 20/" >long.nml
for signal in TERM USR1 INT; do
   if [ $signal = TERM ]; then patience=3; else patience=0; fi
   export OMPI_MCA_odls_base_sigkill_timeout=$patience
   start_ranks 3 long.nml part_$signal
   while kill -0 $job 2>/dev/null && [ ! -e part_$signal/parts/block_000000001.part ]; do sleep 0.01; done
   if [ $signal = INT ]; then kill -INT "$(cat pid.1)"; else kill -$signal $job; fi
   wait $job
   got=$?
   if [ $got = 1 ]; then pass "$signal: exit status 1"; else wrong "$signal: exit status $got instead of 1"; cat err.txt; fi
   holds "it says how to go on" grep -q "go on with: reedvalve run long.nml -o part_$signal --resume" err.txt
   holds "the log knows" grep -q 'stopped on request' part_$signal/run.log
   fails "the lock is gone" test -e part_$signal/run.lock
   kept=$(ls part_$signal/parts | grep -c 'part$')
   if [ "$kept" -lt 3200 ]; then pass "$kept of 3200 blocks are kept"; else wrong "nothing is left to resume"; fi
   fails "no half of a part is left" sh -c "ls part_$signal/parts | grep new"
done

# a disk that is full for all; every case has a message, which no estimate counts, so it fills up in the middle of a run
if [ "$(id -u)" = 0 ] && mkdir disk && mount -t tmpfs -o size=590k reedvalve-test disk 2>/dev/null; then
   cleanup='umount "$work/disk"'
   { sweep_deck 200 1.0e-6; echo "&fluid viscosity_pa_s = 0.002 /"; } >full.nml
   with_ranks 3
   expect 3 'No space left on device' run full.nml -o disk/results --slice 1/1
   holds "it says how many blocks are kept" grep -q 'blocks are finished and kept in .*--resume' err.txt
   fails "no half of a part is left" sh -c 'ls disk/results/parts | grep new'
   mount -o remount,size=20m disk
   expect 0 'All blocks of the run are finished' run full.nml -o disk/results --slice 1/1 --resume
else
   echo "  left out: a full disk (no tmpfs can be mounted here)"
fi
finish
