!> The command line program: `reedvalve run deck.nml` and its like; `reedvalve --help` tells them all.
program reedvalve
   use rv_cli_arguments, only : arguments_type, read_arguments
   use rv_cli_commands, only : cases_command, check_command, merge_command, modes_command, &
      & run_command, template_command
   use rv_cli_help, only : print_help, print_version
   use rv_cli_output, only : complain, end_program, exit_bad, exit_fine
   use rv_error, only : error_type
   use rv_posix, only : keep_standard_files
   implicit none
   type(arguments_type) :: arguments
   type(error_type), allocatable :: error
   integer :: status

   call keep_standard_files()
   call read_arguments(arguments, error)
   status = exit_fine
   if (allocated(error)) then
      call complain(error%message)
      call complain("reedvalve --help tells what there is")
      status = exit_bad
   else
      select case (arguments%command)
      case ("run")
         status = run_command(arguments)
      case ("merge")
         status = merge_command(arguments)
      case ("check")
         status = check_command(arguments)
      case ("cases")
         status = cases_command(arguments)
      case ("modes")
         status = modes_command(arguments)
      case ("template")
         status = template_command(arguments)
      case ("version")
         call print_version()
      case default
         call print_help()
      end select
   end if
   call end_program(status)
end program reedvalve
