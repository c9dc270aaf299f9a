!> Gauss-Legendre quadrature: its degree, closed forms, symmetry.
program test_gauss
   use rv_kinds, only : wp, pi
   use rv_gauss, only : gauss_legendre
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite

   call degree()
   call closed_forms()
   call symmetry()
   call suite%finish()

contains

   !> n points integrate x^(2n-1) and below exactly; at x^2n the error is that of the monic Legendre polynomial,
   !> 2^(2n+1) (n!)^4/((2n+1) (2n)!^2) on -1..1.
   subroutine degree()
      real(wp) :: worst, error
      integer :: n, k

      do n = 1, 12
         worst = 0.0_wp
         do k = 0, 2*n - 1
            worst = max(worst, abs(power(n, k) - merge(2.0_wp/real(k + 1, wp), 0.0_wp, mod(k, 2) == 0)))
         end do
         call suite%close(to_text(n)//" points: worst error up to degree 2n - 1", worst, 0.0_wp, 0.0_wp, 20.0_wp*epsilon(worst))
         error = 2.0_wp/real(2*n + 1, wp) - power(n, 2*n)
         call suite%close(to_text(n)//" points: error at degree 2n", error, &
            & 2.0_wp**(2*n + 1)*gamma(real(n + 1, wp))**4/(real(2*n + 1, wp)*gamma(real(2*n + 1, wp))**2), &
            & 1.0e-6_wp, 20.0_wp*epsilon(worst))
      end do
   end subroutine degree

   real(wp) function power(n, k)
      integer, intent(in) :: n, k
      real(wp) :: x(n), w(n)

      call gauss_legendre(-1.0_wp, 1.0_wp, x, w)
      power = sum(w*x**k)
   end function power

   subroutine closed_forms()
      real(wp) :: x3(3), w3(3), x(20), w(20), x64(64), w64(64)

      call gauss_legendre(-1.0_wp, 1.0_wp, x3, w3)
      call suite%close("third of 3 points", x3(3), sqrt(0.6_wp), 4.0_wp*epsilon(1.0_wp), 0.0_wp)
      call suite%close("its weight", w3(3), 5.0_wp/9.0_wp, 8.0_wp*epsilon(1.0_wp), 0.0_wp)
      call gauss_legendre(0.0_wp, pi, x, w)
      call suite%close("int sin over 0..pi, 20 points", sum(w*sin(x)), 2.0_wp, 1.0e-14_wp, 0.0_wp)
      call gauss_legendre(3.0_wp, 1.0_wp, x, w)
      call suite%close("int 1/x from 3 back to 1, 20 points", sum(w/x), -log(3.0_wp), 1.0e-14_wp, 0.0_wp)
      call gauss_legendre(0.0_wp, 2.0e-3_wp, x64, w64)
      call suite%close("64 weights: the length of the interval", sum(w64), 2.0e-3_wp, 1.0e-13_wp, 0.0_wp)
      call suite%close("64 points: int x^2", sum(w64*x64**2), 8.0e-9_wp/3.0_wp, 1.0e-13_wp, 0.0_wp)
   end subroutine closed_forms

   subroutine symmetry()
      real(wp) :: x(9), w(9)

      call gauss_legendre(-1.0_wp, 1.0_wp, x, w)
      call suite%true("points rise inside the interval", all(x(2:) > x(:8)) .and. x(1) > -1.0_wp .and. x(9) < 1.0_wp)
      call suite%close("points mirrored", maxval(abs(x + x(9:1:-1))), 0.0_wp, 0.0_wp, 4.0_wp*epsilon(1.0_wp))
      call suite%close("weights mirrored", maxval(abs(w - w(9:1:-1))), 0.0_wp, 0.0_wp, 8.0_wp*epsilon(1.0_wp))
      call suite%true("weights positive", all(w > 0.0_wp))
   end subroutine symmetry

end program test_gauss
