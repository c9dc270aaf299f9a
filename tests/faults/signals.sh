# Ctrl-C and SIGTERM: the blocks under way are finished, exit 1, a message how to go on, and the same bytes in the end.
. "$(dirname "$0")/common.sh"
sweep_deck "$(slow_count 600)" >deck.nml
expect 0 'none failed' run deck.nml -o whole
for signal in INT TERM; do
   for threads in 1 2; do
      rm -rf part
      stop_midway part $signal $threads
      if [ $got = 1 ]; then pass "exit status 1"; else wrong "exit status $got instead of 1"; fi
      holds "it says at once that it will stop" grep -q 'stopping when the blocks under way are done' err.txt
      holds "it says how to go on" grep -q 'go on with: reedvalve run deck.nml -o part --resume' err.txt
      holds "the log knows" grep -q 'stopped on request' part/run.log
      fails "the lock is gone" test -e part/run.lock
      fails "no half-written part is left" sh -c 'ls part/parts | grep new'
      expect 0 'none failed' run deck.nml -o part --resume
      same whole part
   done
done
finish
