!> Dense output: the quintic that meets u, u' and u'' at both ends of a step, and its roots.
!>
!> Error h^6 max|u^(6)|/46080 in u. Coefficients are in powers of s = (t - t0)/h, 0 <= s <= 1.
module rv_dense
   use rv_kinds, only : wp
   implicit none
   private
   public :: quintic, value_at, derivative, first_root

contains

   !> Coefficients 0 to 5 of u(s).
   pure function quintic(h, u0, v0, a0, u1, v1, a1) result(c)
      real(wp), intent(in) :: h                   !! step [s]
      real(wp), intent(in) :: u0, v0, a0          !! u [m], u' [m s-1], u'' [m s-2] at s = 0
      real(wp), intent(in) :: u1, v1, a1          !! the same at s = 1
      real(wp) :: c(0:5)                          !! [m]
      real(wp) :: rise, dv, da

      rise = u1 - u0 - h*(v0 + 0.5_wp*h*a0)
      dv = h*(v1 - v0 - h*a0)
      da = h**2*(a1 - a0)
      c(0) = u0
      c(1) = h*v0
      c(2) = 0.5_wp*h**2*a0
      c(3) = 10.0_wp*rise - 4.0_wp*dv + 0.5_wp*da
      c(4) = -15.0_wp*rise + 7.0_wp*dv - da
      c(5) = 6.0_wp*rise - 3.0_wp*dv + 0.5_wp*da
   end function quintic

   !> Value of a polynomial.
   pure real(wp) function value_at(c, s) result(value)
      real(wp), intent(in) :: c(0:)
      real(wp), intent(in) :: s
      integer :: k

      value = c(ubound(c, 1))
      do k = ubound(c, 1) - 1, 0, -1
         value = value*s + c(k)
      end do
   end function value_at

   !> Coefficients of the derivative with respect to s.
   pure function derivative(c) result(d)
      real(wp), intent(in) :: c(0:)
      real(wp) :: d(0:size(c) - 2)
      integer :: k

      do k = 1, size(c) - 1
         d(k - 1) = real(k, wp)*c(k)
      end do
   end function derivative

   !> The root of a polynomial that changes sign between lo and hi, to rounding: Newton held in by bisection.
   pure real(wp) function first_root(c, lo, hi) result(s)
      real(wp), intent(in) :: c(0:)
      real(wp), intent(in) :: lo, hi
      real(wp) :: left, right, f, slope, f_left, newton
      integer :: iteration

      left = lo
      right = hi
      f_left = value_at(c, left)
      s = 0.5_wp*(left + right)
      if (abs(f_left) <= 0.0_wp) then
         s = left
         return
      end if
      do iteration = 1, 100
         f = value_at(c, s)
         if (abs(f) <= 0.0_wp) return
         if ((f > 0.0_wp) .eqv. (f_left > 0.0_wp)) then
            left = s
         else
            right = s
         end if
         if (right - left <= 2.0_wp*epsilon(1.0_wp)) return
         slope = value_at(derivative(c), s)
         if (abs(f) <= 2.0_wp*epsilon(1.0_wp)*abs(slope)) return
         newton = left
         if (abs(f) < abs(slope)) newton = s - f/slope
         s = 0.5_wp*(left + right)
         if (newton > left .and. newton < right) s = newton
      end do
   end function first_root

end module rv_dense
