!> C API: making, setting and closing valves. What each call does is told in reedvalve.h.
module rv_api_valve
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_null_ptr, c_ptr, c_size_t
   use rv_error, only : error_type, rv_bad_input, rv_internal
   use rv_text, only : to_text
   use rv_api_call, only : begin_call, refuse, settle, put_number, put_nan, rv_ok, no_valve, no_pointer, no_text
   use rv_c_text, only : give_lines, give_text, take_text
   use rv_floats, only : float_guard
   use rv_handles, only : valve_type, open_handle, close_handle, valve_of
   use rv_setup, only : new_setup, read_setup
   implicit none
   private
   public :: rv_valve_new, rv_valve_new_deck, rv_valve_free, rv_valve_message
   public :: rv_valve_set_real, rv_valve_set_text, rv_valve_get_real, rv_valve_get_text, rv_valve_is_set

contains

   integer(c_int) function rv_valve_new(out) result(code) bind(C)
      type(c_ptr), value :: out
      type(valve_type), pointer :: valve
      type(c_ptr), pointer :: handle
      integer :: stat
      type(float_guard) :: guard

      call guard%put_aside()
      code = rv_bad_input
      if (.not. c_associated(out)) return
      call c_f_pointer(out, handle)
      handle = c_null_ptr
      allocate(valve, stat=stat)
      code = rv_internal
      if (stat /= 0) return
      valve%message = ""
      !$omp critical (rv_api_text)
      call new_setup(valve%setup)
      !$omp end critical (rv_api_text)
      call open_handle(valve, handle)
      code = rv_ok
   end function rv_valve_new

   integer(c_int) function rv_valve_new_deck(path, out, message, size) result(code) bind(C)
      type(c_ptr), value :: path, out, message
      integer(c_size_t), value :: size
      type(valve_type), pointer :: valve
      type(c_ptr), pointer :: handle
      type(error_type), allocatable :: error
      character(len=:), allocatable :: file
      logical :: taken
      type(float_guard) :: guard

      call guard%put_aside()
      code = rv_bad_input
      call take_text(path, file, taken)
      if (.not. c_associated(out)) then
         call give_text(no_pointer, message, size)
         return
      end if
      call c_f_pointer(out, handle)
      handle = c_null_ptr
      if (.not. taken) then
         call give_text(no_text, message, size)
         return
      end if
      allocate(valve)
      !$omp critical (rv_api_text)
      call read_setup(valve%setup, file, valve%message, error)
      !$omp end critical (rv_api_text)
      call settle(valve, error, code)
      call give_lines(valve%message, message, size)
      if (allocated(error)) then
         deallocate(valve)
      else
         call open_handle(valve, handle)
      end if
   end function rv_valve_new_deck

   integer(c_int) function rv_valve_free(self) result(code) bind(C)
      type(c_ptr), value :: self
      type(c_ptr), pointer :: handle
      type(valve_type), pointer :: valve

      code = rv_ok
      if (.not. c_associated(self)) return
      call c_f_pointer(self, handle)
      if (.not. c_associated(handle)) return
      call close_handle(handle, valve)
      if (associated(valve)) then
         deallocate(valve)
      else
         code = rv_bad_input
      end if
   end function rv_valve_free

   integer(c_int) function rv_valve_message(self, buffer, size) result(code) bind(C)
      type(c_ptr), value :: self, buffer
      integer(c_size_t), value :: size
      type(valve_type), pointer :: valve

      call valve_of(self, valve)
      if (associated(valve)) then
         call give_lines(valve%message, buffer, size)
         code = merge(rv_ok, rv_bad_input, c_associated(buffer))
      else
         call give_text(no_valve, buffer, size)
         code = rv_bad_input
      end if
   end function rv_valve_message

   integer(c_int) function rv_valve_set_real(self, key, value) result(code) bind(C)
      type(c_ptr), value :: self, key
      real(c_double), value :: value
      type(valve_type), pointer :: valve
      type(float_guard) :: guard

      call guard%put_aside()
      call begin_call(self, valve, code)
      if (associated(valve)) call set_key(valve, key, to_text(value), .true., code)
   end function rv_valve_set_real

   integer(c_int) function rv_valve_set_text(self, key, value) result(code) bind(C)
      type(c_ptr), value :: self, key, value
      type(valve_type), pointer :: valve
      character(len=:), allocatable :: word
      logical :: taken
      type(float_guard) :: guard

      call guard%put_aside()
      call begin_call(self, valve, code)
      if (.not. associated(valve)) return
      call take_text(value, word, taken)
      if (taken) then
         call set_key(valve, key, word, .false., code)
      else
         call refuse(valve, no_text, code)
      end if
   end function rv_valve_set_text

   !> What was run or stepped with other settings is over.
   subroutine set_key(valve, key, word, is_number, code)
      type(valve_type), intent(inout) :: valve
      type(c_ptr), intent(in) :: key
      character(len=*), intent(in) :: word
      logical, intent(in) :: is_number
      integer(c_int), intent(out) :: code
      type(error_type), allocatable :: error
      character(len=:), allocatable :: name
      logical :: taken

      call take_text(key, name, taken)
      if (.not. taken) then
         call refuse(valve, no_text, code)
         return
      end if
      !$omp critical (rv_api_text)
      call valve%setup%set(name, word, is_number, valve%message, error)
      !$omp end critical (rv_api_text)
      call settle(valve, error, code)
      if (allocated(error)) return
      valve%has_run = .false.
      valve%is_stepping = .false.
   end subroutine set_key

   integer(c_int) function rv_valve_get_real(self, key, value) result(code) bind(C)
      type(c_ptr), value :: self, key, value
      type(valve_type), pointer :: valve
      type(error_type), allocatable :: error
      character(len=:), allocatable :: name
      real(c_double) :: number
      type(float_guard) :: guard

      call guard%put_aside()
      call put_nan(value)
      call begin_get(self, key, value, valve, name, code)
      if (code /= rv_ok) return
      !$omp critical (rv_api_text)
      call valve%setup%get_number(name, number, error)
      !$omp end critical (rv_api_text)
      call settle(valve, error, code)
      call put_number(number, value)
   end function rv_valve_get_real

   integer(c_int) function rv_valve_get_text(self, key, buffer, size) result(code) bind(C)
      type(c_ptr), value :: self, key, buffer
      integer(c_size_t), value :: size
      type(valve_type), pointer :: valve
      type(error_type), allocatable :: error
      character(len=:), allocatable :: name, word
      type(float_guard) :: guard

      call guard%put_aside()
      call give_text("", buffer, size)
      call begin_get(self, key, buffer, valve, name, code)
      if (code /= rv_ok) return
      !$omp critical (rv_api_text)
      call valve%setup%get_word(name, word, error)
      !$omp end critical (rv_api_text)
      call settle(valve, error, code)
      call give_text(word, buffer, size)
   end function rv_valve_get_text

   integer(c_int) function rv_valve_is_set(self, key, is_set) result(code) bind(C)
      type(c_ptr), value :: self, key, is_set
      type(valve_type), pointer :: valve
      type(error_type), allocatable :: error
      character(len=:), allocatable :: name
      integer(c_int), pointer :: place
      logical :: set
      type(float_guard) :: guard

      call guard%put_aside()
      call begin_get(self, key, is_set, valve, name, code)
      if (code /= rv_ok) return
      !$omp critical (rv_api_text)
      call valve%setup%tell_set(name, set, error)
      !$omp end critical (rv_api_text)
      call settle(valve, error, code)
      call c_f_pointer(is_set, place)
      place = merge(1, 0, set)
   end function rv_valve_is_set

   !> A call that asks for the value of a key and tells it through a pointer.
   subroutine begin_get(self, key, pointer, valve, name, code)
      type(c_ptr), intent(in) :: self, key, pointer
      type(valve_type), pointer, intent(out) :: valve
      character(len=:), allocatable, intent(out) :: name
      integer(c_int), intent(out) :: code
      logical :: taken

      call begin_call(self, valve, code)
      if (.not. associated(valve)) return
      call take_text(key, name, taken)
      if (.not. taken) call refuse(valve, no_text, code)
      if (.not. c_associated(pointer)) call refuse(valve, no_pointer, code)
   end subroutine begin_get

end module rv_api_valve
