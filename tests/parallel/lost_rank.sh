# One of three ranks is killed: the others finish their blocks and end by themselves; --resume runs what was lost.
# sh lost_rank.sh PROGRAM RTOL MPI_PROGRAM MPIEXEC
. "$(dirname "$0")/ranks_common.sh"
if ! "$mpiexec" --version | grep -Eq '\((Open MPI|OpenRTE)\) [34]\.'; then
   echo "  left out: what becomes of ranks whose partner has died is known for Open MPI 3 and 4"
   exit $skip
fi
# what a rank says is in err.RANK at once; mpirun passes on nothing while it waits for the ranks' end
cat >own_err <<END
#!/bin/sh
exec "$mpi" "\$@" 2>err.\$OMPI_COMM_WORLD_RANK
END
chmod 755 own_err
direct=$mpi
sweep_deck "$(slow_count 12000)" >deck.nml
expect 0 'none failed' run deck.nml -o whole

parts() { ls "$1/parts" | grep -c 'part$'; }

# lose RANK FOLDER: kill this rank as soon as a block is finished; sets $killed, in seconds
lose() {
   rm -f err.?
   mpi=./own_err
   start_ranks 3 deck.nml "$2"
   mpi=$direct
   while kill -0 $job 2>/dev/null && [ "$(parts "$2")" = 0 ]; do sleep 0.05; done
   kill -9 "$(cat "pid.$1")"
   killed=$(date +%s)
   ( sleep 60; kill -9 $job; for rank in 0 1 2; do kill -9 "$(cat pid.$rank)"; done ) >/dev/null 2>&1 &
   guard=$!
}

# ended LIMIT: mpiexec is done in so many seconds after the kill
ended() {
   wait $job
   took=$(($(date +%s) - killed))
   kill $guard 2>/dev/null
   if [ $took -le "$1" ]; then pass "ended $took s after the kill"; else wrong "ended only $took s after the kill"; cat err.txt err.?; fi
   holds "it says what has happened" grep -q 'one of the 3 ranks has died' err.0 err.1
   holds "and how to go on" grep -q -- '--resume' err.0 err.1
   fails "no half of a part is left" sh -c "ls $2/parts | grep new"
}

# mpirun lets them work for its patience, stops them, and kills them after as long again
export OMPI_MCA_odls_base_sigkill_timeout=3
lose 2 stopped
while kill -0 $job 2>/dev/null && ! grep -q 'stopping when the blocks under way' err.0; do sleep 0.01; done
before=$(parts stopped)
ended 9 stopped
kept=$(parts stopped)
last=$(ls stopped/parts | sed -n 's/^block_0*\([0-9]*\)\.part$/\1/p' | tail -n 1)
if [ "$kept" -gt "$before" ]; then pass "$((kept - before)) blocks under way were finished"; else wrong "blocks under way are lost"; fi
if [ $((last - kept)) -le 1 ]; then pass "$kept of the first $last blocks are kept"; else wrong "$kept of the first $last blocks are kept"; fi
holds "the log knows" grep -q 'failed.*ranks has died' stopped/run.log
fails "the lock is gone" test -e stopped/run.lock

# with --enable-recovery it does nothing to them, whoever has died
printf '#!/bin/sh\nexec "%s" --enable-recovery "$@"\n' "$mpiexec" >recovering
chmod 755 recovering
plain=$mpiexec
for rank in 0 1; do
   mpiexec=./recovering
   lose $rank lost$rank
   ended 30 lost$rank
   mpiexec=$plain
   kept=$(parts lost$rank)
   if [ "$kept" = 15 ]; then pass "15 of 16 blocks are kept"; else wrong "$kept of 16 blocks are kept"; fi
done

with_ranks 2
for folder in stopped lost0 lost1; do
   expect 0 'none failed' run deck.nml -o $folder --resume
   same whole $folder
done
finish
