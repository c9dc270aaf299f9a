!> Text put together at speed: rows of numbers and words, in room that is kept from use to use.
module rv_row_text
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int, c_int64_t
   use rv_kinds, only : wp, i8
   implicit none
   private
   public :: field_type, row_text

   integer(i8), parameter :: least_room = 4096
   integer, parameter :: number_room = 40   !! what rv_decimal may write, more than a number is long

   !> Where a column's number stands in the row before: nowhere, to begin with.
   type, bind(C) :: field_type
      private
      real(c_double) :: x = 0.0_wp
      integer(c_int64_t) :: at = 0, length = 0
   end type field_type

   !> bytes(:used) is the text.
   type :: row_text
      character(len=:), allocatable :: bytes
      integer(i8) :: used = 0
   contains
      procedure :: clear
      procedure :: add
      procedure :: add_number
      procedure :: add_fields
      procedure :: add_whole
      procedure, private :: make_room
   end type row_text

   interface
      pure subroutine c_number(x, digits, text, length) bind(C, name="rv_decimal_number")
         import :: c_char, c_double, c_int
         real(c_double), value :: x
         integer(c_int), value :: digits
         character(kind=c_char), intent(inout) :: text(*)
         integer(c_int), intent(out) :: length
      end subroutine c_number
      pure subroutine c_fields(x, n, digits, above, text, used) bind(C, name="rv_decimal_fields")
         import :: c_char, c_double, c_int, c_int64_t, field_type
         integer(c_int), value :: n, digits
         real(c_double), intent(in) :: x(n)
         type(field_type), intent(inout) :: above(n)
         character(kind=c_char), intent(inout) :: text(*)
         integer(c_int64_t), intent(inout) :: used
      end subroutine c_fields
      pure subroutine c_whole(i, text, length) bind(C, name="rv_decimal_whole")
         import :: c_char, c_int, c_int64_t
         integer(c_int64_t), value :: i
         character(kind=c_char), intent(inout) :: text(*)
         integer(c_int), intent(out) :: length
      end subroutine c_whole
   end interface

contains

   !> Start anew; the room stays.
   pure subroutine clear(self)
      class(row_text), intent(inout) :: self

      self%used = 0
   end subroutine clear

   pure subroutine add(self, piece)
      class(row_text), intent(inout) :: self
      character(len=*), intent(in) :: piece

      call self%make_room(len(piece, i8))
      self%bytes(self%used + 1:self%used + len(piece)) = piece
      self%used = self%used + len(piece)
   end subroutine add

   !> A number with so many significant digits, as %g of C.
   pure subroutine add_number(self, x, digits)
      class(row_text), intent(inout) :: self
      real(wp), intent(in) :: x
      integer, intent(in) :: digits
      integer(c_int) :: length

      call self%make_room(int(number_room, i8))
      call c_number(x, int(digits, c_int), self%bytes(self%used + 1:self%used + number_room), length)
      self%used = self%used + length
   end subroutine add_number

   !> A comma and a number for each column, no number for a NaN. What a column repeats is copied from the row before,
   !> in the same text: `above` is of the columns' last call since the text was cleared, or new.
   pure subroutine add_fields(self, x, digits, above)
      class(row_text), intent(inout) :: self
      real(wp), intent(in) :: x(:)
      integer, intent(in) :: digits
      type(field_type), intent(inout) :: above(:)

      call self%make_room(size(x)*(number_room + 1_i8))
      call c_fields(x, size(x, kind=c_int), int(digits, c_int), above, self%bytes, self%used)
   end subroutine add_fields

   !> A whole number, not negative.
   pure subroutine add_whole(self, i)
      class(row_text), intent(inout) :: self
      integer(i8), intent(in) :: i
      integer(c_int) :: length

      call self%make_room(int(number_room, i8))
      call c_whole(i, self%bytes(self%used + 1:self%used + number_room), length)
      self%used = self%used + length
   end subroutine add_whole

   !> Room doubles when it runs out.
   pure subroutine make_room(self, more)
      class(row_text), intent(inout) :: self
      integer(i8), intent(in) :: more          !! bytes to come
      character(len=:), allocatable :: larger

      if (.not. allocated(self%bytes)) allocate(character(len=max(least_room, more)) :: self%bytes)
      if (self%used + more <= len(self%bytes, i8)) return
      allocate(character(len=2*(self%used + more)) :: larger)
      larger(:self%used) = self%bytes(:self%used)
      call move_alloc(larger, self%bytes)
   end subroutine make_room

end module rv_row_text
