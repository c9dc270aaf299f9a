!> Reading a deck: all its faults at once, or the values and axes of its cases.
module rv_deck
   use rv_error, only : error_type, fail, rv_internal
   use rv_faults, only : fault_list
   use rv_cases, only : deck_type, axis_type
   implicit none
   private
   public :: deck_type, axis_type, read_deck

contains

   !> Read and check a deck. `error` tells of trouble with its file only; a deck with faults is not fit to run.
   subroutine read_deck(path, deck, faults, error)
      character(len=*), intent(in) :: path
      type(deck_type), intent(out) :: deck
      type(fault_list), intent(out) :: faults     !! all faults and warnings, with their places
      type(error_type), allocatable, intent(out) :: error

      deck%path = path
      call faults%add(path, 0, 0, "not read yet")
      call fail(error, rv_internal, "decks cannot be read yet")
   end subroutine read_deck

end module rv_deck
