!> What a valve designer reads off a response: times between levels, extremes, largest film force.
!>
!> The steady displacement is the static equilibrium under the pressure at the start of the closing
!> event. Levels are fractions of it; their crossings and the extremes lie on the dense output, to
!> rounding. Everything is of the first cycle. What did not happen is NaN.
module rv_measures
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_dense, only : value_at, derivative, product_of, first_root
   use rv_step, only : step_type
   implicit none
   private
   public :: measure_lanes, new_measure_lanes, n_measures

   integer, parameter :: n_measures = 9  !! steady, rise, opening, overshoot, fall, closing, zero, undershoot, peak squeeze

   integer, parameter :: n_up = 3, n_down = 4
   real(wp), parameter :: up_level(n_up) = [0.10_wp, 0.90_wp, 0.98_wp]              !! while opening [-]
   real(wp), parameter :: down_level(n_down) = [0.90_wp, 0.10_wp, 0.02_wp, 0.0_wp]  !! while closing [-]

   !> Crossings and extremes found so far; arrays are (width) or (levels, width).
   type :: measure_lanes
      private
      real(wp) :: start = 0.0_wp      !! first instant [s]
      real(wp) :: event = 0.0_wp      !! start of the closing event [s]
      real(wp) :: cycle_end = 0.0_wp  !! end of what is measured [s]
      real(wp) :: reached = 0.0_wp    !! last instant seen [s]
      real(wp), allocatable :: steady(:)          !! [m]
      real(wp), allocatable :: gap(:)             !! g0 [m]
      real(wp), allocatable :: squeeze(:)         !! C [N s m2]
      real(wp), allocatable :: up(:, :)           !! instants of the upward crossings [s]
      real(wp), allocatable :: down(:, :)         !! instants of the downward crossings [s]
      real(wp), allocatable :: highest(:)         !! largest u while opening [m]
      real(wp), allocatable :: lowest(:)          !! smallest u while closing [m]
      real(wp), allocatable :: largest_force(:)   !! largest film force against closing [N]
   contains
      procedure :: observe
      procedure :: results
   end type measure_lanes

contains

   !> Begin at the initial state.
   pure subroutine new_measure_lanes(self, start, event, cycle_end, steady, u, gap, squeeze)
      type(measure_lanes), intent(out) :: self
      real(wp), intent(in) :: start, event, cycle_end   !! [s]
      real(wp), intent(in) :: steady(:)                 !! [m]
      real(wp), intent(in) :: u(:)                      !! initial displacement [m]
      real(wp), intent(in) :: gap(:)                    !! [m]
      real(wp), intent(in) :: squeeze(:)                !! [N s m2]

      self%start = start
      self%event = event
      self%cycle_end = cycle_end
      self%reached = start
      self%steady = steady
      self%gap = gap
      self%squeeze = squeeze
      allocate(self%up(n_up, size(u)), self%down(n_down, size(u)))
      self%up = ieee_value(1.0_wp, ieee_quiet_nan)
      self%down = self%up(1, 1)
      self%highest = u
      self%lowest = u
      allocate(self%largest_force(size(u)), source=0.0_wp)
   end subroutine new_measure_lanes

   !> Take one more step into account. Steps come in order and none spans the event.
   subroutine observe(self, step)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      integer :: i

      if (step%t0 >= self%cycle_end) return
      self%reached = step%t1
      if (step%t0 <= self%event) self%lowest = step%u0
      do i = 1, step%width
         call observe_lane(self, step, i)
      end do
   end subroutine observe

   subroutine observe_lane(self, step, i)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      integer, intent(in) :: i
      real(wp) :: c(0:5), turn, u_turn
      logical :: turns

      turns = step%v0(i)*step%v1(i) < 0.0_wp
      if (turns .or. crosses_level(self, step, i)) c = step%path(i)
      if (.not. turns) then
         call look(step%u0(i), step%u1(i), 0.0_wp, 1.0_wp)
      else
         turn = first_root(derivative(c), 0.0_wp, 1.0_wp)
         u_turn = value_at(c, turn)
         call look(step%u0(i), u_turn, 0.0_wp, turn)
         call look(u_turn, step%u1(i), turn, 1.0_wp)
      end if
      if (self%squeeze(i) > 0.0_wp .and. min(step%v0(i), step%v1(i)) < 0.0_wp) call look_at_force(self, step, i)

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

   !> Largest force -C v/h^3 with v < 0: at the ends, and where a h - 3 v^2 turns from - to + between them.
   pure subroutine look_at_force(self, step, i)
      class(measure_lanes), intent(inout) :: self
      type(step_type), intent(in) :: step
      integer, intent(in) :: i
      real(wp) :: h0, h1, g(0:8), film(0:5), speed(0:4), s, dt

      h0 = step%u0(i) + self%gap(i)
      h1 = step%u1(i) + self%gap(i)
      self%largest_force(i) = max(self%largest_force(i), -self%squeeze(i)*step%v1(i)/h1**3)
      if (step%a0(i)*h0 - 3.0_wp*step%v0(i)**2 >= 0.0_wp) return
      if (step%a1(i)*h1 - 3.0_wp*step%v1(i)**2 <= 0.0_wp) return
      dt = step%t1 - step%t0
      film = step%path(i)
      film(0) = film(0) + self%gap(i)
      speed = derivative(film)
      g = product_of(derivative(speed), film) - 3.0_wp*product_of(speed, speed)
      s = first_root(g, 0.0_wp, 1.0_wp)
      self%largest_force(i) = max(self%largest_force(i), -self%squeeze(i)*value_at(speed, s)/dt/value_at(film, s)**3)
   end subroutine look_at_force

   !> The measures of lane i in the order of n_measures: m, s, s, m, s, s, s, m, N.
   pure function results(self, i) result(measure)
      class(measure_lanes), intent(in) :: self
      integer, intent(in) :: i
      real(wp) :: measure(n_measures)

      measure = ieee_value(1.0_wp, ieee_quiet_nan)
      measure(1) = self%steady(i)
      measure(2) = self%up(2, i) - self%up(1, i)
      measure(3) = self%up(3, i) - self%start
      if (self%reached >= self%event .and. self%event > self%start) then
         measure(4) = max(0.0_wp, self%highest(i) - self%steady(i))
      end if
      measure(5) = self%down(2, i) - self%down(1, i)
      measure(6) = self%down(3, i) - self%event
      measure(7) = self%down(4, i) - self%event
      if (self%reached > self%event) measure(8) = max(0.0_wp, -self%lowest(i))
      measure(9) = self%largest_force(i)
   end function results

end module rv_measures
