!> Dense output: the quintic that meets u, u' and u'' at both ends of a step, and its roots.
!>
!> Error h^6 max|u^(6)|/46080 in u. Coefficients are in powers of s = (t - t0)/h, 0 <= s <= 1.
module rv_dense
   use rv_kinds, only : wp
   implicit none
   private
   public :: quintic, cubic, value_at, motion_at, derivative, first_root

contains

   !> Coefficients 0 to 5 of u(s).
   pure subroutine quintic(h, u0, v0, a0, u1, v1, a1, c)
      real(wp), intent(in) :: h                   !! step [s]
      real(wp), intent(in) :: u0, v0, a0          !! u [m], u' [m s-1], u'' [m s-2] at s = 0
      real(wp), intent(in) :: u1, v1, a1          !! the same at s = 1
      real(wp), intent(out) :: c(0:5)             !! [m]
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
   end subroutine quintic

   !> The cubic that meets u and u' at both ends, as a quintic; error h^4 max|u''''|/384.
   pure subroutine cubic(h, u0, v0, u1, v1, c)
      real(wp), intent(in) :: h, u0, v0, u1, v1
      real(wp), intent(out) :: c(0:5)

      c = [u0, h*v0, 3.0_wp*(u1 - u0) - h*(2.0_wp*v0 + v1), h*(v0 + v1) - 2.0_wp*(u1 - u0), 0.0_wp, 0.0_wp]
   end subroutine cubic

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

   !> Value, first and second derivative of a quintic with respect to s.
   pure subroutine motion_at(c, s, u, du, ddu)
      real(wp), intent(in) :: c(0:5)
      real(wp), intent(in) :: s
      real(wp), intent(out) :: u, du, ddu

      u = c(0) + s*(c(1) + s*(c(2) + s*(c(3) + s*(c(4) + s*c(5)))))
      du = c(1) + s*(2.0_wp*c(2) + s*(3.0_wp*c(3) + s*(4.0_wp*c(4) + s*5.0_wp*c(5))))
      ddu = 2.0_wp*c(2) + s*(6.0_wp*c(3) + s*(12.0_wp*c(4) + s*20.0_wp*c(5)))
   end subroutine motion_at

   !> Coefficients of the derivative with respect to s.
   pure function derivative(c) result(d)
      real(wp), intent(in) :: c(0:)
      real(wp) :: d(0:size(c) - 2)
      integer :: k

      do k = 1, size(c) - 1
         d(k - 1) = real(k, wp)*c(k)
      end do
   end function derivative

   !> The root of a polynomial that changes sign between lo and hi, to rounding: Newton, held in by bisection, from a
   !> guess if there is one.
   pure real(wp) function first_root(c, lo, hi, guess, near) result(s)
      real(wp), intent(in) :: c(0:)   !! of degree five at most
      real(wp), intent(in) :: lo, hi
      real(wp), intent(in), optional :: guess
      real(wp), intent(in), optional :: near   !! a last correction below it ends the search; Newton squares it
      real(wp), parameter :: nearest = 1.0e-9_wp
      real(wp) :: b(0:5), left, right, f, slope, f_left, f_right, newton
      integer :: iteration
      real(wp) :: enough
      logical :: last

      b = 0.0_wp
      b(:size(c) - 1) = c
      left = lo
      right = hi
      enough = nearest
      if (present(near)) enough = near
      s = left
      call evaluate(b, left, f_left, slope)
      if (abs(f_left) <= 0.0_wp) return
      if (present(guess)) then
         s = guess
      else
         call evaluate(b, right, f_right, slope)
         s = left + (right - left)*(f_left/(f_left - f_right))
      end if
      if (.not. (s > left .and. s < right)) s = 0.5_wp*(left + right)
      do iteration = 1, 100
         call evaluate(b, s, f, slope)
         if (abs(f) <= 0.0_wp) return
         if ((f > 0.0_wp) .eqv. (f_left > 0.0_wp)) then
            left = s
         else
            right = s
         end if
         if (right - left <= 2.0_wp*epsilon(1.0_wp)) return
         newton = left
         if (abs(f) < abs(slope)) newton = s - f/slope
         if (newton > left .and. newton < right) then
            last = abs(newton - s) <= enough
            s = newton
            if (last) return
         else
            s = 0.5_wp*(left + right)
         end if
      end do
   end function first_root

   !> Value and slope of a quintic.
   pure subroutine evaluate(c, s, value, slope)
      real(wp), intent(in) :: c(0:5), s
      real(wp), intent(out) :: value, slope

      value = c(0) + s*(c(1) + s*(c(2) + s*(c(3) + s*(c(4) + s*c(5)))))
      slope = c(1) + s*(2.0_wp*c(2) + s*(3.0_wp*c(3) + s*(4.0_wp*c(4) + s*5.0_wp*c(5))))
   end subroutine evaluate

end module rv_dense
