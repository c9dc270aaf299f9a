!> Run a group of cases, side by side, through one ARKODE integrator.
!>
!> All cases of a group share the pressure history's times, the end time and the tolerance. The error
!> norm is the largest of the lanes' norms: a case is never less accurate for its company, and a case
!> that fails is taken out while the others go on.
module rv_lanes
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_f_pointer, c_funloc, c_int, c_loc, c_null_char, c_ptr
   use rv_kinds, only : wp
   use rv_arkode, only : rv_arkode_new, rv_arkode_step, rv_arkode_restart, rv_arkode_fix_step, &
      & rv_arkode_worst_lane, rv_arkode_free, arkode_message, rv_at_stop
   use rv_lumped, only : lumped_lanes, lumped_valve, new_lumped_lanes
   use rv_measures, only : measure_lanes, new_measure_lanes, n_measures
   use rv_pressure, only : pressure_history
   use rv_sampler, only : sampler_type, new_sampler, n_traces
   use rv_stage, only : solve_stage
   use rv_status, only : status_ok, status_step_too_small, status_film_closed, status_not_finite, &
      & status_too_many_steps, status_no_convergence
   use rv_step, only : step_type, new_step
   use rv_text, only : text_type, to_text
   implicit none
   private
   public :: lane_settings, lane_outcome, run_lanes

   !> Butcher table: fifth order, stiffly accurate, L-stable (Kennedy & Carpenter 2019, doi:10.1016/j.apnum.2018.10.007).
   !> Not ESDIRK547L2SA nor ESDIRK436L2SA: as shipped in SUNDIALS 6.4.1 both converge with order 3 only. The longer
   !> steps of ARK548L2SA would leave the dense output less accurate than the steps.
   character(len=*), parameter :: butcher_table = "ARKODE_ESDIRK547L2SA2_7_4_5"

   !> How to integrate.
   type :: lane_settings
      real(wp) :: t_end = 0.0_wp             !! [s]
      real(wp) :: rtol = 1.0e-6_wp           !! allowed error of a step, relative to the state plus its scale [-]
      integer :: max_steps = 1000000         !! accepted steps of the group
      logical :: from_equilibrium = .false.  !! start at the static equilibrium, else at rest on u = 0
      real(wp) :: fixed_step = 0.0_wp        !! [s]; > 0: no step control (for studies of convergence)
   end type lane_settings

   !> What came out; arrays end in (width).
   type :: lane_outcome
      integer, allocatable :: status(:)          !! status_
      type(text_type), allocatable :: message(:) !! why and when a lane failed, else empty
      real(wp), allocatable :: measure(:, :)     !! (n_measures, width)
      real(wp), allocatable :: trace(:, :, :)    !! (time, n_traces, width)
      integer :: steps = 0                       !! accepted
   end type lane_outcome

   !> What ARKODE's callbacks see.
   type :: problem_type
      type(lumped_lanes) :: lanes
      class(pressure_history), allocatable :: history
      real(wp) :: rtol = 0.0_wp
      real(wp), allocatable :: u_scale(:), v_scale(:)  !! added to |u| and |v| in the tolerance [m], [m s-1]
      real(wp), allocatable :: v_weight(:)             !! last error weights of v [s m-1]
      integer :: worst_lane = 0                        !! lane whose stage had no solution last
   end type problem_type

contains

   !> Integrate all cases from the start of the history to settings%t_end.
   subroutine run_lanes(valve, history, settings, trace_time, outcome)
      type(lumped_valve), intent(in) :: valve(:)
      class(pressure_history), intent(in) :: history
      type(lane_settings), intent(in) :: settings
      real(wp), intent(in) :: trace_time(:)     !! [s], rising; may be empty
      type(lane_outcome), intent(out) :: outcome
      type(problem_type), target :: problem
      type(measure_lanes) :: measures
      type(sampler_type) :: sampler
      type(step_type) :: step
      type(c_ptr) :: integrator
      real(wp) :: inlet, outlet
      real(c_double) :: y(2*size(valve))
      integer :: w, i

      w = size(valve)
      allocate(outcome%status(w), source=status_ok)
      allocate(outcome%message(w))
      do i = 1, w
         outcome%message(i)%s = ""
      end do
      call pose(problem, valve, history, settings%rtol)
      y = 0.0_wp
      call history%factors(history%start, inlet, outlet)
      if (settings%from_equilibrium) y(:w) = valve%equilibrium(inlet, outlet)
      call begin_step(problem, history%start, y, step)
      call history%factors(history%event, inlet, outlet)
      call new_measure_lanes(measures, history%start, history%event, min(history%cycle_end, settings%t_end), &
         & valve%equilibrium(inlet, outlet), y(:w), problem%lanes%gap, problem%lanes%squeeze)
      call new_sampler(sampler, trace_time, w)
      call sampler%sample(step, problem%lanes, history)

      if (start_integrator(problem, settings, y, integrator, outcome)) then
         call integrate(problem, settings, history%stops(settings%t_end), integrator, y, step, measures, sampler, outcome)
      end if
      call rv_arkode_free(integrator)

      allocate(outcome%measure(n_measures, w))
      do i = 1, w
         outcome%measure(:, i) = measures%results(i)
      end do
      call move_alloc(sampler%value, outcome%trace)
   end subroutine run_lanes

   !> March from stop to stop; a failing lane is taken out and the march resumed.
   subroutine integrate(problem, settings, stops, integrator, y, step, measures, sampler, outcome)
      type(problem_type), intent(inout) :: problem
      type(lane_settings), intent(in) :: settings
      real(wp), intent(in) :: stops(:)   !! [s], rising
      type(c_ptr), intent(in) :: integrator
      real(c_double), intent(inout) :: y(:)
      type(step_type), intent(inout) :: step
      type(measure_lanes), intent(inout) :: measures
      type(sampler_type), intent(inout) :: sampler
      type(lane_outcome), intent(inout) :: outcome
      real(c_double) :: t, y_new(size(y))
      integer(c_int) :: flag
      integer :: k

      k = 1
      do while (k <= size(stops))
         t = step%t1
         flag = rv_arkode_step(integrator, stops(k), t, y_new)
         if (flag >= 0 .and. all(ieee_is_finite(y_new))) then
            y = y_new
            if (flag == rv_at_stop) t = stops(k)
            call end_step(problem, t, y, step)
            call measures%observe(step)
            call sampler%sample(step, problem%lanes, problem%history)
            call step%advance()
            outcome%steps = outcome%steps + 1
            if (flag == rv_at_stop) k = k + 1
            if (outcome%steps < settings%max_steps) cycle
            if (k > size(stops)) return
            call fail_rest(outcome, status_too_many_steps, &
               & "after "//to_text(outcome%steps)//" steps at t = "//to_text(t, 6)//" s: &solver max_steps reached")
            return
         end if
         call take_out(problem, integrator, flag, step, y, y_new, outcome)
         if (all(outcome%status /= status_ok)) return
         if (rv_arkode_restart(integrator, step%t1, y) < 0) then
            call fail_rest(outcome, status_no_convergence, &
               & "at t = "//to_text(step%t1, 6)//" s: "//arkode_message(integrator))
            return
         end if
      end do
   end subroutine integrate

   !> Find the lane that stopped the integrator, say why, and silence it.
   subroutine take_out(problem, integrator, flag, step, y, y_new, outcome)
      type(problem_type), intent(inout) :: problem
      type(c_ptr), intent(in) :: integrator
      integer(c_int), intent(in) :: flag
      type(step_type), intent(inout) :: step
      real(c_double), intent(inout) :: y(:)
      real(c_double), intent(in) :: y_new(:)
      type(lane_outcome), intent(inout) :: outcome
      integer :: lane, w, status
      real(wp) :: film
      character(len=:), allocatable :: reason

      w = problem%lanes%width
      lane = 0
      if (flag >= 0) then
         do lane = 1, w
            if (.not. (ieee_is_finite(y_new(lane)) .and. ieee_is_finite(y_new(w + lane)))) exit
         end do
         status = status_not_finite
         reason = "the state is not finite"
      else if (problem%worst_lane > 0) then
         lane = problem%worst_lane
         status = status_no_convergence
         reason = arkode_message(integrator)
      else
         lane = rv_arkode_worst_lane(integrator) + 1
         status = status_step_too_small
         reason = arkode_message(integrator)
      end if
      if (outcome%status(lane) /= status_ok) then   ! no live lane is to blame: nothing can be saved
         call fail_rest(outcome, status, "at t = "//to_text(step%t1, 6)//" s: "//reason)
         return
      end if
      film = y(lane) + problem%lanes%gap(lane)
      if (problem%lanes%squeeze(lane) > 0.0_wp .and. film <= 1.0e-3_wp*problem%lanes%gap(lane)) then
         status = status_film_closed
         reason = "the film under the reed has closed to "//to_text(film, 3)//" m"
      end if
      outcome%status(lane) = status
      outcome%message(lane)%s = "at t = "//to_text(step%t1, 6)//" s: "//reason
      call problem%lanes%silence(lane)
      problem%worst_lane = 0
      y(lane) = 0.0_wp
      y(w + lane) = 0.0_wp
      call begin_step(problem, step%t1, y, step)
   end subroutine take_out

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

   !> The tolerance's scales: the largest static displacement, for a squeeze film at most ten gaps (the film's
   !> force follows (u + g0)^-3), and that length times the natural frequency.
   subroutine pose(problem, valve, history, rtol)
      type(problem_type), intent(out) :: problem
      type(lumped_valve), intent(in) :: valve(:)
      class(pressure_history), intent(in) :: history
      real(wp), intent(in) :: rtol
      integer :: i

      call new_lumped_lanes(problem%lanes, valve)
      allocate(problem%history, source=history)
      problem%rtol = rtol
      allocate(problem%u_scale(size(valve)), problem%v_scale(size(valve)), problem%v_weight(size(valve)))
      do i = 1, size(valve)
         problem%u_scale(i) = history%span(valve(i)%inlet, valve(i)%outlet)*valve(i)%area/valve(i)%stiffness
      end do
      where (valve%squeeze > 0.0_wp) problem%u_scale = min(problem%u_scale, 10.0_wp*valve%gap)
      where (.not. problem%u_scale > 0.0_wp) problem%u_scale = 1.0e-3_wp*valve%gap
      problem%v_scale = problem%u_scale*sqrt(valve%stiffness/valve%mass)
      problem%v_weight = 1.0_wp/(rtol*problem%v_scale)
   end subroutine pose

   logical function start_integrator(problem, settings, y, integrator, outcome) result(started)
      type(problem_type), intent(in), target :: problem
      type(lane_settings), intent(in) :: settings
      real(c_double), intent(in) :: y(:)
      type(c_ptr), intent(out) :: integrator
      type(lane_outcome), intent(inout) :: outcome
      character(kind=c_char, len=*), parameter :: table = butcher_table//c_null_char
      integer(c_int) :: flag

      flag = rv_arkode_new(int(problem%lanes%width, c_int), 2_c_int, problem%history%start, y, table, &
         & c_funloc(rhs), c_funloc(stage), c_funloc(weights), c_loc(problem), integrator)
      if (flag >= 0 .and. settings%fixed_step > 0.0_wp) flag = rv_arkode_fix_step(integrator, settings%fixed_step)
      started = flag >= 0
      if (.not. started) call fail_rest(outcome, status_no_convergence, arkode_message(integrator))
   end function start_integrator

   subroutine begin_step(problem, t, y, step)
      type(problem_type), intent(in) :: problem
      real(wp), intent(in) :: t
      real(c_double), intent(in) :: y(:)
      type(step_type), intent(out) :: step
      real(wp) :: a(problem%lanes%width), inlet, outlet
      integer :: w

      w = problem%lanes%width
      call problem%history%factors(t, inlet, outlet)
      call problem%lanes%acceleration(inlet, outlet, y(:w), y(w + 1:), a)
      call new_step(step, t, y(:w), y(w + 1:), a)
   end subroutine begin_step

   subroutine end_step(problem, t, y, step)
      type(problem_type), intent(in) :: problem
      real(wp), intent(in) :: t
      real(c_double), intent(in) :: y(:)
      type(step_type), intent(inout) :: step
      real(wp) :: inlet, outlet
      integer :: w

      w = problem%lanes%width
      step%t1 = t
      step%u1(:) = y(:w)
      step%v1(:) = y(w + 1:)
      call problem%history%factors(t, inlet, outlet)
      call problem%lanes%acceleration(inlet, outlet, step%u1, step%v1, step%a1)
   end subroutine end_step

   !> ARKODE's right-hand side. 1 where a film is closed: ARKODE then tries a smaller step.
   integer(c_int) function rhs(t, y, ydot, data) bind(C)
      real(c_double), value :: t
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(inout) :: ydot(*)
      type(c_ptr), value :: data
      type(problem_type), pointer :: problem
      real(wp) :: inlet, outlet
      integer :: w

      call c_f_pointer(data, problem)
      w = problem%lanes%width
      call problem%history%factors(t, inlet, outlet)
      call problem%lanes%acceleration(inlet, outlet, y(:w), y(w + 1:2*w), ydot(w + 1:2*w))
      ydot(:w) = y(w + 1:2*w)
      rhs = merge(0_c_int, 1_c_int, all(y(:w) + problem%lanes%gap > 0.0_wp))
   end function rhs

   !> ARKODE's stage. 1 where a lane has no solution.
   integer(c_int) function stage(t, gamma, base, z, data) bind(C)
      real(c_double), value :: t, gamma
      real(c_double), intent(in) :: base(*)
      real(c_double), intent(inout) :: z(*)
      type(c_ptr), value :: data
      type(problem_type), pointer :: problem
      real(wp) :: inlet, outlet
      integer :: w

      call c_f_pointer(data, problem)
      w = problem%lanes%width
      call problem%history%factors(t, inlet, outlet)
      call solve_stage(problem%lanes, inlet, outlet, gamma, base(:w), base(w + 1:2*w), problem%v_weight, &
         & z(:w), z(w + 1:2*w), problem%worst_lane)
      stage = merge(0_c_int, 1_c_int, problem%worst_lane == 0)
   end function stage

   !> ARKODE's error weights: one over rtol (|y| + scale).
   integer(c_int) function weights(y, weight, data) bind(C)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(inout) :: weight(*)
      type(c_ptr), value :: data
      type(problem_type), pointer :: problem
      integer :: w

      call c_f_pointer(data, problem)
      w = problem%lanes%width
      weight(:w) = 1.0_wp/(problem%rtol*(abs(y(:w)) + problem%u_scale))
      weight(w + 1:2*w) = 1.0_wp/(problem%rtol*(abs(y(w + 1:2*w)) + problem%v_scale))
      problem%v_weight(:) = weight(w + 1:2*w)
      weights = 0
   end function weights

end module rv_lanes
