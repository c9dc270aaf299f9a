!> Files read and written as bytes, with a running checksum, every system call checked.
!>
!> Fortran's own units may report a full disk only when they are closed, or not at all, and cannot
!> wait until the bytes are on the disk; a result must be there before its parts go.
module rv_file
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_loc, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only : int32
   use rv_kinds, only : i8
   use rv_error, only : error_type, fail, rv_io
   use rv_checksum, only : crc32_of
   use rv_posix, only : c_text, claim_name, get_reason, path_file, path_kind, path_none, process_mark, &
      & remove_file, rename_path
   implicit none
   private
   public :: file_type, read_whole_file, write_whole_file, claim_whole_file, new_suffix, own_suffix

   !> What a file is called until it is whole.
   character(len=*), parameter :: new_suffix = ".new"
   integer, parameter :: buffer_size = 262144   !! bytes of text collected before they are written

   integer(c_int), parameter :: mode_read = 0
   integer(c_int), parameter :: mode_create = 1
   integer(c_int), parameter :: mode_append = 2

   !> An open file. Texts are collected in a buffer; bytes go straight through.
   type :: file_type
      private
      integer(c_int) :: fd = -1
      character(len=:), allocatable :: name   !! in messages
      character(len=:), allocatable :: buffer
      integer :: used = 0
      integer(int32), public :: crc = 0          !! of the bytes put and got, bar texts, since it was opened or this was 0
   contains
      procedure :: open_old
      procedure :: create
      procedure :: append
      procedure :: put
      procedure :: put_text
      procedure :: get
      procedure :: start_sync
      procedure :: sync
      procedure :: close => close_file
      procedure, private :: flush_buffer
      procedure, private :: start
   end type file_type

   interface
      integer(c_int) function c_open(path, mode, fd) bind(C, name="rv_posix_open")
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
         integer(c_int), intent(out) :: fd
      end function c_open
      integer(c_int) function c_write(fd, data, size) bind(C, name="rv_posix_write")
         import :: c_int, c_ptr, c_size_t
         integer(c_int), value :: fd
         type(c_ptr), value :: data
         integer(c_size_t), value :: size
      end function c_write
      integer(c_int) function c_read(fd, data, size, got) bind(C, name="rv_posix_read")
         import :: c_int, c_ptr, c_size_t
         integer(c_int), value :: fd
         type(c_ptr), value :: data
         integer(c_size_t), value :: size
         integer(c_size_t), intent(out) :: got
      end function c_read
      integer(c_int) function c_sync(fd) bind(C, name="rv_posix_sync")
         import :: c_int
         integer(c_int), value :: fd
      end function c_sync
      subroutine c_start_sync(fd) bind(C, name="rv_posix_start_sync")
         import :: c_int
         integer(c_int), value :: fd
      end subroutine c_start_sync
      integer(c_int) function c_close(fd) bind(C, name="rv_posix_close")
         import :: c_int
         integer(c_int), value :: fd
      end function c_close
   end interface

contains

   !> What a file is called until it is whole, where several processes may write one of that name.
   function own_suffix() result(suffix)
      character(len=len(new_suffix) + 16) :: suffix

      write(suffix, '(a, z16.16)') new_suffix, process_mark()
   end function own_suffix

   !> Open for reading.
   subroutine open_old(self, path, error)
      class(file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      call self%start(path, path, mode_read, "open", error)
   end subroutine open_old

   !> Open for writing; what was there is lost.
   subroutine create(self, path, error)
      class(file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      call self%start(path, path, mode_create, "write", error)
   end subroutine create

   !> Open for writing behind what is there.
   subroutine append(self, path, error)
      class(file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      call self%start(path, path, mode_append, "write", error)
   end subroutine append

   !> Write `size` bytes.
   subroutine put(self, data, size, error)
      class(file_type), intent(inout) :: self
      type(c_ptr), intent(in) :: data
      integer(i8), intent(in) :: size             !! [byte]
      type(error_type), allocatable, intent(out) :: error

      call self%flush_buffer(error)
      if (allocated(error)) return
      self%crc = crc32_of(data, size, self%crc)
      call check(c_write(self%fd, data, int(size, c_size_t)), "write", self%name, error)
   end subroutine put

   !> Write text, sooner or later: at the latest with sync or close.
   subroutine put_text(self, text, error)
      class(file_type), intent(inout) :: self
      character(len=*), intent(in) :: text
      type(error_type), allocatable, intent(out) :: error
      integer :: done, part

      if (len(text) >= buffer_size) then
         call self%flush_buffer(error)
         if (.not. allocated(error)) call write_text(self, text, error)
         return
      end if
      if (.not. allocated(self%buffer)) allocate(character(len=buffer_size) :: self%buffer)
      done = 0
      do while (done < len(text))
         if (self%used == buffer_size) then
            call self%flush_buffer(error)
            if (allocated(error)) return
         end if
         part = min(len(text) - done, buffer_size - self%used)
         self%buffer(self%used + 1:self%used + part) = text(done + 1:done + part)
         self%used = self%used + part
         done = done + part
      end do
   end subroutine put_text

   !> Read exactly `size` bytes; an earlier end of the file is a failure.
   subroutine get(self, data, size, error)
      class(file_type), intent(inout) :: self
      type(c_ptr), intent(in) :: data
      integer(i8), intent(in) :: size             !! [byte]
      type(error_type), allocatable, intent(out) :: error
      integer(c_size_t) :: got

      call check(c_read(self%fd, data, int(size, c_size_t), got), "read", self%name, error)
      if (allocated(error)) return
      if (got < size) then
         call fail(error, rv_io, "'"//self%name//"' is cut short")
         return
      end if
      self%crc = crc32_of(data, size, self%crc)
   end subroutine get

   !> Have what is written on its way to the disk, by whatever descriptor of the file it was written; does not wait.
   subroutine start_sync(self)
      class(file_type), intent(in) :: self

      if (self%fd >= 0) call c_start_sync(self%fd)
   end subroutine start_sync

   !> Wait until everything written is on the disk.
   subroutine sync(self, error)
      class(file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      call self%flush_buffer(error)
      if (allocated(error)) return
      call check(c_sync(self%fd), "write", self%name, error)
   end subroutine sync

   !> Close; harmless when nothing is open. Without `error`, what is in the buffer is dropped.
   subroutine close_file(self, error)
      class(file_type), intent(inout) :: self
      type(error_type), allocatable, optional, intent(out) :: error
      integer(c_int) :: status

      if (self%fd < 0) return
      if (present(error)) call self%flush_buffer(error)
      status = c_close(self%fd)
      self%fd = -1
      self%used = 0
      if (.not. present(error)) return
      if (.not. allocated(error)) call check(status, "write", self%name, error)
   end subroutine close_file

   !> The bytes of a file. `found` is false, without an error, when there is none.
   subroutine read_whole_file(path, text, found, error)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, target, intent(out) :: text
      logical, intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(file_type) :: file
      integer :: kind
      integer(i8) :: size

      text = ""
      found = .false.
      call path_kind(path, kind, error, size)
      if (allocated(error) .or. kind == path_none) return
      if (kind /= path_file) then
         call fail(error, rv_io, "'"//path//"' is not a file")
         return
      end if
      call file%open_old(path, error)
      if (allocated(error)) return
      deallocate(text)
      allocate(character(len=size) :: text)
      if (size > 0) call file%get(c_loc(text), size, error)
      call file%close()
      found = .not. allocated(error)
   end subroutine read_whole_file

   !> Write a file so that it is there whole and on the disk, or not at all.
   subroutine write_whole_file(path, text, error)
      character(len=*), intent(in) :: path
      character(len=*), intent(in) :: text
      type(error_type), allocatable, intent(out) :: error

      call write_called(path, path, text, error)
   end subroutine write_whole_file

   !> The same; messages have another name for it.
   subroutine write_called(path, name, text, error)
      character(len=*), intent(in) :: path, name, text
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: ignored
      type(file_type) :: file

      call file%start(path//new_suffix, name, mode_create, "write", error)
      if (allocated(error)) return
      call file%put_text(text, error)
      if (.not. allocated(error)) call file%sync(error)
      if (.not. allocated(error)) call file%close(error)
      if (.not. allocated(error)) call rename_path(path//new_suffix, path, error)
      if (.not. allocated(error)) return
      call file%close()
      call remove_file(path//new_suffix, ignored)
   end subroutine write_called

   !> Write a file so that it is there whole and on the disk, unless there is one of that name already: then that
   !> one stays and `taken` is true. Several processes may try at once.
   subroutine claim_whole_file(path, text, taken, error)
      character(len=*), intent(in) :: path
      character(len=*), intent(in) :: text
      logical, intent(out) :: taken
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: own
      type(error_type), allocatable :: ignored

      taken = .false.
      own = path//own_suffix()
      call write_called(own, path, text, error)
      if (allocated(error)) return
      call claim_name(own, path, taken, error)
      if (allocated(error)) call remove_file(own, ignored)
   end subroutine claim_whole_file

   subroutine start(self, path, name, mode, what, error)
      class(file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      character(len=*), intent(in) :: name      !! of the file in messages
      integer(c_int), intent(in) :: mode
      character(len=*), intent(in) :: what
      type(error_type), allocatable, intent(out) :: error

      call self%close()
      self%name = name
      self%crc = 0
      call check(c_open(c_text(path), mode, self%fd), what, name, error)
   end subroutine start

   subroutine flush_buffer(self, error)
      class(file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      integer :: used

      if (self%used == 0) return
      used = self%used
      self%used = 0
      call write_text(self, self%buffer(:used), error)
   end subroutine flush_buffer

   subroutine write_text(self, text, error)
      class(file_type), intent(in) :: self
      character(len=*), target, intent(in) :: text
      type(error_type), allocatable, intent(out) :: error

      call check(c_write(self%fd, c_loc(text), len(text, c_size_t)), "write", self%name, error)
   end subroutine write_text

   subroutine check(number, what, path, error)
      integer(c_int), intent(in) :: number
      character(len=*), intent(in) :: what, path
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: reason

      if (number == 0) return
      call get_reason(number, reason)
      call fail(error, rv_io, "cannot "//what//" '"//path//"': "//reason)
   end subroutine check

end module rv_file
