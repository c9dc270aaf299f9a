# What is written, and what is not: compression, the summary that may be left out, and a disk that is too small,
# which is said before anything is computed.
. "$(dirname "$0")/common.sh"
deck() {
   cat <<END
&run model = 'traditional', 'squeeze', block_size = 7, traces = .true., trace_dt_ms = 0.5, $1 /
&sweep key = 'pressure.inlet_kpa', from = 5.0, to = 40.0, count = 16 /
&sweep key = 'film.gap_mm', values = 0.0, 0.05, 0.06, 0.08, 0.10, 0.15, 0.20, 0.25, 0.30 /
END
}
size() { wc -c <"$1"; }

deck 'compress = 0' >plain.nml
deck 'compress = 4' >small.nml
expect 1 'failed' run plain.nml --threads 2
expect 1 'failed' run small.nml -o one --threads 1
expect 1 'failed' run small.nml -o two --threads 2
expect 1 'failed' run small.nml -o four --threads 4
same one two
same one four
holds "compressed results are smaller" test "$(size one/results.nc)" -lt "$(size plain/results.nc)"
holds "the summary is the same" cmp plain/summary.csv one/summary.csv

deck "csv = 'never'" >none.nml
expect 1 'more failed; all of them are in .one/results.nc' run none.nml -o one --force
fails "no summary is written, and none of the run before is left" test -e one/summary.csv
holds "the log says so" grep -q 'no summary.csv' one/run.log
expect 1 '^Results: one/results.nc$' run none.nml -o one --force
expect 0 'for results.nc and no summary.csv, and .* for parts until it is written' cases none.nml
expect 0 'to compute, estimated from a few cases run just now. Writing comes on top.$' cases plain.nml
expect 0 'Writing comes on top: run.compress makes it slower.$' cases small.nml
holds "it tells the room of each file" grep -Eq '^[0-9]+ kB for results.nc and [0-9]+ kB for summary.csv, and [0-9]+ kB for parts until both are written.$' out.txt
deck "csv = 'always'" >always.nml
expect 1 '^Results: one/summary.csv and one/results.nc$' run always.nml -o one --force
holds "it is there again" test -e one/summary.csv

cat >huge.nml <<'END'
&run traces = .true., trace_dt_ms = 0.01, csv = 'never' /
&sweep key = 'pressure.inlet_kpa', from = 5.0, to = 40.0, count = 1000000 /
&sweep key = 'film.gap_mm', from = 0.05, to = 0.30, count = 500 /
END
expect 3 'no room for this run: about [0-9]+ TB of parts and [0-9]+ TB of results' run huge.nml
fails "nothing was computed" test -e huge/parts

# files that may not grow (ulimit -f, here of 2 KiB) are like a full disk: a sentence, not the system's signal
printf '#!/bin/sh\nulimit -f 4\nexec "%s" "$@"\n' "$program" >limited
chmod 755 limited
program=./limited
expect 3 'no room for this run|File too large' run plain.nml -o limited_run
finish
