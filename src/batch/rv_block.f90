!> Run one block: a fixed stretch of consecutive cases.
!>
!> The block is the unit of work, of the crash journal and of reproducibility. Its cases are sorted by
!> the times of their pressure history (lanes must share those) and, within them, by how the film slows the
!> reed and by pressure (lanes of like cases share their step sizes best), then cut into groups of at most
!> `solver.width` lanes; results come back in deck order. The cut depends on the block alone, never on who runs it.
module rv_block
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_value, ieee_quiet_nan
   use rv_blas_threads, only : begin_one_blas_thread, end_one_blas_thread
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_case_facts, only : case_facts, add_note
   use rv_cases, only : deck_type
   use rv_columns, only : column_type, measure_columns, fact_columns, trace_columns, n_facts, n_traces, n_lumped_traces, &
      & fact_lowest_pressure, fact_method
   use rv_film_case, only : planform_cache, planform_key, n_planform, mesh_nodes
   use rv_keys, only : n_keys, from_si, to_si, model_film, model_film_table, key_film_mesh, key_run_model, &
      & key_run_start, key_run_t_end_ms, key_run_traces, key_run_trace_dt_ms, key_run_block_size, key_film_gap_mm, &
      & key_film_vapour_pressure_kpa, key_fluid_viscosity_pa_s, key_reed_a_mm, key_reed_b_mm, key_reed_hole_diameter_mm, &
      & key_pressure_kind, key_pressure_inlet_kpa, &
      & key_pressure_period_ms, key_pressure_transition_ms, key_pressure_file, key_pressure_event_ms, &
      & key_solver_rtol, key_solver_max_steps, key_solver_method, key_solver_width
   use rv_lanes, only : lane_outcome, method_auto, method_implicit, run_lanes
   use rv_measures, only : n_measures, measure_steady, measure_overshoot, measure_undershoot
   use rv_number, only : tidy
   use rv_pressure, only : pressure_history
   use rv_sort, only : sorted_order
   use rv_status, only : status_ok, status_bad_case, status_film_closed, warn_cavitation, warn_large_slope, warn_not_open
   use rv_text, only : text_type, time_text, to_text
   use rv_valve_case, only : new_case_lanes, new_history, settings_of
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: block_result, run_block, trace_times, trace_count, field_nodes, block_count, block_bounds
   public :: n_measures, n_facts, n_traces
   public :: column_type, measure_columns, fact_columns, trace_columns

   !> Results of one block; SI. n is the number of its cases.
   type :: block_result
      integer(i8) :: first = 0                     !! number of its first case, from 1
      real(wp), allocatable :: measure(:, :)       !! (n_measures, n); NaN: did not happen
      real(wp), allocatable :: fact(:, :)          !! (n_facts, n)
      integer, allocatable :: status(:)            !! (n)
      integer, allocatable :: warnings(:)          !! (n) sum of bits
      type(text_type), allocatable :: message(:)   !! (n) why a case failed or what it warns of, or empty
      real(wp), allocatable :: trace(:, :, :)      !! (time, trace_count, n); NaN outside the case's run
      real(wp), allocatable :: field(:, :, :)      !! film pressure (nodes, field time, n) [Pa]; NaN where there is none
   end type block_result

   !> What lanes of one group must share, besides the planform of film models.
   integer, parameter :: shared_keys(10) = [key_run_model, key_pressure_kind, key_pressure_period_ms, &
      & key_pressure_transition_ms, key_pressure_file, key_pressure_event_ms, key_run_t_end_ms, key_run_start, &
      & key_solver_rtol, key_solver_max_steps]
   real(wp), parameter :: least_gap = 1.0e-9_wp   !! keys allow no other but 0 below it [m]
   integer, parameter :: n_shared = n_planform + size(shared_keys)

   ! Blocks that the deck leaves to us: many enough for many workers, large enough that lanes find like neighbours,
   ! small enough that a killed run loses seconds. 2048 is a multiple of every likely width: no lane is left empty.
   integer(i8), parameter :: wanted_blocks = 64, fewest_cases = 2048, most_cases = 8192
   integer(i8), parameter :: fewest_film_cases = 16, most_film_cases = 256  !! of the model film: some 0.1 s a case

   integer(i8), parameter :: most_trace_bytes = 64*1024**2  !! of one block's traces in memory

   !> Tip displacement over length beyond which a reed is marked: linear theory is then 1 to 3 % off, see the theory page.
   real(wp), parameter :: steepest = 0.2_wp

contains

   !> Run cases first..last of the deck. Failures are per case and never end the block.
   subroutine run_block(deck, first, last, result, cache)
      type(deck_type), intent(in) :: deck
      integer(i8), intent(in) :: first, last   !! 1 <= first <= last <= case_count
      type(block_result), intent(out) :: result
      type(planform_cache), intent(inout), optional, target :: cache   !! of whoever runs block after block
      type(planform_cache), target :: own
      type(planform_cache), pointer :: planform
      real(wp), allocatable :: value(:, :), order_by(:, :), time(:)
      integer, allocatable :: order(:)
      integer :: n, i, top, widest
      logical :: is_implicit

      planform => own
      if (present(cache)) planform => cache
      n = int(last - first) + 1
      allocate(value(n_keys, n), order_by(n_shared + 2, n))
      time = trace_times(deck)
      call prepare(deck, result, first, n, size(time))
      do i = 1, n
         call deck%case_values(first + i - 1, value(:, i))
         order_by(:n_planform, i) = planform_key(value(:, i))
         order_by(n_planform + 1:n_shared, i) = value(shared_keys, i)
         order_by(n_shared + 1, i) = value(key_fluid_viscosity_pa_s, i)/max(value(key_film_gap_mm, i), least_gap)**3
         order_by(n_shared + 2, i) = value(key_pressure_inlet_kpa, i)
      end do
      where (ieee_is_nan(order_by)) order_by = -huge(1.0_wp)

      call begin_one_blas_thread()
      is_implicit = nint(deck%value(key_solver_method)) == method_implicit
      order = like_by_like(order_by, strip=merge(2, 1, is_implicit)*nint(deck%value(key_solver_width)))
      i = 1
      do while (i <= n)
         widest = min(n, i - 1 + widest_group(deck, value(:, order(i))))
         top = i - 1 + length_of_group(order_by(:n_shared, order(i:widest)))
         call run_group(deck, value(:, order(i:top)), order(i:top), time, planform, result)
         i = top + 1
      end do
      call end_one_blas_thread()
   end subroutine run_block

   !> The order of cases, which are columns of `key`: by what they share, then by the last but one, then by the last.
   !>
   !> Of each `strip` that follow each other the last decides alone. That narrows the groups' range of pressures at the
   !> price of their range of stiffness, which bounds explicit steps.
   pure function like_by_like(key, strip) result(order)
      real(wp), intent(in) :: key(:, :)
      integer, intent(in) :: strip
      integer :: order(size(key, 2))
      integer :: i, k, top

      order = sorted_order(key)
      do i = 1, size(order), strip
         top = min(i + strip - 1, size(order))
         order(i:top) = order(i - 1 + sorted_order(key([(k, k=1, n_shared), n_shared + 2], order(i:top))))
      end do
   end function like_by_like

   !> How many of the first columns are equal.
   pure integer function length_of_group(shared) result(length)
      real(wp), intent(in) :: shared(:, :)

      do length = 1, size(shared, 2) - 1
         if (any(abs(shared(:, length + 1) - shared(:, 1)) > 0.0_wp)) return
      end do
   end function length_of_group

   !> Lanes an integrator may have: solver.width; one where states have many degrees of freedom.
   pure integer function widest_group(deck, value) result(width)
      type(deck_type), intent(in) :: deck
      real(wp), intent(in) :: value(n_keys)

      width = nint(deck%value(key_solver_width))
      if (nint(value(key_run_model)) == model_film) width = 1
   end function widest_group

   !> Run the lanes of one group and put their results in place. Cases that only their group may have kept from their end
   !> run again, each alone, and implicitly where that was left to us.
   recursive subroutine run_group(deck, value, place, time, cache, result)
      type(deck_type), intent(in) :: deck
      real(wp), intent(in) :: value(:, :)       !! (n_keys, cases of the group)
      integer, intent(in) :: place(:)           !! their places in the block
      real(wp), intent(in) :: time(:)
      type(planform_cache), intent(inout) :: cache
      type(block_result), intent(inout) :: result
      class(pressure_history), allocatable :: history
      class(valve_lanes), allocatable :: lanes
      type(case_facts) :: facts(size(place))
      type(lane_outcome) :: outcome
      type(error_type), allocatable :: error
      integer :: i, lane

      call new_case_lanes(value, cache, lanes, facts)
      call new_history(value(:, 1), deck%trace, history, error)
      if (.not. allocated(error) .and. allocated(lanes)) then
         call run_lanes(lanes, history, settings_of(value(:, 1)), time, outcome, deck%field_times())
      end if
      lane = 0
      do i = 1, size(place)
         if (allocated(error) .and. .not. allocated(facts(i)%error)) facts(i)%error = error
         if (allocated(facts(i)%error)) then
            result%status(place(i)) = status_bad_case
            result%message(place(i))%s = facts(i)%error%message
            cycle
         end if
         if (facts(i)%is_closed) then
            call note_end(facts(i), status_film_closed, "at t = "//time_text(history%start) &
               & //": the film under the reed is closed over the whole land: the gap is 0", place(i), result)
            cycle
         end if
         lane = lane + 1
         if (outcome%given_up(lane) .and. (size(place) > 1 .or. is_auto(value(:, i)))) then
            call run_group(deck, alone(value(:, i)), place(i:i), time, cache, result)
         else
            call note_outcome(value(:, i), facts(i), outcome, lane, place(i), result)
         end if
      end do
   end subroutine run_group

   pure logical function is_auto(value)
      real(wp), intent(in) :: value(n_keys)

      is_auto = nint(value(key_solver_method)) == method_auto
   end function is_auto

   !> A case as a group of its own.
   pure function alone(value) result(group)
      real(wp), intent(in) :: value(n_keys)
      real(wp) :: group(n_keys, 1)

      group(:, 1) = value
      if (is_auto(value)) group(key_solver_method, 1) = real(method_implicit, wp)
   end function alone

   !> Results of one lane.
   subroutine note_outcome(value, facts, outcome, lane, place, result)
      real(wp), intent(in) :: value(n_keys)
      type(case_facts), intent(inout) :: facts
      type(lane_outcome), intent(in) :: outcome
      integer, intent(in) :: lane, place
      type(block_result), intent(inout) :: result
      integer :: traces

      facts%fact(fact_method) = merge(2.0_wp, 1.0_wp, outcome%is_explicit)
      associate (lowest => outcome%lowest_pressure(lane))
         if (lowest < huge(lowest)) then
            facts%fact(fact_lowest_pressure) = lowest
            if (lowest < value(key_film_vapour_pressure_kpa)) then
               facts%warnings = ior(facts%warnings, warn_cavitation)
               call add_note(facts, "the film's pressure falls to "//to_text(1.0e-3_wp*lowest, 4) &
                  & //" kPa, below the vapour pressure: the oil would cavitate")
            end if
         end if
      end associate
      call look_at_bend(value, outcome%measure(:, lane), facts)
      if (outcome%status(lane) == status_ok) call look_at_steady(outcome%measure(measure_steady, lane), facts)
      traces = size(outcome%trace, 2)
      result%measure(:, place) = outcome%measure(:, lane)
      result%trace(:, :traces, place) = outcome%trace(:, :, lane)
      if (size(outcome%field) > 0) result%field(:, :, place) = outcome%field(:, :, lane)
      call note_end(facts, outcome%status(lane), outcome%message(lane)%s, place, result)
   end subroutine note_outcome

   !> Warn of a reed that bends further than its theory goes.
   subroutine look_at_bend(value, measure, facts)
      real(wp), intent(in) :: value(n_keys)
      real(wp), intent(in) :: measure(n_measures)
      type(case_facts), intent(inout) :: facts
      real(wp) :: length, largest

      length = value(key_reed_a_mm) + value(key_reed_hole_diameter_mm) + value(key_reed_b_mm)
      largest = 0.0_wp
      call enlarge(measure(measure_steady))
      call enlarge(measure(measure_steady) + measure(measure_overshoot))
      call enlarge(measure(measure_undershoot))
      if (largest <= steepest*length) return
      facts%warnings = ior(facts%warnings, warn_large_slope)
      call add_note(facts, "the tip moves by "//to_text(1.0e3_wp*largest, 4)//" mm, "//to_text(largest/length, 2) &
         & //" of the reed's length: too steep for the theory of small slopes")

   contains

      !> A measure that is missing says nothing.
      subroutine enlarge(u)
         real(wp), intent(in) :: u

         if (abs(u) > largest) largest = abs(u)
      end subroutine enlarge

   end subroutine look_at_bend

   !> Say why the times are missing of a reed that the pressure does not hold open at the event.
   subroutine look_at_steady(steady, facts)
      real(wp), intent(in) :: steady   !! [m]; NaN: on its seat
      type(case_facts), intent(inout) :: facts

      if (steady > 0.0_wp) return
      facts%warnings = ior(facts%warnings, warn_not_open)
      if (ieee_is_nan(steady)) then
         call add_note(facts, "at the closing event the pressure presses the reed onto its seat: no times are measured")
      else
         call add_note(facts, "at the closing event the pressure does not hold the reed open: no times are measured")
      end if
   end subroutine look_at_steady

   !> How a case ended, and what is known of it. A failure's reason stands before the warnings.
   subroutine note_end(facts, status, message, place, result)
      type(case_facts), intent(in) :: facts
      integer, intent(in) :: status, place
      character(len=*), intent(in) :: message
      type(block_result), intent(inout) :: result

      result%fact(:, place) = facts%fact
      result%status(place) = status
      result%warnings(place) = facts%warnings
      if (message /= "") result%message(place)%s = message
      if (.not. allocated(facts%note)) return
      if (status /= status_ok) result%message(place)%s = result%message(place)%s//"; "
      result%message(place)%s = result%message(place)%s//facts%note
   end subroutine note_end

   subroutine prepare(deck, result, first, n, times)
      type(deck_type), intent(in) :: deck
      type(block_result), intent(inout) :: result
      integer(i8), intent(in) :: first
      integer, intent(in) :: n, times
      real(wp) :: nan
      integer :: i

      nan = ieee_value(1.0_wp, ieee_quiet_nan)
      result%first = first
      allocate(result%measure(n_measures, n), source=nan)
      allocate(result%fact(n_facts, n), source=nan)
      allocate(result%trace(times, trace_count(deck), n), source=nan)
      allocate(result%field(field_nodes(deck), size(deck%field_times()), n), source=nan)
      allocate(result%status(n), source=status_ok)
      allocate(result%warnings(n), source=0)
      allocate(result%message(n))
      do i = 1, n
         result%message(i)%s = ""
      end do
   end subroutine prepare

   !> The grid of times of all traces [s]; empty where none are asked for. It spans all cases.
   function trace_times(deck) result(time)
      type(deck_type), intent(in) :: deck
      real(wp), allocatable :: time(:)
      real(wp) :: start, finish, dt
      integer :: k, n

      allocate(time(0))
      if (nint(deck%value(key_run_traces)) == 0) return
      call deck%time_span(start, finish)
      dt = deck%value(key_run_trace_dt_ms)
      n = int((finish - start)/dt*(1.0_wp + 1.0e-12_wp) + 1.0e-6_wp)
      ! the decimal of a grid time is that of a t_end: a case that ends on the grid has its last sample
      time = to_si(key_run_trace_dt_ms, tidy(from_si(key_run_trace_dt_ms, start) &
         & + real([(k, k = 0, n)], wp)*from_si(key_run_trace_dt_ms, dt)))
      time = max(start, min(time, finish))
   end function trace_times

   !> Values in a trace sample: those of the film models only where one runs.
   pure integer function trace_count(deck) result(count)
      type(deck_type), intent(in) :: deck

      count = merge(n_traces, n_lumped_traces, any(deck%uses_model([model_film, model_film_table])))
   end function trace_count

   !> Nodes of the stored film pressure fields; 0 where none are asked for.
   pure integer function field_nodes(deck) result(nodes)
      type(deck_type), intent(in) :: deck

      nodes = 0
      if (size(deck%field_times()) > 0) nodes = mesh_nodes(nint(deck%value(key_film_mesh)))
   end function field_nodes

   !> Cases in a block: run.block_size, fewer where their traces would take too much memory. The deck alone decides,
   !> not who works on it: the cut shows in the last digits.
   integer(i8) function cases_per_block(deck) result(n)
      type(deck_type), intent(in) :: deck
      integer(i8) :: bytes, fewest, most

      n = nint(deck%value(key_run_block_size), i8)
      if (n == 0) then
         fewest = fewest_cases
         most = most_cases
         if (deck%uses_model(model_film)) then
            fewest = fewest_film_cases
            most = most_film_cases
         end if
         n = max(fewest, min(most, fewest*(deck%case_count()/(wanted_blocks*fewest))))
      end if
      bytes = 8*(int(trace_count(deck), i8)*size(trace_times(deck)) &
         & + int(field_nodes(deck), i8)*size(deck%field_times()))
      if (bytes > 0) n = max(1_i8, min(n, most_trace_bytes/bytes))
   end function cases_per_block

   !> Number of blocks.
   integer function block_count(deck) result(count)
      type(deck_type), intent(in) :: deck
      integer(i8) :: size

      size = cases_per_block(deck)
      count = int((deck%case_count() + size - 1)/size)
   end function block_count

   !> First and last case of block i, 1 <= i <= block_count.
   subroutine block_bounds(deck, i, first, last)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: i
      integer(i8), intent(out) :: first, last
      integer(i8) :: size

      size = cases_per_block(deck)
      first = (i - 1)*size + 1
      last = min(first + size - 1, deck%case_count())
   end subroutine block_bounds

end module rv_block
