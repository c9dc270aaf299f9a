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

# once more stops at once: nothing is finished, the lock is left, and the run can be resumed
sed 's/block_size = [0-9]*/block_size = 65536/' deck.nml >one_block.nml
for pause in 0.1 0.2 0.3; do   # for the block to begin
   rm -rf twice
   "$program" run one_block.nml -o twice --threads 1 >out.txt 2>err.txt &
   victim=$!
   while kill -0 $victim 2>/dev/null && [ ! -e twice/parts/manifest ]; do :; done
   sleep $pause
   kill -INT $victim
   while kill -0 $victim 2>/dev/null && ! grep -q 'once more stops at once' err.txt; do :; done
   kill -INT $victim 2>/dev/null
   wait $victim
   got=$?
   [ $got != 130 ] || break
done
if [ $got = 130 ]; then pass "a second Ctrl-C ends it by the signal"; else wrong "exit status $got instead of 130"; fi
holds "the lock is left" test -e twice/run.lock
fails "the block under way is lost" sh -c "ls twice/parts | grep 'part$'"
expect 0 'none failed' run one_block.nml -o twice --resume
fails "the lock is gone" test -e twice/run.lock

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
