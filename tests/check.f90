!> The checks of the test suites: each says what was compared, the value, the reference and the limit.
module check
   use, intrinsic :: iso_fortran_env, only : output_unit
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_text, only : to_text
   implicit none
   private
   public :: suite_type

   !> Counts the checks of one suite; `finish` ends the program with status 1 if any failed or none ran.
   type :: suite_type
      private
      integer :: passed = 0
      integer :: failed = 0
   contains
      procedure :: close => check_close
      procedure :: true => check_true
      procedure :: text => check_text
      procedure :: equal => check_equal
      procedure :: no_error => check_no_error
      procedure :: fails => check_fails
      procedure :: finish
   end type suite_type

contains

   !> |value - reference| <= atol + rtol |reference|; both limits are given, NaN never passes.
   subroutine check_close(self, what, value, reference, rtol, atol)
      class(suite_type), intent(inout) :: self
      character(len=*), intent(in) :: what
      real(wp), intent(in) :: value, reference
      real(wp), intent(in) :: rtol, atol
      logical :: ok

      ok = abs(value - reference) <= atol + rtol*abs(reference)
      call count_one(self, ok, what//": "//to_text(value)//", reference "//to_text(reference) &
         & //", difference "//to_text(value - reference, 3)//", limit "//to_text(atol + rtol*abs(reference), 3))
   end subroutine check_close

   subroutine check_true(self, what, ok)
      class(suite_type), intent(inout) :: self
      character(len=*), intent(in) :: what
      logical, intent(in) :: ok

      call count_one(self, ok, what)
   end subroutine check_true

   subroutine check_equal(self, what, value, reference)
      class(suite_type), intent(inout) :: self
      character(len=*), intent(in) :: what
      integer, intent(in) :: value, reference

      call count_one(self, value == reference, what//": "//to_text(value)//", reference "//to_text(reference))
   end subroutine check_equal

   subroutine check_text(self, what, value, reference)
      class(suite_type), intent(inout) :: self
      character(len=*), intent(in) :: what, value, reference

      call count_one(self, value == reference, what//": '"//value//"', reference '"//reference//"'")
   end subroutine check_text

   subroutine check_no_error(self, what, error)
      class(suite_type), intent(inout) :: self
      character(len=*), intent(in) :: what
      type(error_type), allocatable, intent(in) :: error

      if (allocated(error)) then
         call count_one(self, .false., what//": "//error%message)
      else
         call count_one(self, .true., what)
      end if
   end subroutine check_no_error

   !> `error` is set and its message contains `part`.
   subroutine check_fails(self, what, error, part)
      class(suite_type), intent(inout) :: self
      character(len=*), intent(in) :: what
      type(error_type), allocatable, intent(in) :: error
      character(len=*), intent(in) :: part

      if (allocated(error)) then
         call count_one(self, index(error%message, part) > 0, what//": '"//error%message//"' should say '"//part//"'")
      else
         call count_one(self, .false., what//": no error, but one that says '"//part//"' was expected")
      end if
   end subroutine check_fails

   subroutine count_one(self, ok, line)
      class(suite_type), intent(inout) :: self
      logical, intent(in) :: ok
      character(len=*), intent(in) :: line

      if (ok) then
         self%passed = self%passed + 1
         write(output_unit, '(a)') "  ok    "//line
      else
         self%failed = self%failed + 1
         write(output_unit, '(a)') "  WRONG "//line
      end if
   end subroutine count_one

   subroutine finish(self)
      class(suite_type), intent(in) :: self

      write(output_unit, '(a)') to_text(self%passed)//" passed, "//to_text(self%failed)//" failed"
      if (self%failed > 0 .or. self%passed == 0) error stop 1
   end subroutine finish

end module check
