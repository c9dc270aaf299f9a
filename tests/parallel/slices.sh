# Slices of a run: in any order, at once, killed, stopped, resumed as something else; always the same bytes.
. "$(dirname "$0")/../faults/common.sh"
mixed_deck 20 1.0e-6 >deck.nml
sweep_deck 21 1.0e-6 >other.nml
sweep_deck "$(slow_count 600)" >slow.nml
expect 0 'none failed' run deck.nml -o whole
for method in implicit explicit; do
   sed "s/'auto'/'$method'/" deck.nml >$method.nml
   expect 0 'none failed' run $method.nml
   fails "not all of it is $method" cmp whole/summary.csv $method/summary.csv
done

# words
for words in 0/7 8/7 -1/7 1/0 1 /7 1/ 1/2/3 a/b 1.5/2 ' 1/2' 1000001/1000001; do
   expect 2 '1 <= I <= N|needs a value' run deck.nml -o none --slice "$words"
done
expect 2 'choose one' run deck.nml -o none --slice 1/7 --force
expect 2 "no option '--slice'" merge none --slice 1/7
fails "none of these made a folder" test -e none

# one after another, the last one told what is next
for slice in 5 2 7 1 3 6; do
   expect 0 "^Slice $slice/7: .* none failed" run deck.nml -o sliced --slice $slice/7 --threads $((slice % 2 + 1))
done
expect 3 '2 of 16 blocks are not finished \(4, 11\): run the slices that are missing' merge sliced
expect 2 "holds finished blocks of slice 3/7: --resume" run deck.nml -o sliced --slice 3/7
expect 0 "Slice 3/7: .* none failed" run deck.nml -o sliced --slice 3/7 --resume
expect 2 "holds an unfinished run" run deck.nml -o sliced
expect 2 "another deck, 'deck'" run other.nml -o sliced --slice 4/7
expect 0 'All blocks of the run are finished. For the results: reedvalve merge sliced' run deck.nml -o sliced --slice 4/7
fails "a slice writes no results" test -e sliced/results.nc
expect 0 'none failed' merge sliced
same whole sliced
fails "no parts are left" test -e sliced/parts
fails "no lock is left" test -e sliced/run.lock
expect 2 "'sliced' holds results" run deck.nml -o sliced --slice 3/7
expect 0 'finished before; nothing was run' run deck.nml -o sliced --slice 3/7 --resume
expect 2 "another deck, 'deck'" run other.nml -o sliced --slice 3/7 --resume

# one slice that is all, slices that are nothing
expect 0 'All blocks' run deck.nml -o only --slice 1/1
expect 0 'Slice 17/17: 0 cases' run deck.nml -o only --slice 17/17
expect 0 'none failed' merge only
same whole only

# at once
for round in 1 2 3; do
   rm -rf at_once
   running=
   for slice in 1 2 3 4 5 6 7; do
      "$program" run deck.nml -o at_once --slice $slice/7 --threads 1 --quiet 2>err.$slice &
      running="$running $!"
   done
   bad=0
   for job in $running; do wait "$job" || bad=$((bad + 1)); done
   if [ $bad = 0 ]; then pass "seven slices at once"; else wrong "$bad of seven slices failed"; cat err.?; fi
   expect 0 'none failed' merge at_once
   same whole at_once
done

# slices of two decks at once: one deck has the folder, the others are refused
running=
for slice in 1 2 3; do
   for deck in deck other; do
      "$program" run $deck.nml -o contested --slice $slice/3 --threads 1 --quiet 2>/dev/null &
      running="$running $!"
   done
done
refused=0
for job in $running; do wait "$job" || refused=$((refused + ($? == 2))); done
if [ $refused = 3 ]; then pass "one of two decks has the folder"; else wrong "$refused of 6 slices were refused"; fi
expect 0 'none failed' merge contested

# while slices are at work (held still, to be sure) others may join, and nobody may take the folder
# slice_holds FOLDER I: start slice I of 3 and hold it still once it is at work
slice_holds() {
   "$program" run slow.nml -o "$1" --slice "$2/3" --threads 1 --quiet &
   slice=$!
   while kill -0 $slice 2>/dev/null && [ ! -s "$1/parts/slice_$2_of_3.lock" ]; do :; done
   kill -STOP $slice
}
slice_holds busy 2
first=$slice
expect 3 "another run is at work in 'busy' \(process $first on .*\): wait" run slow.nml -o busy --resume
expect 3 "another run is at work" run slow.nml -o busy --force
expect 3 "another run is at work" merge busy
expect 3 "slice 2/3 is at work in 'busy' already \(process $first on .*\): wait" run slow.nml -o busy --slice 2/3
expect 3 "slice 2/3 is at work" run slow.nml -o busy --slice 2/3 --resume
expect 0 'Slice 17/17: 0 cases' run slow.nml -o busy --slice 17/17
expect 3 "another run is at work" merge busy   # who ends takes the lock of nobody else away
slice_holds busy 1
second=$slice
kill -9 $first
wait $first 2>/dev/null
expect 3 "another run is at work in 'busy' \(process $second on .*\)" merge busy
kill -TERM $second
kill -CONT $second
wait $second
got=$?
if [ $got = 1 ]; then pass "a slice stops on request"; else wrong "exit status $got instead of 1"; fi
kept=$(ls busy/parts | grep -c 'part$')
if [ "$kept" -lt 16 ]; then pass "$kept of 16 blocks are kept"; else wrong "nothing is left to resume"; fi
fails "no lock is left" test -e busy/run.lock
expect 0 'none failed' run slow.nml -o busy --slice 2/3 --resume
expect 0 'none failed' run slow.nml -o busy --resume
expect 0 'none failed' run slow.nml -o whole_slow
same whole_slow busy
fails "nothing half-written is left" sh -c 'ls busy | grep -v -E "^(results.nc|summary.csv|run.log)$"'

# a stopped slice says how to go on
"$program" run slow.nml -o stopped --slice 1/2 --threads 1 >out.txt 2>err.txt &
first=$!
while kill -0 $first 2>/dev/null && [ ! -e stopped/parts/block_000000001.part ]; do :; done
kill -USR1 $first
wait $first
got=$?
if [ $got = 1 ]; then pass "SIGUSR1 stops, too"; else wrong "exit status $got instead of 1"; fi
holds "it says how to go on" grep -q 'go on with: reedvalve run slow.nml -o stopped --slice 1/2 --resume' err.txt

# failed cases
sed 's/rtol/max_steps = 150, rtol/' deck.nml >failing.nml
expect 1 'Slice 1/2: 320 cases?, [0-9]+ failed|Slice 1/2: 160 cases, [0-9]+ failed' run failing.nml --slice 1/2
finish
