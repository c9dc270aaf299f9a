!> `reedvalve fmu`, in a program that was built without FMUs.
module rv_cli_fmu
   use rv_cli_arguments, only : arguments_type
   use rv_cli_output, only : complain, exit_bad
   implicit none
   private
   public :: fmu_command

contains

   integer function fmu_command(arguments) result(status)
      type(arguments_type), intent(in) :: arguments

      call complain("cannot pack '"//arguments%operand//"': this program was built without FMUs (RV_WITH_FMU, which needs" &
         & //" libzip and the header files of FMI)")
      status = exit_bad
   end function fmu_command

end module rv_cli_fmu
