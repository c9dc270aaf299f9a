# The same bytes with any number of threads and wherever they ran, failed cases and warnings included.
. "$(dirname "$0")/common.sh"
cat >deck.nml <<'END'
&run model = 'traditional', 'squeeze', block_size = 7, traces = .true., trace_dt_ms = 0.5 /
&hydro load = 'maali' /
&solver max_steps = 400 /
&sweep key = 'pressure.inlet_kpa', from = 5.0, to = 40.0, count = 8 /
&sweep key = 'film.gap_mm', from = 0.05, to = 0.30, count = 20 /
END
expect 1 'failed \(.*too_many_steps\)' run deck.nml -o one --threads 1
holds "some cases failed" grep -q ',too_many_steps,' one/summary.csv
holds "and some did not" grep -q ',ok,' one/summary.csv
for threads in 2 4; do
   for again in 1 2; do
      rm -rf many
      expect 1 '' run deck.nml -o many --threads $threads
      same one many
   done
done

# a thread's table of the film does not depend on the gap it met first
cat >film.nml <<'END'
&run model = 'film_table', block_size = 1, t_end_ms = 25.0 /
&sweep key = 'film.gap_mm', values = 0.05, 0.1, 0.2, 0.3 /
END
expect 0 'none failed' run film.nml -o film_one --threads 1
expect 0 'none failed' run film.nml -o film_two --threads 2
same film_one film_two
for slice in 4 3 2 1; do expect 0 '' run film.nml -o film_slices --slice $slice/4; done
expect 0 'none failed' merge film_slices
same film_one film_slices

sleep 1.1   # a time stamp would show
mkdir elsewhere
cp deck.nml elsewhere
(cd elsewhere && "$program" run deck.nml --quiet) 2>/dev/null
same one elsewhere/deck
finish
