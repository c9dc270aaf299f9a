!> Values of a deck: types, ranges, units, effects, and what ties values together.
program test_values
   use check, only : suite_type
   use deck_trial, only : says
   implicit none
   type(suite_type) :: suite
   character(len=*), parameter :: closed_film = "@:1:16: warning: film.gap_mm = 0: the film is closed from the start;" &
      & //" such a case ends there as film_closed"

   call numbers()
   call other_types()
   call lists()
   call units()
   call effects()
   call combinations()
   call several()
   call suite%finish()

contains

   subroutine numbers()
      call says(suite, "negative", "&film~ gap_mm = -0.05 /", "@:2:11: film.gap_mm = -0.05: must be >= 0 (mm)")
      call says(suite, "zero", "&fluid viscosity_pa_s = 0 /", "@:1:25: fluid.viscosity_pa_s = 0: must be > 0 (Pa s)")
      call says(suite, "a closed film", "&film gap_mm = 0 /", closed_film)
      call says(suite, "closed, said otherwise", "&film gap_mm = 0.0d0 /", closed_film)
      call says(suite, "no film that could be closed", "&film gap_mm = 0, k_s = 0 /", "")
      call says(suite, "nor here", "&film gap_mm = 0 /~&run model = 'traditional' /", &
         & "@:1:16: warning: film.gap_mm has no effect on the model 'traditional'")
      call says(suite, "fields after the end", "&film fields_ms = 39, 40, 40.1, 50 /~&run model = 'film' /", &
         & "@:1:19: warning: film.fields_ms: 2 of its times outside the run, 0 to 40 ms: no field is stored for them")
      call says(suite, "fields up to the end", "&film fields_ms = 0, 40 /~&run model = 'film' /", "")
      call says(suite, "fields up to the longest end", "&film fields_ms = 45, 60 /~&run model = 'film' /~" &
         & //"&sweep key = 'run.t_end_ms', values = 50, 20 /", &
         & "@:1:19: warning: film.fields_ms: 1 of its times outside the run, 0 to 50 ms: no field is stored for them")
      call says(suite, "zero that is allowed", "&film k_s = 0 /", "")
      call says(suite, "negative where zero is allowed", "&film k_s = -1e-9 /", &
         & "@:1:13: film.k_s = -1e-9: must be >= 0")
      call says(suite, "huge", "&film gap_mm = 1e300 /", "@:1:16: film.gap_mm = 1e300: must be 0, or 1e-6 to 1000 (mm)")
      call says(suite, "tiny", "&film gap_mm = 1e-300 /", &
         & "@:1:16: film.gap_mm = 1e-300: must be 0, or 1e-6 to 1000 (mm)")
      call says(suite, "overflow", "&film gap_mm = 1e999 /", &
         & "@:1:16: film.gap_mm = 1e999: too large for a double-precision number")
      call says(suite, "underflow", "&film k_s = 1d-999 /", &
         & "@:1:13: film.k_s = 1d-999: too small for a double-precision number")
      call says(suite, "not a number", "&film k_s = NaN, gap_mm = -nan(3) /", &
         & "@:1:13: film.k_s = NaN: NaN and infinity are not allowed~" &
         & //"@:1:27: film.gap_mm = -nan(3): NaN and infinity are not allowed")
      call says(suite, "infinite", "&film k_s = +Inf, gap_mm = infinity /", &
         & "@:1:13: film.k_s = +Inf: NaN and infinity are not allowed~" &
         & //"@:1:28: film.gap_mm = infinity: NaN and infinity are not allowed")
      call says(suite, "a word", "&film k_s = small /", "@:1:13: film.k_s = small: not a number")
      call says(suite, "two points", "&film k_s = 0.0.1 /", "@:1:13: film.k_s = 0.0.1: not a number")
      call says(suite, "a sign as exponent", "&film k_s = 1+3 /", "@:1:13: film.k_s = 1+3: not a number")
      call says(suite, "only an exponent", "&film k_s = e5, gap_mm = 1e /", &
         & "@:1:13: film.k_s = e5: not a number~" &
         & //"@:1:26: film.gap_mm = 1e: not a number; its unit is mm, write the number alone")
      call says(suite, "only a point", "&film k_s = . /", "@:1:13: film.k_s = .: not a number")
      call says(suite, "complex", "&film k_s = (1.0, 2.0) /", "@:1:13: film.k_s = (1.0, 2.0): not a number")
      call says(suite, "a number in quotes", "&film k_s = '0.1' /", &
         & "@:1:13: film.k_s = '0.1': must stand without quotes")
      call says(suite, "unit behind", "&film gap_mm = 0.05mm /", &
         & "@:1:16: film.gap_mm = 0.05mm: not a number; its unit is mm, write the number alone")
      call says(suite, "unit behind a blank", "&film gap_mm = 0.05 mm /", &
         & "@:1:21: film.gap_mm: one value is due, 2 are given; its unit is mm, write the number alone")
      call says(suite, "a word where there is no unit", "&film k_s = 0.05 mm /", "@:1:18: film.k_s: one value is due, 2 are given")
      call says(suite, "units in lists", "&film fields_ms = 1 ms, 2 s /~&run model = 'film' /", &
         & "@:1:21: film.fields_ms = ms: not a number; its unit is ms, write the number alone~" &
         & //"@:1:27: film.fields_ms = s: not a number")
      call says(suite, "units in a sweep", "&sweep key = 'film.gap_mm', from = 0.1 mm, to = 1 mm, count = 3 /", &
         & "@:1:40: sweep.from: one value is due, 2 are given; its unit is mm, write the number alone~" &
         & //"@:1:51: sweep.to: one value is due, 2 are given; its unit is mm, write the number alone")
      call says(suite, "whole numbers", "&solver max_steps = 1e5 width = 2.0 /", &
         & "@:1:21: solver.max_steps = 1e5: not a whole number~@:1:33: solver.width = 2.0: not a whole number")
      call says(suite, "whole number, overflow", "&solver max_steps = 99999999999999999999 /", &
         & "@:1:21: solver.max_steps = 99999999999999999999: too large")
      call says(suite, "whole number, range", "&run block_size = -1 /", "@:1:19: run.block_size = -1: must be >= 0")
      call says(suite, "lanes", "&solver width = 48 /", "@:1:17: solver.width = 48: must be a power of two")
      call says(suite, "lanes, negative", "&solver width = -1 /", "@:1:17: solver.width = -1: must be > 0")
   end subroutine numbers

   subroutine other_types()
      call says(suite, "logical", "&run traces = yes /", "@:1:15: run.traces = yes: must be .true. or .false.")
      call says(suite, "logical as number", "&run traces = 1 /", "@:1:15: run.traces = 1: must be .true. or .false.")
      call says(suite, "logical in quotes", "&run traces = '.true.' /", &
         & "@:1:15: run.traces = '.true.': must stand without quotes")
      call says(suite, "choice", "&run model = 'sqeeze' /", &
         & "@:1:14: run.model = 'sqeeze': must be one of 'traditional', 'squeeze', 'film', 'film_table'; did you mean 'squeeze'?")
      call says(suite, "choice without quotes", "&run model = squeeze /", &
         & "@:1:14: run.model = squeeze: must stand in quotes: 'squeeze'")
      call says(suite, "choice as number", "&hydro load = 1 /", &
         & "@:1:15: hydro.load = 1: must be one of 'published', 'maali', 'sader', 'none'")
      call says(suite, "empty choice", "&hydro load = '' /", &
         & "@:1:15: hydro.load = '': must be one of 'published', 'maali', 'sader', 'none'")
      call says(suite, "text without quotes", "&run title = hello /", &
         & "@:1:14: run.title = hello: must be a text in quotes: 'hello'")
      call says(suite, "longest text", "&run title = '"//repeat("x", 200)//"' /", "")
      call says(suite, "too long a text", "&run title = '"//repeat("x", 201)//"' /", &
         & "@:1:14: run.title = '"//repeat("x", 37)//"...': has 201 bytes; at most 200 are taken")
      call says(suite, "empty file name", "&pressure file = ' ' /", "@:1:18: pressure.file = ' ': must not be empty~" &
         & //"@:1:18: warning: pressure.file has no effect with pressure.kind = 'square'")
   end subroutine other_types

   subroutine lists()
      call says(suite, "decimal comma", "&film k_s = 0,01 /", &
         & "@:1:15: film.k_s: one value is due, 2 are given; a decimal has a point, not a comma")
      call says(suite, "list for a scalar", "&film gap_mm = 0.1, 0.2, 0.3 /", &
         & "@:1:21: film.gap_mm: one value is due, 3 are given; to vary it: &sweep key = 'film.gap_mm', values = ... /")
      call says(suite, "list for what cannot vary", "&solver width = 1, 2 /", &
         & "@:1:20: solver.width: one value is due, 2 are given")
      call says(suite, "repeats for a scalar", "&film k_s = 2*0.1 /", &
         & "@:1:13: film.k_s: one value is due, 2 are given; to vary it: &sweep key = 'film.k_s', values = ... /")
      call says(suite, "a model twice", "&run model = 'squeeze', 'traditional', 'Squeeze' /", &
         & "@:1:40: run.model names 'Squeeze' twice")
   end subroutine lists

   subroutine units()
      call says(suite, "metres", "&reed thickness_mm = 0.00015 /", &
         & "@:1:22: warning: reed.thickness_mm = 0.00015: unusually small for mm; was it given in m?")
      call says(suite, "micrometres", "&film gap_mm = 50 /", &
         & "@:1:16: warning: film.gap_mm = 50: unusually large for mm; was it given in um?")
      call says(suite, "pascal", "&pressure inlet_kpa = 20000 /", &
         & "@:1:23: warning: pressure.inlet_kpa = 20000: unusually large for kPa; was it given in Pa?")
      call says(suite, "megapascal", "&pressure inlet_kpa = -0.02 /", &
         & "@:1:23: warning: pressure.inlet_kpa = -0.02: unusually small for kPa; was it given in bar or MPa?")
      call says(suite, "no pressure at all", "&pressure outlet_kpa = 0 /", "")
      call says(suite, "seconds", "&run t_end_ms = 0.04 /", &
         & "@:1:17: warning: run.t_end_ms = 0.04: unusually small for ms; was it given in s?~" &
         & //"@:1:17: warning: run.t_end_ms = 0.04 ends the run " &
         & //"before closing starts at 19.5 ms; no closing is measured")
      call says(suite, "millipascal second", "&fluid viscosity_pa_s = 48.4 /", &
         & "@:1:25: warning: fluid.viscosity_pa_s = 48.4: unusually large for Pa s; was it given in mPa s?")
      call says(suite, "grams", "&fluid density_kg_m3 = 0.00875 /", &
         & "@:1:24: warning: fluid.density_kg_m3 = 0.00875: unusually small for kg/m3; was it given in g/cm3?")
   end subroutine units

   subroutine effects()
      call says(suite, "film without squeeze", "&run model = 'traditional' / &film gap_mm = 0.1, acts = 'both' /", &
         & "@:1:45: warning: film.gap_mm has no effect on the model 'traditional'~" &
         & //"@:1:57: warning: film.acts has no effect on the model 'traditional'")
      call says(suite, "film with both models", "&run model = 'traditional', 'squeeze' / &film gap_mm = 0.1 /", "")
      call says(suite, "swept without effect", &
         & "&run model = 'traditional' / &sweep key = 'film.gap_mm', values = 0.1, 0.2 /", &
         & "@:1:43: warning: film.gap_mm has no effect on the model 'traditional'")
      call says(suite, "Poisson's ratio", "&reed poisson_ratio = 0.3 /", &
         & "@:1:23: warning: reed.poisson_ratio has no effect on the model 'squeeze'")
      call says(suite, "interval without traces", "&run trace_dt_ms = 0.1 /", &
         & "@:1:20: warning: run.trace_dt_ms has no effect without run.traces = .true.")
      call says(suite, "interval with traces", "&run trace_dt_ms = 0.1, traces = t /", "")
      call says(suite, "fluid without load", &
         & "&run model = 'traditional' / &hydro load = 'none' / &fluid density_kg_m3 = 800 /", &
         & "@:1:76: warning: fluid.density_kg_m3 has no effect with hydro.load = 'none'")
      call says(suite, "viscosity without load, but with film", &
         & "&hydro load = 'none' / &fluid viscosity_pa_s = 0.1 /", "")
   end subroutine effects

   subroutine combinations()
      call says(suite, "ramp too long", "&pressure period_ms = 4,~transition_ms = 2.0 /", &
         & "@:2:17: pressure.transition_ms = 2 must be less than half of pressure.period_ms = 4")
      call says(suite, "ramp against the default period", "&pressure transition_ms = 20.0 /", &
         & "@:1:27: pressure.transition_ms = 20 must be less than half of pressure.period_ms = 40")
      call says(suite, "ramp in a sweep", &
         & "&pressure transition_ms = 5 /~&sweep key = 'pressure.period_ms', values = 40, 8, 30 /", &
         & "@:1:27: case 2: pressure.transition_ms = 5 must be less than half of pressure.period_ms = 8")
      call says(suite, "hole too wide", "&reed hole_diameter_mm = 6.5 /", &
         & "@:1:26: reed.hole_diameter_mm = 6.5 must not exceed reed.width_mm = 6")
      call says(suite, "reed too narrow", "&reed width_mm = 3 /", &
         & "@:1:18: reed.hole_diameter_mm = 4 must not exceed reed.width_mm = 3")
      call says(suite, "no closing", "&run t_end_ms = 19.5 /", &
         & "@:1:17: warning: run.t_end_ms = 19.5 ends the run before closing starts at 19.5 ms; no closing is measured")
      call says(suite, "event before the wave", "&pressure event_ms = -1.0 /", &
         & "@:1:22: pressure.event_ms = -1: must be >= 0 with a square wave, which starts at 0")
      call says(suite, "event behind the end", "&pressure event_ms = 50.0 /", &
         & "@:1:22: warning: run.t_end_ms = 40 ends the run before closing starts at 50 ms; no closing is measured")
      call says(suite, "too many samples", "&run traces = T, trace_dt_ms = 1e-6 /", &
         & "@:1:32: warning: run.trace_dt_ms = 1e-6: unusually small for ms; was it given in s?~" &
         & //"@:1:32: run.trace_dt_ms = 1e-6 stores 4e7 samples from 0 to 40 ms; at most 10000000 can be stored")
      call says(suite, "too many periods", "&run t_end_ms = 1e5 / &pressure period_ms = 0.1 transition_ms = 0.01/", &
         & "@:1:17: run.t_end_ms = 100000 is more than 100000 times pressure.period_ms = 0.1")
   end subroutine combinations

   !> All faults at once, in order of their places.
   subroutine several()
      call says(suite, "several", &
         & "&run modell = 'a', title = 3 /~&fluid density_kg_m3 = x /~&film gap_mm = -1, k_s = 0,1~", &
         & "@:1:6: run.modell: there is no such key; did you mean 'model'?~" &
         & //"@:1:28: run.title = 3: must be a text in quotes: '3'~" &
         & //"@:2:24: fluid.density_kg_m3 = x: not a number~" &
         & //"@:3:1: &film is not closed: no '/' before the end of the file~" &
         & //"@:3:16: film.gap_mm = -1: must be >= 0 (mm)~" &
         & //"@:3:28: film.k_s: one value is due, 2 are given; a decimal has a point, not a comma")
   end subroutine several

end program test_values
