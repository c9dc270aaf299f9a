!> Text files as bytes: reading them whole, refusing what is no text.
module rv_text_file
   use, intrinsic :: iso_fortran_env, only : int64
   use rv_error, only : error_type, fail, rv_bad_input, rv_io
   use rv_faults, only : fault_list
   use rv_posix, only : path_kind, path_other
   use rv_text, only : to_text
   implicit none
   private
   public :: read_text_file, check_encoding, folder_of, byte_order_mark

   character(len=*), parameter :: byte_order_mark = char(239)//char(187)//char(191)   !! of UTF-8

contains

   !> Read a whole file. The size is looked at first: a file larger than `most` is not read at all.
   !>
   !> Codes: rv_io for what is not there or cannot be read, rv_bad_input for a size no such file has.
   subroutine read_text_file(path, most, text, error)
      character(len=*), intent(in) :: path
      integer(int64), intent(in) :: most                    !! [byte]
      character(len=:), allocatable, intent(out) :: text    !! empty on failure
      type(error_type), allocatable, intent(out) :: error
      character(len=256) :: message
      integer(int64) :: bytes
      integer :: unit, stat
      logical :: exists, is_folder
      integer :: kind

      text = ""
      inquire(file=path, exist=exists, size=bytes)
      inquire(file=path//"/.", exist=is_folder)
      call path_kind(path, kind, error)
      if (allocated(error)) return
      if (len_trim(path) == 0 .or. .not. exists) then
         call fail(error, rv_io, "'"//path//"': there is no such file")
      else if (is_folder) then
         call fail(error, rv_io, "'"//path//"' is a folder; name a file in it")
      else if (kind == path_other) then
         call fail(error, rv_io, "'"//path//"' is a pipe or a device; a file is needed here")
      else if (bytes > most) then
         call fail(error, rv_bad_input, "'"//path//"' has "//to_text(bytes)//" bytes, more than the " &
            & //to_text(most)//" such a file may have")
      end if
      if (allocated(error)) return

      open(newunit=unit, file=path, access="stream", form="unformatted", status="old", action="read", &
         & iostat=stat, iomsg=message)
      if (stat == 0) then
         deallocate(text)
         allocate(character(len=bytes) :: text)
         if (bytes > 0) read(unit, iostat=stat, iomsg=message) text
         close(unit)
      end if
      if (stat == 0) return
      text = ""
      call fail(error, rv_io, "'"//path//"' cannot be read: "//trim(message))
   end subroutine read_text_file

   !> Report the first byte that cannot stand in a UTF-8 text: the results quote the deck, and must stay readable.
   subroutine check_encoding(text, file, faults)
      character(len=*), intent(in) :: text
      character(len=*), intent(in) :: file   !! its name in messages
      type(fault_list), intent(inout) :: faults
      integer :: i, c, line, column, length

      line = 1
      column = 1
      i = 1
      do while (i <= len(text))
         c = iachar(text(i:i))
         length = sequence_length(text(i:min(len(text), i + 3)))
         if (length == 0) then
            call faults%add(file, line, column, trouble_with(c, text))
            return
         end if
         i = i + length
         column = column + 1
         if (c == 10) then
            line = line + 1
            column = 1
         end if
      end do
   end subroutine check_encoding

   !> Bytes of the character at the start of `text`; 0 if it is not one of a text.
   pure integer function sequence_length(text) result(n)
      character(len=*), intent(in) :: text
      integer :: c, i

      c = iachar(text(1:1))
      select case (c)
      case (9, 10, 12, 13, 32:126)
         n = 1
      case (194:223)
         n = 2
      case (224:239)
         n = 3
      case (240:244)
         n = 4
      case default
         n = 0
      end select
      if (n > len(text)) n = 0
      do i = 2, n
         c = iachar(text(i:i))
         if (c < 128 .or. c > 191) then
            n = 0
            return
         end if
      end do
   end function sequence_length

   !> The sentence for a byte that does not belong.
   pure function trouble_with(c, text) result(trouble)
      integer, intent(in) :: c
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: trouble
      character(len=2) :: hex
      logical :: is_utf16

      is_utf16 = .false.
      if (len(text) > 1) is_utf16 = abs(iachar(text(1:1)) - iachar(text(2:2))) == 1 .and. iachar(text(1:1)) >= 254
      write(hex, '(z2.2)') c
      if (is_utf16) then
         trouble = "this file is UTF-16; save it as UTF-8"
      else if (c < 128 .or. index(text, achar(0)) > 0) then
         trouble = "byte "//hex//" (hexadecimal) does not belong into a text; is this a binary file?"
      else
         trouble = "byte "//hex//" (hexadecimal) is not UTF-8; save the file as UTF-8"
      end if
   end function trouble_with

   !> The folder part of a path with its / at the end, or nothing.
   pure function folder_of(path) result(folder)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: folder

      folder = path(:index(path, "/", back=.true.))
   end function folder_of

end module rv_text_file
