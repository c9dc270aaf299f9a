!> Gauss-Legendre quadrature on an interval.
module rv_gauss
   use rv_kinds, only : wp, pi
   implicit none
   private
   public :: gauss_legendre

contains

   !> Points and weights of the n-point rule on lo..hi; exact for polynomials of degree 2n - 1.
   pure subroutine gauss_legendre(lo, hi, x, w)
      real(wp), intent(in) :: lo, hi
      real(wp), intent(out) :: x(:)   !! rising
      real(wp), intent(out) :: w(:)   !! (size(x))
      real(wp) :: z, p0, p1, p2, slope
      integer :: n, i, k, iteration

      n = size(x)
      do i = 1, n
         z = -cos(pi*(real(i, wp) - 0.25_wp)/(real(n, wp) + 0.5_wp))
         do iteration = 1, 100
            p0 = 1.0_wp
            p1 = z
            do k = 2, n
               p2 = (real(2*k - 1, wp)*z*p1 - real(k - 1, wp)*p0)/real(k, wp)
               p0 = p1
               p1 = p2
            end do
            if (n == 1) slope = 1.0_wp
            if (n > 1) slope = real(n, wp)*(z*p1 - p0)/(z*z - 1.0_wp)
            z = z - p1/slope
            if (abs(p1/slope) <= 2.0_wp*epsilon(z)) exit
         end do
         x(i) = 0.5_wp*(lo + hi) + 0.5_wp*(hi - lo)*z
         w(i) = (hi - lo)/((1.0_wp - z*z)*slope**2)
      end do
   end subroutine gauss_legendre

end module rv_gauss
