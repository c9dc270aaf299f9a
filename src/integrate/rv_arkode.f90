!> The C shim rv_arkode.h as seen from Fortran. Only the run of a group of lanes uses it.
module rv_arkode
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_funptr, c_int, c_null_char, c_ptr
   implicit none
   private
   public :: rv_arkode_new, rv_arkode_step, rv_arkode_restart, rv_arkode_fix_step
   public :: rv_arkode_worst_lane, rv_arkode_free, get_arkode_message, sundials_version
   public :: rv_stepped, rv_at_stop

   integer(c_int), parameter :: rv_stepped = 0   !! one step done
   integer(c_int), parameter :: rv_at_stop = 1   !! one step done, the stop time is reached

   interface
      integer(c_int) function rv_arkode_new(lanes, states, t0, q0, v0, table, first_step, rhs, stage, weight, data, self) &
         & bind(C)
         import :: c_char, c_double, c_funptr, c_int, c_ptr
         integer(c_int), value :: lanes, states
         real(c_double), value :: t0
         real(c_double), intent(in) :: q0(*), v0(*)
         character(kind=c_char), intent(in) :: table(*)
         real(c_double), value :: first_step
         type(c_funptr), value :: rhs, stage, weight
         type(c_ptr), value :: data
         type(c_ptr), intent(out) :: self
      end function rv_arkode_new

      integer(c_int) function rv_arkode_step(self, t_stop, t, q, v) bind(C)
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: self
         real(c_double), value :: t_stop
         real(c_double), intent(inout) :: t
         real(c_double), intent(inout) :: q(*), v(*)
      end function rv_arkode_step

      integer(c_int) function rv_arkode_restart(self, t, q, v) bind(C)
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: self
         real(c_double), value :: t
         real(c_double), intent(in) :: q(*), v(*)
      end function rv_arkode_restart

      integer(c_int) function rv_arkode_fix_step(self, step) bind(C)
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: self
         real(c_double), value :: step
      end function rv_arkode_fix_step

      integer(c_int) function rv_arkode_worst_lane(self) bind(C)
         import :: c_int, c_ptr
         type(c_ptr), value :: self
      end function rv_arkode_worst_lane

      subroutine rv_arkode_message(self, buffer, size) bind(C)
         import :: c_char, c_int, c_ptr
         type(c_ptr), value :: self
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_int), value :: size
      end subroutine rv_arkode_message

      subroutine rv_arkode_free(self) bind(C)
         import :: c_ptr
         type(c_ptr), intent(inout) :: self
      end subroutine rv_arkode_free

      subroutine rv_sundials_version(buffer, size) bind(C)
         import :: c_char, c_int
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_int), value :: size
      end subroutine rv_sundials_version
   end interface

   integer, parameter :: longest = 256

contains

   !> What went wrong in the last call that returned a negative flag.
   !>
   !> No function, for the sake of threads: see rv_text.
   subroutine get_arkode_message(self, text)
      type(c_ptr), intent(in) :: self
      character(len=:), allocatable, intent(out) :: text
      character(kind=c_char) :: buffer(longest)

      call rv_arkode_message(self, buffer, int(longest, c_int))
      call from_c(buffer, text)
   end subroutine get_arkode_message

   !> Version of SUNDIALS at run time.
   function sundials_version() result(text)
      character(len=:), allocatable :: text
      character(kind=c_char) :: buffer(longest)

      call rv_sundials_version(buffer, int(longest, c_int))
      call from_c(buffer, text)
   end function sundials_version

   pure subroutine from_c(buffer, text)
      character(kind=c_char), intent(in) :: buffer(:)
      character(len=:), allocatable, intent(out) :: text
      integer :: i

      text = ""
      do i = 1, size(buffer)
         if (buffer(i) == c_null_char) exit
         text = text//buffer(i)
      end do
   end subroutine from_c

end module rv_arkode
