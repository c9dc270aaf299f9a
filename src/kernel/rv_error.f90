!> How every procedure that can fail says so: an allocatable error, unallocated on success.
module rv_error
   implicit none
   private
   public :: error_type, fail
   public :: rv_bad_input, rv_io, rv_not_converged, rv_domain, rv_internal

   integer, parameter :: rv_bad_input = 1      !! the caller's data are not allowed
   integer, parameter :: rv_io = 2             !! a file could not be read or written
   integer, parameter :: rv_not_converged = 3  !! a numerical method gave up
   integer, parameter :: rv_domain = 4         !! the state left the model's domain (film closed, not a number)
   integer, parameter :: rv_internal = 5       !! a fault of this code

   !> One failure: what kind, and a sentence that says what, where and with which numbers.
   type :: error_type
      integer :: code = 0
      character(len=:), allocatable :: message
   end type error_type

contains

   !> Set `error`.
   subroutine fail(error, code, message)
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in) :: code              !! one of the rv_ codes
      character(len=*), intent(in) :: message

      allocate(error)
      error%code = code
      error%message = message
   end subroutine fail

end module rv_error
