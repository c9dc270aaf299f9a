!> What a valve designer reads off a response: times between levels, extremes, largest film force.
!>
!> The steady displacement is the static equilibrium under the pressure at the start of the closing
!> event. Levels are fractions of it; their crossings and the extremes lie on the dense output, to
!> rounding. Everything is of the first cycle. What did not happen is NaN.
module rv_measures
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp, i8
   use rv_crossing, only : crossings
   use rv_dense, only : value_at, motion_at, derivative, first_root
   use rv_pressure, only : pressure_history
   use rv_step, only : step_type
   use rv_valve_lanes, only : valve_lanes, most_dofs
   implicit none
   private
   public :: measure_lanes, new_measure_lanes, n_measures, measure_steady, measure_overshoot, measure_undershoot

   integer, parameter :: n_measures = 9  !! steady, rise, opening, overshoot, fall, closing, zero, undershoot, peak squeeze
   integer, parameter :: measure_steady = 1, measure_overshoot = 4, measure_undershoot = 8

   integer, parameter :: n_up = 3, n_down = 4
   real(wp), parameter :: up_level(n_up) = [0.10_wp, 0.90_wp, 0.98_wp]              !! while opening [-]
   real(wp), parameter :: down_level(n_down) = [0.90_wp, 0.10_wp, 0.02_wp, 0.0_wp]  !! while closing [-]

   !> A curve turns no further than where its tangents at a step's ends meet if it bends one way; it need not.
   real(wp), parameter :: allowance = 1.5_wp

   real(wp), parameter :: stiff = 30.0_wp  !! rate of decay times step, where the film force is taken at the steps' ends only
   real(wp), parameter :: noise = 10.0_wp  !! global error over the tolerance of a step, at most

   !> Crossings and extremes found so far; arrays are (width) or (width, levels).
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
      real(wp), allocatable :: force(:), rate(:)  !! that force and its rate at the end of the last step [N], [N s-1]
      real(wp), allocatable :: force_before(:), rate_before(:)   !! and at its start
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
      allocate(self%up(size(u), n_up), self%down(size(u), n_down))
      self%up = ieee_value(1.0_wp, ieee_quiet_nan)
      self%down = self%up(1, 1)
      self%next_up = merge(up_level(1)*steady, huge(1.0_wp), steady > 0.0_wp)
      self%next_down = merge(down_level(1)*steady, -huge(1.0_wp), steady > 0.0_wp)
      self%highest = u
      self%lowest = u
      allocate(self%closed(size(u)), source=.false.)
      allocate(self%last(n_measures, size(u)))
      allocate(self%largest_force(size(u)), self%force(size(u)), self%rate(size(u)), &
         & self%force_before(size(u)), self%rate_before(size(u)), source=0.0_wp)
   end subroutine new_measure_lanes

   !> Take one more step into account. Steps come in order and none spans the event.
   !>
   !> Most steps of most lanes hold no crossing and no extreme: a first look at all lanes tells which may.
   subroutine observe(self, step, lanes, history)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      class(valve_lanes), intent(inout) :: lanes
      class(pressure_history), intent(in) :: history
      real(wp) :: chance(step%width)
      real(wp) :: inlet, outlet
      integer :: lane(step%width), picked, straight, i, k

      if (step%t0 >= self%cycle_end) return
      if (.not. step%all_live) call close_failed(self, step%live)
      self%now = step%t1
      if (step%t1 <= self%event) then
         call look_up(step%width, step%t1 - step%t0, step%u0, step%u1, step%w0, step%w1, self%next_up, &
            & self%steady, self%highest, chance)
      else
         if (step%t0 <= self%event) self%lowest = step%u0
         call look_down(step%width, step%t1 - step%t0, step%u0, step%u1, step%w0, step%w1, self%next_down, self%lowest, &
            & chance)
      end if
      straight = 0
      call pick(step%width, chance, lane, picked)
      do k = 1, picked
         i = lane(k)
         if (.not. step%live(i)) cycle
         if (step%w0(i)*step%w1(i) < 0.0_wp) then
            call observe_turn(self, step, i)
         else
            straight = straight + 1
            lane(straight) = i   ! behind k
         end if
      end do
      if (straight > 0) call observe_straight(self, step, lane(:straight))
      call history%factors(step%t1, inlet, outlet)
      call swap(self%force_before, self%force)
      call swap(self%rate_before, self%rate)
      call lanes%film_forces(inlet, outlet, step%q1, step%v1, step%a1, self%force, self%rate)
      call look_for_peaks(step%width, step%t1 - step%t0, self%force_before, self%rate_before, self%force, self%rate, &
         & self%largest_force, chance)
      call pick(step%width, chance, lane, picked)
      do k = 1, picked
         call find_peak(self, step, lane(k), lanes, history)
      end do
   end subroutine observe

   pure subroutine swap(a, b)
      real(wp), allocatable, intent(inout) :: a(:), b(:)
      real(wp), allocatable :: c(:)

      call move_alloc(a, c)
      call move_alloc(b, a)
      call move_alloc(c, b)
   end subroutine swap

   !> Keep what is known of lanes that have failed.
   pure subroutine close_failed(self, live)
      class(measure_lanes), intent(inout) :: self
      logical, intent(in) :: live(:)
      integer :: i

      do i = 1, size(live)
         if (live(i) .or. self%closed(i)) cycle
         self%last(:, i) = self%results(i)
         self%closed(i) = .true.
      end do
   end subroutine close_failed

   !> Lanes whose `chance` is not negative. They are few: many lanes together are looked at first.
   pure subroutine pick(n, chance, lane, picked)
      integer, intent(in) :: n
      real(wp), intent(in) :: chance(n)
      integer, intent(out) :: lane(n)
      integer, intent(out) :: picked   !! how many of `lane` count
      integer, parameter :: many = 32
      integer(i8) :: some
      integer :: first, last, i

      picked = 0
      do first = 1, n, many
         last = min(first + many - 1, n)
         some = 0_i8
         do i = first, last
            some = ior(some, merge(1_i8, 0_i8, chance(i) >= 0.0_wp))
         end do
         if (some == 0_i8) cycle
         do i = first, last
            if (.not. chance(i) >= 0.0_wp) cycle
            picked = picked + 1
            lane(picked) = i
         end do
      end do
   end subroutine pick

   !> Which lanes may cross a level upwards within a step, or reach a new maximum inside it: those whose `chance` is not
   !> negative. Notes the step's end as a maximum.
   !>
   !> Between turns u runs from end to end; past a turn it goes about as far as where the tangents at the ends meet.
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
         call look_around(dt, u0(i), u1(i), w0(i), w1(i), low, top, reach)
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
         call look_around(dt, u0(i), u1(i), w0(i), w1(i), low, top, reach)
         chance(i) = max(min(next(i) - low, top), merge(lowest(i) - low, -1.0_wp, reach > 0.0_wp))
      end do
   end subroutine look_down

   !> Between what u lies within a step, and how much of that is due to a turn.
   elemental subroutine look_around(dt, u0, u1, w0, w1, low, top, reach)
      real(wp), intent(in) :: dt, u0, u1, w0, w1
      real(wp), intent(out) :: low, top, reach
      real(wp) :: meet

      top = max(u0, u1)
      low = min(u0, u1)
      meet = u0 + w0*((u1 - u0 - w1*dt)/(w0 - w1))
      reach = merge(allowance*max(meet - top, low - meet, 0.0_wp), 0.0_wp, w0*w1 < 0.0_wp)
      top = top + reach
      low = low - reach
   end subroutine look_around

   !> Which lanes' film force may have a new maximum inside a step, those whose `chance` is positive: it rises at the
   !> start, falls at the end, and the tangents there meet above the largest so far. Notes the force at the end. Of
   !> `chance` only the sign counts: it is by how much they do times what would be divided by.
   pure subroutine look_for_peaks(n, dt, force0, rate0, force1, rate1, largest, chance)
      integer, intent(in) :: n
      real(wp), intent(in) :: dt
      real(wp), dimension(n), intent(in) :: force0, rate0, force1, rate1   !! at both ends [N], [N s-1]
      real(wp), intent(inout) :: largest(n)
      real(wp), intent(out) :: chance(n)
      real(wp) :: higher, above, bend
      integer :: i

      do i = 1, n
         largest(i) = max(largest(i), force1(i))
         higher = max(force0(i), force1(i))
         bend = rate0(i) - rate1(i)
         above = rate0(i)*(force1(i) - rate1(i)*dt - force0(i)) - (higher - force0(i))*bend
         above = allowance*above + (higher - largest(i))*bend
         chance(i) = merge(above, -1.0_wp, min(rate0(i), -rate1(i)) > 0.0_wp)
      end do
   end subroutine look_for_peaks

   !> Crossings within a step of lanes that do not turn in it, a level at a time for all of them.
   subroutine observe_straight(self, step, lane)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      integer, intent(in) :: lane(:)
      integer :: k

      if (step%t1 <= self%event) then
         do k = 1, n_up
            call cross(step%width, up_level(k), self%up(:, k))
         end do
      else
         do k = 1, n_down
            call cross(step%width, down_level(k), self%down(:, k))
         end do
      end if
      do k = 1, size(lane)
         call set_next_level(self, lane(k), step%t1 <= self%event)
      end do

   contains

      !> Note the first crossings of a level.
      subroutine cross(width, level, instant)
         integer, intent(in) :: width
         real(wp), intent(in) :: level            !! [-]
         real(wp), intent(inout) :: instant(width)
         integer :: who(size(lane)), n, i, j
         real(wp), dimension(size(lane)) :: b0, b1, s

         n = 0
         do j = 1, size(lane)
            i = lane(j)
            if (instant(i) >= self%start .or. .not. self%steady(i) > 0.0_wp) cycle
            if (.not. passes(step%u0(i), step%u1(i), level*self%steady(i), step%t1 <= self%event)) cycle
            n = n + 1
            who(n) = i
         end do
         if (n == 0) return
         call step%tip_accelerations(who(:n), b0(:n), b1(:n))
         call crossings(n, step%t1 - step%t0, level*self%steady(who(:n)), step%u0(who(:n)), step%w0(who(:n)), b0, &
            & step%u1(who(:n)), step%w1(who(:n)), b1, s)
         instant(who(:n)) = step%t0 + (step%t1 - step%t0)*s(:n)
      end subroutine cross

   end subroutine observe_straight

   !> Whether u comes to a level from below, or from above; a start on it is no coming.
   pure logical function passes(from, to, level, upwards)
      real(wp), intent(in) :: from, to, level
      logical, intent(in) :: upwards

      if (upwards) then
         passes = from < level .and. level <= to
      else
         passes = from > level .and. level >= to
      end if
   end function passes

   !> The first level whose crossing is not known yet, if any.
   pure subroutine set_next_level(self, i, upwards)
      class(measure_lanes), intent(inout) :: self
      integer, intent(in) :: i
      logical, intent(in) :: upwards
      integer :: k

      if (.not. self%steady(i) > 0.0_wp) return
      if (upwards) then
         self%next_up(i) = huge(1.0_wp)
         do k = n_up, 1, -1
            if (.not. self%up(i, k) >= self%start) self%next_up(i) = up_level(k)*self%steady(i)
         end do
      else
         self%next_down(i) = -huge(1.0_wp)
         do k = n_down, 1, -1
            if (.not. self%down(i, k) >= self%start) self%next_down(i) = down_level(k)*self%steady(i)
         end do
      end if
   end subroutine set_next_level

   !> Crossings and the extreme of a lane that turns within a step.
   subroutine observe_turn(self, step, i)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      integer, intent(in) :: i
      real(wp) :: c(0:5), turn, u_turn
      logical :: upwards

      upwards = step%t1 <= self%event
      c = step%tip_path(i)
      turn = first_root(derivative(c), 0.0_wp, 1.0_wp, step%w0(i)/(step%w0(i) - step%w1(i)), near=1.0e-4_wp)   ! u is flat there
      u_turn = value_at(c, turn)
      if (upwards) then
         self%highest(i) = max(self%highest(i), u_turn)
      else
         self%lowest(i) = min(self%lowest(i), u_turn)
      end if
      if (.not. self%steady(i) > 0.0_wp) return
      call look(step%u0(i), u_turn, 0.0_wp, turn)
      call look(u_turn, step%u1(i), turn, 1.0_wp)
      call set_next_level(self, i, upwards)

   contains

      !> One stretch on which u runs from `from` to `to` without turning.
      subroutine look(from, to, s_from, s_to)
         real(wp), intent(in) :: from, to, s_from, s_to
         integer :: k

         if (upwards) then
            do k = 1, n_up
               call note(self%up(i, k), from, to, up_level(k)*self%steady(i), s_from, s_to)
            end do
         else
            do k = 1, n_down
               call note(self%down(i, k), from, to, down_level(k)*self%steady(i), s_from, s_to)
            end do
         end if
      end subroutine look

      !> Keep the first crossing only.
      subroutine note(t, from, to, level, s_from, s_to)
         real(wp), intent(inout) :: t
         real(wp), intent(in) :: from, to, level, s_from, s_to
         real(wp) :: distance(0:5)

         if (t >= self%start .or. .not. passes(from, to, level, upwards)) return
         distance = c
         distance(0) = c(0) - level
         t = step%t0 + (step%t1 - step%t0)*first_root(distance, s_from, s_to)
      end subroutine note

   end subroutine observe_turn

   !> The film force has a maximum within the step: the root of its rate, by false position (Illinois) from the top of
   !> the cubic that meets force and rate at both ends.
   !>
   !> Where the film settles the velocity many times within a step, the motion is quasi-static and the forces at the ends
   !> of the steps tell it; accelerations there, and so the dense output, are the integration's error times that rate.
   subroutine find_peak(self, step, i, lanes, history)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      integer, intent(in) :: i
      class(valve_lanes), intent(inout) :: lanes
      class(pressure_history), intent(in) :: history
      real(wp) :: path(0:5, most_dofs), dt, left, right, rate_left, rate_right, weight_left, weight_right, s, rate, flat
      real(wp), dimension(most_dofs) :: q, v, a
      integer :: k

      dt = step%t1 - step%t0
      if (lanes%decay(i, step%q1(i, :))*dt > stiff) return
      do k = 1, lanes%dofs
         path(:, k) = step%path(i, k)
      end do
      flat = max(1.0e-2_wp*self%resolution, 1.0e-12_wp)*self%largest_force(i)   ! what the peak may lie above the last look
      left = 0.0_wp
      right = 1.0_wp
      rate_left = self%rate_before(i)
      rate_right = self%rate(i)
      weight_left = rate_left
      weight_right = rate_right
      s = top_of_cubic(self%force(i) - self%force_before(i), dt*rate_left, dt*rate_right)
      do k = 1, 60
         rate = rate_at(s)
         ! the top of a parabola lies rate^2/(2 bend) above
         if (.not. dt*rate**2*(right - left) > 2.0_wp*flat*(rate_left - rate_right)) return
         if (rate > 0.0_wp) then
            left = s
            rate_left = rate
            weight_left = rate
            weight_right = 0.5_wp*weight_right
         else
            right = s
            rate_right = rate
            weight_right = rate
            weight_left = 0.5_wp*weight_left
         end if
         s = left + (right - left)*weight_left/(weight_left - weight_right)
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

   !> Where on 0..1 a cubic with slope a > 0 at 0 and b < 0 at 1 that rises by `rise` has its top.
   pure real(wp) function top_of_cubic(rise, a, b) result(s)
      real(wp), intent(in) :: rise, a, b
      real(wp) :: half, last

      ! slope a + 2 half s + last s^2
      half = 3.0_wp*rise - 2.0_wp*a - b
      last = 3.0_wp*(a + b - 2.0_wp*rise)
      s = sqrt(max(0.0_wp, half**2 - a*last)) - half
      s = merge(a/s, 0.5_wp, s > a)
   end function top_of_cubic

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
      measure(2) = self%up(i, 2) - self%up(i, 1)
      measure(3) = self%up(i, 3) - self%start
      if (self%steady(i) > 0.0_wp .and. self%event > self%start .and. self%now >= self%event) then
         measure(4) = above(self%highest(i) - self%steady(i), least)
      end if
      measure(5) = self%down(i, 2) - self%down(i, 1)
      measure(6) = self%down(i, 3) - self%event
      if (-self%lowest(i) > least) measure(7) = self%down(i, 4) - self%event
      if (self%now > self%event) measure(8) = above(-self%lowest(i), least)
      measure(9) = merge(0.0_wp, self%largest_force(i), self%largest_force(i) <= 0.0_wp)   ! no -0
   end function results

   !> x, or zero where it is not above `least`; a `least` that is not known bounds nothing.
   pure real(wp) function above(x, least)
      real(wp), intent(in) :: x, least

      above = merge(x, 0.0_wp, x > 0.0_wp .and. .not. x <= least)
   end function above

end module rv_measures
