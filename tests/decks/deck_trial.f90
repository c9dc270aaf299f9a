!> Decks from a line of text: written to a file, read, and what was said about them compared.
module deck_trial
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_deck, only : deck_type, read_deck
   use check, only : suite_type
   implicit none
   private
   public :: says, read_trial, write_file, lines

   character(len=*), parameter :: trial = "trial.nml"

contains

   !> The deck `text` draws exactly the remarks `expected`; ~ is a line end in both, @ the deck's name.
   subroutine says(suite, what, text, expected)
      type(suite_type), intent(inout) :: suite
      character(len=*), intent(in) :: what, text, expected
      type(deck_type) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      character(len=:), allocatable :: wanted

      call read_trial(text, deck, faults, error)
      call suite%no_error(what//" (file)", error)
      wanted = exchange(lines(expected), "@", trial)
      if (wanted /= "") wanted = wanted//new_line("a")
      call suite%text(what, faults%all_text(), wanted)
      call suite%equal(what//" (length)", len(faults%all_text()), len(wanted))
   end subroutine says

   subroutine read_trial(text, deck, faults, error)
      character(len=*), intent(in) :: text
      type(deck_type), intent(out) :: deck
      type(fault_list), intent(out) :: faults
      type(error_type), allocatable, intent(out) :: error

      call write_file(trial, lines(text))
      call read_deck(trial, deck, faults, error)
   end subroutine read_trial

   subroutine write_file(path, text)
      character(len=*), intent(in) :: path, text
      integer :: unit

      open(newunit=unit, file=path, access="stream", form="unformatted", status="replace", action="write")
      write(unit) text
      close(unit)
   end subroutine write_file

   !> ~ as a line end.
   function lines(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: lines

      lines = exchange(text, "~", new_line("a"))
   end function lines

   function exchange(text, old, new) result(changed)
      character(len=*), intent(in) :: text
      character(len=1), intent(in) :: old
      character(len=*), intent(in) :: new
      character(len=:), allocatable :: changed
      integer :: i

      changed = ""
      do i = 1, len(text)
         if (text(i:i) == old) then
            changed = changed//new
         else
            changed = changed//text(i:i)
         end if
      end do
   end function exchange

end module deck_trial
