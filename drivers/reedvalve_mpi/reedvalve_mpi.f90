!> `reedvalve` on MPI ranks: mpirun -n 4 reedvalve_mpi run deck.nml takes the same words and writes the same bytes.
program reedvalve_mpi
   use rv_cli_output, only : complain, end_program, exit_failed, status_of
   use rv_cli_words, only : obey_words
   use rv_error, only : error_type
   use rv_posix, only : keep_standard_files
   use rv_rank_crew, only : rank_crew
   implicit none
   type(rank_crew) :: crew
   type(error_type), allocatable :: error
   integer :: status

   call keep_standard_files()
   call crew%start(error)
   call crew%share(error)
   if (allocated(error)) then
      if (crew%leads) call complain(error%message)
      status = status_of(error)
   else
      status = obey_words(crew)
      ! ranks that end early may take the others along
      call crew%share(error)
   end if
   if (crew%is_broken) status = exit_failed
   call crew%finish()
   call end_program(status)
end program reedvalve_mpi
