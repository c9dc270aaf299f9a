# What the scripts of this folder share. Each is called as: sh script PROGRAM [RTOL]
# RTOL makes a sweep slow enough to be hit in its middle; a slow build of the program needs none so fine.
# A script works in a folder of its own, says every check, and fails if any check did or none was made.
set -u
program=$1
rtol=${2:-1.0e-10}
work=$(mktemp -d "${TMPDIR:-/tmp}/reedvalve-faults.XXXXXX")
passed=0
failed=0
skip=77
cleanup=:
trap 'eval "$cleanup"; cd /; rm -rf "$work"' EXIT
trap 'exit 1' INT TERM
cd "$work" || exit 1

# pass TEXT / wrong TEXT: one check
pass() { passed=$((passed + 1)); echo "  ok    $1"; }
wrong() { failed=$((failed + 1)); echo "  WRONG $1"; }

# holds TEXT COMMAND...: the command succeeds
holds() {
   what=$1
   shift
   if "$@" >/dev/null 2>&1; then pass "$what"; else wrong "$what"; fi
}

# fails TEXT COMMAND...: the command does not succeed
fails() {
   what=$1
   shift
   if "$@" >/dev/null 2>&1; then wrong "$what"; else pass "$what"; fi
}

# expect STATUS WORDS ARGUMENTS...: reedvalve ends with that status and says those words (an extended
# regular expression, empty for anything) on standard output or error
expect() {
   status=$1
   words=$2
   shift 2
   "$program" "$@" >out.txt 2>err.txt
   got=$?
   if [ "$got" != "$status" ]; then
      wrong "reedvalve $*: exit status $got instead of $status"
      sed 's/^/        /' out.txt err.txt
   elif [ -n "$words" ] && ! cat out.txt err.txt | grep -Eq -- "$words"; then
      wrong "reedvalve $*: does not say '$words'"
      sed 's/^/        /' out.txt err.txt
   else
      pass "reedvalve $*: $status, says '$words'"
   fi
}

# same FOLDER FOLDER: both results are there and the same bytes
same() {
   for name in results.nc summary.csv; do
      if cmp "$1/$name" "$2/$name"; then pass "$1/$name and $2/$name are the same bytes"
      else wrong "$1/$name and $2/$name differ"; fi
   done
}

# stop_midway FOLDER SIGNAL THREADS: run deck.nml and send the signal once the first block is finished; held still, a run
# cannot be over before the signal is on its way
stop_midway() {
   "$program" run deck.nml -o "$1" --threads "$3" >out.txt 2>err.txt &
   victim=$!
   while kill -0 $victim 2>/dev/null && [ ! -e "$1/parts/block_000000001.part" ]; do :; done
   kill -STOP $victim
   kill "-$2" $victim
   kill -CONT $victim 2>/dev/null
   wait $victim 2>/dev/null
   got=$?
   if [ -e "$1/parts/manifest" ] && [ ! -e "$1/results.nc" ]; then pass "stopped midway by $2 with some of $1 done"
   else wrong "a run could not be stopped midway by $2"; fi
}

# sweep_deck CASES [RTOL]: a sweep of 16 blocks of so many cases each, slow enough to be hit in its middle
sweep_deck() {
   cat <<END
&run model = 'traditional', 'squeeze', block_size = $1 /
&solver rtol = ${2:-$rtol} /
&sweep key = 'pressure.inlet_kpa', from = 5.0, to = 40.0, count = $1 /
&sweep key = 'film.gap_mm', values = 0.05, 0.06, 0.08, 0.10, 0.15, 0.20, 0.25, 0.30 /
END
}

# mixed_deck CASES [RTOL]: the same of films on both sides of where 'auto' changes the method, computed and tabulated; a
# group has few lanes, so that a block has groups of either method
mixed_deck() {
   sweep_deck "$@" | sed -e "s/'traditional', 'squeeze'/'squeeze', 'film_table'/" \
      -e "s/&solver/& method = 'auto', width = 4,/" -e 's/0.05, 0.06, 0.08/0.02, 0.03, 0.04/'
}

# milliseconds DECK: processor time of a run on one thread, which other work on this machine does not change
milliseconds() {
   ("$program" run "$1" -o timed --force --quiet --threads 1 >out.txt 2>err.txt; times) \
      | awk 'NR == 2 { split($1, t, "m"); printf "%d", 1000*(60*t[1] + t[2]) }'
   rm -rf timed
}

# slow_count LENGTH [MAKER]: for sweep_deck, or another maker of decks, as many cases in a block as make a run on one
# thread take so many milliseconds
slow_count() {
   count=20
   for attempt in 1 2; do
      ${2:-sweep_deck} $count >try.nml
      length=$(milliseconds try.nml)
      [ $((4 * length)) -lt $((3 * $1)) ] || break
      count=$((count * $1 / (length + 1) + 1))
   done
   rm -f try.nml
   echo $count
}

finish() {
   echo "$passed passed, $failed failed"
   [ "$failed" = 0 ] && [ "$passed" -gt 0 ]
   exit
}
