# A case that fails is recorded with its reason, and the sweep goes on: exit 1, results written, failures listed.
. "$(dirname "$0")/common.sh"
cat >deck.nml <<'END'
&run model = 'traditional', 'squeeze', block_size = 5 /
&solver max_steps = 120 /
&sweep key = 'pressure.inlet_kpa', from = 5.0, to = 40.0, count = 8 /
&sweep key = 'pressure.period_ms', values = 40.0, 60.0 /
END
expect 1 '32 cases, [1-9][0-9]* failed \([0-9]+ too_many_steps\)' run deck.nml
holds "failures are listed" grep -Eq 'reedvalve: case [0-9]+ \(too_many_steps\): .*t = ' err.txt
rows=$(wc -l <deck/summary.csv)
if [ "$rows" = 33 ]; then pass "every case has its row"; else wrong "$rows rows instead of 33"; fi
failed_rows=$(grep -c ',too_many_steps,' deck/summary.csv)
told=$(sed -n 's/.*cases, \([0-9]*\) failed.*/\1/p' out.txt)
if [ "$failed_rows" = "$told" ]; then pass "$told failures told and written"; else wrong "$told told, $failed_rows written"; fi
holds "others went on" grep -q ',ok,' deck/summary.csv
expect 1 'too_many_steps' run deck.nml --force --quiet
if [ -s out.txt ]; then wrong "--quiet prints on standard output"; else pass "--quiet prints nothing but errors"; fi
expect 1 'finished before' run deck.nml --resume

# a case without hope does not keep its neighbour from its end; where the method is left to us, it is no reason to give up
# with_neighbour METHOD PRESSURE VISCOSITY: the paper's valve beside one that is drawn onto its seat; what became of both
with_neighbour() {
   printf 'film.gap_mm,pressure.inlet_kpa,fluid.viscosity_pa_s\n0.05,20,0.0484\n0.3,%s,%s\n' "$2" "$3" >both.csv
   printf "&solver method = '%s', max_steps = 3000 /\n&design file = 'both.csv' /\n" "$1" >both.nml
   "$program" run both.nml --force --quiet >/dev/null 2>&1
   became=$(tail -n 2 both/summary.csv | cut -d, -f 15 | tr '\n' ' ')
}
with_neighbour implicit -100000 1e-7
if [ "$became" = 'ok too_many_steps ' ]; then pass "implicit beside one without hope"; else wrong "implicit: $became"; fi
with_neighbour explicit -1000 0.0484
if [ "$became" = 'ok too_many_steps ' ]; then pass "explicit beside one without hope"; else wrong "explicit: $became"; fi
printf "&solver method = 'explicit' /\n" >paper.nml
expect 0 'none failed' run paper.nml
beside=$(sed -n 2p both/summary.csv | cut -d, -f 6-14)
alone=$(sed -n 2p paper/summary.csv | cut -d, -f 3-11)
if [ "$beside" = "$alone" ]; then pass "it is as it is alone"; else wrong "$beside and alone $alone"; fi
with_neighbour auto -1000 0.0484
if [ "$became" = 'ok ok ' ]; then pass "auto goes on implicitly"; else wrong "auto: $became"; fi

# a warning is not a failure
printf "&hydro load = 'maali' /\n&reed thickness_mm = 0.3 /\n" >warned.nml
expect 0 '1 of 1 cases is marked reynolds_range; the first is case 1: Re = [0-9.]* is outside the range' run warned.nml
holds "the summary has it" grep -q 'ok,.*Re = ' warned/summary.csv

# both film models watch for cavitation, without traces too
cat >suction.nml <<'END'
&run model = 'film', 'film_table', t_end_ms = 3.0 /
&film modes = 1, vapour_pressure_kpa = -20.0 /
END
expect 0 '2 of 2 cases are marked cavitation' run suction.nml
rows=$(grep -Ec 'ok,.*falls to -(39|4[0-3])[.0-9]* kPa, below the vapour pressure' suction/summary.csv)
if [ "$rows" = 2 ]; then pass "both tell how low"; else wrong "$rows of 2 tell how low: $(cat suction/summary.csv)"; fi

# each kind of warning is told with its first case, and with words where that case has no others
cat >warned_twice.nml <<'END'
&run model = 'film_table', t_end_ms = 3.0 /
&film modes = 1, vapour_pressure_kpa = -20.0 /
&hydro load = 'maali' /
&sweep key = 'reed.thickness_mm', values = 0.18, 0.3 /
END
expect 0 ' marked reynolds_range; the first is case 1$' run warned_twice.nml
holds "cavitation has its own case" grep -Eq ' marked cavitation; the first is case 1$' err.txt

# a film without a gap is closed before anything moves: its case ends there, whatever told the gap; others go on
for model in squeeze film film_table; do
   printf "&run model = '%s' /\n&film gap_mm = 0 /\n" $model >shut.nml
   expect 1 'case 1 \(film_closed\): at t = 0 ms: .*closed over the whole land: the gap is 0' run shut.nml --force
done
expect 0 'shut.nml:2:16: warning: film.gap_mm = 0: the film is closed from the start' check shut.nml
expect 0 'The film is closed at film.gap_mm = 0' modes shut.nml
printf "&run model = 'traditional' /\n&film gap_mm = 0 /\n" >shut.nml
expect 0 '1 case, none failed' run shut.nml --force
printf "film.gap_mm,pressure.period_ms\n0.05,40\n0,40\n0,30\n0.1,40\n" >shut.csv
printf "&run model = 'squeeze', 'film_table' /\n&design file = 'shut.csv' /\n" >shut.nml
expect 1 '8 cases, 4 failed \(4 film_closed\)' run shut.nml --force
if grep -Eqi 'nan|inf' shut/summary.csv; then wrong "NaN in the summary"; else pass "no NaN in the summary"; fi
finish
