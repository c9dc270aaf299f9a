!> Run a group of cases, side by side, through one ARKODE integrator.
!>
!> All cases of a group share the pressure history's times, the end time and the tolerance. The error
!> norm is the largest of the lanes' norms: a case is never less accurate for its company, and a case
!> that fails is taken out while the others go on.
module rv_lanes
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_cash_karp, only : cash_karp, new_cash_karp
   use rv_esdirk, only : esdirk, new_esdirk
   use rv_integrator, only : integrator_type, step_at_stop, step_done, step_not_finite
   use rv_measures, only : measure_lanes, new_measure_lanes, n_measures
   use rv_pressure, only : pressure_history
   use rv_problem, only : problem_type, pose
   use rv_rest, only : rest_type
   use rv_sampler, only : sampler_type, new_sampler
   use rv_status, only : status_ok, status_step_too_small, status_film_closed, status_not_finite, &
      & status_too_many_steps, status_no_convergence
   use rv_step, only : step_type, new_step
   use rv_text, only : text_type, time_text, to_text
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: lane_settings, lane_outcome, run_lanes
   public :: method_implicit, method_explicit, method_auto

   integer, parameter :: method_implicit = 1, method_explicit = 2, method_auto = 3

   !> Steps below this part of the time to integrate, so many in a row, are no progress: a film that closes draws the
   !> steps to the instant of its closing, for ever where rounding keeps its last gap open.
   real(wp), parameter :: no_progress = 1.0e-13_wp
   integer, parameter :: patience = 10
   integer, parameter :: step_stuck = -1000   !! beside the integrators' flags

   !> How to integrate.
   type :: lane_settings
      real(wp) :: t_end = 0.0_wp             !! [s]
      real(wp) :: rtol = 1.0e-6_wp           !! allowed error of a step, relative to the state plus its scale [-]
      integer :: max_steps = 1000000         !! accepted steps of the group
      logical :: from_equilibrium = .false.  !! start at the static equilibrium, else at rest on u = 0
      integer :: method = method_implicit
      real(wp) :: fixed_step = 0.0_wp        !! [s]; > 0: no step control (for studies of convergence)
      real(wp) :: first_step = 0.0_wp        !! to try first [s]; 0: chosen here
      real(wp), allocatable :: state(:)      !! to start from, as an outcome's; unallocated: at rest or equilibrium
   end type lane_settings

   !> What came out; arrays end in (width).
   type :: lane_outcome
      integer, allocatable :: status(:)          !! status_
      type(text_type), allocatable :: message(:) !! why and when a lane failed, else empty
      logical, allocatable :: given_up(:)        !! lanes that failed with their group, and alone might not
      real(wp), allocatable :: measure(:, :)     !! (n_measures, width)
      real(wp), allocatable :: trace(:, :, :)    !! (time, traces, width)
      real(wp), allocatable :: field(:, :, :)    !! film pressure (nodes, field time, width) [Pa]
      real(wp), allocatable :: lowest_pressure(:) !! lowest pressure seen in the film [Pa]; huge if none was
      integer :: steps = 0                       !! accepted
      logical :: is_explicit = .false.           !! how the group was integrated
      real(wp), allocatable :: state(:)          !! at the end: displacements [m] (width*dofs), then velocities [m s-1]
      real(wp) :: last_step = 0.0_wp             !! the longer of the last two: a stop may have cut the last one [s]
   end type lane_outcome

contains

   !> Integrate all cases from the start of the history to settings%t_end. The lanes are used up.
   subroutine run_lanes(lanes, history, settings, trace_time, outcome, field_time)
      class(valve_lanes), allocatable, intent(inout) :: lanes
      class(pressure_history), intent(in) :: history
      type(lane_settings), intent(in) :: settings
      real(wp), intent(in) :: trace_time(:)     !! [s], rising; may be empty
      type(lane_outcome), intent(out) :: outcome
      real(wp), intent(in), optional :: field_time(:)   !! of film pressure fields [s], rising
      type(problem_type), target :: problem
      type(measure_lanes) :: measures
      type(sampler_type) :: sampler
      type(step_type) :: step
      class(integrator_type), allocatable :: integrator
      real(wp), dimension(lanes%width, lanes%dofs) :: q, v
      integer :: w, i

      w = lanes%width
      allocate(outcome%status(w), source=status_ok)
      allocate(outcome%given_up(w), source=.false.)
      allocate(outcome%message(w))
      do i = 1, w
         outcome%message(i)%s = ""
      end do
      call pose(problem, lanes, history, settings%rtol)
      call initial_state(problem, settings, q, v, outcome)
      call begin_step(problem, history%start, q, v, outcome%status == status_ok, step)
      call new_measure_lanes(measures, history%start, history%event, min(history%cycle_end, settings%t_end), &
         & steady_state(problem), step%u1, settings%rtol)
      call new_sampler(sampler, trace_time, problem%lanes, field_time)
      call sampler%sample(step, problem%lanes, history)

      if (any(outcome%status == status_ok)) then
         if (start_integrator(problem, settings, step, integrator, outcome)) then
            call integrate(problem, settings, history%stops(settings%t_end), integrator, step, measures, sampler, outcome)
         end if
      end if

      allocate(outcome%measure(n_measures, w))
      do i = 1, w
         outcome%measure(:, i) = measures%results(i)
      end do
      outcome%lowest_pressure = problem%lanes%lowest_pressure
      outcome%state = [step%q1, step%v1]
      call move_alloc(sampler%value, outcome%trace)
      call move_alloc(sampler%field, outcome%field)
   end subroutine run_lanes

   !> Initial state: as given, at rest on u = 0, or at the static equilibrium. A lane that has none is taken out.
   subroutine initial_state(problem, settings, q, v, outcome)
      type(problem_type), intent(inout) :: problem
      type(lane_settings), intent(in) :: settings
      real(wp), dimension(problem%lanes%width, problem%lanes%dofs), intent(out) :: q, v
      type(lane_outcome), intent(inout) :: outcome
      real(wp) :: inlet, outlet
      logical :: found(problem%lanes%width)
      integer :: i

      q = 0.0_wp
      v = 0.0_wp
      if (allocated(settings%state)) then
         q = reshape(settings%state(:size(q)), shape(q))
         v = reshape(settings%state(size(q) + 1:), shape(v))
      else if (settings%from_equilibrium) then
         call problem%history%factors(problem%history%start, inlet, outlet)
         call problem%lanes%equilibrium(inlet, outlet, q, found)
         do i = 1, problem%lanes%width
            if (found(i)) cycle
            outcome%status(i) = status_film_closed
            outcome%message(i)%s = "at t = "//time_text(problem%history%start) &
               & //": no static equilibrium to start from, the pressure closes the film under the reed"
            call problem%lanes%silence(i)
            q(i, :) = 0.0_wp
         end do
      end if
   end subroutine initial_state

   !> Static tip displacement at the event [m]; NaN where the reed would lie on its seat, or nothing is measured.
   function steady_state(problem) result(u)
      type(problem_type), intent(inout) :: problem
      real(wp) :: u(problem%lanes%width)
      real(wp) :: q(problem%lanes%width, problem%lanes%dofs), inlet, outlet
      logical :: found(problem%lanes%width)

      u = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. problem%history%cycle_end > problem%history%start) return
      call problem%history%factors(problem%history%event, inlet, outlet)
      call problem%lanes%equilibrium(inlet, outlet, q, found)
      u = merge(matmul(q, problem%lanes%tip), ieee_value(1.0_wp, ieee_quiet_nan), found)
   end function steady_state

   !> March from stop to stop; a failing lane is taken out and the march resumed.
   subroutine integrate(problem, settings, stops, integrator, step, measures, sampler, outcome)
      type(problem_type), intent(inout), target :: problem   ! integrators' callbacks change it
      type(lane_settings), intent(in) :: settings
      real(wp), intent(in) :: stops(:)   !! [s], rising
      class(integrator_type), intent(inout) :: integrator
      type(step_type), intent(inout) :: step
      type(measure_lanes), intent(inout) :: measures
      type(sampler_type), intent(inout) :: sampler
      type(lane_outcome), intent(inout) :: outcome
      type(rest_type) :: rest
      character(len=:), allocatable :: reason
      real(wp) :: before
      integer :: flag, k, short

      k = 1
      short = 0
      before = 0.0_wp
      do while (k <= size(stops))
         if (settings%fixed_step <= 0.0_wp) then
            if (rest%reached(problem, step, stops(k))) then
               call rest%stay(stops(k), step)
               call measures%observe(step, problem%lanes, problem%history)
               call sampler%sample(step, problem%lanes, problem%history)
               k = k + 1
               if (k > size(stops)) return
               call integrator%restart(problem, step, flag)
            end if
         end if
         call integrator%take_step(problem, stops(k), step, flag)
         if (flag >= 0) then
            call measures%observe(step, problem%lanes, problem%history)
            call sampler%sample(step, problem%lanes, problem%history)
            outcome%last_step = max(before, step%t1 - step%t0)
            before = step%t1 - step%t0
            outcome%steps = outcome%steps + 1
            if (flag == step_at_stop) k = k + 1
            if (outcome%steps >= settings%max_steps .and. k <= size(stops)) then
               call fail_rest(outcome, status_too_many_steps, "after "//to_text(outcome%steps)//" steps at t = " &
                  & //time_text(step%t1)//": &solver max_steps reached")
               return
            end if
            short = merge(short + 1, 0, before < no_progress*(settings%t_end - problem%history%start))
            if (short == 0) then
               problem%hindrance = 0
               problem%closed = .false.
               if (allocated(problem%lanes%closure)) deallocate(problem%lanes%closure)
            end if
            if (short < patience) cycle
            flag = step_stuck
            problem%failed = problem%hindrance
         end if
         short = 0
         call take_out(problem, integrator, flag, step, outcome)
         if (all(outcome%status /= status_ok)) return
         call integrator%restart(problem, step, flag)
         if (flag < 0) then
            call integrator%get_reason(reason)
            call fail_rest(outcome, status_no_convergence, "at t = "//time_text(step%t1)//": "//reason)
            return
         end if
      end do
   end subroutine integrate

   !> Find the lane that stopped the integrator, say why, and silence it.
   subroutine take_out(problem, integrator, flag, step, outcome)
      type(problem_type), intent(inout), target :: problem
      class(integrator_type), intent(in) :: integrator
      integer, intent(in) :: flag
      type(step_type), intent(inout) :: step
      type(lane_outcome), intent(inout) :: outcome
      real(wp), allocatable :: q(:, :), v(:, :)
      integer :: lane, status
      character(len=:), allocatable :: reason

      lane = problem%failed
      if (flag == step_not_finite) then
         status = status_not_finite
         reason = "the state is not finite"
      else
         status = status_no_convergence
         if (lane == 0) then
            lane = integrator%worst_lane(problem, step)
            status = status_step_too_small
         end if
         call integrator%get_reason(reason)
         if (flag == step_stuck) reason = "the steps no longer move the time"
         if (film_has_closed(problem, step%u1(lane), lane)) then
            status = status_film_closed
            reason = "the film under the reed is closed at its tip"
            if (allocated(problem%lanes%closure)) reason = problem%lanes%closure
            reason = reason//"; its tip is at u = "//to_text(1.0e3_wp*step%u1(lane), 6)//" mm"
         end if
      end if
      reason = "at t = "//time_text(step%t1)//": "//reason
      if (outcome%status(lane) /= status_ok) then   ! no live lane is to blame: nothing can be saved
         call fail_rest(outcome, status, reason)
         return
      end if
      outcome%status(lane) = status
      outcome%message(lane)%s = reason
      call problem%lanes%silence(lane)
      problem%failed = 0
      problem%hindrance = 0
      q = step%q1
      v = step%v1
      q(lane, :) = 0.0_wp
      v(lane, :) = 0.0_wp
      call begin_step(problem, step%t1, q, v, outcome%status == status_ok, step)
   end subroutine take_out

   !> Told by the lane's stage or its model since the last step that was progress, or seen at the tip.
   pure logical function film_has_closed(problem, u, lane) result(closed)
      type(problem_type), intent(in) :: problem
      real(wp), intent(in) :: u          !! tip displacement [m]
      integer, intent(in) :: lane
      real(wp), parameter :: left = 1.0e-2_wp   !! of the gap, under the tip

      closed = problem%closed .or. allocated(problem%lanes%closure) .or. u < (left - 1.0_wp)*problem%lanes%gap(lane)
   end function film_has_closed

   subroutine fail_rest(outcome, status, message)
      type(lane_outcome), intent(inout) :: outcome
      integer, intent(in) :: status
      character(len=*), intent(in) :: message
      integer :: i

      do i = 1, size(outcome%status)
         if (outcome%status(i) /= status_ok) cycle
         outcome%status(i) = status
         outcome%message(i)%s = message
         outcome%given_up(i) = .true.
      end do
   end subroutine fail_rest

   logical function start_integrator(problem, settings, step, integrator, outcome) result(started)
      type(problem_type), intent(inout), target :: problem
      type(lane_settings), intent(in) :: settings
      type(step_type), intent(in) :: step
      class(integrator_type), allocatable, intent(out) :: integrator
      type(lane_outcome), intent(inout) :: outcome
      type(cash_karp), allocatable :: explicit
      type(esdirk), allocatable :: implicit
      character(len=:), allocatable :: reason
      real(wp) :: h
      integer :: flag

      outcome%is_explicit = settings%method == method_explicit &
         & .or. settings%method == method_auto .and. maxval(problem%lanes%stiffness_ratio()) <= problem%lanes%explicit_up_to
      h = settings%first_step
      if (.not. h > 0.0_wp) h = merge(0.6_wp, 4.0_wp, outcome%is_explicit)*first_step(problem)
      flag = step_done
      if (outcome%is_explicit) then
         allocate(explicit)
         call new_cash_karp(explicit, problem, h, settings%fixed_step)
         call move_alloc(explicit, integrator)
      else
         allocate(implicit)
         call new_esdirk(implicit, problem, step, h, settings%fixed_step, flag)
         call move_alloc(implicit, integrator)
      end if
      started = flag >= 0
      if (started) return
      call integrator%get_reason(reason)
      call fail_rest(outcome, status_no_convergence, reason)
   end function start_integrator

   !> What a first step is in proportion to: the fastest lane's slowest oscillation, and the tolerance as errors of a step
   !> are to its length.
   pure real(wp) function first_step(problem) result(h)
      type(problem_type), intent(in) :: problem

      h = problem%rtol**0.2_wp*minval(maxval(problem%q_scale/problem%v_scale, dim=2))
   end function first_step

   !> A step of no length at t.
   subroutine begin_step(problem, t, q, v, live, step)
      type(problem_type), intent(inout) :: problem
      real(wp), value :: t   !! may be the step's own
      real(wp), dimension(problem%lanes%width, problem%lanes%dofs), intent(in) :: q, v
      logical, intent(in) :: live(:)
      type(step_type), intent(inout) :: step
      real(wp) :: a(problem%lanes%width, problem%lanes%dofs), inlet, outlet
      integer :: closed

      call problem%history%factors(t, inlet, outlet)
      call problem%lanes%acceleration(1, problem%lanes%width, inlet, outlet, q, v, a, closed)
      call new_step(step, t, q, v, a, problem%lanes%tip, live)
   end subroutine begin_step

end module rv_lanes
