!> `reedvalve fmu`, in a program that was built with FMUs.
module rv_cli_fmu
   use rv_cli_arguments, only : arguments_type
   use rv_cli_commands, only : load_deck
   use rv_cli_output, only : complain, exit_fine, say, status_of
   use rv_deck, only : deck_type
   use rv_error, only : error_type
   use rv_fmu_description, only : counts_text
   use rv_fmu_pack, only : pack_fmu
   implicit none
   private
   public :: fmu_command

contains

   integer function fmu_command(arguments) result(status)
      type(arguments_type), intent(in) :: arguments
      type(deck_type) :: deck
      type(error_type), allocatable :: error
      character(len=:), allocatable :: path

      status = load_deck(arguments, deck)
      if (status /= exit_fine) return
      path = arguments%folder
      if (path == "") path = deck%name//".fmu"
      call pack_fmu(deck, arguments%fmi, path, arguments%force, error)
      if (allocated(error)) then
         call complain(error%message)
         status = status_of(error)
      else if (.not. arguments%quiet) then
         call say(path//": "//counts_text(deck)//".")
      end if
   end function fmu_command

end module rv_cli_fmu
