!> What every call of the C API begins and ends with.
module rv_api_call
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_ptr
   use, intrinsic :: iso_fortran_env, only : int8
   use rv_kinds, only : i8
   use rv_error, only : error_type, fail, rv_bad_input, rv_domain, rv_internal, rv_not_converged
   use rv_handles, only : valve_type, valve_of
   use rv_status, only : status_ok, status_film_closed, status_not_finite, status_bad_case
   use rv_text, only : to_text
   implicit none
   private
   public :: begin_call, refuse, settle, need_memory, code_of_status, put_number, put_nan, rv_ok
   public :: no_valve, no_pointer, no_text

   integer(c_int), parameter :: rv_ok = 0
   character(len=*), parameter :: no_valve = "this valve is NULL, was closed, or never was one"
   character(len=*), parameter :: no_pointer = "a pointer is NULL"
   character(len=*), parameter :: no_text = "a text is NULL or too long"

contains

   !> Find the valve of a handle and clear its message. Null where there is none: rv_bad_input is the answer.
   subroutine begin_call(handle, valve, code)
      type(c_ptr), intent(in) :: handle
      type(valve_type), pointer, intent(out) :: valve
      integer(c_int), intent(out) :: code

      code = rv_bad_input
      call valve_of(handle, valve)
      if (.not. associated(valve)) return
      valve%message = ""
      code = rv_ok
   end subroutine begin_call

   !> The caller's data are not allowed.
   subroutine refuse(valve, message, code)
      type(valve_type), intent(inout) :: valve
      character(len=*), intent(in) :: message
      integer(c_int), intent(out) :: code

      code = rv_bad_input
      valve%message = message
   end subroutine refuse

   !> Keep the message of an error, if there is one.
   subroutine settle(valve, error, code)
      type(valve_type), intent(inout) :: valve
      type(error_type), allocatable, intent(in) :: error
      integer(c_int), intent(out) :: code

      code = rv_ok
      if (.not. allocated(error)) return
      code = error%code
      valve%message = error%message
   end subroutine settle

   !> Whether so much memory is to be had. Far below, an allocation that fails would end the caller's program.
   subroutine need_memory(bytes, error)
      integer(i8), intent(in) :: bytes
      type(error_type), allocatable, intent(out) :: error
      integer(int8), allocatable, volatile :: trial(:)   ! volatile: or the compiler leaves it out
      integer :: stat

      allocate(trial(bytes), stat=stat)
      if (stat /= 0) call fail(error, rv_internal, "there is no memory for this: "//to_text(bytes/2_i8**20)//" MiB more")
   end subroutine need_memory

   !> The error code of a case that ended so.
   pure integer(c_int) function code_of_status(status) result(code)
      integer, intent(in) :: status   !! status_

      select case (status)
      case (status_ok)
         code = rv_ok
      case (status_bad_case)
         code = rv_bad_input
      case (status_film_closed, status_not_finite)
         code = rv_domain
      case default
         code = rv_not_converged
      end select
   end function code_of_status

   !> What a call that fails tells.
   subroutine put_nan(to)
      type(c_ptr), intent(in) :: to   !! may be NULL

      if (c_associated(to)) call put_number(ieee_value(1.0_c_double, ieee_quiet_nan), to)
   end subroutine put_nan

   subroutine put_number(number, to)
      real(c_double), intent(in) :: number
      type(c_ptr), intent(in) :: to   !! not NULL
      real(c_double), pointer :: place

      call c_f_pointer(to, place)
      place = number
   end subroutine put_number

end module rv_api_call
