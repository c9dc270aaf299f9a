!> The reed: the paper's numbers, continuity of the shape, closed integrals against quadrature, refused data.
program test_reed
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_error, only : error_type, rv_bad_input
   use rv_reed, only : reed_type, new_reed
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   !> a, D, b, B, h [m], rho [kg m-3], E [Pa], k_a [-] of Table II
   real(wp), parameter :: paper(8) = [2.5e-3_wp, 4.0e-3_wp, 1.0e-3_wp, 6.0e-3_wp, 0.15e-3_wp, &
      & 8950.0_wp, 110.0e9_wp, 0.91_wp]
   !> A long root, a short hole, a long tip.
   real(wp), parameter :: other(8) = [9.0e-3_wp, 2.0e-3_wp, 5.0e-3_wp, 3.0e-3_wp, 0.4e-3_wp, &
      & 7850.0_wp, 205.0e9_wp, 1.0_wp]

   call test_published()
   call test_ends_and_joints("paper's reed", paper)
   call test_ends_and_joints("other reed", other)
   call test_derivatives("paper's reed", paper)
   call test_derivatives("other reed", other)
   call test_integrals("paper's reed", paper)
   call test_integrals("other reed", other)
   call test_refused_data()
   call suite%finish()

contains

   !> Limits: half a unit of the last digit given.
   subroutine test_published()
      type(reed_type) :: reed

      reed = built(paper)
      call suite%close("length [m]", reed%length, 7.5e-3_wp, rtol=4.0_wp*epsilon(1.0_wp), atol=0.0_wp)
      call suite%close("width [m]", reed%width, 6.0e-3_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("thickness [m]", reed%thickness, 0.15e-3_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("phi(x_c)", reed%shape(4.5e-3_wp), 0.486720_wp, rtol=0.0_wp, atol=0.5e-6_wp)
      call suite%close("phi(S)", reed%shape(6.5e-3_wp), 0.828021_wp, rtol=0.0_wp, atol=0.5e-6_wp)
      call suite%close("integral of phi/L", reed%shape_integral/reed%length, 0.406010_wp, rtol=0.0_wp, atol=0.5e-6_wp)
      call suite%close("integral of phi^2/L", reed%shape2_integral/reed%length, 0.262533_wp, &
         & rtol=0.0_wp, atol=0.5e-6_wp)
      call suite%close("stiffness [N/m]", reed%stiffness, 2691.932_wp, rtol=0.0_wp, atol=0.5e-3_wp)
      call suite%close("equivalent mass [kg]", reed%mass, 1.586025e-5_wp, rtol=0.0_wp, atol=0.5e-11_wp)
   end subroutine test_published

   !> Clamp, tip and the joints at a and S: value, slope and curvature from both sides differ by rounding
   !> and by the distance (1e-13 L) only.
   subroutine test_ends_and_joints(name, data)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: data(8)
      type(reed_type) :: reed
      real(wp), parameter :: limit = 2.0e-12_wp
      real(wp) :: l, x, d
      integer :: joint

      reed = built(data)
      l = reed%length
      d = 1.0e-13_wp*l
      call suite%close(name//": phi(0)", reed%shape(0.0_wp), 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close(name//": slope(0) L", reed%slope(0.0_wp)*l, 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close(name//": phi(L)", reed%shape(l), 1.0_wp, rtol=1.0e-14_wp, atol=0.0_wp)
      call suite%close(name//": curvature(L) L^2", reed%curvature(l)*l**2, 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      do joint = 1, 2
         x = data(1) + merge(0.0_wp, data(2), joint == 1)
         call suite%close(name//": phi either side of x = "//to_text(x, 6), reed%shape(x + d), reed%shape(x - d), &
            & rtol=0.0_wp, atol=limit)
         call suite%close(name//": slope L either side of x = "//to_text(x, 6), reed%slope(x + d)*l, &
            & reed%slope(x - d)*l, rtol=0.0_wp, atol=limit)
         call suite%close(name//": curvature L^2 either side of x = "//to_text(x, 6), reed%curvature(x + d)*l**2, &
            & reed%curvature(x - d)*l**2, rtol=0.0_wp, atol=limit)
      end do
   end subroutine test_ends_and_joints

   !> Slope and curvature are the derivatives of shape and slope. Five-point differences are exact for a polynomial of
   !> fourth degree, so within a region only rounding remains: some epsilon times L over the step of 1e-2 L.
   subroutine test_derivatives(name, data)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: data(8)
      type(reed_type) :: reed
      real(wp), parameter :: limit = 2.0e-13_wp
      real(wp) :: middle(3), x, d
      integer :: region

      reed = built(data)
      d = 1.0e-2_wp*reed%length
      middle = [0.5_wp*data(1), data(1) + 0.5_wp*data(2), data(1) + data(2) + 0.5_wp*data(3)]
      do region = 1, 3
         x = middle(region)
         call suite%close(name//": slope L at x = "//to_text(x, 6), reed%slope(x)*reed%length, &
            & difference(reed%shape(x + d*[-2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp]), d)*reed%length, &
            & rtol=0.0_wp, atol=limit)
         call suite%close(name//": curvature L^2 at x = "//to_text(x, 6), reed%curvature(x)*reed%length**2, &
            & difference(reed%slope(x + d*[-2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp]), d)*reed%length**2, &
            & rtol=0.0_wp, atol=limit)
      end do
   end subroutine test_derivatives

   real(wp) function difference(f, d)
      real(wp), intent(in) :: f(4)   !! values at -2 d, -d, d, 2 d
      real(wp), intent(in) :: d

      difference = (8.0_wp*(f(3) - f(2)) - f(4) + f(1))/(12.0_wp*d)
   end function difference

   !> Five Gauss points are exact for phi^2, a polynomial of eighth degree on each region.
   subroutine test_integrals(name, data)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: data(8)
      type(reed_type) :: reed
      real(wp), parameter :: near = sqrt(5.0_wp - 2.0_wp*sqrt(10.0_wp/7.0_wp))/3.0_wp
      real(wp), parameter :: far = sqrt(5.0_wp + 2.0_wp*sqrt(10.0_wp/7.0_wp))/3.0_wp
      real(wp), parameter :: w_near = (322.0_wp + 13.0_wp*sqrt(70.0_wp))/900.0_wp
      real(wp), parameter :: w_far = (322.0_wp - 13.0_wp*sqrt(70.0_wp))/900.0_wp
      real(wp), parameter :: point(5) = [-far, -near, 0.0_wp, near, far]
      real(wp), parameter :: weight(5) = [w_far, w_near, 128.0_wp/225.0_wp, w_near, w_far]
      real(wp) :: first, second, bounds(4), phi(5)
      integer :: region

      reed = built(data)
      bounds = [0.0_wp, data(1), data(1) + data(2), reed%length]
      first = 0.0_wp
      second = 0.0_wp
      do region = 1, 3
         phi = reed%shape(0.5_wp*(bounds(region) + bounds(region + 1) + (bounds(region + 1) - bounds(region))*point))
         first = first + 0.5_wp*(bounds(region + 1) - bounds(region))*sum(weight*phi)
         second = second + 0.5_wp*(bounds(region + 1) - bounds(region))*sum(weight*phi**2)
      end do
      call suite%close(name//": integral of phi [m]", reed%shape_integral, first, rtol=1.0e-13_wp, atol=0.0_wp)
      call suite%close(name//": integral of phi^2 [m]", reed%shape2_integral, second, rtol=1.0e-13_wp, atol=0.0_wp)
      call suite%close(name//": mass [kg]", reed%mass, data(6)*data(4)*data(5)*second, rtol=1.0e-13_wp, atol=0.0_wp)
   end subroutine test_integrals

   !> Each value in turn zero, negative and not a number; a hole wider than the reed.
   subroutine test_refused_data()
      real(wp) :: bad(3), data(8)
      integer :: i, j

      bad = [0.0_wp, -1.0_wp, ieee_value(1.0_wp, ieee_quiet_nan)]
      do i = 1, 8
         do j = 1, 3
            data = paper
            data(i) = bad(j)
            call refused("value "//to_text(i)//" = "//to_text(bad(j)), data, "must all be > 0")
         end do
      end do
      data = paper
      data(2) = 6.5e-3_wp
      call refused("hole of 6.5 mm in a reed of 6 mm", data, "(diameter 6.5 mm) is wider than the reed (6 mm)")
      data(2) = data(4)
      call suite%true("a hole as wide as the reed is allowed", allocated_stiffness(data) > 0.0_wp)
   end subroutine test_refused_data

   subroutine refused(what, data, part)
      character(len=*), intent(in) :: what
      real(wp), intent(in) :: data(8)
      character(len=*), intent(in) :: part
      type(reed_type) :: reed
      type(error_type), allocatable :: error

      call make(reed, data, error)
      call suite%fails(what, error, part)
      if (allocated(error)) call suite%equal(what//": code", error%code, rv_bad_input)
      call suite%true(what//": a default reed is left", &
         & abs(reed%length) + abs(reed%stiffness) + abs(reed%mass) <= 0.0_wp)
   end subroutine refused

   real(wp) function allocated_stiffness(data) result(stiffness)
      real(wp), intent(in) :: data(8)
      type(reed_type) :: reed

      reed = built(data)
      stiffness = reed%stiffness
   end function allocated_stiffness

   function built(data) result(reed)
      real(wp), intent(in) :: data(8)
      type(reed_type) :: reed
      type(error_type), allocatable :: error

      call make(reed, data, error)
      if (allocated(error)) call suite%no_error("a valid reed", error)
   end function built

   subroutine make(reed, data, error)
      type(reed_type), intent(out) :: reed
      real(wp), intent(in) :: data(8)
      type(error_type), allocatable, intent(out) :: error

      call new_reed(reed, data(1), data(2), data(3), data(4), data(5), data(6), data(7), data(8), error)
   end subroutine make

end program test_reed
