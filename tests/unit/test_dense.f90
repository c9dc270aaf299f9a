!> Dense output: exact for polynomials of degree five, of order six else; roots to rounding wherever they lie.
program test_dense
   use rv_kinds, only : wp
   use rv_dense, only : quintic, value_at, derivative, first_root
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: eps = epsilon(1.0_wp)

   call polynomials()
   call reproduces_degree_five()
   call order_six()
   call roots_anywhere()
   call roots_apart()
   call roots_at_ends()
   call flat_roots()
   call hard_starts()
   call scale_and_sign()
   call suite%finish()

contains

   subroutine polynomials()
      real(wp), parameter :: c(0:3) = [2.0_wp, -3.0_wp, 0.5_wp, 4.0_wp], x = 1.5_wp

      call suite%close("2 - 3 s + s^2/2 + 4 s^3 at 1.5", value_at(c, x), 12.125_wp, 0.0_wp, 0.0_wp)
      call suite%close("a constant", value_at([7.0_wp], x), 7.0_wp, 0.0_wp, 0.0_wp)
      call suite%true("its derivative is -3 + s + 12 s^2", &
         & .not. any(abs(derivative(c) - [-3.0_wp, 1.0_wp, 12.0_wp]) > 0.0_wp))
   end subroutine polynomials

   !> A step cut anywhere out of t^k, k = 0 to 5, gives t^k back: u, u' and u'' at its ends and u inside.
   subroutine reproduces_degree_five()
      real(wp), parameter :: t0 = 0.7_wp, h = 0.45_wp
      real(wp) :: power(0:5), c(0:5), worst, worst_end
      integer :: k, i

      do k = 0, 5
         power = 0.0_wp
         power(k) = 1.0_wp
         associate (first => derivative(power), second => derivative(derivative(power)))
            call quintic(h, value_at(power, t0), value_at(first, t0), value_at(second, t0), &
               & value_at(power, t0 + h), value_at(first, t0 + h), value_at(second, t0 + h), c)
            worst = 0.0_wp
            do i = 0, 16
               associate (s => real(i, wp)/16.0_wp)
                  worst = max(worst, abs(value_at(c, s) - value_at(power, t0 + s*h)))
               end associate
            end do
            worst_end = max(abs(value_at(derivative(c), 0.0_wp)/h - value_at(first, t0)), &
               & abs(value_at(derivative(c), 1.0_wp)/h - value_at(first, t0 + h)), &
               & abs(value_at(derivative(derivative(c)), 0.0_wp)/h**2 - value_at(second, t0)), &
               & abs(value_at(derivative(derivative(c)), 1.0_wp)/h**2 - value_at(second, t0 + h)))
         end associate
         call suite%close("t^"//to_text(k)//" inside a step", worst, 0.0_wp, 0.0_wp, 64.0_wp*eps)
         call suite%close("slope and curvature of t^"//to_text(k)//" at both ends", worst_end, 0.0_wp, 0.0_wp, 2048.0_wp*eps)
      end do
   end subroutine reproduces_degree_five

   !> The error of a step of sin t about its maximum is h^6/46080 in the middle, as stated.
   subroutine order_six()
      real(wp) :: e(4)
      integer :: i

      do i = 1, 4
         e(i) = abs(value_at(step_of_sine(1.0_wp/2.0_wp**(i - 1)), 0.5_wp) - 1.0_wp)
      end do
      do i = 2, 4
         call suite%close("order of the dense output at halving "//to_text(i - 1), log(e(i - 1)/e(i))/log(2.0_wp), &
            & 6.0_wp, 0.0_wp, 0.03_wp)
      end do
      call suite%close("its constant", e(3)/0.25_wp**6, 1.0_wp/46080.0_wp, 1.0e-2_wp, 0.0_wp)
   end subroutine order_six

   !> One step of length h about the maximum of sin t.
   function step_of_sine(h) result(c)
      real(wp), intent(in) :: h
      real(wp) :: c(0:5)
      real(wp), parameter :: middle = 1.5707963267948966_wp

      associate (t0 => middle - 0.5_wp*h, t1 => middle + 0.5_wp*h)
         call quintic(h, sin(t0), cos(t0), -sin(t0), sin(t1), cos(t1), -sin(t1), c)
      end associate
   end function step_of_sine

   !> (s - r)(1 + s + 2 s^2 + s^3 + 3 s^4) with r = 0, 1/64, ..., 1: all coefficients are exact.
   subroutine roots_anywhere()
      real(wp) :: worst
      integer :: i

      worst = 0.0_wp
      do i = 0, 64
         associate (r => real(i, wp)/64.0_wp)
            worst = max(worst, abs(first_root(with_root(r), 0.0_wp, 1.0_wp) - r))
         end associate
      end do
      call suite%close("distance to 65 known roots of quintics", worst, 0.0_wp, 0.0_wp, 4.0_wp*eps)
   end subroutine roots_anywhere

   pure function with_root(r) result(c)
      real(wp), intent(in) :: r
      real(wp) :: c(0:5)
      real(wp), parameter :: factor(0:4) = [1.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 3.0_wp]

      c(1:5) = factor
      c(0) = 0.0_wp
      c(0:4) = c(0:4) - r*factor
   end function with_root

   !> (s - 1/4)(s - 1/2)(s - 3/4): the interval chooses the root.
   subroutine roots_apart()
      real(wp), parameter :: c(0:3) = [-0.09375_wp, 0.6875_wp, -1.5_wp, 1.0_wp]

      call suite%close("the first of three roots", first_root(c, 0.0_wp, 0.375_wp), 0.25_wp, 0.0_wp, 4.0_wp*eps)
      call suite%close("the second", first_root(c, 0.3125_wp, 0.6875_wp), 0.5_wp, 0.0_wp, 4.0_wp*eps)
      call suite%close("the third", first_root(c, 0.625_wp, 1.0_wp), 0.75_wp, 0.0_wp, 4.0_wp*eps)
   end subroutine roots_apart

   !> A root at an end of the interval is found there; so is one that rounding puts just beyond it.
   subroutine roots_at_ends()
      real(wp), parameter :: c(0:3) = [-0.09375_wp, 0.6875_wp, -1.5_wp, 1.0_wp]

      call suite%close("a root at the lower end is exact", first_root(c, 0.25_wp, 0.375_wp), 0.25_wp, 0.0_wp, 0.0_wp)
      call suite%close("a root at the upper end", first_root(c, 0.0_wp, 0.25_wp), 0.25_wp, 0.0_wp, 4.0_wp*eps)
      call suite%close("a root just above 1", first_root([1.0_wp, -1.0_wp + eps], 0.0_wp, 1.0_wp), 1.0_wp, 0.0_wp, 4.0_wp*eps)
      call suite%close("flat beside a root above 1", first_root([1.0_wp + eps, -2.0_wp, 1.0_wp], 0.0_wp, 1.0_wp), 1.0_wp, &
         & 0.0_wp, 4.0_wp*sqrt(eps))
   end subroutine roots_at_ends

   !> Triple and quintuple roots: as near as the rounding of the polynomial lets one see.
   subroutine flat_roots()
      real(wp), parameter :: r = 0.3125_wp
      real(wp), parameter :: triple(0:3) = [-r**3, 3.0_wp*r**2, -3.0_wp*r, 1.0_wp]
      real(wp), parameter :: quintuple(0:5) = [-r**5, 5.0_wp*r**4, -10.0_wp*r**3, 10.0_wp*r**2, -5.0_wp*r, 1.0_wp]

      call suite%close("a triple root", first_root(triple, 0.0_wp, 1.0_wp), r, 0.0_wp, 2.0_wp*eps**(1.0_wp/3.0_wp))
      call suite%close("a quintuple root", first_root(quintuple, 0.0_wp, 1.0_wp), r, 0.0_wp, 2.0_wp*eps**0.2_wp)
      call suite%close("an even flatter start: s^5 = 2^-40", first_root([-2.0_wp**(-40), 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
         & 1.0_wp], 0.0_wp, 1.0_wp), 2.0_wp**(-8), 0.0_wp, 4.0_wp*eps)
   end subroutine flat_roots

   !> No slope in the middle, where the search starts; a slope that throws Newton out; a root next to a corner of
   !> rounding size.
   subroutine hard_starts()
      real(wp), parameter :: level = 0.375_wp
      real(wp), parameter :: saddle(0:3) = [-0.125_wp + 0.001953125_wp, 0.75_wp, -1.5_wp, 1.0_wp]
      real(wp), parameter :: hump(0:2) = [-1.0e-3_wp, 1.0_wp, -0.99_wp]

      call suite%close("(s - 1/2)^3 = -1/512", first_root(saddle, 0.0_wp, 1.0_wp), level, 0.0_wp, 8.0_wp*eps)
      call suite%close("a hump: s - 0.99 s^2 = 0.001", value_at(hump, first_root(hump, 0.0_wp, 1.0_wp)), 0.0_wp, 0.0_wp, &
         & 4.0_wp*eps)
      call suite%close("a root of size 1e-12", first_root([-1.0e-12_wp, 1.0_wp, -0.5_wp], 0.0_wp, 1.0_wp), 1.0e-12_wp, &
         & 0.0_wp, 2.0_wp*eps)
   end subroutine hard_starts

   !> Neither the unit of u nor its direction moves a root.
   subroutine scale_and_sign()
      real(wp), parameter :: r = 0.7_wp
      real(wp) :: root
      integer :: i, exponents(4)
      logical :: same

      root = first_root(with_root(r), 0.0_wp, 1.0_wp)
      exponents = [-900, -30, 40, 900]
      same = .true.
      do i = 1, 4
         same = same .and. .not. abs(first_root(scale(with_root(r), exponents(i)), 0.0_wp, 1.0_wp) - root) > 0.0_wp
      end do
      call suite%true("scaled by powers of two: the same root", same)
      call suite%close("upside down: the same root", first_root(-with_root(r), 0.0_wp, 1.0_wp), root, 0.0_wp, 0.0_wp)
      call suite%close("backwards: the mirrored root", first_root(mirrored(with_root(r)), 0.0_wp, 1.0_wp), 1.0_wp - root, &
         & 0.0_wp, 64.0_wp*eps)
   end subroutine scale_and_sign

   !> c(1 - s) as a polynomial of s.
   pure function mirrored(c) result(m)
      real(wp), intent(in) :: c(0:5)
      real(wp) :: m(0:5)
      integer :: k

      m = 0.0_wp
      do k = 5, 0, -1
         m(1:5) = m(1:5) - m(0:4)   ! m (1 - s) + c(k)
         m(0) = m(0) + c(k)
      end do
   end function mirrored

end program test_dense
