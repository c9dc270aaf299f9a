!> Texts of C: NUL-terminated, in buffers whose size the caller tells.
module rv_c_text
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_f_pointer, c_null_char, c_ptr, c_size_t
   implicit none
   private
   public :: take_text, give_text, give_lines, longest_text

   integer, parameter :: longest_text = 4096   !! that is taken from a caller [byte]

contains

   !> A text of the caller's. Not taken: NULL, or no end within longest_text bytes.
   subroutine take_text(from, text, taken)
      type(c_ptr), intent(in) :: from
      character(len=:), allocatable, intent(out) :: text
      logical, intent(out) :: taken
      character(kind=c_char), pointer :: byte(:)
      integer :: i, n

      text = ""
      taken = .false.
      if (.not. c_associated(from)) return
      call c_f_pointer(from, byte, [longest_text + 1])   ! what lies behind the NUL is not looked at
      do n = 0, longest_text
         if (byte(n + 1) == c_null_char) exit
      end do
      if (n > longest_text) return
      taken = .true.
      deallocate(text)
      allocate(character(len=n) :: text)
      do i = 1, n
         text(i:i) = byte(i)
      end do
   end subroutine take_text

   !> Put a text into the caller's buffer, cut to size - 1 bytes. A NULL or empty buffer gets nothing.
   subroutine give_text(text, buffer, size)
      character(len=*), intent(in) :: text
      type(c_ptr), intent(in) :: buffer
      integer(c_size_t), intent(in) :: size
      character(kind=c_char), pointer :: byte(:)
      integer(c_size_t) :: i, n

      if (.not. c_associated(buffer) .or. size < 1) return   ! sizes of more than half the memory look negative
      n = min(len(text, c_size_t), size - 1)
      call c_f_pointer(buffer, byte, [n + 1])
      do i = 1, n
         byte(i) = text(i:i)
      end do
      byte(n + 1) = c_null_char
   end subroutine give_text

   !> The same for lines, of which the last one comes without its end.
   subroutine give_lines(text, buffer, size)
      character(len=*), intent(in) :: text
      type(c_ptr), intent(in) :: buffer
      integer(c_size_t), intent(in) :: size
      integer :: n

      n = len(text)
      if (n > 0) then
         if (text(n:n) == new_line("a")) n = n - 1
      end if
      call give_text(text(:n), buffer, size)
   end subroutine give_lines

end module rv_c_text
