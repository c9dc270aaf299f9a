!> Text: lists of strings, numbers in their shortest exact form, lower case.
module rv_text
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan
   use rv_kinds, only : wp, i8
   implicit none
   private
   public :: text_type, to_text, lower

   !> One string in a list of strings of different lengths.
   type :: text_type
      character(len=:), allocatable :: s
   end type text_type

   !> A number as text: integers as they are, reals with the fewest digits that read back the same.
   interface to_text
      module procedure real_to_text
      module procedure rounded_to_text
      module procedure integer_to_text
      module procedure long_to_text
   end interface to_text

contains

   !> The shortest decimal that reads back as `x`: 0.05, 1.5e-7, NaN, Infinity.
   pure function real_to_text(x) result(text)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: text
      integer :: digits
      real(wp) :: back

      if (.not. ieee_is_finite(x)) then
         text = non_finite(x)
         return
      end if
      do digits = 15, 17
         text = rounded_to_text(x, digits)
         read(text, *) back
         if (abs(back - x) <= 0.0_wp) return
      end do
   end function real_to_text

   !> `x` with so many significant digits, trailing zeros dropped, as %g of C would choose the form.
   pure function rounded_to_text(x, digits) result(text)
      real(wp), intent(in) :: x
      integer, intent(in) :: digits           !! 1 to 17
      character(len=:), allocatable :: text
      character(len=40) :: buffer, form
      character(len=:), allocatable :: mantissa
      integer :: exponent, e

      if (.not. ieee_is_finite(x)) then
         text = non_finite(x)
         return
      end if
      write(form, '(a, i0, a)') "(es40.", digits - 1, "e3)"
      write(buffer, form) x
      buffer = adjustl(buffer)
      e = scan(buffer, "E")
      read(buffer(e + 1:), *) exponent
      mantissa = buffer(:e - 1)
      if (exponent >= -4 .and. exponent < max(digits, 6)) then
         write(form, '(a, i0, a)') "(f40.", max(0, digits - 1 - exponent), ")"
         write(buffer, form) x
         buffer = adjustl(buffer)
         text = drop_zeros(trim(buffer))
         if (text(1:1) == ".") text = "0"//text
         if (index(text, "-.") == 1) text = "-0"//text(2:)
      else
         write(buffer, '(i0)') exponent
         text = drop_zeros(mantissa)//"e"//trim(buffer)
      end if
   end function rounded_to_text

   pure function integer_to_text(i) result(text)
      integer, intent(in) :: i
      character(len=:), allocatable :: text

      text = long_to_text(int(i, i8))
   end function integer_to_text

   pure function long_to_text(i) result(text)
      integer(i8), intent(in) :: i
      character(len=:), allocatable :: text
      character(len=24) :: buffer

      write(buffer, '(i0)') i
      text = trim(buffer)
   end function long_to_text

   !> ASCII letters in lower case.
   pure function lower(text) result(low)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: low
      integer :: i, c

      do i = 1, len(text)
         c = iachar(text(i:i))
         if (c >= iachar("A") .and. c <= iachar("Z")) c = c + 32
         low(i:i) = achar(c)
      end do
   end function lower

   pure function non_finite(x) result(text)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: text

      if (ieee_is_nan(x)) then
         text = "NaN"
      else if (x > 0.0_wp) then
         text = "Infinity"
      else
         text = "-Infinity"
      end if
   end function non_finite

   pure function drop_zeros(number) result(short)
      character(len=*), intent(in) :: number
      character(len=:), allocatable :: short
      integer :: last

      short = number
      if (index(number, ".") == 0) return
      last = len(number)
      do while (number(last:last) == "0")
         last = last - 1
      end do
      if (number(last:last) == ".") last = last - 1
      short = number(:last)
   end function drop_zeros

end module rv_text
