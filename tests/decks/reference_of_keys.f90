!> Prints the reference of all keys; with a file name, compares it with that file and says how to renew it.
program reference_of_keys
   use, intrinsic :: iso_fortran_env, only : int64, output_unit
   use rv_error, only : error_type
   use rv_key_text, only : key_reference
   use rv_text_file, only : read_text_file
   implicit none
   character(len=:), allocatable :: text, held
   character(len=4096) :: path, program_name
   type(error_type), allocatable :: error

   call key_reference(text)
   call get_command_argument(1, path)
   if (path == "") then
      write(output_unit, '(a)', advance="no") text
      stop
   end if
   call read_text_file(trim(path), 8388608_int64, held, error)
   if (.not. allocated(error) .and. held == text .and. len(held) == len(text)) stop
   call get_command_argument(0, program_name)
   write(output_unit, '(a)') trim(path)//" is stale; renew it with", "   "//trim(program_name)//" > "//trim(path)
   error stop 1
end program reference_of_keys
