!> Text: lists of strings, numbers in their shortest exact form, lower case.
!>
!> No function here has a deferred-length result: gfortran 12 keeps the length of such a result in a static
!> variable of the calling procedure, so that two threads in one procedure would cut each other's texts.
module rv_text
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan
   use rv_kinds, only : wp, i8
   implicit none
   private
   public :: text_type, to_text, time_text, lower

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

   integer, parameter :: longest = 40  !! of a number's text; what is not used is blank

contains

   !> The shortest decimal that reads back as `x`: 0.05, 1.5e-7, NaN, Infinity.
   pure function real_to_text(x) result(text)
      real(wp), intent(in) :: x
      character(len=len_trim(shortest(x), i8)) :: text

      text = shortest(x)
   end function real_to_text

   !> `x` with so many significant digits, trailing zeros dropped, as %g of C would choose the form.
   pure function rounded_to_text(x, digits) result(text)
      real(wp), intent(in) :: x
      integer, intent(in) :: digits           !! 1 to 17
      character(len=len_trim(rounded(x, digits), i8)) :: text

      text = rounded(x, digits)
   end function rounded_to_text

   pure function integer_to_text(i) result(text)
      integer, intent(in) :: i
      character(len=len_trim(whole(int(i, i8)), i8)) :: text

      text = whole(int(i, i8))
   end function integer_to_text

   pure function long_to_text(i) result(text)
      integer(i8), intent(in) :: i
      character(len=len_trim(whole(i), i8)) :: text

      text = whole(i)
   end function long_to_text

   !> An instant as decks and results give it: "22.3235 ms".
   pure function time_text(t) result(text)
      real(wp), intent(in) :: t   !! [s]
      character(len=len_trim(rounded(1.0e3_wp*t, 6), i8) + 3) :: text

      text = trim(rounded(1.0e3_wp*t, 6))//" ms"
   end function time_text

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

   pure function whole(i) result(text)
      integer(i8), intent(in) :: i
      character(len=longest) :: text

      write(text, '(i0)') i
   end function whole

   pure function shortest(x) result(text)
      real(wp), intent(in) :: x
      character(len=longest) :: text
      integer :: digits
      real(wp) :: back

      do digits = 15, 17
         text = rounded(x, digits)
         if (.not. ieee_is_finite(x)) return
         read(text, *) back
         if (abs(back - x) <= 0.0_wp) return
      end do
   end function shortest

   pure function rounded(x, digits) result(text)
      real(wp), intent(in) :: x
      integer, intent(in) :: digits
      character(len=longest) :: text
      character(len=longest) :: buffer, form
      integer :: exponent, e

      if (.not. ieee_is_finite(x)) then
         text = merge("NaN      ", merge("Infinity ", "-Infinity", x > 0.0_wp), ieee_is_nan(x))
         return
      end if
      write(form, '(a, i0, a)') "(es40.", digits - 1, "e3)"
      write(buffer, form) x
      buffer = adjustl(buffer)
      e = scan(buffer, "E")
      read(buffer(e + 1:), *) exponent
      if (exponent >= -4 .and. exponent < max(digits, 6)) then
         write(form, '(a, i0, a)') "(f40.", max(0, digits - 1 - exponent), ")"
         write(buffer, form) x
         text = adjustl(buffer)
         call drop_zeros(text)
         if (text(1:1) == ".") text = "0"//text(:longest - 1)
         if (index(text, "-.") == 1) text = "-0"//text(2:longest - 1)
      else
         text = buffer(:e - 1)
         call drop_zeros(text)
         write(text(len_trim(text) + 1:), '("e", i0)') exponent
      end if
   end function rounded

   !> Drop the zeros that end a fraction, and the point if nothing follows it.
   pure subroutine drop_zeros(number)
      character(len=longest), intent(inout) :: number
      integer :: last

      if (index(number, ".") == 0) return
      last = len_trim(number)
      do while (number(last:last) == "0")
         last = last - 1
      end do
      if (number(last:last) == ".") last = last - 1
      number(last + 1:) = ""
   end subroutine drop_zeros

end module rv_text
