# The command line: help, versions, mistakes, quiet, and decks that come from the program itself.
. "$(dirname "$0")/common.sh"
expect 0 'reedvalve run DECK' --help
expect 0 'reedvalve run DECK' run --help
expect 0 'SUNDIALS [0-9.]+, NetCDF [0-9.]+, NetCDF-Fortran [0-9.]+' --version
expect 2 'which command' 
expect 2 "did you mean 'run'" runn deck.nml
expect 2 "reedvalve run deck.nml" deck.nml
expect 2 'which DECK' run
expect 2 'which DIR' merge
expect 2 'one DECK at a time' run a.nml b.nml
expect 2 "did you mean '--force'" run a.nml --frce
expect 2 "no option '--force'" merge a --force
expect 2 "needs a value" run a.nml -o
expect 2 "takes no value" run a.nml --force=1
expect 2 "whole number from 1 to 1024, not '0'" run a.nml --threads 0
expect 2 "whole number from 1 to 1024, not 'two'" run a.nml --threads=two
expect 2 "choose one" run a.nml --resume --force
expect 2 "must be one of 'traditional', 'squeeze'" template sqeeze

for model in traditional squeeze; do
   "$program" template $model >$model.nml
   expect 0 "$model.nml is fine: 1 case" check $model.nml
   expect 0 '1 case, none failed' run $model.nml
done
expect 0 '^1 case in 1 block' cases squeeze.nml
cat >deck.nml <<'END'
&run model = 'traditional', 'squeeze' /
&sweep key = 'film.gap_mm', from = 0.1, to = 0.3, count = 3 /
END
expect 0 'film.gap_mm: 3 values, 0.1 to 0.3 mm' cases deck.nml
expect 0 'About .* with 1 thread' cases deck.nml --threads 1
fails "'cases' leaves no folder" test -e deck
expect 0 '6 cases, none failed' run deck.nml -odeck.d
holds "-oDIR is -o DIR" test -e deck.d/results.nc
expect 0 '' run deck.nml --quiet
if [ -s out.txt ] || [ -s err.txt ]; then wrong "--quiet prints"; else pass "--quiet prints nothing"; fi
head -n 1 deck/summary.csv >head.txt
echo 'case,model,film.gap_mm,steady_mm,rise_ms,opening_ms,overshoot_mm,fall_ms,closing_ms,zero_ms,undershoot_mm,peak_squeeze_n,status,message' >expected.txt
holds "the summary's header is as promised" cmp head.txt expected.txt
if [ -w /dev/full ]; then
   "$program" template >/dev/full 2>err.txt
   if [ $? = 3 ]; then pass "a full standard output: 3"; else wrong "a full standard output is not noticed"; fi
fi
"$program" run deck.nml --force >&- 2>&-
holds "closed standard files do no harm" cmp deck/results.nc deck.d/results.nc
finish
