!> What a valve designer reads off a response: times between levels, extremes, largest film force.
!>
!> The steady displacement is the static equilibrium under the pressure at the start of the closing
!> event. Levels are fractions of it; their crossings and the extremes lie on the dense output, to
!> rounding. Everything is of the first cycle. What did not happen is NaN.
module rv_measures
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_dense, only : value_at, derivative, first_root
   use rv_pressure, only : pressure_history
   use rv_step, only : step_type
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: measure_lanes, new_measure_lanes, n_measures

   integer, parameter :: n_measures = 9  !! steady, rise, opening, overshoot, fall, closing, zero, undershoot, peak squeeze

   integer, parameter :: n_up = 3, n_down = 4
   real(wp), parameter :: up_level(n_up) = [0.10_wp, 0.90_wp, 0.98_wp]              !! while opening [-]
   real(wp), parameter :: down_level(n_down) = [0.90_wp, 0.10_wp, 0.02_wp, 0.0_wp]  !! while closing [-]

   real(wp), parameter :: noise = 10.0_wp  !! global error over the tolerance of a step, at most

   !> Crossings and extremes found so far; arrays are (width) or (levels, width).
   type :: measure_lanes
      private
      real(wp) :: start = 0.0_wp      !! first instant [s]
      real(wp) :: event = 0.0_wp      !! start of the closing event [s]
      real(wp) :: cycle_end = 0.0_wp  !! end of what is measured [s]
      real(wp) :: resolution = 0.0_wp !! displacements below it, relative to the steady one, are noise [-]
      real(wp), allocatable :: reached(:)         !! last instant seen [s]
      real(wp), allocatable :: steady(:)          !! [m]
      real(wp), allocatable :: up(:, :)           !! instants of the upward crossings [s]
      real(wp), allocatable :: down(:, :)         !! instants of the downward crossings [s]
      real(wp), allocatable :: highest(:)         !! largest u while opening [m]
      real(wp), allocatable :: lowest(:)          !! smallest u while closing [m]
      real(wp), allocatable :: largest_force(:)   !! largest film force against closing [N]
      real(wp), allocatable :: rate(:)            !! rate of change of that force at the end of the last step [N s-1]
   contains
      procedure :: observe
      procedure :: results
   end type measure_lanes

contains

   !> Begin at the initial state. An event nearer to an end than an integrator would stop for lies on that end.
   pure subroutine new_measure_lanes(self, start, event, cycle_end, steady, u, rtol)
      type(measure_lanes), intent(out) :: self
      real(wp), intent(in) :: start, event, cycle_end   !! [s]
      real(wp), intent(in) :: steady(:)                 !! [m]
      real(wp), intent(in) :: u(:)                      !! initial displacement [m]
      real(wp), intent(in), optional :: rtol            !! tolerance of the integration [-]; 0 unless given
      real(wp) :: closest

      self%start = start
      self%event = event
      self%cycle_end = cycle_end
      closest = 1.0e-9_wp*(cycle_end - start)
      if (abs(event - start) <= closest) self%event = start
      if (abs(event - cycle_end) <= closest) self%event = cycle_end
      self%steady = steady
      self%resolution = 0.0_wp
      if (present(rtol)) self%resolution = noise*rtol
      allocate(self%up(n_up, size(u)), self%down(n_down, size(u)))
      self%up = ieee_value(1.0_wp, ieee_quiet_nan)
      self%down = self%up(1, 1)
      self%highest = u
      self%lowest = u
      allocate(self%reached(size(u)), source=start)
      allocate(self%largest_force(size(u)), self%rate(size(u)), source=0.0_wp)
   end subroutine new_measure_lanes

   !> Take one more step into account. Steps come in order and none spans the event.
   subroutine observe(self, step, lanes, history)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      class(valve_lanes), intent(inout) :: lanes
      class(pressure_history), intent(in) :: history
      real(wp) :: inlet, outlet, force, rate
      integer :: i

      if (step%t0 >= self%cycle_end) return
      call history%factors(step%t1, inlet, outlet)
      do i = 1, step%width
         if (.not. step%live(i)) cycle
         self%reached(i) = step%t1
         if (step%t0 <= self%event) self%lowest(i) = step%u0(i)
         call observe_lane(self, step, i)
         if (.not. lanes%has_film(i)) cycle
         call lanes%film_force(i, inlet, outlet, step%q1(i, :), step%v1(i, :), step%a1(i, :), force, rate)
         self%largest_force(i) = max(self%largest_force(i), force)
         if (self%rate(i) > 0.0_wp .and. rate < 0.0_wp) call find_peak(self, step, i, lanes, history)
         self%rate(i) = rate
      end do
   end subroutine observe

   subroutine observe_lane(self, step, i)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      integer, intent(in) :: i
      real(wp) :: c(0:5), turn, u_turn
      logical :: turns

      turns = step%w0(i)*step%w1(i) < 0.0_wp
      if (turns .or. crosses_level(self, step, i)) c = step%tip_path(i)
      if (.not. turns) then
         call look(step%u0(i), step%u1(i), 0.0_wp, 1.0_wp)
      else
         turn = first_root(derivative(c), 0.0_wp, 1.0_wp)
         u_turn = value_at(c, turn)
         call look(step%u0(i), u_turn, 0.0_wp, turn)
         call look(u_turn, step%u1(i), turn, 1.0_wp)
      end if

   contains

      !> One stretch on which u runs from `from` to `to` without turning.
      subroutine look(from, to, s_from, s_to)
         real(wp), intent(in) :: from, to, s_from, s_to
         real(wp) :: level
         integer :: k

         if (step%t1 <= self%event) then
            self%highest(i) = max(self%highest(i), to)
            if (.not. (self%steady(i) > 0.0_wp .and. to > from)) return
            do k = 1, n_up
               level = up_level(k)*self%steady(i)
               if (from < level .and. level <= to) call note(self%up(k, i), level, s_from, s_to)
            end do
         else
            self%lowest(i) = min(self%lowest(i), to)
            if (.not. (self%steady(i) > 0.0_wp .and. to < from)) return
            do k = 1, n_down
               level = down_level(k)*self%steady(i)
               if (from > level .and. level >= to) call note(self%down(k, i), level, s_from, s_to)
            end do
         end if
      end subroutine look

      !> Keep the first crossing only.
      subroutine note(t, level, s_from, s_to)
         real(wp), intent(inout) :: t
         real(wp), intent(in) :: level, s_from, s_to
         real(wp) :: distance(0:5)

         if (t >= self%start) return
         distance = c
         distance(0) = c(0) - level
         t = step%t0 + (step%t1 - step%t0)*first_root(distance, s_from, s_to)
      end subroutine note

   end subroutine observe_lane

   !> Whether any level lies between the step's ends, so that the dense output is needed.
   pure logical function crosses_level(self, step, i)
      class(measure_lanes), intent(in) :: self
      type(step_type), intent(in) :: step
      integer, intent(in) :: i
      real(wp) :: lo, hi

      lo = min(step%u0(i), step%u1(i))
      hi = max(step%u0(i), step%u1(i))
      crosses_level = any(lo <= up_level*self%steady(i) .and. up_level*self%steady(i) <= hi) &
         & .or. any(lo <= down_level*self%steady(i) .and. down_level*self%steady(i) <= hi)
   end function crosses_level

   !> The film force has a maximum within the step: bisect its rate.
   subroutine find_peak(self, step, i, lanes, history)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      integer, intent(in) :: i
      class(valve_lanes), intent(inout) :: lanes
      class(pressure_history), intent(in) :: history
      real(wp) :: path(0:5, lanes%dofs), left, right, s
      integer :: k

      do k = 1, lanes%dofs
         path(:, k) = step%path(i, k)
      end do
      left = 0.0_wp
      right = 1.0_wp
      do while (right - left > sqrt(epsilon(1.0_wp)))   ! the force is flat there: its error is of order epsilon
         s = 0.5_wp*(left + right)
         if (rate_at(s) > 0.0_wp) then
            left = s
         else
            right = s
         end if
      end do

   contains

      !> Rate of the force at s; notes the force.
      real(wp) function rate_at(s) result(rate)
         real(wp), intent(in) :: s
         real(wp), dimension(lanes%dofs) :: q, v, a
         real(wp) :: dt, inlet, outlet, force
         integer :: j

         dt = step%t1 - step%t0
         do j = 1, lanes%dofs
            q(j) = value_at(path(:, j), s)
            v(j) = value_at(derivative(path(:, j)), s)/dt
            a(j) = value_at(derivative(derivative(path(:, j))), s)/dt**2
         end do
         call history%factors(step%t0 + s*dt, inlet, outlet)
         call lanes%film_force(i, inlet, outlet, q, v, a, force, rate)
         self%largest_force(i) = max(self%largest_force(i), force)
      end function rate_at

   end subroutine find_peak

   !> The measures of lane i in the order of n_measures: m, s, s, m, s, s, s, m, N.
   !>
   !> A reed that creeps home comes within the integration's error of zero and may cross it there by chance: without
   !> an undershoot above that error it has not come to zero.
   pure function results(self, i) result(measure)
      class(measure_lanes), intent(in) :: self
      integer, intent(in) :: i
      real(wp) :: measure(n_measures)
      real(wp) :: least

      least = self%resolution*abs(self%steady(i))
      measure = ieee_value(1.0_wp, ieee_quiet_nan)
      measure(1) = self%steady(i)
      measure(2) = self%up(2, i) - self%up(1, i)
      measure(3) = self%up(3, i) - self%start
      if (self%steady(i) > 0.0_wp .and. self%event > self%start .and. self%reached(i) >= self%event) then
         measure(4) = above(self%highest(i) - self%steady(i), least)
      end if
      measure(5) = self%down(2, i) - self%down(1, i)
      measure(6) = self%down(3, i) - self%event
      if (-self%lowest(i) > least) measure(7) = self%down(4, i) - self%event
      if (self%reached(i) > self%event) measure(8) = above(-self%lowest(i), least)
      measure(9) = self%largest_force(i)
   end function results

   !> x, or zero where it is not above `least`; a `least` that is not known bounds nothing.
   pure real(wp) function above(x, least)
      real(wp), intent(in) :: x, least

      above = merge(x, 0.0_wp, x > 0.0_wp .and. .not. x <= least)
   end function above

end module rv_measures
