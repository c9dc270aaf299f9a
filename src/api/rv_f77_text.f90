!> Texts of Fortran 77: of fixed length, padded with blanks, and their NUL-terminated copies for the C API.
module rv_f77_text
   use, intrinsic :: iso_c_binding, only : c_char, c_null_char
   implicit none
   private
   public :: as_text, to_c, to_f77

contains

   !> The same characters as one text.
   pure function as_text(text) result(whole)
      character(kind=c_char), intent(in) :: text(:)
      character(len=size(text)) :: whole
      integer :: i

      do i = 1, size(text)
         whole(i:i) = text(i)
      end do
   end function as_text

   !> The text without the blanks behind it.
   subroutine to_c(text, copy)
      character(kind=c_char), intent(in) :: text(:)
      character(kind=c_char), allocatable, intent(out) :: copy(:)
      integer :: n

      do n = size(text), 1, -1
         if (text(n) /= " ") exit
      end do
      allocate(copy(n + 1))
      copy(:n) = text(:n)
      copy(n + 1) = c_null_char
   end subroutine to_c

   !> Blanks in place of the NUL and what lies behind it; cut to fit.
   subroutine to_f77(copy, text)
      character(kind=c_char), intent(in) :: copy(:)
      character(kind=c_char), intent(out) :: text(:)
      integer :: n

      text = " "
      do n = 1, min(size(copy), size(text))
         if (copy(n) == c_null_char) exit
         text(n) = copy(n)
      end do
   end subroutine to_f77

end module rv_f77_text
