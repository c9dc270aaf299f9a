!> Shape-preserving piecewise cubic interpolation: no overshoot where the data have none.
!>
!> Fritsch & Butland (1984), doi:10.1137/0905021: interior slopes are the weighted harmonic mean of
!> the neighbouring secants, zero at a turn; the ends take a three-point formula held to the same rule.
!> Second order in general, third for smooth monotone data on even samples.
module rv_monotone_cubic
   use rv_kinds, only : wp
   implicit none
   private
   public :: monotone_slopes, cubic_value

contains

   !> Slopes of the interpolant at the samples.
   pure function monotone_slopes(x, y) result(slope)
      real(wp), intent(in) :: x(:)    !! rising, at least two
      real(wp), intent(in) :: y(:)    !! (size(x))
      real(wp) :: slope(size(x))      !! dy/dx
      real(wp) :: h(size(x) - 1), secant(size(x) - 1), w1, w2
      integer :: n, i

      n = size(x)
      h = x(2:) - x(:n - 1)
      secant = (y(2:) - y(:n - 1))/h
      if (n == 2) then
         slope = secant(1)
         return
      end if
      do i = 2, n - 1
         slope(i) = 0.0_wp
         if (secant(i - 1)*secant(i) > 0.0_wp) then
            w1 = 2.0_wp*h(i) + h(i - 1)
            w2 = h(i) + 2.0_wp*h(i - 1)
            slope(i) = (w1 + w2)/(w1/secant(i - 1) + w2/secant(i))
         end if
      end do
      slope(1) = end_slope(h(1), h(2), secant(1), secant(2))
      slope(n) = end_slope(h(n - 1), h(n - 2), secant(n - 1), secant(n - 2))
   end function monotone_slopes

   !> Cubic Hermite value on the interval x(1)..x(2).
   pure real(wp) function cubic_value(x, y, slope, at) result(value)
      real(wp), intent(in) :: x(2), y(2), slope(2)
      real(wp), intent(in) :: at
      real(wp) :: h, s, secant

      h = x(2) - x(1)
      s = (at - x(1))/h
      secant = (y(2) - y(1))/h
      value = y(1) + s*h*(slope(1) + s*((3.0_wp*secant - 2.0_wp*slope(1) - slope(2)) &
         & + s*(slope(1) + slope(2) - 2.0_wp*secant)))
   end function cubic_value

   !> One-sided three-point slope; zero if it points the wrong way, at most three secants at a turn.
   pure real(wp) function end_slope(h1, h2, secant1, secant2) result(slope)
      real(wp), intent(in) :: h1, h2            !! nearest interval, the next
      real(wp), intent(in) :: secant1, secant2

      slope = ((2.0_wp*h1 + h2)*secant1 - h1*secant2)/(h1 + h2)
      if (slope*secant1 <= 0.0_wp) then
         slope = 0.0_wp
      else if (secant1*secant2 <= 0.0_wp .and. abs(slope) > 3.0_wp*abs(secant1)) then
         slope = 3.0_wp*secant1
      end if
   end function end_slope

end module rv_monotone_cubic
