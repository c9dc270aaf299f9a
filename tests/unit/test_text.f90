!> Numbers as text: shortest exact form, both notations, special values.
program test_text
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan, ieee_positive_inf
   use rv_kinds, only : wp
   use rv_text, only : to_text, lower
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite

   call suite%text("short decimal", to_text(0.05_wp), "0.05")
   call suite%text("integer value", to_text(40.0_wp), "40")
   call suite%text("large integer value", to_text(123456.0_wp), "123456")
   call suite%text("negative fraction", to_text(-0.5_wp), "-0.5")
   call suite%text("small", to_text(1.5e-7_wp), "1.5e-7")
   call suite%text("large", to_text(1.0e300_wp), "1e300")
   call suite%text("seventeen digits", to_text(0.1_wp + 0.2_wp), "0.30000000000000004")
   call suite%text("zero", to_text(0.0_wp), "0")
   call suite%text("rounded", to_text(3.14159265_wp, 4), "3.142")
   call suite%text("rounded up to a power of ten", to_text(9.9999_wp, 3), "10")
   call suite%text("not a number", to_text(ieee_value(1.0_wp, ieee_quiet_nan)), "NaN")
   call suite%text("infinity", to_text(ieee_value(1.0_wp, ieee_positive_inf)), "Infinity")
   call suite%text("lower case", lower("Film.GAP_mm"), "film.gap_mm")
   call suite%finish()
end program test_text
