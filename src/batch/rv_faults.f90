!> A list of faults and warnings, each with its place in a file: all of them are told at once.
module rv_faults
   use rv_text, only : to_text
   implicit none
   private
   public :: fault_list, clip

   !> One remark.
   type :: fault_type
      character(len=:), allocatable :: file, text
      integer :: line = 0, column = 0
      logical :: is_warning = .false.
   end type fault_type

   !> Faults and warnings of one deck and the files it names, in order of file, line and column.
   type :: fault_list
      private
      type(fault_type), allocatable :: item(:)   !! the first `held` are in use
      integer :: held = 0
      integer :: fault_count = 0                 !! these two count what was not held, too
      integer :: warning_count = 0
   contains
      procedure :: add
      procedure :: warn
      procedure :: errors
      procedure :: warnings
      procedure :: count => held_count
      procedure :: is_warning
      procedure :: text => item_text
      procedure :: all_text
   end type fault_list

   integer, parameter :: most_held = 200   !! a person reads no more, and a broken file can have millions

contains

   !> Add a fault.
   pure subroutine add(self, file, line, column, text)
      class(fault_list), intent(inout) :: self
      character(len=*), intent(in) :: file
      integer, intent(in) :: line, column   !! from 1; 0: the place has none
      character(len=*), intent(in) :: text

      self%fault_count = self%fault_count + 1
      call insert(self, file, line, column, text, is_warning=.false.)
   end subroutine add

   !> Add a warning.
   pure subroutine warn(self, file, line, column, text)
      class(fault_list), intent(inout) :: self
      character(len=*), intent(in) :: file
      integer, intent(in) :: line, column
      character(len=*), intent(in) :: text

      self%warning_count = self%warning_count + 1
      call insert(self, file, line, column, text, is_warning=.true.)
   end subroutine warn

   !> How many faults.
   pure integer function errors(self)
      class(fault_list), intent(in) :: self

      errors = self%fault_count
   end function errors

   !> How many warnings.
   pure integer function warnings(self)
      class(fault_list), intent(in) :: self

      warnings = self%warning_count
   end function warnings

   !> How many remarks can be read with `text`: all, up to a limit.
   pure integer function held_count(self)
      class(fault_list), intent(in) :: self

      held_count = self%held
   end function held_count

   pure logical function is_warning(self, i)
      class(fault_list), intent(in) :: self
      integer, intent(in) :: i

      is_warning = self%item(i)%is_warning
   end function is_warning

   !> "deck.nml:12:8: film.gap_mm = -0.05: must be >= 0 (mm)"; a warning says so after the place. Settings that are of no
   !> file have no place.
   pure function item_text(self, i) result(text)
      class(fault_list), intent(in) :: self
      integer, intent(in) :: i
      character(len=:), allocatable :: text

      associate (item => self%item(i))
         text = item%file
         if (item%line > 0) text = text//":"//to_text(item%line)
         if (item%line > 0 .and. item%column > 0) text = text//":"//to_text(item%column)
         if (text /= "") text = text//": "
         if (item%is_warning) text = text//"warning: "
         text = text//item%text
      end associate
   end function item_text

   !> Every remark on a line of its own, and how many more there are.
   pure function all_text(self) result(text)
      class(fault_list), intent(in) :: self
      character(len=:), allocatable :: text
      integer :: i, more

      text = ""
      do i = 1, self%held
         text = text//self%text(i)//new_line("a")
      end do
      more = self%fault_count + self%warning_count - self%held
      if (more > 0) text = text//"and "//to_text(more)//" more"//new_line("a")
   end function all_text

   !> Put `new` behind what stands before it in the same file; the files keep the order of their first remark.
   pure subroutine insert(self, file, line, column, text, is_warning)
      class(fault_list), intent(inout) :: self
      character(len=*), intent(in) :: file, text
      integer, intent(in) :: line, column
      logical, intent(in) :: is_warning
      type(fault_type) :: new
      integer :: i, place

      if (.not. allocated(self%item)) allocate(self%item(most_held))
      if (self%held >= merge(most_held/2, most_held, is_warning)) return
      new%file = file
      new%text = text
      new%line = line
      new%column = column
      new%is_warning = is_warning
      place = self%held + 1
      do i = self%held, 1, -1
         if (self%item(i)%file /= file) cycle
         place = i
         if (is_before(new, self%item(i))) cycle
         place = i + 1
         exit
      end do
      do i = self%held, place, -1
         self%item(i + 1) = self%item(i)
      end do
      self%item(place) = new
      self%held = self%held + 1
   end subroutine insert

   pure logical function is_before(a, b)
      type(fault_type), intent(in) :: a, b

      is_before = a%line < b%line .or. (a%line == b%line .and. a%column < b%column)
   end function is_before

   !> `text` cut to a length that fits into a message.
   pure function clip(text, longest) result(short)
      character(len=*), intent(in) :: text
      integer, intent(in) :: longest
      character(len=:), allocatable :: short

      integer :: last

      short = text
      if (len(text) <= longest) return
      last = longest - 3
      do while (last > 0)   ! never inside a character of several bytes
         if (iachar(text(last + 1:last + 1)) < 128 .or. iachar(text(last + 1:last + 1)) >= 192) exit
         last = last - 1
      end do
      short = text(:last)//"..."
   end function clip

end module rv_faults
