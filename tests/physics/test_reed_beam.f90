!> The reed as a beam: its equation, the unit-load solution, the two limits of the hole, scaling laws.
program test_reed_beam
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_reed, only : reed_type, new_reed
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: density = 8950.0_wp, modulus = 110.0e9_wp
   real(wp), parameter :: width = 6.0e-3_wp, thickness = 0.15e-3_wp
   real(wp), parameter :: inertia = width*thickness**3/12.0_wp

   call test_beam_equation()
   call test_unit_load()
   call test_hole_everywhere()
   call test_hole_nowhere()
   call test_scaling()
   call suite%finish()

contains

   !> E I phi'''' is the load per tip displacement, k/(k_a D), over the hole and nothing elsewhere. The curvature is
   !> at most
   !> a parabola on each region, where second differences are exact.
   subroutine test_beam_equation()
      type(reed_type) :: reed
      real(wp), parameter :: middle(3) = [1.25e-3_wp, 4.5e-3_wp, 7.0e-3_wp], d = 0.45e-3_wp
      real(wp) :: load, fourth
      integer :: region

      reed = built(2.5e-3_wp, 4.0e-3_wp, 1.0e-3_wp, 0.91_wp)
      load = reed%stiffness/(0.91_wp*4.0e-3_wp)
      do region = 1, 3
         fourth = (reed%curvature(middle(region) + d) - 2.0_wp*reed%curvature(middle(region)) &
            & + reed%curvature(middle(region) - d))/d**2
         call suite%close("E I phi'''' at "//to_text(middle(region))//" m [N/m2]", modulus*inertia*fourth, &
            & merge(load, 0.0_wp, region == 2), rtol=1.0e-12_wp, atol=1.0e-12_wp*load)
      end do
   end subroutine test_beam_equation

   !> The deflection under a load at xi is x^2 (3 xi - x)/(6 E I) up to xi and xi^2 (3 x - xi)/(6 E I) beyond. Its
   !> integral over
   !> the hole gives shape and stiffness without Eq. (14): three Gauss points on each side of x are exact.
   subroutine test_unit_load()
      real(wp), parameter :: root(3) = [2.5e-3_wp, 9.0e-3_wp, 0.3e-3_wp]
      real(wp), parameter :: hole(3) = [4.0e-3_wp, 2.0e-3_wp, 5.9e-3_wp]
      real(wp), parameter :: tip(3) = [1.0e-3_wp, 5.0e-3_wp, 0.2e-3_wp]
      type(reed_type) :: reed
      real(wp) :: x, at_tip
      integer :: n, i

      do n = 1, 3
         reed = built(root(n), hole(n), tip(n), 0.8_wp)
         at_tip = deflection(reed%length, root(n), hole(n))
         call suite%close("k from unit loads, reed "//to_text(n)//" [N/m]", reed%stiffness, &
            & 0.8_wp*hole(n)*6.0_wp*modulus*inertia/at_tip, rtol=1.0e-12_wp, atol=0.0_wp)
         do i = 1, 10
            x = 0.1_wp*real(i, wp)*reed%length
            call suite%close("phi from unit loads, reed "//to_text(n)//", x/L = "//to_text(0.1_wp*real(i, wp), 2), &
               & reed%shape(x), deflection(x, root(n), hole(n))/at_tip, rtol=1.0e-12_wp, atol=0.0_wp)
         end do
      end do
   end subroutine test_unit_load

   !> Integral of the kernel over the hole [m4].
   real(wp) function deflection(x, root, hole) result(u)
      real(wp), intent(in) :: x, root, hole
      real(wp) :: knee

      knee = max(root, min(root + hole, x))
      u = gauss(x, root, knee) + gauss(x, knee, root + hole)
   end function deflection

   real(wp) function gauss(x, from, to) result(integral)
      real(wp), intent(in) :: x, from, to
      real(wp), parameter :: point(3) = [-sqrt(0.6_wp), 0.0_wp, sqrt(0.6_wp)]
      real(wp), parameter :: weight(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp
      real(wp) :: xi(3)

      xi = 0.5_wp*(from + to + (to - from)*point)
      integral = (to - from)*sum(weight*min(x, xi)**2*(3.0_wp*max(x, xi) - min(x, xi)))
   end function gauss

   !> Hole from clamp to tip: the cantilever under uniform load, k = 8 E I/L^3, phi = (6 r^2 - 4 r^3 + r^4)/3,
   !> integral of phi 2/5 L, of phi^2 104/405 L. Root and tip of 1e-7 L change none of them by more than twice that.
   subroutine test_hole_everywhere()
      type(reed_type) :: reed
      real(wp), parameter :: l = 5.0e-3_wp, rest = 1.0e-7_wp*l, limit = 2.0e-7_wp
      real(wp) :: r
      integer :: i

      reed = built(rest, l - 2.0_wp*rest, rest, 1.0_wp)
      call suite%close("uniform load: k [N/m]", reed%stiffness, 8.0_wp*modulus*inertia/l**3, rtol=limit, atol=0.0_wp)
      call suite%close("uniform load: integral of phi/L", reed%shape_integral/l, 0.4_wp, rtol=limit, atol=0.0_wp)
      call suite%close("uniform load: integral of phi^2/L", reed%shape2_integral/l, 104.0_wp/405.0_wp, &
         & rtol=limit, atol=0.0_wp)
      do i = 1, 4
         r = 0.25_wp*real(i, wp)
         call suite%close("uniform load: phi at x/L = "//to_text(r), reed%shape(r*l), &
            & (6.0_wp*r**2 - 4.0_wp*r**3 + r**4)/3.0_wp, rtol=limit, atol=0.0_wp)
      end do
   end subroutine test_hole_everywhere

   !> A pinhole at x_c: the point load, k = 6 E I/(x_c^2 (3 L - x_c)), phi of the unit-load formula. The difference is
   !> some (D/L)^2/10: a hole of 1e-4 L leaves 1e-9, one twice as wide four times that.
   subroutine test_hole_nowhere()
      type(reed_type) :: reed
      real(wp), parameter :: l = 8.0e-3_wp, xc = 5.0e-3_wp
      real(wp), parameter :: point_load = 6.0_wp*modulus*inertia/(xc**2*(3.0_wp*l - xc))
      real(wp) :: d, error(2)
      integer :: i

      do i = 1, 2
         d = 1.0e-2_wp*l*real(i, wp)
         reed = built(xc - 0.5_wp*d, d, l - xc - 0.5_wp*d, 1.0_wp)
         error(i) = reed%stiffness/point_load - 1.0_wp
      end do
      call suite%close("point load: order of the approach", log(error(2)/error(1))/log(2.0_wp), 2.0_wp, &
         & rtol=0.0_wp, atol=0.01_wp)
      d = 1.0e-4_wp*l
      reed = built(xc - 0.5_wp*d, d, l - xc - 0.5_wp*d, 1.0_wp)
      call suite%close("point load: k [N/m]", reed%stiffness, point_load, rtol=1.0e-8_wp, atol=0.0_wp)
      call suite%close("point load: phi halfway to the hole", reed%shape(0.5_wp*xc), &
         & 0.25_wp*2.5_wp*xc/(3.0_wp*l - xc), rtol=1.0e-8_wp, atol=0.0_wp)
      call suite%close("point load: phi beyond the hole", reed%shape(7.0e-3_wp), &
         & (3.0_wp*7.0e-3_wp - xc)/(3.0_wp*l - xc), rtol=1.0e-8_wp, atol=0.0_wp)
   end subroutine test_hole_nowhere

   !> k ~ E B h^3 k_a, m ~ rho B h, and with all lengths times s: k ~ s, m ~ s^3, phi unchanged.
   subroutine test_scaling()
      type(reed_type) :: base, reed
      type(error_type), allocatable :: error
      real(wp), parameter :: a = 2.5e-3_wp, hole = 4.0e-3_wp, b = 1.0e-3_wp, s = 3.0_wp

      base = built(a, hole, b, 1.0_wp)
      call new_reed(reed, a, hole, b, width, s*thickness, density, modulus, 1.0_wp, error)
      call compare("thickness", reed, base, s**3, s)
      call new_reed(reed, a, hole, b, s*width, thickness, density, modulus, 1.0_wp, error)
      call compare("width", reed, base, s, s)
      call new_reed(reed, a, hole, b, width, thickness, s*density, modulus, 1.0_wp, error)
      call compare("density", reed, base, 1.0_wp, s)
      call new_reed(reed, a, hole, b, width, thickness, density, s*modulus, 1.0_wp, error)
      call compare("Young's modulus", reed, base, s, 1.0_wp)
      call new_reed(reed, a, hole, b, width, thickness, density, modulus, s, error)
      call compare("k_a", reed, base, s, 1.0_wp)
      call new_reed(reed, s*a, s*hole, s*b, s*width, s*thickness, density, modulus, 1.0_wp, error)
      call compare("every length", reed, base, s, s**3)
      call suite%close("every length: phi(x_c)", reed%shape(s*4.5e-3_wp), base%shape(4.5e-3_wp), rtol=1.0e-14_wp, &
         & atol=0.0_wp)
      call suite%close("every length: slope(x_c)", s*reed%slope(s*4.5e-3_wp), base%slope(4.5e-3_wp), &
         & rtol=1.0e-14_wp, atol=0.0_wp)
      call suite%close("every length: curvature(x_c)", s**2*reed%curvature(s*4.5e-3_wp), base%curvature(4.5e-3_wp), &
         & rtol=1.0e-13_wp, atol=0.0_wp)
      call suite%close("every length: integral of phi", reed%shape_integral, s*base%shape_integral, &
         & rtol=1.0e-14_wp, atol=0.0_wp)
   end subroutine test_scaling

   subroutine compare(what, reed, base, stiffness_ratio, mass_ratio)
      character(len=*), intent(in) :: what
      type(reed_type), intent(in) :: reed, base
      real(wp), intent(in) :: stiffness_ratio, mass_ratio

      call suite%close("three times the "//what//": k ratio", reed%stiffness/base%stiffness, stiffness_ratio, &
         & rtol=1.0e-14_wp, atol=0.0_wp)
      call suite%close("three times the "//what//": mass ratio", reed%mass/base%mass, mass_ratio, &
         & rtol=1.0e-14_wp, atol=0.0_wp)
   end subroutine compare

   function built(root, hole, tip, k_a) result(reed)
      real(wp), intent(in) :: root, hole, tip, k_a
      type(reed_type) :: reed
      type(error_type), allocatable :: error

      call new_reed(reed, root, hole, tip, width, thickness, density, modulus, k_a, error)
      call suite%no_error("a valid reed", error)
   end function built

end program test_reed_beam
