# One of three ranks is killed and mpirun lets the others go on: they run all blocks but one and end by themselves;
# --resume runs what was lost.
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
sweep_deck "$(slow_count 6000)" >deck.nml
expect 0 'none failed' run deck.nml -o whole

parts() { ls "$1/parts" | grep -c 'part$'; }

# lose RANK FOLDER: kill this rank as soon as a block is finished
lose() {
   rm -f err.?
   mpi=./own_err
   start_ranks 3 deck.nml "$2"
   mpi=$direct
   while kill -0 $job 2>/dev/null && [ "$(parts "$2")" = 0 ]; do sleep 0.05; done
   kill -9 "$(cat "pid.$1")"
   ( sleep 120; kill -9 $job; for rank in 0 1 2; do kill -9 "$(cat pid.$rank)"; done ) >/dev/null 2>&1 &
   guard=$!
}

# ended FOLDER: mpiexec ends without the guard
ended() {
   wait $job
   holds "ended by themselves" kill $guard
   holds "it says what has happened" grep -q 'one of the 3 ranks has died' err.0 err.1
   holds "and how to go on" grep -q -- '--resume' err.0 err.1
   fails "no half of a part is left" sh -c "ls $1/parts | grep new"
}

printf '#!/bin/sh\nexec "%s" --enable-recovery "$@"\n' "$mpiexec" >recovering
chmod 755 recovering
plain=$mpiexec
for rank in 0 1; do
   mpiexec=./recovering
   lose $rank lost$rank
   ended lost$rank
   mpiexec=$plain
   kept=$(parts lost$rank)
   if [ "$kept" -ge 15 ]; then pass "$kept of 16 blocks are kept"; else wrong "$kept of 16 blocks are kept"; fi
done

with_ranks 2
for folder in lost0 lost1; do
   expect 0 'none failed' run deck.nml -o $folder --resume
   same whole $folder
done
finish
