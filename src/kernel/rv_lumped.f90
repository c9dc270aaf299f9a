!> The lumped valve models: one degree of freedom, with or without squeeze force.
!>
!> (m_e + m_a) u'' + (c_a + C/h^3) u' + k u = (p_in - p_out) A,  h = u + g0,   Eqs. (15), (22), (26),
!>
!> where the film term C u'/h^3 of the squeeze model acts while closing only (u' < 0, the paper's
!> switch; the force is zero at the switch, its slope jumps) or both ways; the traditional model of
!> Eq. (27) has C = 0. The cases of a group are lanes: structure of arrays, one entry a case.
module rv_lumped
   use rv_kinds, only : wp
   use rv_valve_lanes, only : valve_lanes, no_film_gap
   implicit none
   private
   public :: lumped_valve, lumped_lanes, new_lumped_lanes, squeeze_coefficient

   !> One case of a lumped model.
   type :: lumped_valve
      real(wp) :: mass = 1.0_wp       !! m_e + m_a [kg], > 0
      real(wp) :: damping = 0.0_wp    !! c_a [N s m-1], >= 0
      real(wp) :: stiffness = 1.0_wp  !! k [N m-1], > 0
      real(wp) :: area = 0.0_wp       !! A, the pressure's action area [m2]
      real(wp) :: squeeze = 0.0_wp    !! C of squeeze_coefficient [N s m2]; 0: traditional
      real(wp) :: gap = 1.0_wp        !! g0, film thickness under the reed at rest [m], > 0
      logical :: both_ways = .false.  !! the film acts while opening too
      real(wp) :: inlet = 0.0_wp      !! amplitude of the inlet factor [Pa] or [-]
      real(wp) :: outlet = 0.0_wp     !! amplitude of the outlet factor [Pa] or [-]
   end type lumped_valve

   !> Cases side by side; all arrays are (width).
   type, extends(valve_lanes) :: lumped_lanes
      real(wp), allocatable, private :: squeeze(:)        !! C [N s m2]
      real(wp), allocatable, private :: inverse_mass(:)   !! [kg-1]
      real(wp), allocatable, private :: damping(:)        !! [N s m-1]
      real(wp), allocatable, private :: stiffness(:)      !! [N m-1]
      real(wp), allocatable, private :: area(:)           !! [m2]
      real(wp), allocatable, private :: fastest(:)        !! velocity above which the film does not act [m s-1]
   contains
      procedure :: acceleration
      procedure :: linearise
      procedure :: film_force
      procedure :: equilibrium
      procedure :: scales
      procedure :: trace_values
      procedure :: silence
   end type lumped_lanes

contains

   !> C = k_s mu L B^3: twice the integral of Eq. (25) over the half width, times k_s; the print's 8 is 1.
   elemental real(wp) function squeeze_coefficient(k_s, viscosity, length, width) result(c)
      real(wp), intent(in) :: k_s        !! fitted factor of Eq. (26) [-], >= 0
      real(wp), intent(in) :: viscosity  !! mu [Pa s], > 0
      real(wp), intent(in) :: length     !! L [m], > 0
      real(wp), intent(in) :: width      !! B [m], > 0

      c = k_s*viscosity*length*width**3
   end function squeeze_coefficient

   !> Put cases side by side.
   pure subroutine new_lumped_lanes(self, valve)
      type(lumped_lanes), intent(out) :: self
      type(lumped_valve), intent(in) :: valve(:)

      self%width = size(valve)
      self%traces = 5
      self%inlet = valve%inlet
      self%outlet = valve%outlet
      self%has_film = valve%squeeze > 0.0_wp
      self%gap = merge(valve%gap, no_film_gap, self%has_film)
      self%tip = [1.0_wp]
      allocate(self%lowest_pressure(size(valve)), source=huge(1.0_wp))
      self%squeeze = valve%squeeze
      self%inverse_mass = 1.0_wp/valve%mass
      self%damping = valve%damping
      self%stiffness = valve%stiffness
      self%area = valve%area
      self%fastest = merge(huge(1.0_wp), 0.0_wp, valve%both_ways)
   end subroutine new_lumped_lanes

   !> Right-hand side v' [m s-2].
   subroutine acceleration(self, inlet, outlet, q, v, a, closed)
      class(lumped_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet                !! factors of the pressure history
      real(wp), intent(in) :: q(self%width, self%dofs)     !! tip displacement u [m]
      real(wp), intent(in) :: v(self%width, self%dofs)     !! tip velocity [m s-1]
      real(wp), intent(out) :: a(self%width, self%dofs)    !! [m s-2]
      integer, intent(out) :: closed
      integer :: i

      do i = 1, self%width
         a(i, 1) = ((self%inlet(i)*inlet - self%outlet(i)*outlet)*self%area(i) &
            & - self%stiffness(i)*q(i, 1) - self%damping(i)*v(i, 1) &
            & - self%squeeze(i)*min(v(i, 1), self%fastest(i))/(q(i, 1) + self%gap(i))**3)*self%inverse_mass(i)
      end do
      closed = first_closed(self, q(:, 1))
   end subroutine acceleration

   !> Right-hand side and its derivatives. At the switch v = 0 the closing side's slope is taken.
   subroutine linearise(self, inlet, outlet, q, v, a, a_q, a_v, closed)
      class(lumped_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%width, self%dofs)
      real(wp), intent(in) :: v(self%width, self%dofs)
      real(wp), intent(out) :: a(self%width, self%dofs)
      real(wp), intent(out) :: a_q(self%width, self%dofs, self%dofs)   !! da/du [s-2]
      real(wp), intent(out) :: a_v(self%width, self%dofs, self%dofs)   !! da/dv [s-1]
      integer, intent(out) :: closed
      real(wp) :: h, film
      integer :: i

      do i = 1, self%width
         h = q(i, 1) + self%gap(i)
         film = self%squeeze(i)/(h*h*h)
         film = merge(film, 0.0_wp, v(i, 1) <= self%fastest(i))
         a(i, 1) = ((self%inlet(i)*inlet - self%outlet(i)*outlet)*self%area(i) &
            & - self%stiffness(i)*q(i, 1) - (self%damping(i) + film)*v(i, 1))*self%inverse_mass(i)
         a_q(i, 1, 1) = (3.0_wp*film*v(i, 1)/h - self%stiffness(i))*self%inverse_mass(i)
         a_v(i, 1, 1) = -(film + self%damping(i))*self%inverse_mass(i)
      end do
      closed = first_closed(self, q(:, 1))
   end subroutine linearise

   !> -F_s of Eq. (26) [N] and its rate.
   subroutine film_force(self, lane, inlet, outlet, q, v, a, force, rate)
      class(lumped_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs), a(self%dofs)
      real(wp), intent(out) :: force, rate
      real(wp) :: h, film

      associate (unused => [inlet, outlet])
      end associate
      h = q(1) + self%gap(lane)
      film = 0.0_wp
      if (v(1) <= self%fastest(lane)) film = self%squeeze(lane)/h**3
      force = -film*v(1)
      rate = -film*(a(1) - 3.0_wp*v(1)**2/h)
   end subroutine film_force

   !> u = (p_in - p_out) A/k [m].
   subroutine equilibrium(self, inlet, outlet, q, found)
      class(lumped_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(out) :: q(self%width, self%dofs)
      logical, intent(out) :: found(self%width)

      q(:, 1) = (self%inlet*inlet - self%outlet*outlet)*self%area/self%stiffness
      found = q(:, 1) + self%gap > 0.0_wp
   end subroutine equilibrium

   !> The static displacement, for a squeeze film at most ten gaps (its force follows (u + g0)^-3),
   !> and that length times the natural frequency.
   subroutine scales(self, span, q_scale, v_scale)
      class(lumped_lanes), intent(in) :: self
      real(wp), intent(in) :: span(self%width)
      real(wp), intent(out) :: q_scale(self%width, self%dofs)
      real(wp), intent(out) :: v_scale(self%width, self%dofs)

      q_scale(:, 1) = min(span*self%area/self%stiffness, 10.0_wp*self%gap)
      where (.not. q_scale(:, 1) > 0.0_wp) q_scale(:, 1) = 1.0e-3_wp*min(self%gap, 1.0e-3_wp)
      v_scale(:, 1) = q_scale(:, 1)*sqrt(self%stiffness*self%inverse_mass)
   end subroutine scales

   !> Displacement [m], velocity [m s-1], inlet and outlet pressure [Pa], film force [N].
   subroutine trace_values(self, lane, inlet, outlet, q, v, value)
      class(lumped_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs)
      real(wp), intent(out) :: value(self%traces)
      real(wp) :: force, rate

      call self%film_force(lane, inlet, outlet, q, v, 0.0_wp*v, force, rate)
      value = [q(1), v(1), self%inlet(lane)*inlet, self%outlet(lane)*outlet, force]
   end subroutine trace_values

   subroutine silence(self, lane)
      class(lumped_lanes), intent(inout) :: self
      integer, intent(in) :: lane

      self%inlet(lane) = 0.0_wp
      self%outlet(lane) = 0.0_wp
      self%squeeze(lane) = 0.0_wp
      self%has_film(lane) = .false.
      self%gap(lane) = no_film_gap
      self%stiffness(lane) = 0.0_wp
      self%damping(lane) = 0.0_wp
      self%inverse_mass(lane) = 0.0_wp
   end subroutine silence

   pure integer function first_closed(self, u) result(lane)
      type(lumped_lanes), intent(in) :: self
      real(wp), intent(in) :: u(:)

      lane = 0
      if (all(u + self%gap > 0.0_wp)) return
      do lane = 1, self%width
         if (.not. u(lane) + self%gap(lane) > 0.0_wp) return
      end do
   end function first_closed

end module rv_lumped
