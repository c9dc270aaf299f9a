!> C API: what keys a valve has, and which version of the library this is. See reedvalve.h.
module rv_api_facts
   use, intrinsic :: iso_c_binding, only : c_associated, c_int, c_ptr, c_size_t
   use rv_error, only : rv_bad_input
   use rv_api_call, only : rv_ok
   use rv_c_text, only : give_text
   use rv_keys, only : keys, n_keys
   use rv_version, only : code_version
   implicit none
   private
   public :: rv_version_text, rv_key_count, rv_key_name, rv_key_unit, rv_key_help, rv_key_kind

contains

   integer(c_int) function rv_version_text(buffer, size) result(code) bind(C)
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      call give_text(code_version, buffer, size)
      code = merge(rv_ok, rv_bad_input, c_associated(buffer))
   end function rv_version_text

   integer(c_int) function rv_key_count() result(n) bind(C)
      n = n_keys
   end function rv_key_count

   integer(c_int) function rv_key_name(i, buffer, size) result(code) bind(C)
      integer(c_int), value :: i
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      code = rv_bad_input
      call give_text("", buffer, size)
      if (.not. (is_key(i) .and. c_associated(buffer))) return
      call give_text(trim(keys(i + 1)%group)//"."//trim(keys(i + 1)%name), buffer, size)
      code = rv_ok
   end function rv_key_name

   integer(c_int) function rv_key_unit(i, buffer, size) result(code) bind(C)
      integer(c_int), value :: i
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      code = rv_bad_input
      call give_text("", buffer, size)
      if (.not. (is_key(i) .and. c_associated(buffer))) return
      call give_text(trim(keys(i + 1)%unit), buffer, size)
      code = rv_ok
   end function rv_key_unit

   integer(c_int) function rv_key_help(i, buffer, size) result(code) bind(C)
      integer(c_int), value :: i
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      code = rv_bad_input
      call give_text("", buffer, size)
      if (.not. (is_key(i) .and. c_associated(buffer))) return
      call give_text(trim(keys(i + 1)%help), buffer, size)
      code = rv_ok
   end function rv_key_help

   integer(c_int) function rv_key_kind(i) result(kind) bind(C)
      integer(c_int), value :: i

      kind = 0
      if (is_key(i)) kind = keys(i + 1)%kind
   end function rv_key_kind

   pure logical function is_key(i)
      integer(c_int), intent(in) :: i   !! from 0

      is_key = i >= 0 .and. i < n_keys
   end function is_key

end module rv_api_facts
