!> Fortran 77 interface: making, setting and closing valves; names of keys, measures and traces. See docs/fortran.md.
!>
!> Each procedure hands its call to the C API. Its name is what gfortran makes of the name in Fortran 77, and the lengths
!> of texts come behind the other arguments, as gfortran passes them. A valve is the number of its handle.
module rv_f77_valve
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_double, c_int, c_loc, c_null_char, c_ptr, c_size_t
   use rv_api_facts, only : rv_key_name, rv_key_unit, rv_version_text
   use rv_api_run, only : rv_fact_name, rv_fact_unit, rv_measure_name, rv_measure_unit, rv_trace_name, rv_trace_unit
   use rv_api_valve, only : rv_valve_new, rv_valve_new_deck, rv_valve_free, rv_valve_message, rv_valve_set_real, &
      & rv_valve_set_text, rv_valve_get_real, rv_valve_get_text
   use rv_api_call, only : rv_ok
   use rv_error, only : rv_bad_input
   use rv_f77_text, only : as_text, to_c, to_f77
   use rv_handles, only : handle_of, number_of
   use rv_text, only : lower
   implicit none
   private
   public :: f77_new, f77_deck, f77_free, f77_msg, f77_set, f77_setc, f77_get, f77_getc
   public :: f77_name, f77_vers

   integer, parameter :: longest = 4097   !! text that is given back, with its NUL [byte]

contains

   !> CALL RV_NEW(IV, IERR)
   subroutine f77_new(iv, ierr) bind(C, name="rv_new_")
      integer(c_int), intent(out) :: iv, ierr
      type(c_ptr), target :: handle

      ierr = rv_valve_new(c_loc(handle))
      call take_number(handle, iv, ierr)
   end subroutine f77_new

   !> CALL RV_DECK(PATH, IV, TEXT, IERR)
   subroutine f77_deck(path, iv, text, ierr, path_length, text_length) bind(C, name="rv_deck_")
      integer(c_size_t), value :: path_length, text_length
      character(kind=c_char), intent(in) :: path(path_length)
      character(kind=c_char), intent(out) :: text(text_length)
      integer(c_int), intent(out) :: iv, ierr
      character(kind=c_char), allocatable, target :: file(:)
      character(kind=c_char), target :: buffer(longest)
      type(c_ptr), target :: handle

      call to_c(path, file)
      ierr = rv_valve_new_deck(c_loc(file), c_loc(handle), c_loc(buffer), size(buffer, kind=c_size_t))
      call to_f77(buffer, text)
      call take_number(handle, iv, ierr)
   end subroutine f77_deck

   !> The number of a valve just made; a valve past the last number is closed.
   subroutine take_number(handle, iv, ierr)
      type(c_ptr), intent(inout), target :: handle
      integer(c_int), intent(out) :: iv
      integer(c_int), intent(inout) :: ierr

      iv = 0
      if (ierr /= rv_ok) return
      iv = number_of(handle)
      if (iv > 0) return
      ierr = rv_valve_free(c_loc(handle))
      ierr = rv_bad_input
   end subroutine take_number

   !> CALL RV_FREE(IV, IERR)
   subroutine f77_free(iv, ierr) bind(C, name="rv_free_")
      integer(c_int), intent(inout) :: iv
      integer(c_int), intent(out) :: ierr
      type(c_ptr), target :: handle

      ierr = rv_ok
      if (iv == 0) return
      handle = handle_of(iv)
      iv = 0
      ierr = rv_bad_input
      if (c_associated(handle)) ierr = rv_valve_free(c_loc(handle))
   end subroutine f77_free

   !> CALL RV_MSG(IV, TEXT, IERR)
   subroutine f77_msg(iv, text, ierr, text_length) bind(C, name="rv_msg_")
      integer(c_size_t), value :: text_length
      integer(c_int), intent(in) :: iv
      character(kind=c_char), intent(out) :: text(text_length)
      integer(c_int), intent(out) :: ierr
      character(kind=c_char), target :: buffer(longest)

      ierr = rv_valve_message(handle_of(iv), c_loc(buffer), size(buffer, kind=c_size_t))
      call to_f77(buffer, text)
   end subroutine f77_msg

   !> CALL RV_SET(IV, KEY, X, IERR)
   subroutine f77_set(iv, key, x, ierr, key_length) bind(C, name="rv_set_")
      integer(c_size_t), value :: key_length
      integer(c_int), intent(in) :: iv
      character(kind=c_char), intent(in) :: key(key_length)
      real(c_double), intent(in) :: x
      integer(c_int), intent(out) :: ierr
      character(kind=c_char), allocatable, target :: name(:)

      call to_c(key, name)
      ierr = rv_valve_set_real(handle_of(iv), c_loc(name), x)
   end subroutine f77_set

   !> CALL RV_SETC(IV, KEY, WORD, IERR)
   subroutine f77_setc(iv, key, word, ierr, key_length, word_length) bind(C, name="rv_setc_")
      integer(c_size_t), value :: key_length, word_length
      integer(c_int), intent(in) :: iv
      character(kind=c_char), intent(in) :: key(key_length), word(word_length)
      integer(c_int), intent(out) :: ierr
      character(kind=c_char), allocatable, target :: name(:), text(:)

      call to_c(key, name)
      call to_c(word, text)
      ierr = rv_valve_set_text(handle_of(iv), c_loc(name), c_loc(text))
   end subroutine f77_setc

   !> CALL RV_GET(IV, KEY, X, IERR)
   subroutine f77_get(iv, key, x, ierr, key_length) bind(C, name="rv_get_")
      integer(c_size_t), value :: key_length
      integer(c_int), intent(in) :: iv
      character(kind=c_char), intent(in) :: key(key_length)
      real(c_double), intent(inout), target :: x
      integer(c_int), intent(out) :: ierr
      character(kind=c_char), allocatable, target :: name(:)

      call to_c(key, name)
      ierr = rv_valve_get_real(handle_of(iv), c_loc(name), c_loc(x))
   end subroutine f77_get

   !> CALL RV_GETC(IV, KEY, WORD, IERR)
   subroutine f77_getc(iv, key, word, ierr, key_length, word_length) bind(C, name="rv_getc_")
      integer(c_size_t), value :: key_length, word_length
      integer(c_int), intent(in) :: iv
      character(kind=c_char), intent(in) :: key(key_length)
      character(kind=c_char), intent(out) :: word(word_length)
      integer(c_int), intent(out) :: ierr
      character(kind=c_char), allocatable, target :: name(:)
      character(kind=c_char), target :: buffer(longest)

      buffer(1) = c_null_char
      call to_c(key, name)
      ierr = rv_valve_get_text(handle_of(iv), c_loc(name), c_loc(buffer), size(buffer, kind=c_size_t))
      call to_f77(buffer, word)
   end subroutine f77_getc

   !> CALL RV_NAME(LIST, I, NAME, UNIT, IERR)
   subroutine f77_name(list, i, name, unit, ierr, list_length, name_length, unit_length) bind(C, name="rv_name_")
      integer(c_size_t), value :: list_length, name_length, unit_length
      character(kind=c_char), intent(in) :: list(list_length)
      integer(c_int), intent(in) :: i
      character(kind=c_char), intent(out) :: name(name_length), unit(unit_length)
      integer(c_int), intent(out) :: ierr
      character(kind=c_char), target :: text(longest), word(longest)
      integer(c_int) :: from_zero

      text(1) = c_null_char
      word(1) = c_null_char
      from_zero = max(i, 0_c_int) - 1
      select case (lower(as_text(list)))
      case ("keys")
         ierr = rv_key_name(from_zero, c_loc(text), size(text, kind=c_size_t))
         ierr = rv_key_unit(from_zero, c_loc(word), size(word, kind=c_size_t))
      case ("measures")
         ierr = rv_measure_name(from_zero, c_loc(text), size(text, kind=c_size_t))
         ierr = rv_measure_unit(from_zero, c_loc(word), size(word, kind=c_size_t))
      case ("facts")
         ierr = rv_fact_name(from_zero, c_loc(text), size(text, kind=c_size_t))
         ierr = rv_fact_unit(from_zero, c_loc(word), size(word, kind=c_size_t))
      case ("traces")
         ierr = rv_trace_name(from_zero, c_loc(text), size(text, kind=c_size_t))
         ierr = rv_trace_unit(from_zero, c_loc(word), size(word, kind=c_size_t))
      case default
         ierr = rv_bad_input
      end select
      call to_f77(text, name)
      call to_f77(word, unit)
   end subroutine f77_name

   !> CALL RV_VERS(TEXT, IERR)
   subroutine f77_vers(text, ierr, text_length) bind(C, name="rv_vers_")
      integer(c_size_t), value :: text_length
      character(kind=c_char), intent(out) :: text(text_length)
      integer(c_int), intent(out) :: ierr
      character(kind=c_char), target :: buffer(longest)

      ierr = rv_version_text(c_loc(buffer), size(buffer, kind=c_size_t))
      call to_f77(buffer, text)
   end subroutine f77_vers

end module rv_f77_valve
