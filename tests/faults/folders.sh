# What a results folder may hold, and what is done about it.
. "$(dirname "$0")/common.sh"
sweep_deck "$(slow_count 300)" >deck.nml
sed 's/0.30/0.35/' deck.nml >other.nml
expect 0 'none failed' run deck.nml -o whole

# results that are there
cp -r whole copy
expect 2 "'copy' holds results.*--force" run deck.nml -o copy
same whole copy
expect 0 'finished before; nothing was run' run deck.nml -o copy --resume
same whole copy
expect 2 "another deck, 'deck'" run other.nml -o copy --resume
same whole copy
expect 0 'none failed' run other.nml -o copy --force
fails "--force replaced the results" cmp whole/results.nc copy/results.nc
expect 0 'none failed' run deck.nml -o copy --force
same whole copy
rm copy/results.nc
expect 2 "'copy' holds results" run deck.nml -o copy
unseen="cannot tell whether the results in 'copy' are of this run: cannot read 'copy/results.nc'"
expect 3 "$unseen: No such file.* or replace them with --force" run deck.nml -o copy --resume
head -c 20000 whole/results.nc >copy/results.nc
expect 3 "$unseen: NetCDF: HDF error" run deck.nml -o copy --resume
expect 0 'none failed' run deck.nml -o copy --force
same whole copy

# an unfinished run
stop_midway part KILL 2
cp -r part stopped
holds "the lock of a killed run is left" test -e part/run.lock
expect 2 "'part' holds an unfinished run: --resume" run deck.nml -o part
expect 2 "another deck, 'deck'" run other.nml -o part --resume
cp deck.nml keep.nml
echo '! edited' >>deck.nml
expect 2 'the deck was edited since' run deck.nml -o part --resume
cp keep.nml deck.nml
expect 3 '[0-9]+ of 16 blocks are not finished \([0-9, ]+(\.\.\.)?\)' merge part
cp -r part copied
expect 0 'of them were run now, the others before' run deck.nml -o part --resume
same whole part
expect 2 'nothing to merge' merge part
expect 0 'none failed' run other.nml -o copied --force
fails "--force dropped the parts" test -e copied/parts
expect 0 'none failed' run deck.nml -o new --resume
same whole new

# parts that are not as they were written
stop_midway part2 KILL 1
first=part2/parts/block_000000001.part
cp $first good.part
for damage in flip cut grow empty foreign; do
   rm -rf trial
   cp -r part2 trial
   first=trial/parts/block_000000001.part
   case $damage in
   flip) printf '\377' | dd of=$first bs=1 seek=2500 conv=notrunc 2>/dev/null ;;
   cut) head -c 2500 good.part >$first ;;
   grow) echo >>$first ;;
   empty) : >$first ;;
   foreign)
      rm -rf mine
      mv deck.nml aside.nml
      mv other.nml deck.nml
      stop_midway mine KILL 1
      mv deck.nml other.nml
      mv aside.nml deck.nml
      cp mine/parts/block_000000001.part $first ;;
   esac
   expect 0 '1 part file in .* could not be used' run deck.nml -o trial --resume
   same whole trial
done
rm -rf trial
cp -r part2 trial
echo damaged >trial/parts/manifest
expect 3 "cannot use 'trial/parts/manifest': it is damaged; remove it" run deck.nml -o trial --resume
expect 3 "cannot use 'trial/parts/manifest': it is damaged; remove it" merge trial
: >trial/parts/manifest
expect 3 "it is empty; remove it, and run ... --resume" run deck.nml -o trial --resume
cp -r trial dropped
expect 0 'none failed' run deck.nml -o dropped --force
same whole dropped
rm trial/parts/manifest
expect 0 'none failed.* of them were run now, the others before' run deck.nml -o trial --resume
same whole trial

# a file the deck names has changed
printf 'film.gap_mm\n' >plan.csv
awk 'BEGIN { for (i = 1; i <= 400; i++) print 0.05 + i*1e-4 }' >>plan.csv
mv deck.nml aside.nml
printf "&run block_size = 30 /\n&solver rtol = $rtol /\n&design file = 'plan.csv' /\n" >deck.nml
stop_midway design KILL 1
echo 0.2 >>plan.csv
expect 2 'a file that the deck names was changed since' run deck.nml -o design --resume
mv aside.nml deck.nml

# places that cannot hold a folder
expect 3 "cannot make the folder 'no/such/place': there is no folder 'no/such'" run deck.nml -o no/such/place
expect 3 "'deck.nml' is a file, and the results need a folder" run deck.nml -o deck.nml
expect 3 "there is no folder 'nowhere'" merge nowhere
cp deck.nml plain
expect 3 "'plain' is a file, and the results need a folder: choose one with -o" run plain
mkdir -p mine2
expect 0 'none failed' run deck.nml -o mine2///
holds "slashes at the end do no harm" test -e mine2/results.nc

# two runs in one folder; the first is held still, to be sure that it is there
"$program" run deck.nml -o shared --quiet --threads 1 &
first=$!
while kill -0 $first 2>/dev/null && [ ! -e shared/parts/manifest ]; do :; done
kill -STOP $first
expect 3 "another run is at work in 'shared' \(process $first on .*\): wait" run deck.nml -o shared
expect 3 "another run is at work" run deck.nml -o shared --force
expect 3 "another run is at work" merge shared
kill -CONT $first
wait $first
same whole shared

# no permission: root writes everywhere, so it lends itself to nobody
mkdir locked
chmod 555 locked
if [ "$(id -u)" = 0 ]; then
   if setpriv --reuid=65534 --regid=65534 --clear-groups "$program" --version >/dev/null 2>&1; then
      chmod 755 .
      own=$program
      program=./as_nobody
      printf '#!/bin/sh\nexec setpriv --reuid=65534 --regid=65534 --clear-groups "%s" "$@"\n' "$own" >as_nobody
      chmod 755 as_nobody
   else
      program=none
      echo "  left out: folders without permission (root writes everywhere, and nobody cannot run the program here)"
   fi
fi
if [ "$program" != none ]; then
   expect 3 "cannot make the folder 'locked/new': Permission denied" run deck.nml -o locked/new
   expect 3 "cannot lock 'locked/run.lock': Permission denied" run deck.nml -o locked
   cp -r whole hidden
   chmod 777 hidden
   chmod 666 hidden/run.log
   chmod 000 hidden/results.nc
   expect 3 "cannot tell whether .* cannot read 'hidden/results.nc': Permission denied" run deck.nml -o hidden --resume
fi
finish
