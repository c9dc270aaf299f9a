!> The command line program: `reedvalve run deck.nml` and its like; `reedvalve --help` tells them all.
program reedvalve
   use rv_cli_output, only : end_program
   use rv_cli_words, only : obey_words
   use rv_crew, only : lone_crew
   use rv_posix, only : keep_standard_files
   implicit none
   type(lone_crew) :: crew
   integer :: status

   call keep_standard_files()
   status = obey_words(crew)
   call end_program(status)
end program reedvalve
