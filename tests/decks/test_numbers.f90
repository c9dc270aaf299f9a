!> Words as numbers, lists of remarks, long texts.
program test_numbers
   use rv_kinds, only : wp, i8
   use rv_number, only : parse_real, parse_integer, parse_logical, tidy
   use rv_faults, only : fault_list, clip
   use rv_text, only : text_type
   use rv_text_builder, only : text_builder, append_text
   use rv_text_file, only : folder_of
   use rv_suggest, only : closest
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite

   call reals()
   call others()
   call tidied()
   call remarks()
   call texts()
   call suite%finish()

contains

   subroutine reals()
      character(len=*), parameter :: good(8) = [character(len=10) :: &
         & "1", "-1.5", "+.5", "5.", "1e3", "1.5D-03", "2.5E+2", "007"]
      real(wp), parameter :: meant(8) = [1.0_wp, -1.5_wp, 0.5_wp, 5.0_wp, 1000.0_wp, 0.0015_wp, 250.0_wp, 7.0_wp]
      ! some of these are numbers to strtod or to Fortran's read
      character(len=*), parameter :: bad(20) = [character(len=10) :: &
         & ".", "e5", "1e", "1e+", "1.2.3", "--1", "1+5", "0x10", "1_wp", "1,5", "1.0q0", "+", "1e5.0", "d", &
         & "0x1p3", "-0X.8", "nano", "1/", "1e5d5", "2*1.5"]
      character(len=*), parameter :: no_finite(6) = [character(len=10) :: &
         & "nan", "NaN", "-nan(0x1)", "inf", "+Inf", "-infinity"]
      character(len=:), allocatable :: trouble
      real(wp) :: x
      integer :: i

      do i = 1, size(good)
         call parse_real(trim(good(i)), x, trouble)
         call suite%text(trim(good(i)), trouble, "")
         call suite%close(trim(good(i)), x, meant(i), 0.0_wp, 0.0_wp)
      end do
      do i = 1, size(bad)
         call parse_real(trim(bad(i)), x, trouble)
         call suite%text(trim(bad(i)), trouble, "not a number")
      end do
      call parse_real(" 1.5", x, trouble)
      call suite%text("a blank before it", trouble, "not a number")
      call parse_real("1.5"//achar(0), x, trouble)
      call suite%text("a NUL behind it", trouble, "not a number")
      do i = 1, size(no_finite)
         call parse_real(trim(no_finite(i)), x, trouble)
         call suite%text(trim(no_finite(i)), trouble, "NaN and infinity are not allowed")
         call suite%close(trim(no_finite(i)), x, 0.0_wp, 0.0_wp, 0.0_wp)
      end do
      call parse_real(repeat("0", 300)//"1."//repeat("3", 300), x, trouble)
      call suite%close("600 digits", x, 4.0_wp/3.0_wp, 0.0_wp, 0.0_wp)
      call parse_real("", x, trouble)
      call suite%text("nothing", trouble, "a number is missing")
      call parse_real("4.9e-324", x, trouble)
      call suite%close("the smallest", x, tiny(1.0_wp)*epsilon(1.0_wp), 0.0_wp, 0.0_wp)
      call parse_real("1.8e308", x, trouble)
      call suite%text("1.8e308", trouble, "too large for a double-precision number")
      call parse_real("1e99999999999999999999", x, trouble)
      call suite%text("1e99999999999999999999", trouble, "too large for a double-precision number")
      call parse_real("-0.0001e-330", x, trouble)
      call suite%text("-0.0001e-330", trouble, "too small for a double-precision number")
      call parse_real("0.000e-330", x, trouble)
      call suite%text("0.000e-330", trouble, "")
   end subroutine reals

   subroutine others()
      character(len=:), allocatable :: trouble
      integer(i8) :: i
      logical :: flag

      call parse_integer("-42", i, trouble)
      call suite%true("-42", i == -42_i8 .and. trouble == "")
      call parse_integer("9223372036854775807", i, trouble)
      call suite%true("9223372036854775807", i == huge(i) .and. trouble == "")
      call parse_integer("9223372036854775808", i, trouble)
      call suite%text("9223372036854775808", trouble, "too large")
      call parse_integer("4.0", i, trouble)
      call suite%text("4.0", trouble, "not a whole number")
      call parse_integer("", i, trouble)
      call suite%text("nothing", trouble, "not a whole number")
      call parse_logical(".TRUE.", flag, trouble)
      call suite%true(".TRUE.", flag .and. trouble == "")
      call parse_logical("f", flag, trouble)
      call suite%true("f", .not. flag .and. trouble == "")
      call parse_logical("tru", flag, trouble)
      call suite%text("tru", trouble, "must be .true. or .false.")
   end subroutine others

   subroutine tidied()
      call suite%close("0.1 + 0.2", tidy(0.1_wp + 0.2_wp), 0.3_wp, 0.0_wp, 0.0_wp)
      call suite%close("-3*1.1", tidy(-3.0_wp*1.1_wp), -3.3_wp, 0.0_wp, 0.0_wp)
      call suite%close("a power of ten", tidy(1000.0_wp), 1000.0_wp, 0.0_wp, 0.0_wp)
      call suite%close("just below a power of ten", tidy(9.99999999999999999_wp), 10.0_wp, 0.0_wp, 0.0_wp)
      call suite%close("zero", tidy(0.0_wp), 0.0_wp, 0.0_wp, 0.0_wp)
      call suite%close("out of reach", tidy(huge(1.0_wp)), huge(1.0_wp), 0.0_wp, 0.0_wp)
   end subroutine tidied

   subroutine remarks()
      type(fault_list) :: faults
      integer :: i

      call faults%add("a", 3, 1, "third")
      call faults%warn("b", 1, 1, "other file")
      call faults%add("a", 1, 7, "second")
      call faults%add("a", 1, 2, "first")
      call faults%add("a", 1, 7, "same place")
      call faults%add("a", 0, 0, "whole file")
      call suite%text("in order", faults%all_text(), "a: whole file"//new_line("a")//"a:1:2: first"//new_line("a") &
         & //"a:1:7: second"//new_line("a")//"a:1:7: same place"//new_line("a")//"a:3:1: third"//new_line("a") &
         & //"b:1:1: warning: other file"//new_line("a"))
      call suite%equal("errors", faults%errors(), 5)
      call suite%equal("warnings", faults%warnings(), 1)
      call suite%true("which is the warning", faults%is_warning(6) .and. .not. faults%is_warning(1))
      do i = 1, 1000
         call faults%warn("b", i, 1, "warning")
      end do
      call faults%add("b", 1, 1, "a fault behind many warnings")
      call suite%equal("warnings leave room", faults%count(), 101)
      call suite%text("clip", clip("abcdefghij", 8), "abcde...")
      call suite%text("clip nothing", clip("abcdefgh", 8), "abcdefgh")
      call suite%text("clip before a character of two bytes", clip("abcd"//char(206)//char(188)//"fghi", 8), "abcd...")
   end subroutine remarks

   subroutine texts()
      type(text_builder) :: build
      type(text_type), allocatable :: list(:)
      integer :: i

      call suite%text("empty", build%text(), "")
      do i = 1, 3000
         call build%add("abc")
      end do
      call suite%true("long", build%text() == repeat("abc", 3000) .and. len(build%text()) == 9000)
      allocate(list(0))
      call append_text(list, "gap_mm")
      call append_text(list, "thickness_mm")
      call suite%text("closest", closest("thicknes_mm", list), "thickness_mm")
      call suite%text("nothing close", closest("q", list), "")
      call suite%text("folder", folder_of("a/b/c.nml"), "a/b/")
      call suite%text("no folder", folder_of("c.nml"), "")
   end subroutine texts

end program test_numbers
