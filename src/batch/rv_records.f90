!> Named texts one behind the other in one text, each as `name bytes`, a line end, its bytes, a line end.
!>
!> Any bytes may stand in a value: a deck, or records again.
module rv_records
   use rv_kinds, only : i8
   use rv_text, only : to_text
   implicit none
   private
   public :: add_record, next_record, record_count, record_value

   character(len=1), parameter :: newline = achar(10)

contains

   !> Append one record to `text`.
   pure subroutine add_record(text, name, value)
      character(len=:), allocatable, intent(inout) :: text
      character(len=*), intent(in) :: name        !! without blanks
      character(len=*), intent(in) :: value

      text = text//name//" "//to_text(len(value))//newline//value//newline
   end subroutine add_record

   !> Read the record that begins at `at`; `at` then points behind it. `name` is empty at the end or on damage.
   pure subroutine next_record(text, at, name, value)
      character(len=*), intent(in) :: text
      integer, intent(inout) :: at
      character(len=:), allocatable, intent(out) :: name, value
      integer(i8) :: bytes
      integer :: line_end, blank, status

      name = ""
      value = ""
      if (at > len(text)) return
      line_end = at + index(text(at:), newline) - 1
      blank = at + index(text(at:), " ") - 1
      if (blank <= at .or. line_end < blank) return
      read(text(blank + 1:line_end - 1), *, iostat=status) bytes
      if (status /= 0 .or. bytes < 0 .or. bytes > len(text) - line_end - 1) return
      name = text(at:blank - 1)
      value = text(line_end + 1:line_end + int(bytes))
      at = line_end + int(bytes) + 2
   end subroutine next_record

   !> The value of the first record of that name; empty without one.
   pure function record_value(text, name) result(value)
      character(len=*), intent(in) :: text, name
      character(len=:), allocatable :: value
      character(len=:), allocatable :: found
      integer :: at

      at = 1
      do
         call next_record(text, at, found, value)
         if (found == name .or. found == "") return
      end do
   end function record_value

   !> How many records of that name there are.
   pure integer function record_count(text, name) result(n)
      character(len=*), intent(in) :: text, name
      character(len=:), allocatable :: found, value
      integer :: at

      at = 1
      n = 0
      do
         call next_record(text, at, found, value)
         if (found == "") return
         if (found == name) n = n + 1
      end do
   end function record_count

end module rv_records
