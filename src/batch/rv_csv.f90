!> Rows of a comma-separated file with the place of every field.
module rv_csv
   use rv_text_file, only : byte_order_mark
   implicit none
   private
   public :: csv_reader, new_csv_reader, field_type

   !> One field, without blanks and quotes around it.
   type :: field_type
      integer :: first = 1, last = 0   !! bytes of the text
      integer :: column = 0            !! of its start in the line
   end type field_type

   !> Reads row after row; lines that are empty or start with # do not count as rows.
   type :: csv_reader
      character(len=:), allocatable :: text
      integer :: line = 0              !! of the row read last
      type(field_type), allocatable :: field(:)
      integer :: fields = 0            !! of the row read last; so many of `field` are in use
      integer, private :: at = 1
   contains
      procedure :: next_row
      procedure :: line_count
      procedure :: word
   end type csv_reader

   character(len=*), parameter :: blanks = " "//achar(9)//achar(13)

contains

   !> Start before the first row.
   pure function new_csv_reader(text) result(reader)
      character(len=*), intent(in) :: text
      type(csv_reader) :: reader

      reader%text = text
      allocate(reader%field(16))
      if (index(text, byte_order_mark) == 1) reader%at = len(byte_order_mark) + 1
   end function new_csv_reader

   !> Go to the next row; false after the last.
   logical function next_row(self)
      class(csv_reader), intent(inout) :: self
      integer :: first, last, length, comment

      next_row = .true.
      do while (self%at <= len(self%text))
         first = self%at
         length = index(self%text(first:), achar(10)) - 1
         if (length < 0) length = len(self%text) - first + 1
         last = first + length - 1
         self%at = last + 2
         self%line = self%line + 1
         if (verify(self%text(first:last), blanks) == 0) cycle
         comment = first + verify(self%text(first:last), " ") - 1
         if (self%text(comment:comment) == "#") cycle
         call split(self, first, last)
         return
      end do
      next_row = .false.
   end function next_row

   !> Cut a line at its commas, but not inside double quotes.
   subroutine split(self, first, last)
      class(csv_reader), intent(inout) :: self
      integer, intent(in) :: first, last
      integer :: i, start
      logical :: in_quotes

      self%fields = 0
      start = first
      in_quotes = .false.
      do i = first, last
         if (self%text(i:i) == '"') in_quotes = .not. in_quotes
         if (in_quotes .or. self%text(i:i) /= ",") cycle
         call append(self, start, i - 1, first)
         start = i + 1
      end do
      call append(self, start, last, first)
   end subroutine split

   subroutine append(self, start, finish, line_start)
      class(csv_reader), intent(inout) :: self
      integer, intent(in) :: start, finish, line_start
      type(field_type) :: new, filler
      integer :: skip

      new%first = start
      new%last = finish
      skip = verify(self%text(start:finish), blanks)
      if (skip > 0) then
         new%first = start + skip - 1
         new%last = start + verify(self%text(start:finish), blanks, back=.true.) - 1
      end if
      new%column = new%first - line_start + 1
      if (skip == 0) new%last = new%first - 1
      if (new%last > new%first) then
         if (self%text(new%first:new%first) == '"' .and. self%text(new%last:new%last) == '"') then
            new%first = new%first + 1
            new%last = new%last - 1
         end if
      end if
      if (self%fields == size(self%field)) self%field = [self%field, spread(filler, 1, self%fields)]
      self%fields = self%fields + 1
      self%field(self%fields) = new
   end subroutine append

   !> Lines of the text, no fewer than it has rows.
   pure integer function line_count(self)
      class(csv_reader), intent(in) :: self
      integer :: i

      line_count = 1
      do i = 1, len(self%text)
         if (self%text(i:i) == achar(10)) line_count = line_count + 1
      end do
   end function line_count

   !> The i-th field of the row.
   pure function word(self, i)
      class(csv_reader), intent(in) :: self
      integer, intent(in) :: i
      character(len=:), allocatable :: word

      word = self%text(self%field(i)%first:self%field(i)%last)
   end function word

end module rv_csv
