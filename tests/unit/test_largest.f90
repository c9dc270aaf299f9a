!> The largest of some numbers: against maxval, NaN above all, nothing below zero.
program test_largest
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_value, ieee_positive_inf, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_largest, only : largest
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   integer, parameter :: n = 37
   real(wp) :: x(n)
   integer :: i

   call suite%close("of none", largest([real(wp) ::]), 0.0_wp, 0.0_wp, 0.0_wp)
   x = [(10.0_wp**mod(7*i, 61)*abs(sin(real(i, wp))), i=1, n)]
   do i = 1, n
      call suite%close("of the first "//to_text(i), largest(x(:i)), maxval(x(:i)), 0.0_wp, 0.0_wp)
   end do
   call suite%close("of the tiniest", largest([0.0_wp, tiny(1.0_wp), epsilon(1.0_wp)*tiny(1.0_wp)]), tiny(1.0_wp), 0.0_wp, 0.0_wp)
   x(11) = ieee_value(1.0_wp, ieee_positive_inf)
   call suite%true("infinity is above all numbers", largest(x) > huge(1.0_wp))
   x(5) = ieee_value(1.0_wp, ieee_quiet_nan)
   call suite%true("NaN is above infinity", ieee_is_nan(largest(x)))
   x(5) = sign(x(5), -1.0_wp)   ! as processors make it
   call suite%true("NaN with a sign, too", ieee_is_nan(largest(x)))
   call suite%finish()
end program test_largest
