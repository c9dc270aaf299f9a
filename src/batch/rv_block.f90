!> Run one block: a fixed stretch of consecutive cases.
!>
!> The block is the unit of work, of the crash journal and of reproducibility. Its cases are sorted by
!> the times of their pressure history (lanes must share those) and, within them, by how fast film and
!> pressure move the reed (lanes of like cases share their step sizes best), then cut into groups of at most
!> `solver.width` lanes; results come back in deck order. The cut depends on the block alone, never on who runs it.
module rv_block
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_cases, only : deck_type
   use rv_columns, only : column_type, measure_columns, fact_columns, trace_columns, n_facts, n_traces
   use rv_keys, only : n_keys, from_si, to_si, kind_trace, key_run_start, key_run_t_end_ms, key_run_traces, key_run_trace_dt_ms, &
      & key_run_block_size, key_pressure_kind, key_pressure_period_ms, key_pressure_transition_ms, key_pressure_file, &
      & key_pressure_event_ms, key_solver_rtol, key_solver_max_steps, key_solver_width
   use rv_lanes, only : lane_outcome, run_lanes
   use rv_lumped, only : lumped_lanes, lumped_valve, new_lumped_lanes
   use rv_measures, only : n_measures
   use rv_number, only : tidy
   use rv_pressure, only : pressure_history
   use rv_sort, only : sorted_order
   use rv_status, only : status_ok, status_bad_case
   use rv_text, only : text_type
   use rv_valve_lanes, only : valve_lanes
   use rv_valve_case, only : new_valve, new_history, settings_of
   implicit none
   private
   public :: block_result, run_block, trace_times, block_count, block_bounds
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
      real(wp), allocatable :: trace(:, :, :)      !! (time, n_traces, n); NaN outside the case's run
   end type block_result

   !> What lanes of one group must share.
   integer, parameter :: shared_keys(9) = [key_pressure_kind, key_pressure_period_ms, key_pressure_transition_ms, &
      & key_pressure_file, key_pressure_event_ms, key_run_t_end_ms, key_run_start, key_solver_rtol, key_solver_max_steps]

   integer(i8), parameter :: most_trace_bytes = 64*1024**2  !! of one block's traces in memory

contains

   !> Run cases first..last of the deck. Failures are per case and never end the block.
   subroutine run_block(deck, first, last, result)
      type(deck_type), intent(in) :: deck
      integer(i8), intent(in) :: first, last   !! 1 <= first <= last <= case_count
      type(block_result), intent(out) :: result
      type(lumped_valve), allocatable :: valve(:)
      real(wp), allocatable :: value(:, :), order_by(:, :), time(:)
      integer, allocatable :: order(:)
      type(error_type), allocatable :: error
      integer :: n, i, k, top, width

      n = int(last - first) + 1
      allocate(valve(n), value(n_keys, n), order_by(size(shared_keys) + 2, n))
      time = trace_times(deck)
      call prepare(result, first, n, size(time))
      do i = 1, n
         call deck%case_values(first + i - 1, value(:, i))
         call new_valve(value(:, i), valve(i), result%fact(:, i), result%warnings(i), result%message(i)%s, error)
         if (allocated(error)) call refuse(result, i, error)
         order_by(:, i) = [value(shared_keys, i), valve(i)%squeeze/(valve(i)%mass*valve(i)%gap**3), &
            & (valve(i)%inlet - valve(i)%outlet)*valve(i)%area/valve(i)%stiffness]
      end do
      where (ieee_is_nan(order_by)) order_by = -huge(1.0_wp)

      order = sorted_order(order_by)
      order = pack(order, result%status(order) == status_ok)
      width = nint(deck%value(key_solver_width))
      i = 1
      do while (i <= size(order))
         top = min(i + width - 1, size(order))
         do k = i + 1, top
            if (any(abs(order_by(:size(shared_keys), order(k)) - order_by(:size(shared_keys), order(i))) > 0.0_wp)) then
               top = k - 1
               exit
            end if
         end do
         call run_group(deck, value(:, order(i)), valve(order(i:top)), order(i:top), time, result)
         i = top + 1
      end do
   end subroutine run_block

   !> Run the lanes of one group and put their results in place.
   subroutine run_group(deck, value, valve, place, time, result)
      type(deck_type), intent(in) :: deck
      real(wp), intent(in) :: value(n_keys)     !! of any case of the group: the shared keys count
      type(lumped_valve), intent(in) :: valve(:)
      integer, intent(in) :: place(:)           !! (size(valve)) place in the block
      real(wp), intent(in) :: time(:)
      type(block_result), intent(inout) :: result
      class(pressure_history), allocatable :: history
      type(lumped_lanes) :: lumped
      class(valve_lanes), allocatable :: lanes
      type(lane_outcome) :: outcome
      type(error_type), allocatable :: error
      integer :: i

      call new_history(value, deck%trace, history, error)
      if (allocated(error)) then
         do i = 1, size(place)
            call refuse(result, place(i), error)
         end do
         return
      end if
      call new_lumped_lanes(lumped, valve)
      allocate(lanes, source=lumped)
      call run_lanes(lanes, history, settings_of(value), time, outcome)
      do i = 1, size(place)
         result%measure(:, place(i)) = outcome%measure(:, i)
         result%status(place(i)) = outcome%status(i)
         if (outcome%status(i) /= status_ok) result%message(place(i))%s = outcome%message(i)%s
         result%trace(:, :, place(i)) = outcome%trace(:, :, i)
      end do
   end subroutine run_group

   subroutine prepare(result, first, n, times)
      type(block_result), intent(inout) :: result
      integer(i8), intent(in) :: first
      integer, intent(in) :: n, times
      real(wp) :: nan

      nan = ieee_value(1.0_wp, ieee_quiet_nan)
      result%first = first
      allocate(result%measure(n_measures, n), source=nan)
      allocate(result%fact(n_facts, n), source=nan)
      allocate(result%trace(times, n_traces, n), source=nan)
      allocate(result%status(n), source=status_ok)
      allocate(result%warnings(n), source=0)
      allocate(result%message(n))
   end subroutine prepare

   subroutine refuse(result, i, error)
      type(block_result), intent(inout) :: result
      integer, intent(in) :: i
      type(error_type), intent(in) :: error

      result%status(i) = status_bad_case
      result%message(i)%s = error%message
   end subroutine refuse

   !> The grid of times of all traces [s]; empty where none are asked for. It spans all cases.
   function trace_times(deck) result(time)
      type(deck_type), intent(in) :: deck
      real(wp), allocatable :: time(:)
      real(wp) :: start, finish, dt
      integer :: k, n

      allocate(time(0))
      if (nint(deck%value(key_run_traces)) == 0) return
      call time_span(deck, start, finish)
      dt = deck%value(key_run_trace_dt_ms)
      n = int((finish - start)/dt*(1.0_wp + 1.0e-12_wp) + 1.0e-6_wp)
      ! the decimal of a grid time is that of a t_end: a case that ends on the grid has its last sample
      time = to_si(key_run_trace_dt_ms, tidy(from_si(key_run_trace_dt_ms, start) &
         & + real([(k, k = 0, n)], wp)*from_si(key_run_trace_dt_ms, dt)))
      time = max(start, min(time, finish))
   end function trace_times

   !> Earliest start and latest end over the deck's axes; all combinations of an axis' values lie in between.
   subroutine time_span(deck, start, finish)
      type(deck_type), intent(in) :: deck
      real(wp), intent(out) :: start, finish
      real(wp) :: value(n_keys)
      integer :: i

      start = 0.0_wp
      if (nint(deck%value(key_pressure_kind)) == kind_trace) then
         start = huge(1.0_wp)
         do i = 1, size(deck%trace)
            start = min(start, deck%trace(i)%time(1))
         end do
      end if
      finish = deck%value(key_run_t_end_ms)
      do i = 1, size(deck%axis)
         if (deck%axis(i)%key == key_run_t_end_ms) finish = maxval(deck%axis(i)%value)
      end do
      if (deck%has_design) then
         do i = 1, size(deck%design_key)
            if (deck%design_key(i) == key_run_t_end_ms) finish = maxval(deck%design(i, :))
         end do
      end if
      if (.not. ieee_is_nan(finish)) return
      finish = start
      do i = 1, size(deck%trace)
         finish = max(finish, deck%trace(i)%time(size(deck%trace(i)%time)))
      end do
      if (size(deck%trace) > 0) return
      call deck%case_values(1_i8, value)
      finish = value(key_run_t_end_ms)
   end subroutine time_span

   !> Cases in a block: run.block_size, fewer where their traces would take too much memory.
   integer(i8) function cases_per_block(deck) result(n)
      type(deck_type), intent(in) :: deck
      integer(i8) :: bytes

      n = nint(deck%value(key_run_block_size), i8)
      bytes = 8*int(n_traces, i8)*size(trace_times(deck))
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
