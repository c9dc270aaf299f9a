!> Axes of a deck: faults of &sweep, the points of a range, the order of cases.
program test_sweeps
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_keys, only : n_keys, from_si, value_text, key_run_model, key_film_gap_mm, key_film_k_s, &
      & key_pressure_inlet_kpa, &
      & key_run_t_end_ms, model_squeeze, model_traditional
   use rv_deck, only : deck_type
   use check, only : suite_type
   use deck_trial, only : says, read_trial
   implicit none
   type(suite_type) :: suite

   call key_faults()
   call form_faults()
   call value_faults()
   call ranges()
   call order()
   call suite%finish()

contains

   subroutine key_faults()
      call says(suite, "no key", "&sweep values = 1.0 /", &
         & "@:1:1: &sweep: sweep.key must name the key to vary: key = 'group.name'")
      call says(suite, "unknown key", "&sweep key = 'film.gap_m', values = 1.0 /", &
         & "@:1:14: sweep.key = 'film.gap_m': there is no such key; did you mean 'film.gap_mm'?")
      call says(suite, "key without its group", "&sweep key = 'GAP_mm', values = 1.0 /", &
         & "@:1:14: sweep.key = 'GAP_mm': write it with its group: 'film.gap_mm'")
      call says(suite, "key without quotes", "&sweep key = film.gap_mm, values = 1.0 /", &
         & "@:1:14: sweep.key = film.gap_mm: must be a text in quotes: 'film.gap_mm'")
      call says(suite, "two keys", "&sweep key = 'film.gap_mm', 'film.k_s', values = 1.0 /", &
         & "@:1:29: sweep.key: one key for each &sweep")
      call says(suite, "key twice", &
         & "&sweep key = 'film.gap_mm', values = 1.0 /~&sweep key = 'film.gap_mm', values = 2.0 /", &
         & "@:2:14: sweep.key = 'film.gap_mm': it is swept already in line 1")
      call says(suite, "key that cannot vary", "&sweep key = 'run.trace_dt_ms', values = 1.0 /", &
         & "@:1:14: sweep.key = " &
         & //"'run.trace_dt_ms': this key cannot vary from case to case; real keys, run.model and pressure.file can")
      call says(suite, "models", "&sweep key = 'run.model', values = 'squeeze' /", &
         & "@:1:14: sweep.key = 'run.model': list the models in &run: model = 'traditional', 'squeeze'")
   end subroutine key_faults

   subroutine form_faults()
      character(len=*), parameter :: start = "&sweep key = 'film.gap_mm', "
      character(len=*), parameter :: rule = "@:1:1: &sweep of film.gap_mm: give either values, or from, to and count"

      call says(suite, "neither", "&sweep key = 'film.gap_mm' /", rule)
      call says(suite, "both", start//"values = 0.1, count = 3 /", rule//", not both")
      call says(suite, "scale with values", start//"values = 0.1, scale = 'log' /", rule//", not both")
      call says(suite, "no count", start//"from = 0.1, to = 0.2 /", rule)
      call says(suite, "misspelt", start//"form = 0.1, to = 0.2, count = 3 /", &
         & "@:1:29: sweep.form: there is no such key; did you mean 'from'?")
      call says(suite, "range of files", "&sweep key = 'pressure.file', from = 1, to = 2, count = 2 /", &
         & "@:1:1: &sweep of pressure.file: it has no numbers between from and to; list its values~" &
         & //"@:1:14: warning: pressure.file has no effect with pressure.kind = 'square'")
      call says(suite, "log from zero", "&sweep key = 'film.k_s', from = 0, to = 2, count = 2 scale = 'log' /", &
         & "@:1:1: &sweep of film.k_s: scale = 'log' needs from and to > 0")
      call says(suite, "no range", start//"from = 0.1, to = 0.10, count = 2 /", &
         & "@:1:46: sweep.to must differ from sweep.from")
      call says(suite, "two values for from", start//"from = 0.1, 0.2, to = 0.5, count = 2 /", &
         & "@:1:41: sweep.from: one value is due, 2 are given")
   end subroutine form_faults

   subroutine value_faults()
      call says(suite, "value out of range", "&sweep key = 'film.gap_mm', values = 0.1,~ 0.2, -0.3, 1e999 /", &
         & "@:2:7: film.gap_mm = -0.3: must be >= 0 (mm)~" &
         & //"@:2:13: film.gap_mm = 1e999: too large for a double-precision number")
      call says(suite, "closed in one case", "&sweep key = 'film.gap_mm', from = 0, to = 0.2, count = 3 /", &
         & "@:1:14: warning: case 1: film.gap_mm = 0: the film is closed from the start; such a case ends there as" &
         & //" film_closed")
      call says(suite, "unusual value", "&sweep key = 'film.gap_mm', values = 0.1, 0.0001 /", &
         & "@:1:43: warning: film.gap_mm = 0.0001: unusually small for mm; was it given in m?")
      call says(suite, "ends out of range", "&sweep key = 'film.gap_mm', from = -0.1, to = 2e3, count = 1 /", &
         & "@:1:36: film.gap_mm = -0.1: must be >= 0 (mm)~@:1:47: film.gap_mm = 2e3: must be 0, or 1e-6 to 1000 (mm)~" &
         & //"@:1:60: sweep.count = 1: must be from 2 to 1000000")
      call says(suite, "scale", "&sweep key = 'film.gap_mm', from = 0.1, to = 0.2, count = 3, scale = 'lin' /", &
         & "@:1:70: sweep.scale = 'lin': must be one of 'linear', 'log'")
      call says(suite, "value twice", "&sweep key = 'film.gap_mm', values = 0.1, 0.2, 0.10 /", &
         & "@:1:48: warning: sweep.values: 0.10 a second time; its cases are run twice")
      call says(suite, "too many cases", "&sweep key = 'film.gap_mm', from = 0.1, to = 0.2, count = 1000000 /~" &
         & //"&sweep key = 'film.k_s', from = 0.1, to = 0.2, count = 2001 /", &
         & "@:2:14: the sweeps make 2e9 cases; at most 2000000000 can be run")
   end subroutine value_faults

   subroutine ranges()
      type(deck_type) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      real(wp) :: value(n_keys)
      integer :: i

      call read_trial("&sweep key = 'film.gap_mm', from = 0.05, to = 0.30, count = 6 /", deck, faults, error)
      call suite%equal("range: cases", int(deck%case_count()), 6)
      do i = 1, 6
         call deck%case_values(int(i, i8), value)
         call suite%close("range", value(key_film_gap_mm), (0.05_wp*real(i, wp))*1.0e-3_wp, 4.0e-16_wp, 0.0_wp)
      end do
      call deck%case_values(3_i8, value)
      call suite%text("range: 0.15, not 0.15000000000000002", value_text(key_film_gap_mm, value(key_film_gap_mm)), &
         & "0.15")

      call read_trial("&sweep key = 'film.gap_mm', from = 10.0, to = 0.01, count = 4, scale = 'log' /", deck, faults, &
         & error)
      call suite%equal("log: faults", faults%errors(), 0)
      do i = 1, 4
         call deck%case_values(int(i, i8), value)
         call suite%close("log", from_si(key_film_gap_mm, value(key_film_gap_mm)), 10.0_wp**(2 - i), 4.0e-16_wp, 0.0_wp)
      end do
   end subroutine ranges

   subroutine order()
      type(deck_type) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      real(wp) :: value(n_keys)
      integer :: model, inlet, gap, i

      call read_trial("&sweep key = 'pressure.inlet_kpa', values = 5, 10 /~" &
         & //"&sweep key = 'film.gap_mm', values = 1, 2, 3/~" &
         & //"&run model = 'squeeze', 'traditional' /", deck, faults, error)
      call suite%text("order: no faults", faults%all_text(), "")
      call suite%equal("order: cases", int(deck%case_count()), 12)
      call suite%equal("order: columns", size(deck%swept_keys()), 2)
      call suite%true("order: columns", all(deck%swept_keys() == [key_pressure_inlet_kpa, key_film_gap_mm]))
      i = 0
      do model = 1, 2
         do inlet = 1, 2
            do gap = 1, 3
               i = i + 1
               call deck%case_values(int(i, i8), value)
               call suite%equal("order: model", nint(value(key_run_model)), merge(model_squeeze, model_traditional, &
                  & model == 1))
               call suite%close("order: inlet", value(key_pressure_inlet_kpa), 5000.0_wp*real(inlet, wp), 0.0_wp, &
                  & 0.0_wp)
               call suite%close("order: gap, fastest", value(key_film_gap_mm), 1.0e-3_wp*real(gap, wp), 0.0_wp, 0.0_wp)
            end do
         end do
      end do
      call suite%close("order: others keep their base value", value(key_film_k_s), 0.0075_wp, 0.0_wp, 0.0_wp)
      call suite%close("default end of a square wave", value(key_run_t_end_ms), 0.04_wp, 0.0_wp, 0.0_wp)

      call read_trial("&sweep key = 'film.gap_mm', from = 0.1, to = 0.2, count = 40000 /~" &
         & //"&sweep key = 'film.k_s', from = 0.1, to = 0.2, count = 50000 /", deck, faults, error)
      call suite%equal("largest product: faults", faults%errors(), 0)
      call suite%true("largest product: cases", deck%case_count() == 2000000000_i8)
      call deck%case_values(2000000000_i8, value)
      call suite%close("largest product: last gap", value(key_film_gap_mm), 2.0e-4_wp, 1.0e-15_wp, 0.0_wp)
      call suite%close("largest product: last k_s", value(key_film_k_s), 0.2_wp, 0.0_wp, 0.0_wp)
   end subroutine order

end program test_sweeps
