# Broken decks: exit 2 or 3, a message that names place and cure, and no results folder.
. "$(dirname "$0")/common.sh"

# broken STATUS WORDS: deck bad.nml as it stands
broken() {
   expect "$1" "$2" run bad.nml
   for name in bad bad.nml.d results parts; do
      if [ -e $name ]; then wrong "the broken deck left '$name' behind"; rm -rf $name; fi
   done
}

# deck LINES: bad.nml
deck() { printf '%s\n' "$@" >bad.nml; }

deck "&run model = 'squeeze' /" "&film gap_mm = -0.05 /";             broken 2 'bad.nml:2:.*film.gap_mm = -0.05: must be >= 0 [(]mm[)]'
deck "&film gap = 0.05 /";                                            broken 2 'bad.nml:1:.*gap_mm'
deck "&flim gap_mm = 0.05 /";                                         broken 2 'bad.nml:1:.*film'
deck "&run model = 'sqeeze' /";                                       broken 2 'bad.nml:1:.*squeeze'
deck "&film gap_mm = 0.05, gap_mm = 0.06 /";                          broken 2 'bad.nml:1:.*a second time; the first is in line 1'
deck "&film gap_mm = nan /";                                          broken 2 'bad.nml:1:.*NaN'
deck "&film gap_mm = inf /";                                          broken 2 'bad.nml:1:.*infinity'
deck "&film gap_mm = 1.0e999 /";                                      broken 2 'bad.nml:1:.*too large'
deck "&film gap_mm = 'wide' /";                                       broken 2 'bad.nml:1:.*without quotes'
deck "&film gap_mm = 0.05, 0.06 /";                                   broken 2 'bad.nml:1:.*sweep'
deck "&run traces = 7 /";                                             broken 2 'bad.nml:1:.*true'
deck "&run block_size = 2.5 /";                                       broken 2 'bad.nml:1:.*whole number'
deck "&film gap_mm = 0.05" "&run /";                                  broken 2 'bad.nml:.*/'
deck "&run title = 'unfinished /";                                    broken 2 'bad.nml:1:.*text is not closed'
deck "&pressure file = a/b.csv /";                                    broken 2 'bad.nml:1:.*quote'
deck "&run /" "stray words";                                          broken 2 'bad.nml:2:'
deck "&run title = '$(printf '%0300d' 0)' /";                         broken 2 'bad.nml:1:.*200'
deck "&sweep key = 'film.gapmm', values = 0.1 /";                     broken 2 'bad.nml:1:.*film.gap_mm'
deck "&sweep key = 'film.gap_mm', from = 0.1, to = 0.2 /";            broken 2 'bad.nml:1:.*count'
deck "&sweep key = 'film.gap_mm', values = 0.1, -0.1 /";              broken 2 'bad.nml:1:.*-0.1'
deck "&pressure kind = 'trace' /";                                    broken 2 'bad.nml:.*file'
deck "&pressure kind = 'trace', file = 'none.csv', event_ms = 1.0 /"; broken 2 'bad.nml:1:.*none.csv.*no such file'
deck "&design file = 'none.csv' /";                                   broken 2 'bad.nml:1:.*none.csv.*no such file'
deck "&sweep key = 'film.gap_mm', from = 0.1, to = 0.2, count = 1000000 /" \
     "&sweep key = 'pressure.inlet_kpa', from = 1.0, to = 2.0, count = 1000000 /"; broken 2 'bad.nml:.*cases'

printf '' >bad.nml;                                                   broken 2 'bad.nml.*empty'
printf '&run model = "squeeze"' >bad.nml;                             broken 2 "bad.nml:1:.*/"
printf '\177ELF\002\001\001\000\000\000' >bad.nml;                    broken 2 'bad.nml.*(binary|text)'
printf '\211HDF\r\n\032\n\000' >bad.nml;                              broken 2 'bad.nml.*binary'
printf '\377\376&\000r\000' >bad.nml;                                 broken 2 'bad.nml.*UTF-8'
rm bad.nml; truncate -s 1G bad.nml;                                   broken 2 'bad.nml.*1073741824 bytes'
rm bad.nml;                                                           broken 3 "bad.nml.*no such file"
mkdir bad.nml;                                                        broken 3 "bad.nml.*folder"
rmdir bad.nml
mkfifo bad.nml;                                                       broken 3 "'bad.nml' is a pipe or a device"
rm bad.nml
deck "&run /"
expect 3 "'bad': there is no such file; did you mean 'bad.nml'[?]" run bad
mkdir bad
expect 3 "'bad/' is a folder; name a file in it; did you mean 'bad.nml'[?]" run bad/
mv bad elsewhere
touch elsewhere/results.nc
expect 3 "'elsewhere' is a folder with results, not a deck" check elsewhere
rm -r elsewhere
deck "&film gap_mm = -0.05, gep_mm = 1 /" "&reed a_mm = 'x' /"
broken 2 '3 faults'

# a fault in a file that the deck names
deck "&pressure kind = 'trace', file = 'p.csv', event_ms = 1.0 /"
printf 't_ms,p_diff_kpa\n0,1\n1,nan\n2,3\n' >p.csv;                   broken 2 'p.csv:3:'
deck "&design file = 'plan.csv' /"
printf 'film.gap_mm\n0.1\n-0.2\n' >plan.csv;                          broken 2 'plan.csv:3:'

# no permission: root reads everything, so it lends itself to nobody
deck "&run /"
chmod 000 bad.nml
if [ "$(id -u)" != 0 ]; then
   broken 3 'bad.nml.*[Pp]ermission'
elif setpriv --reuid=65534 --regid=65534 --clear-groups "$program" --version >/dev/null 2>&1; then
   chmod 777 .
   own=$program
   program=./as_nobody
   printf '#!/bin/sh\nexec setpriv --reuid=65534 --regid=65534 --clear-groups "%s" "$@"\n' "$own" >as_nobody
   chmod 755 as_nobody
   broken 3 'bad.nml.*[Pp]ermission'
else
   echo "  left out: reading without permission (root reads everything, and nobody cannot run the program here)"
fi
finish
