!> CRC-32 (polynomial 0x04C11DB7 reflected, as in IEEE 802.3, zip and PNG), eight bytes at a step.
!>
!> Finds every burst of up to 32 wrong bits; other damage passes with probability 2^-32.
!> Peterson & Brown (1961), doi:10.1109/JRPROC.1961.287814; tables for eight bytes at once after
!> Kounavis & Berry (2008), doi:10.1109/TC.2008.85. Cost: about 1 ns per byte.
module rv_checksum
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_intptr_t, c_loc, c_ptr
   use, intrinsic :: iso_fortran_env, only : int8, int32
   use rv_kinds, only : i8
   implicit none
   private
   public :: crc32_of, crc32_text, hex_text

   integer :: i_
   integer(int32), parameter :: polynomial = int(-306674912, int32)  !! 0xEDB88320
   integer(int32), parameter :: low_byte = 255_int32

   ! Each table comes from the one before at compile time: eight bit steps, then seven byte steps.
   integer(int32), parameter :: b0(0:255) = [(int(i_, int32), i_=0, 255)]
   integer(int32), parameter :: b1(0:255) = merge(ieor(shiftr(b0, 1), polynomial), shiftr(b0, 1), btest(b0, 0))
   integer(int32), parameter :: b2(0:255) = merge(ieor(shiftr(b1, 1), polynomial), shiftr(b1, 1), btest(b1, 0))
   integer(int32), parameter :: b3(0:255) = merge(ieor(shiftr(b2, 1), polynomial), shiftr(b2, 1), btest(b2, 0))
   integer(int32), parameter :: b4(0:255) = merge(ieor(shiftr(b3, 1), polynomial), shiftr(b3, 1), btest(b3, 0))
   integer(int32), parameter :: b5(0:255) = merge(ieor(shiftr(b4, 1), polynomial), shiftr(b4, 1), btest(b4, 0))
   integer(int32), parameter :: b6(0:255) = merge(ieor(shiftr(b5, 1), polynomial), shiftr(b5, 1), btest(b5, 0))
   integer(int32), parameter :: b7(0:255) = merge(ieor(shiftr(b6, 1), polynomial), shiftr(b6, 1), btest(b6, 0))
   integer(int32), parameter :: t0(0:255) = merge(ieor(shiftr(b7, 1), polynomial), shiftr(b7, 1), btest(b7, 0))
   integer(int32), parameter :: t1(0:255) = ieor(shiftr(t0, 8), t0(iand(t0, low_byte)))
   integer(int32), parameter :: t2(0:255) = ieor(shiftr(t1, 8), t0(iand(t1, low_byte)))
   integer(int32), parameter :: t3(0:255) = ieor(shiftr(t2, 8), t0(iand(t2, low_byte)))
   integer(int32), parameter :: t4(0:255) = ieor(shiftr(t3, 8), t0(iand(t3, low_byte)))
   integer(int32), parameter :: t5(0:255) = ieor(shiftr(t4, 8), t0(iand(t4, low_byte)))
   integer(int32), parameter :: t6(0:255) = ieor(shiftr(t5, 8), t0(iand(t5, low_byte)))
   integer(int32), parameter :: t7(0:255) = ieor(shiftr(t6, 8), t0(iand(t6, low_byte)))

contains

   !> Checksum of `size` bytes at `data`; with `start`, of those bytes after the ones whose checksum `start` is.
   function crc32_of(data, size, start) result(crc)
      type(c_ptr), intent(in) :: data
      integer(i8), intent(in) :: size             !! [byte]
      integer(int32), optional, intent(in) :: start
      integer(int32) :: crc
      integer(int32), pointer :: word(:, :)
      integer(int8), pointer :: byte(:)
      integer(i8) :: head, words, i

      crc = -1_int32
      if (present(start)) crc = not(start)
      call c_f_pointer(data, byte, [size])
      head = min(size, modulo(-transfer(data, 0_c_intptr_t), 4_c_intptr_t))   ! up to the first whole word
      words = (size - head)/8
      do i = 1, head
         crc = one_byte(crc, byte(i))
      end do
      if (words > 0) call c_f_pointer(c_loc(byte(head + 1)), word, [2_i8, words])
      do i = 1, words
         crc = eight_bytes(ieor(crc, word(1, i)), word(2, i))
      end do
      do i = head + 8*words + 1, size
         crc = one_byte(crc, byte(i))
      end do
      crc = not(crc)
   end function crc32_of

   function crc32_text(text) result(crc)
      character(len=*), target, intent(in) :: text
      integer(int32) :: crc

      crc = crc32_of(c_loc(text), len(text, kind=i8))
   end function crc32_text

   !> Eight hexadecimal digits.
   pure function hex_text(crc) result(text)
      integer(int32), intent(in) :: crc
      character(len=8) :: text

      write(text, '(z8.8)') crc
   end function hex_text

   pure integer(int32) function one_byte(crc, byte)
      integer(int32), intent(in) :: crc
      integer(int8), intent(in) :: byte

      one_byte = ieor(shiftr(crc, 8), t0(iand(ieor(crc, int(byte, int32)), low_byte)))
   end function one_byte

   pure function eight_bytes(low, high) result(crc)
      integer(int32), intent(in) :: low, high
      integer(int32) :: crc

      crc = ieor(ieor(t7(iand(low, low_byte)), t6(iand(shiftr(low, 8), low_byte))), &
         & ieor(t5(iand(shiftr(low, 16), low_byte)), t4(shiftr(low, 24))))
      crc = ieor(crc, ieor(ieor(t3(iand(high, low_byte)), t2(iand(shiftr(high, 8), low_byte))), &
         & ieor(t1(iand(shiftr(high, 16), low_byte)), t0(shiftr(high, 24)))))
   end function eight_bytes

end module rv_checksum
