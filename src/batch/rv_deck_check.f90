!> What can be wrong with a deck whose values are each fine: their combinations, the files, keys without effect.
module rv_deck_check
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_text, only : to_text
   use rv_case_facts, only : film_is_closed
   use rv_deck_draft, only : draft_type
   use rv_hydrodynamic_load, only : load_published
   use rv_keys, only : keys, n_keys, full_name, value_text, choice_name, kind_square, kind_trace, model_film, &
      & model_film_table, key_hydro_load, key_reed_a_mm, key_reed_b_mm, key_film_fields_ms, key_film_gap_mm, key_film_k_s, &
      & key_run_model, key_run_t_end_ms, key_run_traces, key_run_trace_dt_ms, key_reed_hole_diameter_mm, &
      & key_reed_width_mm, key_fluid_density_kg_m3, key_fluid_viscosity_pa_s, key_pressure_kind, &
      & key_pressure_period_ms, key_pressure_transition_ms, key_pressure_file, key_pressure_event_ms
   use rv_trace_file, only : read_pressure_trace
   use rv_cases, only : deck_type
   implicit none
   private
   public :: check_deck

   real(wp), parameter :: most_cases = 2.0e9_wp
   real(wp), parameter :: most_samples = 1.0e7_wp   !! of the stored history of one case
   real(wp), parameter :: most_periods = 1.0e5_wp   !! in one run
   integer(i8), parameter :: most_checked = 10000_i8   !! cases looked at; beyond them each case checks itself

   !> Rules that tie values of one case together: the keys each looks at, and its pressure.kind (0: any).
   integer, parameter :: hole_fits = 1, ramp_fits = 2, few_periods = 3, event_not_negative = 4, event_in_trace = 5, &
      & end_in_trace = 6, event_before_end = 7, tip_is_round = 8, film_load = 9, film_open = 10, n_rules = 10
   integer, parameter :: rule_kind(n_rules) = [0, kind_square, kind_square, kind_square, kind_trace, kind_trace, 0, 0, 0, 0]
   integer, parameter :: rule_keys(5, n_rules) = reshape([ &
      & key_reed_hole_diameter_mm, key_reed_width_mm, 0, 0, 0, &
      & key_pressure_transition_ms, key_pressure_period_ms, 0, 0, 0, &
      & key_run_t_end_ms, key_pressure_period_ms, 0, 0, 0, &
      & key_pressure_event_ms, 0, 0, 0, 0, &
      & key_pressure_event_ms, key_pressure_file, 0, 0, 0, &
      & key_run_t_end_ms, key_pressure_file, 0, 0, 0, &
      & key_run_t_end_ms, key_pressure_event_ms, key_pressure_period_ms, key_pressure_transition_ms, &
      & key_pressure_file, &
      & key_reed_b_mm, key_reed_width_mm, key_reed_hole_diameter_mm, key_run_model, 0, &
      & key_hydro_load, key_run_model, 0, 0, 0, &
      & key_film_gap_mm, key_run_model, key_film_k_s, 0, 0], [5, n_rules])

contains

   !> Tell everything that is left to tell; reads the trace files.
   subroutine check_deck(draft)
      type(draft_type), intent(inout) :: draft
      integer :: rule

      allocate(draft%deck%trace(0))
      if (draft%is_bad(key_pressure_kind)) return
      if (nint(draft%deck%value(key_pressure_kind)) == kind_trace) call check_files(draft)
      if (.not. draft%is_bad(key_run_model)) call warn_without_effect(draft)
      if (too_many_cases(draft)) return
      do rule = 1, n_rules
         if (any(rule_kind(rule) == [0, nint(draft%deck%value(key_pressure_kind))])) call check_rule(draft, rule)
      end do
      call check_samples(draft)
      call check_fields(draft)
   end subroutine check_deck

   !> The stored histories of all cases share one time axis; it must not be endless.
   subroutine check_samples(draft)
      type(draft_type), intent(inout) :: draft
      real(wp) :: start, finish, samples

      if (any(draft%is_bad([key_run_traces, key_run_trace_dt_ms, key_run_t_end_ms, key_pressure_file]))) return
      if (draft%deck%value(key_run_traces) < 0.5_wp) return
      call draft%deck%time_span(start, finish)
      samples = (finish - start)/draft%deck%value(key_run_trace_dt_ms)
      if (samples > most_samples) call tell_at(draft, key_run_trace_dt_ms, setting(key_run_trace_dt_ms, &
         & draft%deck%value)//" stores "//to_text(samples, 3)//" samples from "//range_in_ms(start, finish) &
         & //"; at most "//to_text(nint(most_samples))//" can be stored")
   end subroutine check_samples

   !> The stored pressure fields of all cases share one mesh.
   subroutine check_fields(draft)
      type(draft_type), intent(inout) :: draft
      integer, parameter :: planform(4) = [key_reed_a_mm, key_reed_b_mm, key_reed_hole_diameter_mm, key_reed_width_mm]
      real(wp) :: start, finish
      integer :: i, outside

      if (draft%is_bad(key_film_fields_ms) .or. size(draft%deck%field_times()) == 0) return
      do i = 1, size(planform)
         if (varies(draft, planform(i))) call tell_at(draft, key_film_fields_ms, "film.fields_ms needs one planform;" &
            & //" store the fields of a sweep over "//full_name(planform(i))//" in runs of their own")
      end do
      if (any(draft%is_bad([key_run_t_end_ms, key_pressure_file]))) return
      call draft%deck%time_span(start, finish)
      outside = count(draft%deck%field_times() < start .or. draft%deck%field_times() > finish)
      if (outside > 0) call warn_at(draft, key_film_fields_ms, "film.fields_ms: "//to_text(outside) &
         & //" of its times outside the run, "//range_in_ms(start, finish)//": no field is stored for them")
   end subroutine check_fields

   !> A trace needs its file, and the event that nothing else tells.
   subroutine check_files(draft)
      type(draft_type), intent(inout) :: draft

      if (.not. draft%deck%given(key_pressure_file)) then
         call tell_at(draft, key_pressure_kind, "pressure.kind = 'trace' needs pressure.file, the CSV file of the trace")
         draft%is_bad(key_pressure_file) = .true.
      end if
      if (.not. draft%deck%given(key_pressure_event_ms)) then
         call tell_at(draft, key_pressure_kind, &
            & "pressure.kind = 'trace' needs pressure.event_ms, the time when closing starts")
         draft%is_bad(key_pressure_event_ms) = .true.
      end if
      call read_traces(draft)
   end subroutine check_files

   subroutine read_traces(draft)
      type(draft_type), intent(inout) :: draft
      type(error_type), allocatable :: error
      integer :: i, before

      before = draft%faults%errors()
      deallocate(draft%deck%trace)
      allocate(draft%deck%trace(size(draft%deck%trace_name)))
      do i = 1, size(draft%deck%trace)
         call read_pressure_trace(draft%deck%trace_file(i)%s, draft%deck%trace(i), draft%faults, error)
         if (.not. allocated(error)) cycle
         associate (mention => draft%deck%trace_mention(i))
            call draft%faults%add(mention%file, mention%line, mention%column, "pressure.file: "//error%message)
         end associate
      end do
      if (draft%faults%errors() > before) draft%is_bad(key_pressure_file) = .true.
   end subroutine read_traces

   !> More cases than a run can number? Tells it.
   logical function too_many_cases(draft)
      type(draft_type), intent(inout) :: draft
      real(wp) :: cases
      integer :: i

      cases = 1.0_wp
      do i = 1, size(draft%deck%axis)
         cases = cases*real(size(draft%deck%axis(i)%value), wp)
      end do
      if (draft%deck%has_design) cases = cases*real(size(draft%deck%design, 2), wp)
      too_many_cases = cases > most_cases
      if (too_many_cases) call tell_at(draft, draft%deck%axis(size(draft%deck%axis))%key, &
         & "the sweeps make "//to_text(cases, 3)//" cases; at most "//to_text(nint(most_cases))//" can be run")
   end function too_many_cases

   !> Look for the first case that breaks a rule.
   subroutine check_rule(draft, rule)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: rule
      real(wp) :: value(n_keys)
      integer, allocatable :: list(:)
      character(len=:), allocatable :: text
      integer(i8) :: i
      integer :: key, n

      allocate(list, source=pack(rule_keys(:, rule), rule_keys(:, rule) > 0))
      if (any(draft%is_bad(list))) return
      text = ""
      do i = 1, min(draft%deck%case_count(), most_checked)
         call draft%deck%case_values(i, value)
         text = broken_rule(draft%deck, rule, value)
         if (text /= "") exit
      end do
      if (text == "") return
      if (any(varies(draft, list))) text = "case "//to_text(i)//": "//text
      key = list(1)
      do n = size(list), 1, -1
         if (draft%deck%line(list(n)) > 0) key = list(n)
      end do
      if (any(rule == [event_before_end, film_open])) then
         call warn_at(draft, key, text)
      else
         call tell_at(draft, key, text)
      end if
   end subroutine check_rule

   !> What is wrong with the values of one case, empty if nothing.
   function broken_rule(deck, rule, value) result(text)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: rule
      real(wp), intent(in) :: value(n_keys)
      character(len=:), allocatable :: text
      real(wp) :: first, last, event, overhang
      logical :: is_film

      is_film = any(nint(value(key_run_model)) == [model_film, model_film_table])
      call time_range(deck, value, first, last)
      event = value(key_pressure_event_ms)
      if (ieee_is_nan(event)) event = 0.5_wp*(value(key_pressure_period_ms) - value(key_pressure_transition_ms))
      text = ""
      associate (finish => value(key_run_t_end_ms), period => value(key_pressure_period_ms))
         select case (rule)
         case (hole_fits)
            if (value(key_reed_hole_diameter_mm) > value(key_reed_width_mm)) text = &
               & setting(key_reed_hole_diameter_mm, value)//" must not exceed "//setting(key_reed_width_mm, value)
         case (ramp_fits)
            if (value(key_pressure_transition_ms) >= 0.5_wp*period) text = setting(key_pressure_transition_ms, value) &
               & //" must be less than half of "//setting(key_pressure_period_ms, value)
         case (few_periods)
            if (finish > most_periods*period) text = setting(key_run_t_end_ms, value)//" is more than " &
               & //to_text(nint(most_periods))//" times "//setting(key_pressure_period_ms, value)
         case (event_not_negative)
            if (event < 0.0_wp) text = setting(key_pressure_event_ms, value) &
               & //": must be >= 0 with a square wave, which starts at 0"
         case (event_in_trace)
            if (event < first .or. event > last) text = setting(key_pressure_event_ms, value) &
               & //" must lie within the trace, "//range_in_ms(first, last)
         case (end_in_trace)
            if (finish <= first .or. finish > last) text = setting(key_run_t_end_ms, value) &
               & //" must lie within the trace, "//range_in_ms(first, last)
         case (tip_is_round)
            overhang = 0.5_wp*(value(key_reed_width_mm) - value(key_reed_hole_diameter_mm))
            if (.not. is_film) return
            if (overhang > 0.0_wp .and. abs(value(key_reed_b_mm) - overhang) <= 1.0e-6_wp*overhang) return
            text = setting(key_reed_b_mm, value)//": the film models need a tip concentric with the hole," &
               & //" b = (width - hole diameter)/2 = "//to_text(1.0e3_wp*overhang, 6)//" mm, > 0"
         case (film_load)
            if (is_film .and. nint(value(key_hydro_load)) == load_published) text = setting(key_hydro_load, value) &
               & //" is a reading of the lumped models; the film models take 'maali', 'sader' or 'none'"
         case (film_open)
            if (film_is_closed(value)) text = setting(key_film_gap_mm, value) &
               & //": the film is closed from the start; such a case ends there as film_closed"
         case default
            if (event >= finish) text = setting(key_run_t_end_ms, value)//" ends the run before closing starts at " &
               & //to_text(1.0e3_wp*event, 6)//" ms; no closing is measured"
         end select
      end associate
   end function broken_rule

   !> First and last time that the pressures are known [s]; a square wave starts at 0 and has no end.
   subroutine time_range(deck, value, first, last)
      type(deck_type), intent(in) :: deck
      real(wp), intent(in) :: value(n_keys)
      real(wp), intent(out) :: first, last
      integer :: file

      first = 0.0_wp
      last = huge(1.0_wp)
      file = nint(value(key_pressure_file))
      if (file < 1 .or. file > size(deck%trace)) return
      associate (time => deck%trace(file)%time)
         if (size(time) == 0) return   ! its faults have been told
         first = time(1)
         last = time(size(time))
      end associate
   end subroutine time_range

   function range_in_ms(first, last) result(text)
      real(wp), intent(in) :: first, last   !! [s]
      character(len=:), allocatable :: text

      text = to_text(1.0e3_wp*first, 8)//" to "//to_text(1.0e3_wp*last, 8)//" ms"
   end function range_in_ms

   !> "film.gap_mm = 0.05"
   function setting(key, value) result(text)
      integer, intent(in) :: key
      real(wp), intent(in) :: value(n_keys)
      character(len=:), allocatable :: text

      text = full_name(key)//" = "//value_text(key, value(key))
   end function setting

   !> Does a key differ between cases?
   elemental logical function varies(draft, key)
      type(draft_type), intent(in) :: draft
      integer, intent(in) :: key

      varies = draft%sweep_line(key) > 0
      if (draft%deck%has_design) varies = varies .or. any(draft%deck%design_key == key)
   end function varies

   !> Keys that were given but change nothing.
   subroutine warn_without_effect(draft)
      type(draft_type), intent(inout) :: draft
      integer :: key

      do key = 1, n_keys
         if (.not. draft%deck%given(key) .or. draft%deck%matters(key)) cycle
         call warn_at(draft, key, full_name(key)//" has no effect "//reason(draft%deck, key))
      end do
   end subroutine warn_without_effect

   !> Why a key has no effect.
   function reason(deck, key) result(text)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: key
      character(len=:), allocatable :: text
      integer :: kind

      kind = nint(deck%value(key_pressure_kind))
      if (keys(key)%for_kind > 0 .and. keys(key)%for_kind /= kind) then
         text = "with pressure.kind = '"//choice_name(key_pressure_kind, kind)//"'"
      else if (key == key_run_trace_dt_ms) then
         text = "without run.traces = .true."
      else if (key == key_fluid_density_kg_m3 .or. key == key_fluid_viscosity_pa_s) then
         text = "with hydro.load = 'none'"
      else
         text = "on the model '"//choice_name(key_run_model, nint(deck%value(key_run_model)))//"'"
      end if
   end function reason

   !> Add a fault where the deck gives a key, or of the deck as a whole.
   subroutine tell_at(draft, key, text)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: key
      character(len=*), intent(in) :: text

      call draft%faults%add(draft%scan%file, draft%deck%line(key), draft%deck%column(key), text)
   end subroutine tell_at

   !> Add a warning where the deck gives a key, or of the deck as a whole.
   subroutine warn_at(draft, key, text)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: key
      character(len=*), intent(in) :: text

      call draft%faults%warn(draft%scan%file, draft%deck%line(key), draft%deck%column(key), text)
   end subroutine warn_at

end module rv_deck_check
