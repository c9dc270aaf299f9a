!> The cantilever reed as one degree of freedom: deflection shape, stiffness and mass.
!>
!> Zhang et al., Eqs. (1) to (18): a beam clamped at x = 0, loaded over a < x < S = a + D
!> (the valve hole), free to its tip x = L = S + b. The state is the tip displacement u(L).
!> Euler-Bernoulli beam, small slopes; the width is taken as constant over the length.
module rv_reed
   use rv_kinds, only : wp
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_text, only : to_text
   implicit none
   private
   public :: reed_type, new_reed

   !> One reed; build it with new_reed.
   type :: reed_type
      real(wp) :: length = 0.0_wp         !! L, clamp to tip [m]
      real(wp) :: width = 0.0_wp          !! B [m]
      real(wp) :: thickness = 0.0_wp      !! h [m]
      real(wp) :: stiffness = 0.0_wp      !! k of Eq. (18): uniform load over the hole per tip displacement [N/m]
      real(wp) :: mass = 0.0_wp           !! m_e of Eq. (16) [kg]
      real(wp) :: shape_integral = 0.0_wp   !! integral of phi dx over 0 to L [m]
      real(wp) :: shape2_integral = 0.0_wp  !! integral of phi**2 dx over 0 to L [m]
      real(wp), private :: bounds(0:3) = 0.0_wp     !! 0, a/L, S/L, 1 [-]
      real(wp), private :: coefficient(0:4, 3) = 0.0_wp  !! phi in powers of x/L on the three regions [-]
   contains
      procedure :: shape => shape_at
      procedure :: slope => slope_at
      procedure :: curvature => curvature_at
   end type reed_type

contains

   !> Check the data and build a reed. On failure `self` is a default reed.
   subroutine new_reed(self, root, hole_diameter, tip, width, thickness, density, youngs_modulus, k_a, error)
      type(reed_type), intent(out) :: self
      real(wp), intent(in) :: root            !! a, clamp to the edge of the hole [m], > 0
      real(wp), intent(in) :: hole_diameter   !! D [m], 0 < D <= width
      real(wp), intent(in) :: tip             !! b, edge of the hole to the tip [m], > 0
      real(wp), intent(in) :: width           !! B [m], > 0
      real(wp), intent(in) :: thickness       !! h [m], > 0
      real(wp), intent(in) :: density         !! [kg m-3], > 0
      real(wp), intent(in) :: youngs_modulus  !! E [Pa], > 0
      real(wp), intent(in) :: k_a             !! factor on the stiffness for the rounded planform, Eq. (18) [-], > 0
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: a, s, b, q, inertia

      if (.not. (root > 0.0_wp .and. hole_diameter > 0.0_wp .and. tip > 0.0_wp .and. width > 0.0_wp &
         & .and. thickness > 0.0_wp .and. density > 0.0_wp .and. youngs_modulus > 0.0_wp .and. k_a > 0.0_wp)) then
         call fail(error, rv_bad_input, "the reed's lengths, density, Young's modulus and k_a must all be > 0")
         return
      end if
      if (hole_diameter > width) then
         call fail(error, rv_bad_input, "the hole (diameter "//to_text(1.0e3_wp*hole_diameter, 6)// &
            & " mm) is wider than the reed ("//to_text(1.0e3_wp*width, 6)//" mm)")
         return
      end if

      self%length = root + hole_diameter + tip
      self%width = width
      self%thickness = thickness
      a = root/self%length
      s = (root + hole_diameter)/self%length
      b = tip/self%length
      q = 3.0_wp*s**4 + 4.0_wp*b*s**3 - 4.0_wp*a**3*s - 4.0_wp*a**3*b + a**4
      self%bounds = [0.0_wp, a, s, 1.0_wp]
      self%coefficient(:, 1) = 2.0_wp*(s - a)*[0.0_wp, 0.0_wp, 3.0_wp*(a + s), -2.0_wp, 0.0_wp]/q
      self%coefficient(:, 2) = [a**4, -4.0_wp*a**3, 6.0_wp*s**2, -4.0_wp*s, 1.0_wp]/q
      self%coefficient(:, 3) = [a**4 - s**4, 4.0_wp*(s**3 - a**3), 0.0_wp, 0.0_wp, 0.0_wp]/q

      self%shape_integral = self%length*shape_moment(self, 1)
      self%shape2_integral = self%length*shape_moment(self, 2)
      inertia = width*thickness**3/12.0_wp
      self%stiffness = k_a*24.0_wp*youngs_modulus*inertia*hole_diameter/(q*self%length**4)
      self%mass = density*width*thickness*self%shape2_integral
   end subroutine new_reed

   !> Deflection phi(x) = u(x)/u(L), Eq. (14); phi(0) = 0, phi(L) = 1. Outside 0..L the end pieces go on.
   elemental function shape_at(self, x) result(phi)
      class(reed_type), intent(in) :: self
      real(wp), intent(in) :: x   !! distance from the clamp [m]
      real(wp) :: phi             !! [-]
      real(wp) :: c(0:4), r

      r = x/self%length
      c = self%coefficient(:, region(self, r))
      phi = c(0) + r*(c(1) + r*(c(2) + r*(c(3) + r*c(4))))
   end function shape_at

   !> Slope d(phi)/dx, Eq. (12) in region II.
   elemental function slope_at(self, x) result(slope)
      class(reed_type), intent(in) :: self
      real(wp), intent(in) :: x   !! distance from the clamp [m]
      real(wp) :: slope           !! [m-1]
      real(wp) :: c(0:4), r

      r = x/self%length
      c = self%coefficient(:, region(self, r))
      slope = (c(1) + r*(2.0_wp*c(2) + r*(3.0_wp*c(3) + r*4.0_wp*c(4))))/self%length
   end function slope_at

   !> Curvature d2(phi)/dx2 = M/(E I u(L)), Eq. (10). It and its slope are continuous; E I times its second derivative
   !> is the load, which jumps at the edges of the hole.
   elemental function curvature_at(self, x) result(curvature)
      class(reed_type), intent(in) :: self
      real(wp), intent(in) :: x   !! distance from the clamp [m]
      real(wp) :: curvature       !! [m-2]
      real(wp) :: c(0:4), r

      r = x/self%length
      c = self%coefficient(:, region(self, r))
      curvature = (2.0_wp*c(2) + r*(6.0_wp*c(3) + r*12.0_wp*c(4)))/self%length**2
   end function curvature_at

   pure integer function region(self, r)
      type(reed_type), intent(in) :: self
      real(wp), intent(in) :: r

      region = 1
      if (r > self%bounds(1)) region = 2
      if (r > self%bounds(2)) region = 3
   end function region

   !> Integral of phi**power over x/L from 0 to 1, in closed form: phi is a polynomial on each region.
   pure real(wp) function shape_moment(self, power) result(moment)
      type(reed_type), intent(in) :: self
      integer, intent(in) :: power   !! 1 or 2
      real(wp) :: lo, hi, weight
      real(wp) :: other(0:4)
      integer :: i, j, piece, n

      moment = 0.0_wp
      do piece = 1, 3
         lo = self%bounds(piece - 1)
         hi = self%bounds(piece)
         other = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
         if (power == 2) other = self%coefficient(:, piece)
         do i = 0, 4
            do j = 0, 4
               weight = self%coefficient(i, piece)*other(j)
               n = i + j + 1
               moment = moment + weight*(hi**n - lo**n)/real(n, wp)
            end do
         end do
      end do
   end function shape_moment

end module rv_reed
