!> Rows of numbers: the bytes of C's printf for every number, on both sides of every tie, whatever the size; and what a
!> column repeats.
program test_row_text
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int, c_null_char, c_size_t
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_negative_inf, ieee_quiet_nan, ieee_value
   use check, only : suite_type
   use rv_kinds, only : wp, i8
   use rv_row_text, only : field_type, row_text
   use rv_text, only : to_text
   implicit none
   type(suite_type) :: suite
   integer :: compared = 0, wrong = 0

   interface
      subroutine printf_number(x, digits, text, size) bind(C, name="test_printf_number")
         import :: c_char, c_double, c_int, c_size_t
         real(c_double), value :: x
         integer(c_int), value :: digits
         character(kind=c_char), intent(out) :: text(*)
         integer(c_size_t), value :: size
      end subroutine printf_number
   end interface

   call test_known()
   call test_room()
   call test_whole()
   call test_fields()
   call test_ties()
   call test_powers()
   call test_everywhere()
   call suite%true("numbers were compared", compared > 100000)
   call suite%equal("numbers unlike printf's", wrong, 0)
   call suite%finish()

contains

   subroutine test_known()
      call suite%text("12 digits", written(1.0_wp/3.0_wp, 12), "0.333333333333")
      call suite%text("no zeros at the end", written(0.05_wp, 15), "0.05")
      call suite%text("an exponent", written(-1.5e-7_wp, 12), "-1.5e-07")
      call suite%text("a whole number", written(120.0_wp, 12), "120")
      call suite%text("nines that round up", written(0.9999999999999_wp, 12), "1")
      call suite%text("as many digits as there are", written(123456789012.0_wp, 12), "123456789012")
      call suite%text("one more", written(1234567890123.0_wp, 12), "1.23456789012e+12")
   end subroutine test_known

   !> Text outgrows its room, and room is used again.
   subroutine test_room()
      type(row_text) :: rows
      integer :: i
      logical :: right

      do i = 1, 100000
         call rows%add_whole(1000000_i8*1000000_i8 + i)
         call rows%add(", ")
      end do
      call suite%equal("bytes of many whole numbers", int(rows%used), 1500000)
      right = .true.
      do i = 1, 100000
         right = right .and. rows%bytes(15*i - 14:15*i) == "1000000"//digits_of(i)//", "
      end do
      call suite%true("all of them right", right)
      call rows%clear()
      call rows%add_whole(0_i8)
      call suite%text("used again", rows%bytes(:rows%used), "0")
   end subroutine test_room

   !> Whole numbers of every length.
   subroutine test_whole()
      type(row_text) :: rows
      integer(i8) :: i
      integer :: e

      do e = 0, range(i)
         i = 10_i8**e
         call rows%clear()
         call rows%add_whole(i)
         call rows%add(" ")
         call rows%add_whole(i - 1)
         call suite%text("around 10^n", rows%bytes(:rows%used), to_text(i)//" "//to_text(i - 1))
      end do
      call rows%clear()
      call rows%add_whole(huge(i))
      call suite%text("the largest", rows%bytes(:rows%used), to_text(huge(i)))
   end subroutine test_whole

   !> Rows of some columns, which repeat their numbers now and then, are the rows of each number written anew.
   subroutine test_fields()
      integer, parameter :: columns = 7, rows = 20000
      type(field_type) :: above(columns)
      type(row_text) :: text, expected
      real(wp) :: x(columns), pool(8)
      integer :: i, j, state

      pool = [0.0_wp, -0.0_wp, ieee_value(0.0_wp, ieee_quiet_nan), 1.0_wp/3.0_wp, -1.0e-300_wp/7.0_wp, 5.0_wp, &
         & -1234567.0_wp/3.0_wp*1.0e14_wp, nearest(1.0_wp/3.0_wp, 1.0_wp)]
      state = 1
      do i = 1, rows
         do j = 1, columns
            state = modulo(state*1103 + 12345, 65536)
            if (i == 1 .or. modulo(state/64, 3) == 0) x(j) = pool(1 + modulo(state/256, size(pool)))
         end do
         call text%add_whole(int(i, i8))
         call text%add_fields(x(:2), 15, above(:2))
         call text%add_fields(x(3:), 12, above(3:))
         call expected%add_whole(int(i, i8))
         do j = 1, columns
            call expected%add(",")
            if (.not. ieee_is_nan(x(j))) call expected%add_number(x(j), merge(15, 12, j <= 2))
         end do
      end do
      call suite%true("numbers that repeat", text%bytes(:text%used) == expected%bytes(:expected%used))
   end subroutine test_fields

   !> Halves of the last digit, which are doubles, and their neighbours.
   subroutine test_ties()
      integer :: i, digits
      real(wp) :: x

      do i = 1, 4000
         x = real(i, wp)*0.0078125_wp
         do digits = 1, 7
            call compare_around(x, digits)
            call compare_around(x*1048576.0_wp, digits)
         end do
      end do
   end subroutine test_ties

   subroutine test_powers()
      integer :: e, digits

      do e = -12, 25
         do digits = 1, 15
            call compare_around(10.0_wp**e, digits)
            call compare_around(9.99999999999995_wp*10.0_wp**e, digits)
            call compare_around(-5.0_wp*10.0_wp**e, digits)
         end do
      end do
   end subroutine test_powers

   !> Over all sizes, for what has none, and beyond what the quick way takes.
   subroutine test_everywhere()
      real(wp) :: nan
      integer :: i

      do i = 1, 20000
         call compare_around(modulo(sin(real(i, wp)), 1.0_wp)*10.0_wp**(modulo(i, 37) - 12), 12)
         call compare_around(modulo(cos(real(i, wp)), 1.0_wp)*10.0_wp**(modulo(i, 37) - 12), 15)
         call compare_around(anint(modulo(cos(real(i, wp)), 1.0_wp)*1.0e6_wp)/10.0_wp**modulo(i, 9), 15)
      end do
      nan = ieee_value(nan, ieee_quiet_nan)
      call compare(0.0_wp, 12)
      call compare(-0.0_wp, 12)
      call compare(tiny(1.0_wp), 12)
      call compare(tiny(1.0_wp)/3.0_wp, 12)
      call compare(huge(1.0_wp), 15)
      call compare(ieee_value(nan, ieee_negative_inf), 12)
      call compare(nan, 12)
      call compare(1.0_wp/3.0_wp, 17)
   end subroutine test_everywhere

   !> A number and its neighbours.
   subroutine compare_around(x, digits)
      real(wp), intent(in) :: x
      integer, intent(in) :: digits

      call compare(x, digits)
      call compare(nearest(x, 1.0_wp), digits)
      call compare(nearest(x, -1.0_wp), digits)
   end subroutine compare_around

   subroutine compare(x, digits)
      real(wp), intent(in) :: x
      integer, intent(in) :: digits
      character(kind=c_char) :: buffer(60)
      character(len=60) :: expected
      integer :: i

      call printf_number(x, int(digits, c_int), buffer, size(buffer, kind=c_size_t))
      expected = ""
      do i = 1, size(buffer)
         if (buffer(i) == c_null_char) exit
         expected(i:i) = buffer(i)
      end do
      compared = compared + 1
      if (written(x, digits) == trim(expected)) return
      wrong = wrong + 1
      if (wrong <= 5) call suite%text(to_text(digits)//" digits of "//to_text(x), written(x, digits), trim(expected))
   end subroutine compare

   function written(x, digits) result(text)
      real(wp), intent(in) :: x
      integer, intent(in) :: digits
      character(len=:), allocatable :: text
      type(row_text), save :: row

      call row%clear()
      call row%add_number(x, digits)
      text = row%bytes(:row%used)
   end function written

   pure function digits_of(i) result(text)
      integer, intent(in) :: i
      character(len=6) :: text

      write(text, '(i6.6)') i
   end function digits_of

end program test_row_text
