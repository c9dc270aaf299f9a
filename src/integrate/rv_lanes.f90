!> Run a group of cases, side by side, through one ARKODE integrator.
!>
!> All cases of a group share the pressure history's times, the end time and the tolerance. The error
!> norm is the largest of the lanes' norms: a case is never less accurate for its company, and a case
!> that fails is taken out while the others go on.
module rv_lanes
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_value, ieee_quiet_nan
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_f_pointer, c_funloc, c_int, c_loc, c_null_char, &
      & c_null_funptr, c_ptr
   use rv_kinds, only : wp, i8
   use rv_arkode, only : rv_arkode_new, rv_arkode_step, rv_arkode_restart, rv_arkode_fix_step, &
      & rv_arkode_worst_lane, rv_arkode_free, get_arkode_message, rv_at_stop
   use rv_measures, only : measure_lanes, new_measure_lanes, n_measures
   use rv_pressure, only : pressure_history
   use rv_sampler, only : sampler_type, new_sampler
   use rv_stage, only : solve_stage, stage_guess
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
   real(wp), parameter :: out_of_bounds = 1.0e30_wp   !! an acceleration [m s-2]
   integer(c_int), parameter :: rv_stuck = -1000_c_int  !! beside ARKODE's flags: its steps are no progress

   !> Butcher table: fifth order, stiffly accurate, L-stable (Kennedy & Carpenter 2019, doi:10.1016/j.apnum.2019.07.008).
   !> Not its relatives ESDIRK547L2SA and ESDIRK436L2SA: they have a stage behind the end of the step, which at a corner
   !> of the pressure sees what comes after it and costs them their order (2 in place of 5). The longer steps of
   !> ARK548L2SA would leave the dense output less accurate than the steps.
   character(kind=c_char, len=*), parameter :: implicit_table = "ARKODE_ESDIRK547L2SA2_7_4_5"//c_null_char
   !> Fifth order (Cash & Karp 1990, doi:10.1145/79505.79507): of the explicit tables whose last stage ARKODE 6.4 does not
   !> take for the next step's first where it is not.
   character(kind=c_char, len=*), parameter :: explicit_table = "ARKODE_CASH_KARP_6_4_5"//c_null_char

   !> Stiffest lane, as stiffness_ratio has it, that method_auto still integrates explicitly: where both took equally long
   !> to the same error for the reed of the paper, at a gap of some 0.06 mm.
   real(wp), parameter :: explicit_up_to = 5.0_wp

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
      real(wp), allocatable :: measure(:, :)     !! (n_measures, width)
      real(wp), allocatable :: trace(:, :, :)    !! (time, traces, width)
      real(wp), allocatable :: field(:, :, :)    !! film pressure (nodes, field time, width) [Pa]
      real(wp), allocatable :: lowest_pressure(:) !! lowest pressure seen in the film [Pa]; huge if none was
      integer :: steps = 0                       !! accepted
      logical :: is_explicit = .false.           !! how the group was integrated
      real(wp), allocatable :: state(:)          !! at the end: displacements [m] (width*dofs), then velocities [m s-1]
      real(wp) :: last_step = 0.0_wp             !! the longer of the last two: a stop may have cut the last one [s]
   end type lane_outcome

   !> What ARKODE's callbacks see.
   type :: problem_type
      class(valve_lanes), allocatable :: lanes
      class(pressure_history), allocatable :: history
      integer :: half = 0                                  !! width*dofs: displacements, and velocities after them
      real(wp) :: rtol = 0.0_wp
      real(wp), allocatable :: q_scale(:, :), v_scale(:, :)  !! added to |q| and |v| in the tolerance
      real(wp), allocatable :: v_weight(:, :)                !! last error weights of v
      type(stage_guess) :: guess
      integer :: failed = 0                                !! lane whose stage had no solution last
      logical :: closed = .false.                          !! because its film was closed
      logical :: is_explicit = .false.                     !! how it is integrated
      integer :: hindrance = 0                             !! lane whose stage had no solution most recently
   end type problem_type

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
      type(c_ptr) :: integrator
      real(c_double), allocatable :: y(:)
      integer :: w, i

      w = lanes%width
      allocate(outcome%status(w), source=status_ok)
      allocate(outcome%message(w))
      do i = 1, w
         outcome%message(i)%s = ""
      end do
      call pose(problem, lanes, history, settings%rtol)
      allocate(y(2*problem%half))
      if (allocated(settings%state)) then
         y = settings%state
      else
         call initial_state(problem, settings%from_equilibrium, y, outcome)
      end if
      call begin_step(problem, history%start, y, outcome%status == status_ok, step)
      call new_measure_lanes(measures, history%start, history%event, min(history%cycle_end, settings%t_end), &
         & steady_state(problem), step%u1, settings%rtol)
      call new_sampler(sampler, trace_time, problem%lanes, field_time)
      call sampler%sample(step, problem%lanes, history)

      if (any(outcome%status == status_ok)) then
         if (start_integrator(problem, settings, y, integrator, outcome)) then
            call integrate(problem, settings, history%stops(settings%t_end), integrator, y, step, measures, sampler, outcome)
         end if
         call rv_arkode_free(integrator)
      end if

      allocate(outcome%measure(n_measures, w))
      do i = 1, w
         outcome%measure(:, i) = measures%results(i)
      end do
      outcome%lowest_pressure = problem%lanes%lowest_pressure
      outcome%state = y
      call move_alloc(sampler%value, outcome%trace)
      call move_alloc(sampler%field, outcome%field)
   end subroutine run_lanes

   !> Initial state: at rest on u = 0, or at the static equilibrium. A lane that has none is taken out.
   subroutine initial_state(problem, from_equilibrium, y, outcome)
      type(problem_type), intent(inout) :: problem
      logical, intent(in) :: from_equilibrium
      real(c_double), intent(out) :: y(:)
      type(lane_outcome), intent(inout) :: outcome
      real(wp) :: q(problem%lanes%width, problem%lanes%dofs), inlet, outlet
      logical :: found(problem%lanes%width)
      integer :: i

      y = 0.0_wp
      if (.not. from_equilibrium) return
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
      y(:problem%half) = reshape(q, [problem%half])
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
   subroutine integrate(problem, settings, stops, integrator, y, step, measures, sampler, outcome)
      type(problem_type), intent(inout), target :: problem   ! ARKODE's callbacks change it
      type(lane_settings), intent(in) :: settings
      real(wp), intent(in) :: stops(:)   !! [s], rising
      type(c_ptr), intent(in) :: integrator
      real(c_double), intent(inout) :: y(:)
      type(step_type), intent(inout) :: step
      type(measure_lanes), intent(inout) :: measures
      type(sampler_type), intent(inout) :: sampler
      type(lane_outcome), intent(inout) :: outcome
      real(c_double) :: t, y_new(size(y))
      character(len=:), allocatable :: reason
      real(wp) :: before
      integer(c_int) :: flag
      integer :: k, short

      k = 1
      short = 0
      before = 0.0_wp
      do while (k <= size(stops))
         t = step%t1
         flag = rv_arkode_step(integrator, stops(k), t, y_new)
         short = merge(short + 1, 0, t - step%t1 < no_progress*(settings%t_end - problem%history%start))
         if (flag >= 0 .and. short == 0) then
            problem%closed = .false.
            if (allocated(problem%lanes%closure)) deallocate(problem%lanes%closure)
         end if
         if (flag >= 0 .and. short >= patience) then
            flag = rv_stuck
            problem%failed = problem%hindrance
         end if
         if (flag < 0) y_new = y   ! a failed step leaves no state
         if (flag >= 0 .and. is_finite(y_new)) then
            y = y_new
            if (flag == rv_at_stop) t = stops(k)
            call end_step(problem, t, y, step)
            call measures%observe(step, problem%lanes, problem%history)
            call sampler%sample(step, problem%lanes, problem%history)
            outcome%last_step = max(before, step%t1 - step%t0)
            before = step%t1 - step%t0
            call step%advance()
            outcome%steps = outcome%steps + 1
            if (flag == rv_at_stop) k = k + 1
            if (outcome%steps < settings%max_steps) cycle
            if (k > size(stops)) return
            call fail_rest(outcome, status_too_many_steps, &
               & "after "//to_text(outcome%steps)//" steps at t = "//time_text(t)//": &solver max_steps reached")
            return
         end if
         short = 0
         call take_out(problem, integrator, flag, step, y, y_new, outcome)
         if (all(outcome%status /= status_ok)) return
         if (rv_arkode_restart(integrator, step%t1, y) < 0) then
            call get_arkode_message(integrator, reason)
            call fail_rest(outcome, status_no_convergence, "at t = "//time_text(step%t1)//": "//reason)
            return
         end if
      end do
   end subroutine integrate

   !> Find the lane that stopped the integrator, say why, and silence it.
   subroutine take_out(problem, integrator, flag, step, y, y_new, outcome)
      type(problem_type), intent(inout), target :: problem   ! ARKODE's callbacks change it
      type(c_ptr), intent(in) :: integrator
      integer(c_int), intent(in) :: flag
      type(step_type), intent(inout) :: step
      real(c_double), intent(inout) :: y(:)
      real(c_double), intent(in) :: y_new(:)
      type(lane_outcome), intent(inout) :: outcome
      integer :: lane, w, status
      real(wp) :: t
      character(len=:), allocatable :: reason

      w = problem%lanes%width
      t = step%t1
      if (flag >= 0) then
         do lane = 1, w
            if (.not. all(ieee_is_finite(y_new(lane::w)))) exit
         end do
         status = status_not_finite
         reason = "the state is not finite"
      else
         lane = problem%failed
         status = status_no_convergence
         if (lane == 0) then
            lane = rv_arkode_worst_lane(integrator) + 1
            status = status_step_too_small
         end if
         call get_arkode_message(integrator, reason)
         if (flag == rv_stuck) reason = "the steps no longer move the time"
         if (film_has_closed(problem, step%u1(lane), lane)) then
            status = status_film_closed
            reason = "the film under the reed is closed at its tip"
            if (allocated(problem%lanes%closure)) reason = problem%lanes%closure
            reason = reason//"; its tip is at u = "//to_text(1.0e3_wp*step%u1(lane), 6)//" mm"
         end if
      end if
      if (outcome%status(lane) /= status_ok) then   ! no live lane is to blame: nothing can be saved
         call fail_rest(outcome, status, "at t = "//time_text(t)//": "//reason)
         return
      end if
      outcome%status(lane) = status
      outcome%message(lane)%s = "at t = "//time_text(t)//": "//reason
      call problem%lanes%silence(lane)
      problem%failed = 0
      problem%hindrance = 0
      y(lane::w) = 0.0_wp
      call begin_step(problem, t, y, outcome%status == status_ok, step)
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
      end do
   end subroutine fail_rest

   subroutine pose(problem, lanes, history, rtol)
      type(problem_type), intent(out) :: problem
      class(valve_lanes), allocatable, intent(inout) :: lanes
      class(pressure_history), intent(in) :: history
      real(wp), intent(in) :: rtol
      real(wp) :: span(lanes%width)
      integer :: i

      call move_alloc(lanes, problem%lanes)
      allocate(problem%history, source=history)
      problem%rtol = rtol
      associate (w => problem%lanes%width, dofs => problem%lanes%dofs)
         problem%half = w*dofs
         allocate(problem%q_scale(w, dofs), problem%v_scale(w, dofs))
         do i = 1, w
            span(i) = history%span(problem%lanes%inlet(i), problem%lanes%outlet(i))
         end do
      end associate
      call problem%lanes%scales(span, problem%q_scale, problem%v_scale)
      problem%v_weight = 1.0_wp/(rtol*problem%v_scale)
   end subroutine pose

   logical function start_integrator(problem, settings, y, integrator, outcome) result(started)
      type(problem_type), intent(inout), target :: problem
      type(lane_settings), intent(in) :: settings
      real(c_double), intent(in) :: y(:)
      type(c_ptr), intent(out) :: integrator
      type(lane_outcome), intent(inout) :: outcome
      character(len=:), allocatable :: reason
      real(wp) :: h
      integer(c_int) :: flag

      h = settings%first_step
      if (.not. h > 0.0_wp) h = first_step(problem)
      outcome%is_explicit = settings%method == method_explicit &
         & .or. settings%method == method_auto .and. maxval(problem%lanes%stiffness_ratio()) <= explicit_up_to
      problem%is_explicit = outcome%is_explicit
      if (outcome%is_explicit) then
         flag = rv_arkode_new(int(problem%lanes%width, c_int), int(2*problem%lanes%dofs, c_int), problem%history%start, y, &
            & explicit_table, h, c_funloc(rhs), c_null_funptr, c_funloc(weights), c_loc(problem), integrator)
      else
         flag = rv_arkode_new(int(problem%lanes%width, c_int), int(2*problem%lanes%dofs, c_int), problem%history%start, y, &
            & implicit_table, h, c_funloc(rhs), c_funloc(stage), c_funloc(weights), c_loc(problem), integrator)
      end if
      if (flag >= 0 .and. settings%fixed_step > 0.0_wp) flag = rv_arkode_fix_step(integrator, settings%fixed_step)
      started = flag >= 0
      if (started) return
      call get_arkode_message(integrator, reason)
      call fail_rest(outcome, status_no_convergence, reason)
   end function start_integrator

   !> A first step that is a small part of the fastest lane's slowest oscillation: an error per step near the tolerance
   !> for a pressure that jumps at the start.
   pure real(wp) function first_step(problem) result(h)
      type(problem_type), intent(in) :: problem

      h = 0.6_wp*problem%rtol**0.2_wp*minval(maxval(problem%q_scale/problem%v_scale, dim=2))
   end function first_step

   subroutine begin_step(problem, t, y, live, step)
      type(problem_type), intent(inout) :: problem
      real(wp), intent(in) :: t
      real(c_double), intent(in) :: y(:)
      logical, intent(in) :: live(:)
      type(step_type), intent(out) :: step
      real(wp), dimension(problem%lanes%width, problem%lanes%dofs) :: q, v

      q = reshape(y(:problem%half), shape(q))
      v = reshape(y(problem%half + 1:), shape(v))
      call new_step(step, t, q, v, 0.0_wp*q, problem%lanes%tip, live)
      call end_step(problem, t, y, step)
      call step%advance()
      call problem%guess%begin(t, step%a1)
   end subroutine begin_step

   subroutine end_step(problem, t, y, step)
      type(problem_type), intent(inout) :: problem
      real(wp), intent(in) :: t
      real(c_double), intent(in) :: y(:)
      type(step_type), intent(inout) :: step
      real(wp) :: inlet, outlet
      integer :: closed

      call step%land(t, y(:problem%half), y(problem%half + 1:))
      call problem%history%factors(t, inlet, outlet)
      call problem%lanes%acceleration(inlet, outlet, step%q1, step%v1, step%a1, closed)
   end subroutine end_step

   !> Whether all numbers are finite, in a loop that vectors can do.
   pure logical function is_finite(y)
      real(c_double), intent(in) :: y(:)
      integer(i8) :: some
      integer :: i

      some = 0_i8
      do i = 1, size(y)
         some = ior(some, merge(0_i8, 1_i8, abs(y(i)) <= huge(y)))
      end do
      is_finite = some == 0_i8
   end function is_finite

   !> ARKODE's right-hand side. 1 where a film is closed: ARKODE then tries a smaller step. In an explicit stage it would
   !> give up instead; there an acceleration out of all bounds makes it reject the step.
   integer(c_int) function rhs(t, y, ydot, data) bind(C)
      real(c_double), value :: t
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(inout) :: ydot(*)
      type(c_ptr), value :: data
      type(problem_type), pointer :: problem
      real(wp) :: inlet, outlet
      integer :: closed

      call c_f_pointer(data, problem)
      associate (n => problem%half)
         call problem%history%factors(t, inlet, outlet)
         call problem%lanes%acceleration(inlet, outlet, y(:n), y(n + 1:2*n), ydot(n + 1:2*n), closed)
         ydot(:n) = y(n + 1:2*n)
      end associate
      rhs = 0
      if (closed == 0) return
      problem%hindrance = closed
      problem%closed = .true.
      if (problem%is_explicit) then
         ydot(problem%half + closed) = out_of_bounds
      else
         problem%failed = closed
         rhs = 1
      end if
   end function rhs

   !> ARKODE's stage. 1 where a lane has no solution.
   integer(c_int) function stage(t, gamma, predicted, known, correction, data) bind(C)
      real(c_double), value :: t, gamma
      real(c_double), intent(in) :: predicted(*), known(*)
      real(c_double), intent(inout) :: correction(*)
      type(c_ptr), value :: data
      type(problem_type), pointer :: problem
      real(wp) :: inlet, outlet

      call c_f_pointer(data, problem)
      associate (n => problem%half)
         call problem%history%factors(t, inlet, outlet)
         call solve_stage(problem%lanes, t, inlet, outlet, gamma, predicted(:n), predicted(n + 1:2*n), known(:n), &
            & known(n + 1:2*n), problem%v_weight, problem%guess, correction(:n), correction(n + 1:2*n), &
            & problem%failed, problem%closed)
      end associate
      if (problem%failed > 0) problem%hindrance = problem%failed
      stage = merge(0_c_int, 1_c_int, problem%failed == 0)
   end function stage

   !> ARKODE's error weights: one over rtol (|y| + scale).
   integer(c_int) function weights(y, weight, data) bind(C)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(inout) :: weight(*)
      type(c_ptr), value :: data
      type(problem_type), pointer :: problem
      integer :: w, k, lo, hi

      call c_f_pointer(data, problem)
      w = problem%lanes%width
      do k = 1, problem%lanes%dofs
         lo = (k - 1)*w + 1
         hi = k*w
         weight(lo:hi) = 1.0_wp/(problem%rtol*(abs(y(lo:hi)) + problem%q_scale(:, k)))
         lo = lo + problem%half
         hi = hi + problem%half
         weight(lo:hi) = 1.0_wp/(problem%rtol*(abs(y(lo:hi)) + problem%v_scale(:, k)))
         problem%v_weight(:, k) = weight(lo:hi)
      end do
      weights = 0
   end function weights

end module rv_lanes
