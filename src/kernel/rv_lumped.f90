!> The lumped valve models: one degree of freedom, with or without squeeze force.
!>
!> (m_e + m_a) u'' + (c_a + C/h^3) u' + k u = (p_in - p_out) A,  h = u + g0,   Eqs. (15), (22), (26),
!>
!> where the film term C u'/h^3 of the squeeze model acts while closing only (u' < 0, the paper's
!> switch; the force is zero at the switch, its slope jumps) or both ways; the traditional model of
!> Eq. (27) has C = 0. The cases of a group are lanes: structure of arrays, one entry a case.
module rv_lumped
   use rv_kinds, only : wp, i8
   use rv_largest, only : largest
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
      real(wp), allocatable, private :: mass(:)           !! m_e + m_a [kg]
      real(wp), allocatable, private :: area(:)           !! A over the mass [m2 kg-1]
      real(wp), allocatable, private :: push_in(:)        !! inlet amplitude times A over the mass [m s-2]
      real(wp), allocatable, private :: push_out(:)       !! outlet amplitude times A over the mass [m s-2]
      real(wp), allocatable, private :: stiffness(:)      !! k over the mass [s-2]
      real(wp), allocatable, private :: damping(:)        !! c_a over the mass [s-1]
      real(wp), allocatable, private :: squeeze(:)        !! C over the mass [m3 s-1]
      real(wp), allocatable, private :: fastest(:)        !! velocity above which the film does not act [m s-1]
   contains
      procedure :: acceleration
      procedure :: linearise
      procedure :: correction
      procedure :: stiffness_ratio
      procedure :: decay
      procedure :: fastest_decay
      procedure :: film_force
      procedure :: film_forces
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
      self%mass = valve%mass
      self%area = valve%area/valve%mass
      self%push_in = valve%inlet*self%area
      self%push_out = valve%outlet*self%area
      self%stiffness = valve%stiffness/valve%mass
      self%damping = valve%damping/valve%mass
      self%squeeze = valve%squeeze/valve%mass
      self%fastest = merge(huge(1.0_wp), 0.0_wp, valve%both_ways)
   end subroutine new_lumped_lanes

   !> Right-hand side v' [m s-2].
   subroutine acceleration(self, first, last, inlet, outlet, q, v, a, closed)
      class(lumped_lanes), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet                !! factors of the pressure history
      real(wp), intent(in) :: q(first:last, self%dofs)     !! tip displacement u [m]
      real(wp), intent(in) :: v(first:last, self%dofs)     !! tip velocity [m s-1]
      real(wp), intent(out) :: a(first:last, self%dofs)    !! [m s-2]
      integer, intent(out) :: closed
      logical :: some

      call accelerate(last - first + 1, inlet, outlet, self%push_in(first:last), self%push_out(first:last), &
         & self%stiffness(first:last), self%damping(first:last), self%squeeze(first:last), self%gap(first:last), &
         & self%fastest(first:last), q, v, a, some)
      closed = 0
      if (some) closed = first - 1 + first_closed(q(:, 1), self%gap(first:last))
   end subroutine acceleration

   !> Right-hand side and its derivatives. At the switch v = 0 the closing side's slope is taken.
   subroutine linearise(self, first, last, inlet, outlet, q, v, a, a_q, a_v, closed)
      class(lumped_lanes), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(first:last, self%dofs)
      real(wp), intent(in) :: v(first:last, self%dofs)
      real(wp), intent(out) :: a(first:last, self%dofs)
      real(wp), intent(out) :: a_q(first:last, self%dofs, self%dofs)   !! da/du [s-2]
      real(wp), intent(out) :: a_v(first:last, self%dofs, self%dofs)   !! da/dv [s-1]
      integer, intent(out) :: closed
      logical :: some

      call slopes(last - first + 1, inlet, outlet, self%push_in(first:last), self%push_out(first:last), &
         & self%stiffness(first:last), self%damping(first:last), self%squeeze(first:last), self%gap(first:last), &
         & self%fastest(first:last), q, v, a, a_q, a_v, some)
      closed = 0
      if (some) closed = first - 1 + first_closed(q(:, 1), self%gap(first:last))
   end subroutine linearise

   !> The base type's correction, all in one loop.
   subroutine correction(self, first, last, inlet, outlet, gamma, base_q, base_v, v, dv, film, closed)
      class(lumped_lanes), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet, gamma
      real(wp), dimension(first:last), intent(in) :: base_q, base_v, v
      real(wp), dimension(first:last), intent(out) :: dv, film
      integer, intent(out) :: closed
      logical :: some

      call correct(last - first + 1, inlet, outlet, gamma, self%push_in(first:last), self%push_out(first:last), &
         & self%stiffness(first:last), self%damping(first:last), self%squeeze(first:last), self%gap(first:last), &
         & self%fastest(first:last), base_q, base_v, v, dv, film, some)
      closed = 0
      if (some) closed = first - 1 + first_closed(film, 0.0_wp*film)
   end subroutine correction

   !> Newton's correction of n lanes as plain arrays; residual and slope are multiplied with h^4, which saves a division.
   pure subroutine correct(n, inlet, outlet, gamma, push_in, push_out, stiffness, damping, squeeze, gap, fastest, &
      & base_q, base_v, v, dv, film, closed)
      integer, intent(in) :: n
      real(wp), intent(in) :: inlet, outlet, gamma
      real(wp), dimension(n), intent(in) :: push_in, push_out, stiffness, damping, squeeze, gap, fastest
      real(wp), dimension(n), intent(in) :: base_q, base_v, v
      real(wp), dimension(n), intent(out) :: dv, film
      logical, intent(out) :: closed
      real(wp) :: q, h, h4, c, free, slope
      integer(i8) :: some
      integer :: i

      some = 0_i8
      do i = 1, n
         q = base_q(i) + gamma*v(i)
         h = q + gap(i)
         h4 = (h*h)*(h*h)
         c = gamma*merge(squeeze(i), 0.0_wp, v(i) <= fastest(i))
         free = v(i) - base_v(i) - gamma*(push_in(i)*inlet - push_out(i)*outlet - stiffness(i)*q - damping(i)*v(i))
         slope = 1.0_wp + gamma*(damping(i) + gamma*stiffness(i))
         dv(i) = -(free*h4 + c*v(i)*h)/(slope*h4 + c*(h - 3.0_wp*gamma*v(i)))
         film(i) = h
         some = ior(some, merge(0_i8, 1_i8, h > 0.0_wp))
      end do
      closed = some > 0_i8
   end subroutine correct

   !> The accelerations of n lanes as plain arrays, which the compiler turns into vector code. `closed`: some film is.
   pure subroutine accelerate(n, inlet, outlet, push_in, push_out, stiffness, damping, squeeze, gap, fastest, q, v, a, closed)
      integer, intent(in) :: n
      real(wp), intent(in) :: inlet, outlet
      real(wp), dimension(n), intent(in) :: push_in, push_out, stiffness, damping, squeeze, gap, fastest, q, v
      real(wp), intent(out) :: a(n)
      logical, intent(out) :: closed
      real(wp) :: h
      integer(i8) :: some
      integer :: i

      some = 0_i8
      do i = 1, n
         h = q(i) + gap(i)
         a(i) = push_in(i)*inlet - push_out(i)*outlet - stiffness(i)*q(i) - damping(i)*v(i) &
            & - squeeze(i)*min(v(i), fastest(i))/(h*h*h)
         some = ior(some, merge(0_i8, 1_i8, h > 0.0_wp))
      end do
      closed = some > 0_i8
   end subroutine accelerate

   !> accelerate with derivatives.
   pure subroutine slopes(n, inlet, outlet, push_in, push_out, stiffness, damping, squeeze, gap, fastest, q, v, &
      & a, a_q, a_v, closed)
      integer, intent(in) :: n
      real(wp), intent(in) :: inlet, outlet
      real(wp), dimension(n), intent(in) :: push_in, push_out, stiffness, damping, squeeze, gap, fastest, q, v
      real(wp), dimension(n), intent(out) :: a, a_q, a_v
      logical, intent(out) :: closed
      real(wp) :: h, per_h, film
      integer(i8) :: some
      integer :: i

      some = 0_i8
      do i = 1, n
         h = q(i) + gap(i)
         per_h = 1.0_wp/h
         film = merge(squeeze(i), 0.0_wp, v(i) <= fastest(i))*(per_h*per_h*per_h)
         a(i) = push_in(i)*inlet - push_out(i)*outlet - stiffness(i)*q(i) - (damping(i) + film)*v(i)
         a_q(i) = 3.0_wp*film*v(i)*per_h - stiffness(i)
         a_v(i) = -(damping(i) + film)
         some = ior(some, merge(0_i8, 1_i8, h > 0.0_wp))
      end do
      closed = some > 0_i8
   end subroutine slopes

   pure function stiffness_ratio(self) result(ratio)
      class(lumped_lanes), intent(in) :: self
      real(wp) :: ratio(self%width)

      ratio = (self%damping + self%squeeze/self%gap**3)/sqrt(self%stiffness)
   end function stiffness_ratio

   pure real(wp) function decay(self, lane, q)
      class(lumped_lanes), intent(in) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: q(self%dofs)

      decay = self%damping(lane) + self%squeeze(lane)/(q(1) + self%gap(lane))**3
   end function decay

   pure real(wp) function fastest_decay(self, q, v)
      class(lumped_lanes), intent(in) :: self
      real(wp), intent(in), dimension(self%width, self%dofs) :: q, v
      real(wp) :: rate(self%width)

      call decays(self%width, self%damping, self%squeeze, self%gap, self%fastest, q, v, rate)
      fastest_decay = largest(rate)
   end function fastest_decay

   pure subroutine decays(n, damping, squeeze, gap, fastest, q, v, rate)
      integer, intent(in) :: n
      real(wp), dimension(n), intent(in) :: damping, squeeze, gap, fastest, q, v
      real(wp), intent(out) :: rate(n)
      real(wp) :: h
      integer :: i

      do i = 1, n
         h = q(i) + gap(i)
         rate(i) = max(0.0_wp, damping(i) + merge(squeeze(i), 0.0_wp, v(i) <= fastest(i))/(h*h*h))
      end do
   end subroutine decays

   !> -F_s of Eq. (26) [N] and its rate.
   subroutine film_force(self, lane, inlet, outlet, q, v, a, force, rate)
      class(lumped_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs), a(self%dofs)
      real(wp), intent(out) :: force, rate

      associate (unused => [inlet, outlet])
      end associate
      call resist(self%mass(lane)*self%squeeze(lane), self%fastest(lane), q(1) + self%gap(lane), v(1), a(1), force, rate)
   end subroutine film_force

   subroutine film_forces(self, inlet, outlet, q, v, a, force, rate)
      class(lumped_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in), dimension(self%width, self%dofs) :: q, v, a
      real(wp), intent(out), dimension(self%width) :: force, rate

      associate (unused => [inlet, outlet])
      end associate
      call resist(self%mass*self%squeeze, self%fastest, q(:, 1) + self%gap, v(:, 1), a(:, 1), force, rate)
   end subroutine film_forces

   elemental subroutine resist(squeeze, fastest, h, v, a, force, rate)
      real(wp), intent(in) :: squeeze   !! C [N s m2]
      real(wp), intent(in) :: fastest   !! velocity above which the film does not act [m s-1]
      real(wp), intent(in) :: h, v, a   !! u + g0 [m], u' [m s-1], u'' [m s-2]
      real(wp), intent(out) :: force, rate
      real(wp) :: film, per_h

      per_h = 1.0_wp/h
      film = merge(squeeze, 0.0_wp, v <= fastest)*(per_h*per_h*per_h)
      force = -film*v
      rate = -film*(a - 3.0_wp*v*v*per_h)
   end subroutine resist

   !> u = (p_in - p_out) A/k [m].
   subroutine equilibrium(self, inlet, outlet, q, found)
      class(lumped_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(out) :: q(self%width, self%dofs)
      logical, intent(out) :: found(self%width)

      q(:, 1) = (self%push_in*inlet - self%push_out*outlet)/self%stiffness
      found = q(:, 1) + self%gap > 0.0_wp
   end subroutine equilibrium

   !> The static displacement, for a squeeze film at most ten gaps (its force follows (u + g0)^-3),
   !> and that length times the natural frequency.
   subroutine scales(self, span, q_scale, v_scale)
      class(lumped_lanes), intent(in) :: self
      real(wp), intent(in) :: span(self%width)
      real(wp), intent(out) :: q_scale(self%width, self%dofs)
      real(wp), intent(out) :: v_scale(self%width, self%dofs)

      q_scale(:, 1) = min(span*self%area/self%stiffness, self%gap/3.0_wp)
      where (.not. q_scale(:, 1) > 0.0_wp) q_scale(:, 1) = 1.0e-3_wp*min(self%gap, 1.0e-3_wp)
      v_scale(:, 1) = q_scale(:, 1)*sqrt(self%stiffness)
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
      self%push_in(lane) = 0.0_wp
      self%push_out(lane) = 0.0_wp
   end subroutine silence

   pure integer function first_closed(u, gap) result(lane)
      real(wp), intent(in) :: u(:), gap(:)

      do lane = 1, size(u)
         if (.not. u(lane) + gap(lane) > 0.0_wp) return
      end do
      lane = 0
   end function first_closed

end module rv_lumped
