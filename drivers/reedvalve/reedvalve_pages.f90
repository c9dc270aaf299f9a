!> Prints the manual page of reedvalve or its completion for a shell: `reedvalve_pages man | bash | zsh | fish`.
program reedvalve_pages
   use rv_cli_completion, only : print_bash, print_fish, print_zsh
   use rv_cli_man, only : print_manual
   implicit none
   character(len=4) :: page

   call get_command_argument(1, page)
   select case (page)
   case ("bash")
      call print_bash()
   case ("zsh")
      call print_zsh()
   case ("fish")
      call print_fish()
   case default
      call print_manual()
   end select
end program reedvalve_pages
