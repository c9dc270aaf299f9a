# Progress on standard error: a bar on a terminal, a line now and then in a log, nothing when quiet.
here=$(cd "$(dirname "$0")" && pwd)
. "$(dirname "$0")/common.sh"
sweep_deck "$(slow_count 600)" >deck.nml
state='[0-9]+ of [0-9]+ cases, [0-9]+ %, [0-9.]+ cases/s, [0-9a-z. ]+ left'

# hold FOLDER OPTIONS...: start a run that logs to FOLDER.txt and hold it still when it is at work; $held is the process
hold() {
   folder=$1
   shift
   "$program" run deck.nml -o "$folder" --threads 1 "$@" >"$folder.out" 2>"$folder.txt" &
   held=$!
   while kill -0 $held 2>/dev/null && [ ! -e "$folder/parts/block_000000001.part" ]; do :; done
   kill -STOP $held
}
hold log
log=$held
hold quiet_log --quiet
quiet_log=$held
sleep 10.2 &   # longer than a log is left alone
pause=$!

# on a terminal, meanwhile
own=$program
if command -v python3 >/dev/null; then
   for columns in 80 30 0; do
      printf '#!/bin/sh\nexec python3 "%s/terminal.py" %d terminal.txt "%s" "$@"\n' "$here" $columns "$own" >on_terminal
      chmod 755 on_terminal
      program=./on_terminal
      expect 0 'none failed' run deck.nml -o shown --force --threads 1
      tr '\r' '\n' <terminal.txt | sed 's/\x1b\[K//' >bars.txt
      if [ $columns != 30 ]; then
         holds "a bar with rate and time left" grep -Eq "^\[#+-*\] $state$" bars.txt
         holds "it grows" test "$(sed 's/].*//' bars.txt | sort -u | grep -c '#')" -ge 2
      else
         holds "a narrow terminal has no bar" grep -Eq '^[0-9]+ of [0-9]+ cases, [0-9]+ %' bars.txt
         fails "none at all" grep -q '#' bars.txt
      fi
      if [ $columns = 0 ]; then widest=80; else widest=$columns; fi
      holds "no line is as wide as its $columns columns" awk "length(\$0) >= $widest { exit 1 }" bars.txt
      tail -c 4 terminal.txt >end.txt
      printf '\r\033[K' >expected.txt
      holds "nothing of it stays" cmp end.txt expected.txt
   done
   expect 0 '' run deck.nml -o shown --force --threads 1 --quiet
   fails "nothing on a terminal when quiet" test -s terminal.txt
   program=$own
else
   echo "  left out: a terminal (no python3 here)"
fi

# a log
expect 0 'none failed' run deck.nml -o short --threads 1
fails "nothing in the log of a short run" test -s err.txt
wait $pause
kill -CONT $log $quiet_log
wait $log
holds "a line now and then in the log of a long one" grep -Eq "^reedvalve: $state$" log.txt
told=$(wc -l <log.txt)
if [ "$told" = 1 ]; then pass "one in ten seconds"; else wrong "$told lines in ten seconds"; fi
fails "with nothing for terminals" grep -q "$(printf '\033')" log.txt
wait $quiet_log
fails "nothing in a log when quiet" test -s quiet_log.txt
holds "the quiet run is finished, too" cmp log/results.nc quiet_log/results.nc
finish
