!> What the program says, and how it ends. Results of a command go to standard output, all else to standard error.
module rv_cli_output
   use, intrinsic :: iso_c_binding, only : c_int, c_loc, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only : error_unit
   use rv_error, only : error_type, rv_bad_input, rv_io
   implicit none
   private
   public :: say, complain, remark, status_of, end_program
   public :: exit_fine, exit_failed, exit_bad, exit_io, exit_internal

   integer, parameter :: exit_fine = 0
   integer, parameter :: exit_failed = 1     !! some cases failed, or the run was stopped
   integer, parameter :: exit_bad = 2        !! bad command line or deck
   integer, parameter :: exit_io = 3         !! input or output trouble
   integer, parameter :: exit_internal = 4   !! a fault of this code

   interface
      integer(c_size_t) function c_write(fd, data, size) bind(C, name="write")
         import :: c_int, c_ptr, c_size_t
         integer(c_int), value :: fd
         type(c_ptr), value :: data
         integer(c_size_t), value :: size
      end function c_write
      subroutine c_exit(status) bind(C, name="exit")
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit
      subroutine c_exit_at_once(status) bind(C, name="_exit")
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit_at_once
   end interface

contains

   !> Lines for standard output, past Fortran's own unit, which does not tell when a disk is full.
   subroutine say(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable, target :: rest
      integer(c_size_t) :: done

      rest = text//new_line("a")
      do while (len(rest) > 0)
         done = c_write(1_c_int, c_loc(rest), len(rest, kind=c_size_t))
         if (done <= 0) then
            call complain("cannot write to standard output")
            call c_exit_at_once(int(exit_io, c_int))
         end if
         rest = rest(done + 1:)
      end do
   end subroutine say

   !> A line for standard error, with the program's name.
   subroutine complain(text)
      character(len=*), intent(in) :: text

      call remark("reedvalve: "//text)
   end subroutine complain

   !> A line for standard error as it is: what begins with file and line, so that editors find the place.
   subroutine remark(text)
      character(len=*), intent(in) :: text
      integer :: flag

      write(error_unit, '(a)', iostat=flag) text
      flush(error_unit)
      if (flag /= 0) call c_exit_at_once(int(exit_io, c_int))   ! nobody is left to tell
   end subroutine remark

   !> The exit status for an error of the library.
   pure integer function status_of(error) result(status)
      type(error_type), intent(in) :: error

      select case (error%code)
      case (rv_bad_input)
         status = exit_bad
      case (rv_io)
         status = exit_io
      case default
         status = exit_internal
      end select
   end function status_of

   subroutine end_program(status)
      integer, intent(in) :: status

      ! HDF5 may crash in its own clean-up after a write that failed for want of room
      if (status >= exit_io) call c_exit_at_once(int(status, c_int))
      call c_exit(int(status, c_int))
   end subroutine end_program

end module rv_cli_output
