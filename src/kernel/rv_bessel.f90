!> Modified Bessel functions K0 and K1 of complex argument in the right half plane.
!>
!> |z| <= 2: ascending series (Abramowitz & Stegun 9.6.11 and 9.6.13).
!> |z| > 2: Steed's evaluation of Temme's continued fraction CF2
!> (Temme 1975, doi:10.1016/0021-9991(75)90082-0). Both reach rounding in at most
!> some hundred terms; on the ray arg z = -pi/4 the relative error stays below 1e-13.
module rv_bessel
   use rv_kinds, only : wp, pi
   implicit none
   private
   public :: bessel_k01

   real(wp), parameter :: euler_gamma = 0.57721566490153286060651209008240243_wp  !! Euler-Mascheroni constant [-]
   integer, parameter :: max_terms = 1000

contains

   !> exp(z) K0(z) and exp(z) K1(z): the factor keeps large arguments from underflow.
   pure subroutine bessel_k01(z, k0, k1)
      complex(wp), intent(in) :: z         !! real part > 0
      complex(wp), intent(out) :: k0, k1   !! exp(z) K0(z), exp(z) K1(z)

      if (abs(z) <= 2.0_wp) then
         call ascending_series(z, k0, k1)
      else
         call continued_fraction(z, k0, k1)
      end if
   end subroutine bessel_k01

   !> K0 = -(ln(z/2) + gamma) I0 + sum h_k t^k/(k!)^2,
   !> K1 = 1/z + ln(z/2) I1 - (z/4) sum (psi(k+1) + psi(k+2)) t^k/(k!(k+1)!), t = z^2/4, h_k the harmonic numbers.
   pure subroutine ascending_series(z, k0, k1)
      complex(wp), intent(in) :: z
      complex(wp), intent(out) :: k0, k1
      complex(wp) :: t, term0, term1, i0, i1, sum0, sum1
      real(wp) :: harmonic
      integer :: k

      t = 0.25_wp*z*z
      term0 = 1.0_wp
      term1 = 1.0_wp
      i0 = 1.0_wp
      i1 = 1.0_wp
      sum0 = 0.0_wp
      harmonic = 0.0_wp
      sum1 = 1.0_wp - 2.0_wp*euler_gamma
      do k = 1, max_terms
         term0 = term0*t/real(k, wp)**2
         term1 = term1*t/(real(k, wp)*real(k + 1, wp))
         harmonic = harmonic + 1.0_wp/real(k, wp)
         i0 = i0 + term0
         i1 = i1 + term1
         sum0 = sum0 + harmonic*term0
         sum1 = sum1 + (2.0_wp*(harmonic - euler_gamma) + 1.0_wp/real(k + 1, wp))*term1
         if (abs(harmonic*term0) <= epsilon(1.0_wp)*abs(i0)) exit
      end do
      k0 = exp(z)*(sum0 - (log(0.5_wp*z) + euler_gamma)*i0)
      k1 = exp(z)*(1.0_wp/z + log(0.5_wp*z)*0.5_wp*z*i1 - 0.25_wp*z*sum1)
   end subroutine ascending_series

   !> CF2 for order 0, a_n = -(n - 1/2)^2 and b_n = 2 (n + z): Steed's recurrence gives K0 and K1/K0 together.
   pure subroutine continued_fraction(z, k0, k1)
      complex(wp), intent(in) :: z
      complex(wp), intent(out) :: k0, k1
      complex(wp) :: b, d, f, delta, q1, q2, q, c, s, step, new
      real(wp) :: a
      integer :: n

      b = 2.0_wp*(1.0_wp + z)
      d = 1.0_wp/b
      f = d
      delta = d
      q1 = 0.0_wp
      q2 = 1.0_wp
      a = -0.25_wp
      c = 0.25_wp
      q = c
      s = 1.0_wp + q*delta
      do n = 2, max_terms
         a = a - 2.0_wp*real(n - 1, wp)
         c = -a*c/real(n, wp)
         new = (q1 - b*q2)/a
         q1 = q2
         q2 = new
         q = q + c*new
         b = b + 2.0_wp
         d = 1.0_wp/(b + a*d)
         delta = (b*d - 1.0_wp)*delta
         f = f + delta
         step = q*delta
         s = s + step
         if (abs(step) <= 0.5_wp*epsilon(1.0_wp)*abs(s)) exit
      end do
      k0 = sqrt(0.5_wp*pi/z)/s
      k1 = k0*(0.5_wp + z - 0.25_wp*f)/z
   end subroutine continued_fraction

end module rv_bessel
