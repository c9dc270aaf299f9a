!> Lanes of several degrees of freedom for the suites: coupled springs, dampers, and a film under the tip.
!>
!> q'' = load p - K q - D v - tip C u'/(u + g0)^3,  u = sum of tip_k q_k,  p = inlet*factor - outlet*factor.
!> The film acts both ways; without C the lanes are linear.
module spring_lanes
   use rv_kinds, only : wp
   use rv_valve_lanes, only : valve_lanes, no_film_gap
   implicit none
   private
   public :: spring_valve, new_spring_valve

   type, extends(valve_lanes) :: spring_valve
      real(wp), allocatable :: stiffness(:, :, :)   !! K [s-2], (width, dofs, dofs)
      real(wp), allocatable :: damping(:, :, :)     !! D [s-1], (width, dofs, dofs)
      real(wp), allocatable :: load(:, :)           !! (width, dofs)
      real(wp), allocatable :: squeeze(:)           !! C [m3 s-1], (width)
      integer :: calls = 0                          !! of linearise
   contains
      procedure :: acceleration
      procedure :: linearise
      procedure :: film_force
      procedure :: equilibrium
      procedure :: scales
      procedure :: trace_values
      procedure :: silence
   end type spring_valve

contains

   !> Lanes at rest without film, load and springs: the suite fills in what it needs.
   pure subroutine new_spring_valve(self, width, dofs)
      type(spring_valve), intent(out) :: self
      integer, intent(in) :: width, dofs

      self%width = width
      self%dofs = dofs
      self%traces = 3
      allocate(self%inlet(width), source=1.0_wp)
      allocate(self%outlet(width), self%squeeze(width), self%lowest_pressure(width), source=0.0_wp)
      allocate(self%gap(width), source=no_film_gap)
      allocate(self%has_film(width), source=.false.)
      allocate(self%tip(dofs), source=1.0_wp)
      allocate(self%load(width, dofs), source=0.0_wp)
      allocate(self%stiffness(width, dofs, dofs), self%damping(width, dofs, dofs), source=0.0_wp)
   end subroutine new_spring_valve

   subroutine acceleration(self, first, last, inlet, outlet, q, v, a, closed)
      class(spring_valve), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(first:last, self%dofs), v(first:last, self%dofs)
      real(wp), intent(out) :: a(first:last, self%dofs)
      integer, intent(out) :: closed
      real(wp) :: h
      integer :: i

      closed = 0
      do i = last, first, -1
         h = dot_product(self%tip, q(i, :)) + self%gap(i)
         a(i, :) = self%load(i, :)*(self%inlet(i)*inlet - self%outlet(i)*outlet) - matmul(self%stiffness(i, :, :), q(i, :)) &
            & - matmul(self%damping(i, :, :), v(i, :)) - self%tip*self%squeeze(i)*dot_product(self%tip, v(i, :))/h**3
         if (.not. h > 0.0_wp) closed = i
      end do
   end subroutine acceleration

   subroutine linearise(self, first, last, inlet, outlet, q, v, a, a_q, a_v, closed)
      class(spring_valve), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(first:last, self%dofs), v(first:last, self%dofs)
      real(wp), intent(out) :: a(first:last, self%dofs)
      real(wp), intent(out) :: a_q(first:last, self%dofs, self%dofs), a_v(first:last, self%dofs, self%dofs)
      integer, intent(out) :: closed
      real(wp) :: h, speed, film
      integer :: i, k

      self%calls = self%calls + 1
      call self%acceleration(first, last, inlet, outlet, q, v, a, closed)
      do i = first, last
         h = dot_product(self%tip, q(i, :)) + self%gap(i)
         speed = dot_product(self%tip, v(i, :))
         film = self%squeeze(i)/h**3
         do k = 1, self%dofs
            a_q(i, :, k) = 3.0_wp*self%tip*film*speed/h*self%tip(k) - self%stiffness(i, :, k)
            a_v(i, :, k) = -self%tip*film*self%tip(k) - self%damping(i, :, k)
         end do
      end do
   end subroutine linearise

   subroutine film_force(self, lane, inlet, outlet, q, v, a, force, rate)
      class(spring_valve), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs), a(self%dofs)
      real(wp), intent(out) :: force, rate
      real(wp) :: h, speed

      associate (unused => [inlet, outlet])
      end associate
      h = dot_product(self%tip, q) + self%gap(lane)
      speed = dot_product(self%tip, v)
      force = -self%squeeze(lane)*speed/h**3
      rate = -self%squeeze(lane)*(dot_product(self%tip, a) - 3.0_wp*speed**2/h)/h**3
   end subroutine film_force

   !> No suite starts these lanes from their equilibrium.
   subroutine equilibrium(self, inlet, outlet, q, found)
      class(spring_valve), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(out) :: q(self%width, self%dofs)
      logical, intent(out) :: found(self%width)

      associate (unused => [inlet, outlet])
      end associate
      q = 0.0_wp
      found = .false.
   end subroutine equilibrium

   subroutine scales(self, span, q_scale, v_scale)
      class(spring_valve), intent(in) :: self
      real(wp), intent(in) :: span(self%width)
      real(wp), intent(out) :: q_scale(self%width, self%dofs), v_scale(self%width, self%dofs)

      associate (unused => span)
      end associate
      q_scale = 1.0_wp
      v_scale = 1.0_wp
   end subroutine scales

   !> Tip displacement [m], velocity [m s-1] and pressure difference [Pa].
   subroutine trace_values(self, lane, inlet, outlet, q, v, value)
      class(spring_valve), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs)
      real(wp), intent(out) :: value(self%traces)

      value = [dot_product(self%tip, q), dot_product(self%tip, v), self%inlet(lane)*inlet - self%outlet(lane)*outlet]
   end subroutine trace_values

   subroutine silence(self, lane)
      class(spring_valve), intent(inout) :: self
      integer, intent(in) :: lane

      self%load(lane, :) = 0.0_wp
      self%stiffness(lane, :, :) = 0.0_wp
      self%damping(lane, :, :) = 0.0_wp
      self%squeeze(lane) = 0.0_wp
      self%gap(lane) = no_film_gap
   end subroutine silence

end module spring_lanes
