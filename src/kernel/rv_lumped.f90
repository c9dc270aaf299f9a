!> The lumped valve models: one degree of freedom, with or without squeeze force.
!>
!> (m_e + m_a) u'' + (c_a + C/h^3) u' + k u = (p_in - p_out) A,  h = u + g0,   Eqs. (15), (22), (26),
!>
!> where the film term C u'/h^3 of the squeeze model acts while closing only (u' < 0, the paper's
!> switch; the force is zero at the switch, its slope jumps) or both ways; the traditional model of
!> Eq. (27) has C = 0. The cases of a group are lanes: structure of arrays, one entry a case.
module rv_lumped
   use rv_kinds, only : wp
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
   contains
      procedure :: equilibrium
   end type lumped_valve

   !> Cases side by side; all arrays are (width).
   type :: lumped_lanes
      integer :: width = 0
      real(wp), allocatable :: inlet(:), outlet(:)   !! amplitudes [Pa] or [-]
      real(wp), allocatable :: gap(:)                !! g0 [m]; for a lane without film a length no reed comes near
      real(wp), allocatable :: squeeze(:)            !! C [N s m2]
      real(wp), allocatable, private :: inverse_mass(:)   !! [kg-1]
      real(wp), allocatable, private :: damping(:)        !! [N s m-1]
      real(wp), allocatable, private :: stiffness(:)      !! [N m-1]
      real(wp), allocatable, private :: area(:)           !! [m2]
      real(wp), allocatable, private :: fastest(:)        !! velocity above which the film does not act [m s-1]
   contains
      procedure :: film_force
      procedure :: acceleration
      procedure :: jacobian
      procedure :: silence
   end type lumped_lanes

   real(wp), parameter :: no_film_gap = 1.0e3_wp  !! [m]

contains

   !> C = k_s mu L B^3: twice the integral of Eq. (25) over the half width, times k_s; the print's 8 is 1.
   elemental real(wp) function squeeze_coefficient(k_s, viscosity, length, width) result(c)
      real(wp), intent(in) :: k_s        !! fitted factor of Eq. (26) [-], >= 0
      real(wp), intent(in) :: viscosity  !! mu [Pa s], > 0
      real(wp), intent(in) :: length     !! L [m], > 0
      real(wp), intent(in) :: width      !! B [m], > 0

      c = k_s*viscosity*length*width**3
   end function squeeze_coefficient

   !> Static tip displacement under given factors, u = (p_in - p_out) A/k [m].
   elemental real(wp) function equilibrium(self, inlet, outlet) result(u)
      class(lumped_valve), intent(in) :: self
      real(wp), intent(in) :: inlet, outlet   !! factors of the pressure history

      u = (self%inlet*inlet - self%outlet*outlet)*self%area/self%stiffness
   end function equilibrium

   !> Put cases side by side.
   pure subroutine new_lumped_lanes(self, valve)
      type(lumped_lanes), intent(out) :: self
      type(lumped_valve), intent(in) :: valve(:)

      self%width = size(valve)
      self%inlet = valve%inlet
      self%outlet = valve%outlet
      self%squeeze = valve%squeeze
      self%gap = merge(valve%gap, no_film_gap, valve%squeeze > 0.0_wp)
      self%inverse_mass = 1.0_wp/valve%mass
      self%damping = valve%damping
      self%stiffness = valve%stiffness
      self%area = valve%area
      self%fastest = merge(huge(1.0_wp), 0.0_wp, valve%both_ways)
   end subroutine new_lumped_lanes

   !> Force of the film on the reed, -F_s of Eq. (26) [N]: positive pushes the reed open.
   pure subroutine film_force(self, u, v, force)
      class(lumped_lanes), intent(in) :: self
      real(wp), intent(in) :: u(self%width)       !! tip displacement [m], > -gap
      real(wp), intent(in) :: v(self%width)       !! tip velocity [m s-1]
      real(wp), intent(out) :: force(self%width)  !! [N]

      force = -self%squeeze*min(v, self%fastest)/(u + self%gap)**3
   end subroutine film_force

   !> Right-hand side v' [m s-2].
   pure subroutine acceleration(self, inlet, outlet, u, v, a)
      class(lumped_lanes), intent(in) :: self
      real(wp), intent(in) :: inlet, outlet      !! factors of the pressure history
      real(wp), intent(in) :: u(self%width)      !! [m], > -gap
      real(wp), intent(in) :: v(self%width)      !! [m s-1]
      real(wp), intent(out) :: a(self%width)     !! [m s-2]
      integer :: i

      do i = 1, self%width
         a(i) = ((self%inlet(i)*inlet - self%outlet(i)*outlet)*self%area(i) &
            & - self%stiffness(i)*u(i) - self%damping(i)*v(i) &
            & - self%squeeze(i)*min(v(i), self%fastest(i))/(u(i) + self%gap(i))**3)*self%inverse_mass(i)
      end do
   end subroutine acceleration

   !> Derivatives of the right-hand side. At the switch v = 0 the closing side's slope is taken.
   pure subroutine jacobian(self, u, v, a_u, a_v)
      class(lumped_lanes), intent(in) :: self
      real(wp), intent(in) :: u(self%width)        !! [m], > -gap
      real(wp), intent(in) :: v(self%width)        !! [m s-1]
      real(wp), intent(out) :: a_u(self%width)     !! da/du [s-2]
      real(wp), intent(out) :: a_v(self%width)     !! da/dv [s-1]
      real(wp) :: film
      integer :: i

      do i = 1, self%width
         film = 0.0_wp
         if (v(i) <= self%fastest(i)) film = self%squeeze(i)/(u(i) + self%gap(i))**3
         a_u(i) = (3.0_wp*film*v(i)/(u(i) + self%gap(i)) - self%stiffness(i))*self%inverse_mass(i)
         a_v(i) = -(film + self%damping(i))*self%inverse_mass(i)
      end do
   end subroutine jacobian

   !> Take lane i out: no force, so that a lane at u = v = 0 stays there.
   pure subroutine silence(self, i)
      class(lumped_lanes), intent(inout) :: self
      integer, intent(in) :: i

      self%inlet(i) = 0.0_wp
      self%outlet(i) = 0.0_wp
      self%squeeze(i) = 0.0_wp
      self%gap(i) = no_film_gap
      self%stiffness(i) = 0.0_wp
      self%damping(i) = 0.0_wp
      self%inverse_mass(i) = 0.0_wp
   end subroutine silence

end module rv_lumped
