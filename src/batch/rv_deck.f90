!> Reading a deck: all its faults at once, or the values and axes of its cases.
module rv_deck
   use, intrinsic :: iso_fortran_env, only : int64
   use rv_error, only : error_type, rv_bad_input
   use rv_text, only : lower
   use rv_faults, only : fault_list
   use rv_text_file, only : read_text_file, check_encoding, folder_of
   use rv_deck_scan, only : scan_deck
   use rv_deck_draft, only : draft_type, find_keys
   use rv_deck_settings, only : read_settings, default_by_model
   use rv_deck_sweeps, only : read_sweeps
   use rv_design, only : read_design
   use rv_deck_check, only : check_deck
   use rv_cases, only : deck_type, axis_type
   implicit none
   private
   public :: deck_type, axis_type, read_deck, start_deck

   integer(int64), parameter :: most_bytes = 8388608_int64

contains

   !> Read and check a deck. `error` tells of trouble with its file only; a deck with faults is not fit to run.
   subroutine read_deck(path, deck, faults, error)
      character(len=*), intent(in) :: path
      type(deck_type), intent(out) :: deck
      type(fault_list), intent(out) :: faults     !! all faults and warnings, with their places
      type(error_type), allocatable, intent(out) :: error
      type(draft_type) :: draft

      call start_deck(path, draft%deck)
      call read_text_file(path, most_bytes, draft%deck%text, error)
      if (allocated(error)) then
         call add_hint(path, error)
         if (error%code /= rv_bad_input) return
         call draft%faults%add(path, 0, 0, error%message)
         deallocate(error)
      else if (len(draft%deck%text) == 0) then
         call draft%faults%add(path, 0, 0, "the file is empty; `reedvalve template` prints a deck to start from")
      else
         call check_encoding(draft%deck%text, path, draft%faults)
         if (draft%faults%errors() == 0) call read_text(draft)
      end if
      deck = draft%deck
      faults = draft%faults
   end subroutine read_deck

   !> The deck's name without its end, or the folder of its results, is easily given for the deck.
   subroutine add_hint(path, error)
      character(len=*), intent(in) :: path
      type(error_type), intent(inout) :: error
      character(len=:), allocatable :: deck
      logical :: exists

      deck = path//".nml"
      if (len(path) > 1) deck = path(:verify(path, "/", back=.true.))//".nml"
      inquire(file=deck, exist=exists)
      if (exists) then
         error%message = error%message//"; did you mean '"//deck//"'?"
         return
      end if
      inquire(file=path//"/results.nc", exist=exists)
      if (exists) error%message = "'"//path//"' is a folder with results, not a deck"
   end subroutine add_hint

   !> Names and empty lists.
   subroutine start_deck(path, deck)
      character(len=*), intent(in) :: path
      type(deck_type), intent(inout) :: deck
      integer :: dot

      deck%path = path
      deck%folder = folder_of(path)
      deck%name = path(len(deck%folder) + 1:)
      dot = index(lower(deck%name), ".nml", back=.true.)
      if (dot > 1 .and. dot == len(deck%name) - 3) deck%name = deck%name(:dot - 1)
      deck%title = ""
      allocate(deck%axis(0), deck%trace_name(0), deck%trace_mention(0), deck%trace_file(0))
   end subroutine start_deck

   subroutine read_text(draft)
      type(draft_type), intent(inout) :: draft

      call scan_deck(draft%deck%text, draft%deck%path, draft%scan, draft%faults)
      if (draft%scan%groups == 0 .and. draft%faults%errors() == 0) call draft%faults%add(draft%deck%path, 1, 1, &
         & "there is no group in this deck; `reedvalve template` prints a deck to start from")
      call find_keys(draft)
      call read_settings(draft)
      call read_sweeps(draft)
      call read_design(draft)
      call default_by_model(draft%deck)
      call check_deck(draft)
   end subroutine read_text

end module rv_deck
