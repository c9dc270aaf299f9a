!> Crossings of many lanes: the roots that first_root finds for each quintic alone, at ends, beside turns, in any company.
program test_crossing
   use rv_kinds, only : wp
   use rv_crossing, only : crossings
   use rv_dense, only : first_root, quintic
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   integer, parameter :: n = 1000
   real(wp), parameter :: eps = epsilon(1.0_wp), h = 3.0e-5_wp

   call many_at_once()
   call at_the_ends()
   call suite%finish()

contains

   !> Rising and falling steps with slopes of one sign and any curvature that keeps them monotone enough to have one root.
   subroutine many_at_once()
      real(wp), dimension(n) :: level, u0, v0, a0, u1, v1, a1, s, alone
      real(wp) :: c(0:5), r(6)
      integer :: i

      do i = 1, n
         r = modulo(real(i, wp)*[0.6180339887498949_wp, 0.4142135623730951_wp, 0.7320508075688772_wp, 0.2360679774997898_wp, &
            & 0.6457513110645906_wp, 0.3166247903553998_wp], 1.0_wp)
         u0(i) = 1.0e-4_wp*(r(1) - 0.5_wp)
         u1(i) = u0(i) + sign(1.0e-5_wp*(0.1_wp + r(2)), r(3) - 0.5_wp)
         v0(i) = (u1(i) - u0(i))/h*(0.2_wp + 1.6_wp*r(4))
         v1(i) = (u1(i) - u0(i))/h*(0.2_wp + 1.6_wp*r(5))
         a0(i) = (v1(i) - v0(i))/h*2.0_wp*r(6)
         a1(i) = (v1(i) - v0(i))/h*2.0_wp*(1.0_wp - r(6))
         level(i) = u0(i) + r(3)*(u1(i) - u0(i))
         call quintic(h, u0(i), v0(i), a0(i), u1(i), v1(i), a1(i), c)
         c(0) = c(0) - level(i)
         alone(i) = first_root(c, 0.0_wp, 1.0_wp)
      end do
      call crossings(n, h, level, u0, v0, a0, u1, v1, a1, s)
      call suite%close("distance to the roots found alone", maxval(abs(s - alone)), 0.0_wp, 0.0_wp, 256.0_wp*eps)
      call suite%true("all lie in the step", all(s >= 0.0_wp) .and. all(s <= 1.0_wp))
      call crossings(1, h, level(7:7), u0(7:7), v0(7:7), a0(7:7), u1(7:7), v1(7:7), a1(7:7), alone(7:7))
      call suite%close("one by itself", alone(7), s(7), 0.0_wp, 16.0_wp*eps)
   end subroutine many_at_once

   !> A level at the very end, slopes that vanish there, a straight line.
   subroutine at_the_ends()
      real(wp), parameter :: zero = 0.0_wp, one = 1.0_wp
      real(wp) :: s(4)

      ! u = s at level 1; u = s^2 at 1/4; u = 1 - (1 - s)^2 at 1; u = s at 0.3
      call crossings(4, one, [one, 0.25_wp, one, 0.3_wp], [zero, zero, zero, zero], [one, zero, 2.0_wp, one], &
         & [zero, 2.0_wp, -2.0_wp, zero], [one, one, one, one], [one, 2.0_wp, zero, one], [zero, 2.0_wp, -2.0_wp, zero], s)
      call suite%close("a line at its end", s(1), 1.0_wp, 0.0_wp, 4.0_wp*eps)
      call suite%close("from rest", s(2), 0.5_wp, 0.0_wp, 8.0_wp*eps)
      call suite%close("a level that is the turn: a double root", s(3), 1.0_wp, 0.0_wp, 4.0_wp*sqrt(eps))
      call suite%close("a line", s(4), 0.3_wp, 0.0_wp, 4.0_wp*eps)
   end subroutine at_the_ends

end program test_crossing
