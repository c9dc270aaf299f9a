!> Files that decks name: pressure traces and designs, and files that are no decks at all.
program test_files
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use, intrinsic :: iso_fortran_env, only : int64
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_keys, only : n_keys, key_run_model, key_run_start, key_run_t_end_ms, key_film_gap_mm, key_pressure_file, &
      & key_pressure_inlet_kpa, model_squeeze, model_traditional, start_equilibrium
   use rv_deck, only : deck_type, read_deck
   use check, only : suite_type
   use deck_trial, only : says, read_trial, write_file, lines
   implicit none
   type(suite_type) :: suite

   call good_traces()
   call trace_faults()
   call trace_rules()
   call good_designs()
   call design_faults()
   call no_decks()
   call suite%finish()

contains

   subroutine good_traces()
      type(deck_type) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      real(wp) :: value(n_keys)

      call write_file("a.csv", &
         & lines("# measured~~ T_ms , p_in_kPa,""p_out_kpa""~1,20,5~ 2.5, 10 ,5.5~# half way~3,0,6"))
      call write_file("b.csv", lines("p_diff_bar,t_s"//achar(13)//"~0.2,-0.001"//achar(13)//"~-1e-3,2d-3"//achar(13) &
         & //"~"))
      call read_trial("&pressure kind = 'trace', event_ms = 1.5 /~" &
         & //"&sweep key = 'pressure.file', values = 'a.csv', 'b.csv' /", &
         & deck, faults, error)
      call suite%text("traces: no faults", faults%all_text(), "")
      call suite%equal("traces: cases", int(deck%case_count()), 2)
      call suite%equal("trace a: rows", size(deck%trace(1)%time), 3)
      call suite%close("trace a: time", deck%trace(1)%time(2), 2.5e-3_wp, 0.0_wp, 0.0_wp)
      call suite%close("trace a: inlet", deck%trace(1)%inlet(2), 1.0e4_wp, 0.0_wp, 0.0_wp)
      call suite%close("trace a: outlet", deck%trace(1)%outlet(2), 5.5e3_wp, 0.0_wp, 0.0_wp)
      call suite%close("trace b: time", deck%trace(2)%time(1), -1.0e-3_wp, 0.0_wp, 0.0_wp)
      call suite%close("trace b: inlet", deck%trace(2)%inlet(1), 2.0e4_wp, 1.0e-15_wp, 0.0_wp)
      call suite%close("trace b: outlet", deck%trace(2)%outlet(2), 0.0_wp, 0.0_wp, 0.0_wp)
      call deck%case_values(1_i8, value)
      call suite%equal("traces: file of case 1", nint(value(key_pressure_file)), 1)
      call suite%equal("traces: start", nint(value(key_run_start)), start_equilibrium)
      call suite%close("traces: end of case 1", value(key_run_t_end_ms), 3.0e-3_wp, 0.0_wp, 0.0_wp)
      call deck%case_values(2_i8, value)
      call suite%equal("traces: file of case 2", nint(value(key_pressure_file)), 2)
      call suite%close("traces: end of case 2", value(key_run_t_end_ms), 2.0e-3_wp, 0.0_wp, 0.0_wp)
      call suite%true("traces: the deck has no end of its own", ieee_is_nan(deck%value(key_run_t_end_ms)))
   end subroutine good_traces

   subroutine trace_faults()
      call tell_trace("no data", "# nothing~", &
         & "t.csv: there are no data; a header such as t_ms,p_in_kpa,p_out_kpa or t_ms,p_diff_kpa is due")
      call tell_trace("no header", "1,2~2,3~", &
         & "t.csv:1:1: a header such as t_ms,p_in_kpa,p_out_kpa or t_ms,p_diff_kpa is due")
      call tell_trace("no unit", "t_ms,p_diff~1,2~", &
         & "t.csv:1:1: a header such as t_ms,p_in_kpa,p_out_kpa or t_ms,p_diff_kpa is due")
      call tell_trace("no outlet", "t_ms,p_in_kpa~1,2~", &
         & "t.csv:1:1: a header such as t_ms,p_in_kpa,p_out_kpa or t_ms,p_diff_kpa is due")
      call tell_trace("difference and inlet", "t_ms,p_diff_kpa,p_in_kpa,p_out_kpa~1,2,3,4~", &
         & "t.csv:1:1: a header such as t_ms,p_in_kpa,p_out_kpa or t_ms,p_diff_kpa is due")
      call tell_trace("semicolons", "t_ms;p_diff_kpa~1;2~", &
         & "t.csv:1:1: columns are separated by commas, and decimals have a point")
      call tell_trace("column twice", "t_ms,p_diff_kpa,t_s~1,2,3~2,2,3~", &
         & "t.csv:1:17: a second column of this kind: t_s")
      call tell_trace("one row", "t_ms,p_diff_kpa~1,2~", "t.csv: two rows of data at least are needed")
      call tell_trace("order", "t_ms,p_diff_kpa~1,2~2,2~2,3~3,4~", &
         & "t.csv:4:1: time must rise from row to row: 2 is not later than the row before")
      call tell_trace("numbers", "t_ms,p_diff_kpa~1,NaN~2,~3, x~4,1e999~5,inf~6,2e5~", &
         & "t.csv:2:3: p_diff_kpa = 'NaN': NaN and infinity are not allowed~" &
         & //"t.csv:3:3: p_diff_kpa = '': a number is missing~t.csv:4:4: p_diff_kpa = 'x': not a number~" &
         & //"t.csv:5:3: p_diff_kpa = '1e999': too large for a double-precision number~" &
         & //"t.csv:6:3: p_diff_kpa = 'inf': NaN and infinity are not allowed~" &
         & //"t.csv:7:3: p_diff_kpa = '2e5': beyond the limit of 100000 kPa")
      call tell_trace("ragged", "t_ms,p_diff_kpa~1,2~2~3,4,5~4,4~", &
         & "t.csv:3:1: 1 columns; the header has 2~t.csv:4:1: 3 columns; the header has 2")
      call tell_trace("gap", "t_ms,p_diff_kpa~1,2~2,2~3,4~4,4~# here~25,3~26,3~", &
         & "t.csv:7:1: a gap before this row: 21 ms, more than 20 times the median step; fill it or cut the trace")
      call tell_trace("no gap", "t_ms,p_diff_kpa~1,2~2,2~3,4~4,4~24,3~25,3~", "")
      call tell_trace("binary", "t_ms,p_diff_kpa~1,"//achar(1), &
         & "t.csv:2:3: byte 01 (hexadecimal) does not belong into a text; is this a binary file?")
      call tell_trace("a comma in quotes", "t_ms,""a, b"",p_diff_kpa~1,"","",2~2,x,2~", &
         & "t.csv:1:6: warning: column 'a, b' is not used")
      call tell_trace("unused column", "t_ms,p_diff_kpa,note~1,2,x~2,2,y~", &
         & "t.csv:1:17: warning: column 'note' is not used")
      call says(suite, "missing trace", "&pressure kind = 'trace', file = 'none.csv', event_ms = 1 /", &
         & "@:1:34: pressure.file: 'none.csv': there is no such file")
      call says(suite, "folder as trace", "&pressure kind = 'trace', file = '.', event_ms = 1 /", &
         & "@:1:34: pressure.file: '.' is a folder; name a file in it")
      call tell_trace("too late", "t_s,p_diff_kpa~1,2~2e6,2~", &
         & "t.csv:3:1: t_s = '2e6': beyond the limit of 1000000000 ms")
      call write_file("t.csv", lines("t_ms,p_diff_kpa~1,2~9,2~17,2~"))
      call says(suite, "trace without event", "&pressure kind = 'trace', file = 't.csv' /", &
         & "@:1:18: pressure.kind = 'trace' needs pressure.event_ms, the time when closing starts")
      call says(suite, "trace without event, its end given", "&pressure kind = 'trace', file = 't.csv' /~&run t_end_ms = 15 /", &
         & "@:1:18: pressure.kind = 'trace' needs pressure.event_ms, the time when closing starts")
      call says(suite, "trace without file and event", "&pressure kind = 'trace' /", &
         & "@:1:18: pressure.kind = 'trace' needs pressure.file, the CSV file of the trace~" &
         & //"@:1:18: pressure.kind = 'trace' needs pressure.event_ms, the time when closing starts")
   end subroutine trace_faults

   !> The deck of a trace with this text draws these remarks.
   subroutine tell_trace(what, text, expected)
      character(len=*), intent(in) :: what, text, expected

      call write_file("t.csv", lines(text))
      call says(suite, "trace, "//what, "&pressure kind = 'trace', file = 't.csv', event_ms = 1.5 /", expected)
   end subroutine tell_trace

   subroutine trace_rules()
      call write_file("t.csv", lines("t_ms,p_diff_kpa~500,20~502,10~504,0~"))
      call says(suite, "event outside the trace", "&pressure kind = 'trace', file = 't.csv', event_ms = 2 /", &
         & "@:1:54: pressure.event_ms = 2 must lie within the trace, 500 to 504 ms")
      call says(suite, "end behind the trace", &
         & "&run t_end_ms = 505 / &pressure kind='trace', file='t.csv', event_ms=501 /", &
         & "@:1:17: run.t_end_ms = 505 must lie within the trace, 500 to 504 ms")
      call says(suite, "end before the trace", &
         & "&run t_end_ms = 40 / &pressure kind='trace', file='t.csv', event_ms=501 /", &
         & "@:1:17: run.t_end_ms = 40 must lie within the trace, 500 to 504 ms~@:1:17: warning: " &
         & //"run.t_end_ms = 40 ends the run before closing starts at 501 ms; no closing is measured")
      call says(suite, "square wave with a trace", &
         & "&pressure kind='trace', file='t.csv', event_ms=501, inlet_kpa=3 /", &
         & "@:1:63: warning: pressure.inlet_kpa has no effect with pressure.kind = 'trace'")
   end subroutine trace_rules

   subroutine good_designs()
      type(deck_type) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      real(wp) :: value(n_keys)

      call write_file("plan.csv", lines("# a plan~film.gap_mm,Pressure.Inlet_kPa~0.1,5~0.2,10~0.3,20~"))
      call read_trial("&run model = 'traditional', 'squeeze' /~&design file = 'plan.csv' /", deck, faults, error)
      call suite%text("design: no faults", faults%all_text(), "")
      call suite%equal("design: cases", int(deck%case_count()), 6)
      call suite%true("design: columns", all(deck%swept_keys() == [key_film_gap_mm, key_pressure_inlet_kpa]))
      call deck%case_values(5_i8, value)
      call suite%equal("design: model of case 5", nint(value(key_run_model)), model_squeeze)
      call suite%close("design: gap of case 5", value(key_film_gap_mm), 2.0e-4_wp, 0.0_wp, 0.0_wp)
      call suite%close("design: inlet of case 5", value(key_pressure_inlet_kpa), 1.0e4_wp, 0.0_wp, 0.0_wp)

      call write_file("t.csv", lines("t_ms,p_diff_kpa~500,20~502,10~504,0~"))
      call write_file("plan.csv", &
         & lines("pressure.file,film.gap_mm,run.model~t.csv,0.1,squeeze~""t.csv"",0.2,traditional"))
      call read_trial("&pressure kind = 'trace', event_ms = 501 / &design file = 'plan.csv' /", deck, faults, error)
      call suite%text("design of files and models: no faults", faults%all_text(), "")
      call suite%equal("design of files and models: columns", size(deck%swept_keys()), 2)
      call suite%equal("design of files and models: traces", size(deck%trace), 1)
      call deck%case_values(2_i8, value)
      call suite%equal("design of files and models: model", nint(value(key_run_model)), model_traditional)
      call suite%equal("design of files and models: file", nint(value(key_pressure_file)), 1)
      call suite%true("design of files and models: uses both", deck%uses_model(model_squeeze) &
         & .and. deck%uses_model(model_traditional))
   end subroutine good_designs

   subroutine design_faults()
      character(len=*), parameter :: deck = "&design file = 'plan.csv' /"
      integer :: unit

      call says(suite, "design, no file", "&design /", &
         & "@:1:1: &design: design.file must name a CSV file: file = 'plan.csv'")
      call says(suite, "design, missing file", "&design file = 'none.csv' /", &
         & "@:1:16: design.file: 'none.csv': there is no such file")
      call write_file("plan.csv", "")
      call says(suite, "design, empty file", deck, &
         & "plan.csv: there are no data; a header that names keys is due: film.gap_mm,film.k_s")
      call write_file("plan.csv", lines("film.gap_mm~"))
      call says(suite, "design, no rows", deck, "plan.csv: there are no rows of data")
      call write_file("plan.csv", lines("film.gap,gap_mm,film.gap_mm,film.gap_mm,solver.width~1,2,3,4,5~"))
      call says(suite, "design, header", deck, &
         & "plan.csv:1:1: 'film.gap': there is no such key; did you mean 'film.gap_mm'?~" &
         & //"plan.csv:1:10: 'gap_mm': write it with its group: 'film.gap_mm'~" &
         & //"plan.csv:1:29: 'film.gap_mm': a second column of this key~plan.csv:1:41: 'solver.width': " &
         & //"this key cannot vary from case to case; real keys, run.model and pressure.file can")
      call write_file("plan.csv", lines("film.gap_mm,film.k_s~1,0.1~-1,0.1~1~,nan~"))
      call says(suite, "design, rows", deck, "plan.csv:3:1: film.gap_mm = -1: must be >= 0 (mm)~" &
         & //"plan.csv:4:1: 1 columns; the header has 2~plan.csv:5:1: film.gap_mm = : a number is missing~" &
         & //"plan.csv:5:2: film.k_s = nan: NaN and infinity are not allowed")
      call write_file("plan.csv", lines("film.gap_mm~0.00005~0.1~"))
      call says(suite, "design, unusual value", deck, &
         & "plan.csv:2:1: warning: film.gap_mm = 0.00005: unusually small for mm; was it given in m?")
      call write_file("plan.csv", lines("film.gap_mm~0.1~"))
      call says(suite, "design and sweep", "&sweep key = 'film.k_s', values = 1, 2 /~"//deck, &
         & "@:2:1: &design and &sweep " &
         & //"together: the design's rows are the cases; put the swept values into them")
      call says(suite, "design without effect", "&run model = 'traditional' /~"//deck, &
         & "@:2:16: warning: film.gap_mm has no effect on the model 'traditional'")
      call write_file("plan.csv", lines("reed.width_mm~6~3~"))
      call says(suite, "design, combination", deck, &
         & "@:1:16: case 2: reed.hole_diameter_mm = 4 must not exceed reed.width_mm = 3")
      call write_file("plan.csv", lines("run.model~squeeze~sqeeze~"))
      call says(suite, "design, model", deck, &
         & "plan.csv:3:1: run.model = sqeeze: must be one of 'traditional', 'squeeze', 'film', 'film_table'; " &
         & //"did you mean 'squeeze'?")
      call says(suite, "design, models twice", "&run model = 'squeeze', 'traditional' /~"//deck, &
         & "plan.csv:1:1: 'run.model': the deck lists several models in &run; name them in one place only")
      call write_file("plan.csv", lines("film.gap_mm , ""film.k_s""~# a comment~ +0.1,1d-3~~""2e-1"",.5~0x1,0x1p-3" &
         & //"~inf,1 2~1e999, -~"))
      call says(suite, "design, forms of numbers", deck, "plan.csv:6:1: film.gap_mm = 0x1: not a number; its " &
         & //"unit is mm, write the number alone~plan.csv:6:5: film.k_s = 0x1p-3: not a number~" &
         & //"plan.csv:7:1: film.gap_mm = inf: NaN and infinity are not allowed~" &
         & //"plan.csv:7:5: film.k_s = 1 2: not a number~" &
         & //"plan.csv:8:1: film.gap_mm = 1e999: too large for a double-precision number~" &
         & //"plan.csv:8:8: film.k_s = -: not a number")
      open(newunit=unit, file="huge.csv", access="stream", form="unformatted", status="replace", action="write")
      write(unit, pos=268435457_int64) "x"
      close(unit)
      call says(suite, "design, too large", "&design file = 'huge.csv' /", "@:1:16: design.file: 'huge.csv' has " &
         & //"268435457 bytes, more than the 268435456 such a file may have")
      open(newunit=unit, file="huge.csv", status="old")
      close(unit, status="delete")
   end subroutine design_faults

   subroutine no_decks()
      type(deck_type) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      integer :: unit

      call read_deck("none.nml", deck, faults, error)
      call suite%fails("missing deck", error, "'none.nml': there is no such file")
      call read_deck("", deck, faults, error)
      call suite%fails("no name", error, "there is no such file")
      call read_deck(".", deck, faults, error)
      call suite%fails("a folder", error, "'.' is a folder; name a file in it")
      call read_deck("/dev/null", deck, faults, error)
      call suite%fails("no regular file", error, "'/dev/null' is a pipe or a device; a file is needed here")

      open(newunit=unit, file="huge.nml", access="stream", form="unformatted", status="replace", action="write")
      write(unit, pos=1073741824_int64) "x"
      close(unit)
      call read_deck("huge.nml", deck, faults, error)
      open(newunit=unit, file="huge.nml")
      close(unit, status="delete")
      call suite%no_error("a line of 1 GB: the file is there", error)
      call suite%text("a line of 1 GB", faults%all_text(), "huge.nml: 'huge.nml' has 1073741824 bytes, more than the " &
         & //"8388608 such a file may have"//new_line("a"))

      call write_file("long.nml", repeat(" ", 8388607)//"&")
      call read_deck("long.nml", deck, faults, error)
      call suite%true("the largest deck is read", index(faults%all_text(), ":1:8388608: a group's name") > 0)
      call write_file("long.nml", repeat(" ", 8388608)//"&")
      call read_deck("long.nml", deck, faults, error)
      call suite%true("a larger deck is not", index(faults%all_text(), "has 8388609 bytes") > 0)
      call write_file("long.nml", "&run title = '"//repeat("x", 8000000)//"' /")
      call read_deck("long.nml", deck, faults, error)
      call suite%equal("a long line: one fault", faults%errors(), 1)
      call write_file("many.nml", repeat("x ", 4000000)//"&a"//repeat(" b = c", 60000))
      call read_deck("many.nml", deck, faults, error)
      call suite%equal("a long line outside groups: one fault", faults%errors(), 1)
      call write_file("many.nml", "&film"//repeat(" b = c", 100000)//"/")
      call read_deck("many.nml", deck, faults, error)
      call suite%equal("very many faults: counted", faults%errors(), 100000)
      call suite%equal("very many faults: held", faults%count(), 200)
   end subroutine no_decks

end program test_files
