# Ctrl-C, SIGTERM and a lost connection: the blocks under way are finished, exit 1, a message how to go on, and the same bytes in the end.
. "$(dirname "$0")/common.sh"
sweep_deck "$(slow_count 400)" >deck.nml
expect 0 'none failed' run deck.nml -o whole
for signal in 'INT 1' 'TERM 2' 'HUP 2'; do
   rm -rf part
   stop_midway part $signal
   if [ $got = 1 ]; then pass "exit status 1"; else wrong "exit status $got instead of 1"; fi
   holds "it says at once that it will stop" grep -q 'stopping when the blocks under way are done' err.txt
   holds "it says how to go on" grep -q 'go on with: reedvalve run deck.nml -o part --resume' err.txt
   holds "the log knows" grep -q 'stopped on request' part/run.log
   fails "the lock is gone" test -e part/run.lock
   fails "no half-written part is left" sh -c 'ls part/parts | grep new'
   expect 0 'none failed' run deck.nml -o part --resume
   same whole part
done

# under nohup a lost connection stops nothing
own=$program
printf '#!/bin/sh\ntrap "" HUP\nexec "%s" "$@"\n' "$own" >deaf
chmod 755 deaf
program=./deaf
"$program" run deck.nml -o deaf_run --threads 1 >out.txt 2>err.txt &
victim=$!
while kill -0 $victim 2>/dev/null && [ ! -e deaf_run/parts/block_000000001.part ]; do :; done
kill -HUP $victim
wait $victim
got=$?
if [ $got = 0 ]; then pass "SIGHUP that is ignored stays so"; else wrong "exit status $got instead of 0"; fi
finish
