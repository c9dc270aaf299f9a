!> Texts put together from many pieces, at a cost that grows with their length only, and lists of texts.
module rv_text_builder
   use rv_text, only : text_type
   implicit none
   private
   public :: text_builder, append_text

   !> Room doubles when it runs out.
   type :: text_builder
      private
      character(len=:), allocatable :: room
      integer :: used = 0
   contains
      procedure :: add
      procedure :: line
      procedure :: text
   end type text_builder

contains

   !> Append a piece.
   pure subroutine add(self, piece)
      class(text_builder), intent(inout) :: self
      character(len=*), intent(in) :: piece
      character(len=:), allocatable :: larger

      if (.not. allocated(self%room)) allocate(character(len=4096) :: self%room)
      if (self%used + len(piece) > len(self%room)) then
         allocate(character(len=2*(self%used + len(piece))) :: larger)
         larger(:self%used) = self%room(:self%used)
         call move_alloc(larger, self%room)
      end if
      self%room(self%used + 1:self%used + len(piece)) = piece
      self%used = self%used + len(piece)
   end subroutine add

   !> Append a line.
   pure subroutine line(self, piece)
      class(text_builder), intent(inout) :: self
      character(len=*), intent(in) :: piece

      call self%add(piece)
      call self%add(new_line("a"))
   end subroutine line

   !> All of it.
   pure function text(self)
      class(text_builder), intent(in) :: self
      character(len=:), allocatable :: text

      text = ""
      if (allocated(self%room)) text = self%room(:self%used)
   end function text

   !> One more text in a list. (The array constructor [list, text_type(piece)] frees foreign memory in gfortran 12.)
   pure subroutine append_text(list, piece)
      type(text_type), allocatable, intent(inout) :: list(:)
      character(len=*), intent(in) :: piece
      type(text_type), allocatable :: longer(:)
      integer :: i

      allocate(longer(size(list) + 1))
      do i = 1, size(list)
         call move_alloc(list(i)%s, longer(i)%s)
      end do
      longer(size(longer))%s = piece
      call move_alloc(longer, list)
   end subroutine append_text

end module rv_text_builder
