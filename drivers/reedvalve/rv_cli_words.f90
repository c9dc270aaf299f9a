!> From the words of the command line to an exit status, for one process or a crew of them.
module rv_cli_words
   use rv_cli_arguments, only : arguments_type, read_arguments
   use rv_cli_commands, only : cases_command, check_command, merge_command, modes_command, run_command, template_command
   use rv_cli_fmu, only : fmu_command
   use rv_cli_help, only : print_help, print_version
   use rv_cli_output, only : complain, exit_bad, exit_fine
   use rv_crew, only : crew_type
   use rv_error, only : error_type
   implicit none
   private
   public :: obey_words

contains

   !> Do what the command line says. All of a crew run a deck; everything else, and speaking, is its leader's.
   integer function obey_words(crew) result(status)
      class(crew_type), intent(inout) :: crew
      type(arguments_type) :: arguments
      type(error_type), allocatable :: error

      status = exit_fine
      call read_arguments(arguments, error)
      if (.not. allocated(error)) then
         if (arguments%command == "run") then
            status = run_command(arguments, crew)
         else if (crew%leads) then
            status = obey_leader(arguments)
         end if
      else if (crew%leads) then
         call complain(error%message)
         call complain("reedvalve --help tells what there is")
         status = exit_bad
      end if
   end function obey_words

   integer function obey_leader(arguments) result(status)
      type(arguments_type), intent(in) :: arguments

      status = exit_fine
      select case (arguments%command)
      case ("merge")
         status = merge_command(arguments)
      case ("check")
         status = check_command(arguments)
      case ("cases")
         status = cases_command(arguments)
      case ("modes")
         status = modes_command(arguments)
      case ("fmu")
         status = fmu_command(arguments)
      case ("template")
         status = template_command(arguments)
      case ("version")
         call print_version()
      case default
         call print_help()
      end select
   end function obey_leader

end module rv_cli_words
