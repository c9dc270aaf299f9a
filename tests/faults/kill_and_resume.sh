# kill -9 at random moments, then --resume with another number of threads: the bytes of an unbroken run.
. "$(dirname "$0")/common.sh"
sweep_deck "$(slow_count 400)" >deck.nml

start=$(date +%s%N)
expect 0 'none failed' run deck.nml -o whole --threads 2
length=$((($(date +%s%N) - start) / 1000000))   # [ms]

seed=$(od -An -N2 -tu2 /dev/urandom | tr -d ' ')
echo "  seed $seed, an unbroken run takes $length ms"
killed=0
for round in 1 2; do
   rm -rf broken
   # two kills, the second in a resumed run
   for attempt in 1 2; do
      moment=$(awk -v s="$seed" -v r="$round$attempt" -v l="$length" \
         'BEGIN { srand(s + r); printf "%.3f", (0.05 + 0.8*rand())*l/1000/'$attempt' }')
      "$program" run deck.nml -o broken --resume --quiet --threads "$attempt" &
      victim=$!
      sleep "$moment"
      kill -9 $victim 2>/dev/null && killed=$((killed + 1))
      wait $victim 2>/dev/null
   done
   kept=$(ls broken/parts 2>/dev/null | grep -c 'part$')
   expect 0 'none failed' run deck.nml -o broken --resume --threads $((round % 3 + 1))
   echo "  killed for good with $kept blocks kept"
   same whole broken
   fails "no parts are left" test -e broken/parts
   fails "no lock is left" test -e broken/run.lock
done
if [ $killed -gt 0 ]; then pass "$killed kills hit a running program"; else wrong "only $killed kills hit a running program"; fi

# in the middle of the merge
rm -rf broken
"$program" run deck.nml -o broken --quiet &
victim=$!
while [ ! -e broken/results.nc ] && [ ! -e broken/results.nc.new ]; do sleep 0.002; done
kill -9 $victim 2>/dev/null
wait $victim 2>/dev/null
if [ -e broken/parts/manifest ]; then
   expect 0 'none failed' merge broken
else
   echo "  the merge was over before it could be killed"
fi
same whole broken
fails "nothing half-written is left" test -e broken/results.nc.new
finish
