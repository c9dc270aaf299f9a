!> What came out of many cases, in a few numbers and the first failures.
module rv_tally
   use rv_kinds, only : i8
   use rv_text, only : text_type, to_text
   use rv_block, only : block_result
   use rv_status, only : n_statuses, n_warnings, status_name, status_ok
   implicit none
   private
   public :: tally_type

   integer, parameter :: most_named = 10   !! failures told one by one

   type :: tally_type
      integer(i8) :: cases = 0
      integer(i8) :: failed = 0
      integer(i8) :: by_status(0:n_statuses - 1) = 0
      integer(i8) :: warned(n_warnings) = 0
      type(text_type) :: failure(most_named)   !! the first failures: "case 17 (film_closed): ..."
      integer :: named = 0                     !! how many of them there are
      integer(i8) :: first_warned(n_warnings) = 0   !! of each warning its first case
      type(text_type) :: warning(n_warnings)   !! and what is told of that case, if that is this warning and nothing else
   contains
      procedure :: add
   end type tally_type

contains

   !> Count a block's cases; blocks come in their order.
   subroutine add(self, result)
      class(tally_type), intent(inout) :: self
      type(block_result), intent(in) :: result
      integer :: i, bit

      do i = 1, size(result%status)
         self%cases = self%cases + 1
         self%by_status(result%status(i)) = self%by_status(result%status(i)) + 1
         do bit = 1, n_warnings
            if (.not. btest(result%warnings(i), bit - 1)) cycle
            self%warned(bit) = self%warned(bit) + 1
            if (self%warned(bit) == 1) call name_warning(self, result, i, bit)
         end do
         if (result%status(i) /= status_ok) call name_failure(self, result, i)
      end do
   end subroutine add

   !> A message tells of the failure and of all warnings of its case.
   subroutine name_warning(self, result, i, bit)
      class(tally_type), intent(inout) :: self
      type(block_result), intent(in) :: result
      integer, intent(in) :: i, bit

      self%first_warned(bit) = result%first + i - 1
      if (result%status(i) == status_ok .and. result%warnings(i) == 2**(bit - 1)) self%warning(bit)%s = result%message(i)%s
   end subroutine name_warning

   subroutine name_failure(self, result, i)
      class(tally_type), intent(inout) :: self
      type(block_result), intent(in) :: result
      integer, intent(in) :: i

      self%failed = self%failed + 1
      if (self%named == most_named) return
      self%named = self%named + 1
      self%failure(self%named)%s = "case "//to_text(result%first + i - 1)//" (" &
         & //status_name(result%status(i))//"): "//result%message(i)%s
   end subroutine name_failure

end module rv_tally
