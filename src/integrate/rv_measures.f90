!> What a valve designer reads off a response: times between levels, extremes, largest film force.
!>
!> The steady displacement is the static equilibrium under the pressure at the start of the closing
!> event. Levels are fractions of it; their crossings and the extremes lie on the dense output, to
!> rounding. Everything is of the first cycle. What did not happen is NaN.
module rv_measures
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_dense, only : value_at, motion_at, derivative, first_root, inverse_guess
   use rv_pressure, only : pressure_history
   use rv_step, only : step_type
   use rv_valve_lanes, only : valve_lanes, most_dofs
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
      real(wp) :: now = 0.0_wp        !! last instant seen [s]
      real(wp), allocatable :: steady(:)          !! [m]
      real(wp), allocatable :: up(:, :)           !! instants of the upward crossings [s]
      real(wp), allocatable :: down(:, :)         !! instants of the downward crossings [s]
      real(wp), allocatable :: next_up(:)         !! lowest level not yet crossed upwards; huge: none [m]
      real(wp), allocatable :: next_down(:)       !! highest level not yet crossed downwards; -huge: none [m]
      real(wp), allocatable :: highest(:)         !! largest u while opening [m]
      real(wp), allocatable :: lowest(:)          !! smallest u while closing [m]
      real(wp), allocatable :: largest_force(:)   !! largest film force against closing [N]
      logical, allocatable :: closed(:)           !! a lane that has failed: its measures stay
      real(wp), allocatable :: last(:, :)         !! those measures
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
      self%now = start
      closest = 1.0e-9_wp*(cycle_end - start)
      if (abs(event - start) <= closest) self%event = start
      if (abs(event - cycle_end) <= closest) self%event = cycle_end
      self%steady = steady
      self%resolution = 0.0_wp
      if (present(rtol)) self%resolution = noise*rtol
      allocate(self%up(n_up, size(u)), self%down(n_down, size(u)))
      self%up = ieee_value(1.0_wp, ieee_quiet_nan)
      self%down = self%up(1, 1)
      self%next_up = merge(up_level(1)*steady, huge(1.0_wp), steady > 0.0_wp)
      self%next_down = merge(down_level(1)*steady, -huge(1.0_wp), steady > 0.0_wp)
      self%highest = u
      self%lowest = u
      allocate(self%closed(size(u)), source=.false.)
      allocate(self%last(n_measures, size(u)))
      allocate(self%largest_force(size(u)), self%rate(size(u)), source=0.0_wp)
   end subroutine new_measure_lanes

   !> Take one more step into account. Steps come in order and none spans the event.
   !>
   !> Most steps of most lanes hold no crossing and no extreme: a first look at all lanes tells which may.
   subroutine observe(self, step, lanes, history)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      class(valve_lanes), intent(inout) :: lanes
      class(pressure_history), intent(in) :: history
      real(wp), dimension(step%width) :: chance, force, rate
      real(wp) :: inlet, outlet
      integer :: i

      if (step%t0 >= self%cycle_end) return
      do i = 1, step%width
         if (step%live(i) .or. self%closed(i)) cycle
         self%last(:, i) = self%results(i)
         self%closed(i) = .true.
      end do
      self%now = step%t1
      if (step%t1 <= self%event) then
         call look_up(step%width, step%t1 - step%t0, step%u0, step%u1, step%w0, step%w1, self%next_up, &
            & self%steady, self%highest, chance)
      else
         if (step%t0 <= self%event) self%lowest = step%u0
         call look_down(step%width, step%t1 - step%t0, step%u0, step%u1, step%w0, step%w1, self%next_down, self%lowest, &
            & chance)
      end if
      do i = 1, step%width
         if (.not. chance(i) >= 0.0_wp) cycle
         if (step%live(i)) call observe_lane(self, step, i)
      end do
      call history%factors(step%t1, inlet, outlet)
      call lanes%film_forces(inlet, outlet, step%q1, step%v1, step%a1, force, rate)
      call look_for_peaks(step%width, step%t1 - step%t0, force, self%rate, rate, self%largest_force, chance)
      do i = 1, step%width
         if (chance(i) >= 0.0_wp) call find_peak(self, step, i, lanes, history, rate(i))
      end do
      self%rate = rate
   end subroutine observe

   !> Which lanes may cross a level upwards within a step, or reach a new maximum inside it: those whose `chance` is not
   !> negative. Notes the step's end as a maximum.
   !>
   !> Between turns u runs from end to end; past a turn it goes no further than the larger of its speeds takes it.
   pure subroutine look_up(n, dt, u0, u1, w0, w1, next, steady, highest, chance)
      integer, intent(in) :: n
      real(wp), intent(in) :: dt
      real(wp), dimension(n), intent(in) :: u0, u1, w0, w1, steady
      real(wp), intent(in) :: next(n)       !! lowest level still of interest [m]; that at `steady` is above the highest
      real(wp), intent(inout) :: highest(n)
      real(wp), intent(out) :: chance(n)
      real(wp) :: reach, top, low
      integer :: i

      do i = 1, n
         highest(i) = max(highest(i), u1(i))
         reach = dt*max(abs(w0(i)), abs(w1(i)))
         reach = merge(reach, 0.0_wp, w0(i)*w1(i) < 0.0_wp)
         top = max(u0(i), u1(i)) + reach
         low = min(u0(i), u1(i)) - reach
         chance(i) = max(min(top - next(i), steady(i) - low), merge(top - highest(i), -1.0_wp, reach > 0.0_wp))
      end do
   end subroutine look_up

   !> look_up's counterpart for levels downwards, the last one zero, and minima.
   pure subroutine look_down(n, dt, u0, u1, w0, w1, next, lowest, chance)
      integer, intent(in) :: n
      real(wp), intent(in) :: dt
      real(wp), dimension(n), intent(in) :: u0, u1, w0, w1
      real(wp), intent(in) :: next(n)    !! highest level still of interest [m]
      real(wp), intent(inout) :: lowest(n)
      real(wp), intent(out) :: chance(n)
      real(wp) :: reach, top, low
      integer :: i

      do i = 1, n
         lowest(i) = min(lowest(i), u1(i))
         reach = dt*max(abs(w0(i)), abs(w1(i)))
         reach = merge(reach, 0.0_wp, w0(i)*w1(i) < 0.0_wp)
         top = max(u0(i), u1(i)) + reach
         low = min(u0(i), u1(i)) - reach
         chance(i) = max(min(next(i) - low, top), merge(lowest(i) - low, -1.0_wp, reach > 0.0_wp))
      end do
   end subroutine look_down

   !> Which lanes' film force may have a new maximum inside a step: it rises at the start, falls at the end, and its
   !> rates there could take it so high. Notes the force at the end.
   pure subroutine look_for_peaks(n, dt, force, rate0, rate1, largest, chance)
      integer, intent(in) :: n
      real(wp), intent(in) :: dt
      real(wp), dimension(n), intent(in) :: force, rate0, rate1   !! at the end [N]; at both ends [N s-1]
      real(wp), intent(inout) :: largest(n)
      real(wp), intent(out) :: chance(n)
      integer :: i

      do i = 1, n
         largest(i) = max(largest(i), force(i))
         chance(i) = merge(force(i) + dt*max(rate0(i), -rate1(i)) - largest(i), -1.0_wp, min(rate0(i), -rate1(i)) > 0.0_wp)
      end do
   end subroutine look_for_peaks

   !> Crossings and extremes of one lane within a step.
   subroutine observe_lane(self, step, i)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      integer, intent(in) :: i
      real(wp) :: c(0:5), dt, turn, u_turn

      c = step%tip_path(i)
      dt = step%t1 - step%t0
      if (.not. step%w0(i)*step%w1(i) < 0.0_wp) then
         call look(step%u0(i), step%u1(i), 0.0_wp, 1.0_wp)
      else
         turn = first_root(derivative(c), 0.0_wp, 1.0_wp, step%w0(i)/(step%w0(i) - step%w1(i)))
         u_turn = value_at(c, turn)
         call look(step%u0(i), u_turn, 0.0_wp, turn)
         call look(u_turn, step%u1(i), turn, 1.0_wp)
      end if
      if (step%t1 <= self%event) then
         self%next_up(i) = next_level(up_level, self%up(:, i), huge(1.0_wp))
      else
         self%next_down(i) = next_level(down_level, self%down(:, i), -huge(1.0_wp))
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
         real(wp) :: distance(0:5), guess

         if (t >= self%start) return
         distance = c
         distance(0) = c(0) - level
         guess = inverse_guess(step%u0(i) - level, dt*step%w0(i), step%u1(i) - level, dt*step%w1(i))
         t = step%t0 + dt*first_root(distance, s_from, s_to, guess)
      end subroutine note

      !> The first level whose crossing is not known yet, or `none`.
      pure real(wp) function next_level(level, crossed, none)
         real(wp), intent(in) :: level(:), crossed(:), none
         integer :: k

         next_level = none
         if (.not. self%steady(i) > 0.0_wp) return
         do k = size(level), 1, -1
            if (.not. crossed(k) >= self%start) next_level = level(k)*self%steady(i)
         end do
      end function next_level

   end subroutine observe_lane

   !> The film force has a maximum within the step: the root of its rate, by false position (Illinois).
   subroutine find_peak(self, step, i, lanes, history, rate_now)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      integer, intent(in) :: i
      class(valve_lanes), intent(inout) :: lanes
      class(pressure_history), intent(in) :: history
      real(wp), intent(in) :: rate_now   !! of change of the force at the end of the step [N s-1]
      real(wp), parameter :: flat = 1.0e-9_wp   ! of the largest force, what the peak may lie above it
      real(wp) :: path(0:5, most_dofs), dt, left, right, rate_left, rate_right, s, rate, bend
      real(wp), dimension(most_dofs) :: q, v, a
      integer :: k

      do k = 1, lanes%dofs
         path(:, k) = step%path(i, k)
      end do
      dt = step%t1 - step%t0
      left = 0.0_wp
      right = 1.0_wp
      rate_left = self%rate(i)
      rate_right = rate_now
      do k = 1, 60
         bend = (rate_left - rate_right)/(right - left)
         s = left + rate_left/bend
         rate = rate_at(s)
         if (.not. dt*rate**2 > flat*self%largest_force(i)*bend) return   ! a parabola's top is rate^2/(2 bend) above
         if (rate > 0.0_wp) then
            left = s
            rate_left = rate
            rate_right = 0.5_wp*rate_right
         else
            right = s
            rate_right = rate
            rate_left = 0.5_wp*rate_left
         end if
      end do

   contains

      !> Rate of the force at s; notes the force.
      real(wp) function rate_at(s) result(rate)
         real(wp), intent(in) :: s
         real(wp) :: inlet, outlet, force
         integer :: j

         do j = 1, lanes%dofs
            call motion_at(path(:, j), s, q(j), v(j), a(j))
            v(j) = v(j)/dt
            a(j) = a(j)/dt**2
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

      if (self%closed(i)) then
         measure = self%last(:, i)
         return
      end if
      least = self%resolution*abs(self%steady(i))
      measure = ieee_value(1.0_wp, ieee_quiet_nan)
      measure(1) = self%steady(i)
      measure(2) = self%up(2, i) - self%up(1, i)
      measure(3) = self%up(3, i) - self%start
      if (self%steady(i) > 0.0_wp .and. self%event > self%start .and. self%now >= self%event) then
         measure(4) = above(self%highest(i) - self%steady(i), least)
      end if
      measure(5) = self%down(2, i) - self%down(1, i)
      measure(6) = self%down(3, i) - self%event
      if (-self%lowest(i) > least) measure(7) = self%down(4, i) - self%event
      if (self%now > self%event) measure(8) = above(-self%lowest(i), least)
      measure(9) = self%largest_force(i)
   end function results

   !> x, or zero where it is not above `least`; a `least` that is not known bounds nothing.
   pure real(wp) function above(x, least)
      real(wp), intent(in) :: x, least

      above = merge(x, 0.0_wp, x > 0.0_wp .and. .not. x <= least)
   end function above

end module rv_measures
