# kill -9 of the program, or of one rank, at twenty random moments; --resume with other workers: the bytes of an
# unbroken run.
# sh kills.sh PROGRAM RTOL [MPI_PROGRAM MPIEXEC]
. "$(dirname "$0")/ranks_common.sh"
mixed_deck "$(slow_count 400 mixed_deck)" >deck.nml
length=$(milliseconds deck.nml)
expect 0 'none failed' run deck.nml -o whole
seed=$(od -An -N2 -tu2 /dev/urandom | tr -d ' ')
echo "  seed $seed, an unbroken run takes $length ms of one processor"

# draw LIMIT: sets $drawn to a whole number from 0 to LIMIT - 1, the next one of the seed
draw() {
   seed=$(((seed * 75 + 74) % 65537))
   drawn=$((seed * $1 / 65537))
}

# resume HOW: finish the run in folder broken
resume() {
   program=$own
   case $1 in
   0 | 1 | 2) expect 0 'none failed' run deck.nml -o broken --resume --threads $(($1 + 1)) ;;
   3)
      for slice in 3 1 2; do expect 0 'none failed' run deck.nml -o broken --resume --slice $slice/3 --threads 1; done
      # a run that was over before its kill has its results and no parts
      if [ -d broken/parts ]; then expect 0 'none failed' merge broken; fi
      ;;
   *)
      with_ranks $(($1 - 2))
      expect 0 'none failed' run deck.nml -o broken --resume
      ;;
   esac
}

hits=0
left=0
ways=4
if [ -n "$mpi" ]; then ways=6; fi
for round in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
   rm -rf broken
   draw $((length * 6 / 10))
   moment=$(printf '%d.%03d' $((drawn / 1000)) $((drawn % 1000)))
   if [ -n "$mpi" ] && [ $((round % 3)) = 0 ]; then
      ranks=$((2 + round % 2))
      start_ranks $ranks deck.nml broken
      draw $ranks
      who="rank $drawn of $ranks"
      victim=$(cat pid.$drawn)
   else
      threads=$((1 + round % 2))
      "$own" run deck.nml -o broken --quiet --threads $threads &
      job=$!
      victim=$job
      who="a run on $threads threads"
   fi
   sleep "$moment"
   if kill -9 "$victim" 2>/dev/null; then hits=$((hits + 1)); fi
   wait $job 2>/dev/null
   kept=$(ls broken/parts 2>/dev/null | grep -c 'part$')
   if [ "$kept" -lt 16 ] && [ ! -e broken/results.nc ]; then left=$((left + 1)); fi
   echo "  round $round: $who killed after $moment s, $kept of 16 blocks kept"
   draw $ways
   resume $drawn
   same whole broken
   fails "nothing else is left" sh -c 'ls broken | grep -v -E "^(results.nc|summary.csv|run.log)$"'
done
if [ $hits -ge 10 ]; then pass "$hits kills hit a running program"; else wrong "only $hits kills hit a running program"; fi
if [ $left -ge 5 ]; then pass "$left left work to do"; else wrong "only $left left work to do"; fi
finish
