!> What the operating system does for a run: folders, renames, locks, signals, clocks. Files are in rv_file.
module rv_posix
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int, c_int64_t, c_null_char, c_null_ptr, c_ptr, &
      & c_size_t
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_io
   use rv_text, only : text_type, to_text
   implicit none
   private
   public :: path_kind, path_none, path_file, path_folder, path_other, free_bytes, check_room
   public :: make_folder, remove_folder, remove_file, rename_path, claim_name, sync_folder, list_folder
   public :: lock_file, unlock_file, lock_ours, lock_held, lock_none
   public :: catch_signals, signal_seen, keep_standard_files, is_terminal, terminal_width
   public :: seconds, nap, utc_date, host_name, process_number, process_mark, is_neighbour, is_gone, get_reason, c_text

   integer, parameter :: path_none = 0    !! nothing of that name
   integer, parameter :: path_file = 1
   integer, parameter :: path_folder = 2
   integer, parameter :: path_other = 3   !! a device, a pipe, ...

   integer, parameter :: lock_ours = 0
   integer, parameter :: lock_held = 1    !! by another process
   integer, parameter :: lock_none = 2    !! this file system has no locks

   integer, parameter :: longest_text = 4096  !! longest path or name taken from C

   interface
      integer(c_int) function c_catch_signals(notice) bind(C, name="rv_posix_catch_signals")
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: notice(*)
      end function c_catch_signals
      integer(c_int) function c_signal_seen() bind(C, name="rv_posix_signal_seen")
         import :: c_int
      end function c_signal_seen
      subroutine c_reason(number, buffer, size) bind(C, name="rv_posix_reason")
         import :: c_int, c_char, c_size_t
         integer(c_int), value :: number
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end subroutine c_reason
      integer(c_int) function c_make_folder(path) bind(C, name="rv_posix_make_folder")
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_make_folder
      integer(c_int) function c_remove_folder(path) bind(C, name="rv_posix_remove_folder")
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_remove_folder
      integer(c_int) function c_remove_file(path) bind(C, name="rv_posix_remove_file")
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_remove_file
      integer(c_int) function c_rename(from, to) bind(C, name="rv_posix_rename")
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: from(*), to(*)
      end function c_rename
      integer(c_int) function c_link(from, to, taken) bind(C, name="rv_posix_link")
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: from(*), to(*)
         integer(c_int), intent(out) :: taken
      end function c_link
      integer(c_int) function c_kind(path, kind, size) bind(C, name="rv_posix_kind")
         import :: c_int, c_char, c_int64_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), intent(out) :: kind
         integer(c_int64_t), intent(out) :: size
      end function c_kind
      integer(c_int) function c_free_bytes(path, bytes) bind(C, name="rv_posix_free_bytes")
         import :: c_int, c_char, c_int64_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int64_t), intent(out) :: bytes
      end function c_free_bytes
      integer(c_int) function c_reserve(path, bytes) bind(C, name="rv_posix_reserve")
         import :: c_int, c_char, c_int64_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int64_t), value :: bytes
      end function c_reserve
      integer(c_int) function c_sync_folder(path) bind(C, name="rv_posix_sync_folder")
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
      end function c_sync_folder
      integer(c_int) function c_lock(path, holder, shared, fd, state) bind(C, name="rv_posix_lock")
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*), holder(*)
         integer(c_int), value :: shared
         integer(c_int), intent(out) :: fd, state
      end function c_lock
      subroutine c_unlock(path, fd) bind(C, name="rv_posix_unlock")
         import :: c_int, c_char
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: fd
      end subroutine c_unlock
      integer(c_int) function c_list_open(path, list) bind(C, name="rv_posix_list_open")
         import :: c_int, c_char, c_ptr
         character(kind=c_char), intent(in) :: path(*)
         type(c_ptr), intent(out) :: list
      end function c_list_open
      integer(c_int) function c_list_next(list, name, size) bind(C, name="rv_posix_list_next")
         import :: c_int, c_char, c_ptr, c_size_t
         type(c_ptr), value :: list
         character(kind=c_char), intent(out) :: name(*)
         integer(c_size_t), value :: size
      end function c_list_next
      subroutine c_list_close(list) bind(C, name="rv_posix_list_close")
         import :: c_ptr
         type(c_ptr), value :: list
      end subroutine c_list_close
      subroutine keep_standard_files() bind(C, name="rv_posix_keep_standard_files")
      end subroutine keep_standard_files
      integer(c_int) function c_is_terminal(fd) bind(C, name="rv_posix_is_terminal")
         import :: c_int
         integer(c_int), value :: fd
      end function c_is_terminal
      integer(c_int) function c_terminal_width(fd) bind(C, name="rv_posix_terminal_width")
         import :: c_int
         integer(c_int), value :: fd
      end function c_terminal_width
      real(c_double) function c_seconds() bind(C, name="rv_posix_seconds")
         import :: c_double
      end function c_seconds
      subroutine c_nap(seconds) bind(C, name="rv_posix_nap")
         import :: c_double
         real(c_double), value :: seconds
      end subroutine c_nap
      subroutine c_date(buffer, size) bind(C, name="rv_posix_date")
         import :: c_char, c_size_t
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end subroutine c_date
      subroutine c_host(buffer, size) bind(C, name="rv_posix_host")
         import :: c_char, c_size_t
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end subroutine c_host
      integer(c_int) function c_process() bind(C, name="rv_posix_process")
         import :: c_int
      end function c_process
      integer(c_int64_t) function c_process_mark() bind(C, name="rv_posix_process_mark")
         import :: c_int64_t
      end function c_process_mark
      integer(c_int) function c_is_neighbour(mark) bind(C, name="rv_posix_is_neighbour")
         import :: c_int, c_int64_t
         integer(c_int64_t), value :: mark
      end function c_is_neighbour
      integer(c_int) function c_is_gone(mark) bind(C, name="rv_posix_is_gone")
         import :: c_int, c_int64_t
         integer(c_int64_t), value :: mark
      end function c_is_gone
   end interface

contains

   !> What kind of thing `path` is (one of path_*), and its size in bytes.
   subroutine path_kind(path, kind, error, size)
      character(len=*), intent(in) :: path
      integer, intent(out) :: kind
      type(error_type), allocatable, intent(out) :: error
      integer(i8), optional, intent(out) :: size  !! [byte]
      integer(c_int) :: found
      integer(c_int64_t) :: bytes

      call check(c_kind(c_text(path), found, bytes), "look at '"//path//"'", error)
      kind = found
      if (present(size)) size = bytes
   end subroutine path_kind

   !> Bytes free for us on the file system of `path`; -1 where it will not say.
   function free_bytes(path) result(bytes)
      character(len=*), intent(in) :: path
      integer(i8) :: bytes                        !! [byte]

      if (c_free_bytes(c_text(path), bytes) /= 0) bytes = -1
   end function free_bytes

   !> Fail if there is no room for a file `path` of so many bytes; no file is left.
   subroutine check_room(path, bytes, error)
      character(len=*), intent(in) :: path
      integer(i8), intent(in) :: bytes            !! [byte]
      type(error_type), allocatable, intent(out) :: error

      call check(c_reserve(c_text(path), bytes), "write the "//to_text(bytes/1048576 + 1)//" MiB of '"//path//"'", &
         & error)
   end subroutine check_room

   !> Make one folder; one that exists is a failure.
   subroutine make_folder(path, error)
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      call check(c_make_folder(c_text(path)), "make the folder '"//path//"'", error)
   end subroutine make_folder

   !> Remove one empty folder.
   subroutine remove_folder(path, error)
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      call check(c_remove_folder(c_text(path)), "remove the folder '"//path//"'", error)
   end subroutine remove_folder

   subroutine remove_file(path, error)
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      call check(c_remove_file(c_text(path)), "remove '"//path//"'", error)
   end subroutine remove_file

   !> Give a file its final name in one step; a file of that name is replaced.
   subroutine rename_path(from, to, error)
      character(len=*), intent(in) :: from, to
      type(error_type), allocatable, intent(out) :: error

      call check(c_rename(c_text(from), c_text(to)), "rename '"//from//"' to '"//to//"'", error)
   end subroutine rename_path

   !> Give a whole file its final name in one step, unless a file has that name: then it stays, and `taken` is true.
   subroutine claim_name(from, to, taken, error)
      character(len=*), intent(in) :: from, to
      logical, intent(out) :: taken
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: ignored
      integer(c_int) :: found, status

      status = c_link(c_text(from), c_text(to), found)
      taken = found /= 0
      if (status /= 0) then
         ! a file system without links, where the last of several that come at once has the name
         call rename_path(from, to, error)
      else
         call remove_file(from, ignored)
      end if
   end subroutine claim_name

   !> Bring the names in a folder to the disk.
   subroutine sync_folder(path, error)
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error

      call check(c_sync_folder(c_text(path)), "write the folder '"//path//"' to disk", error)
   end subroutine sync_folder

   !> The names in a folder, in no particular order.
   subroutine list_folder(path, name, error)
      character(len=*), intent(in) :: path
      type(text_type), allocatable, intent(out) :: name(:)
      type(error_type), allocatable, intent(out) :: error
      type(text_type), allocatable :: longer(:)
      character(kind=c_char) :: buffer(longest_text)
      type(c_ptr) :: list
      integer :: n

      allocate(name(0))
      list = c_null_ptr
      call check(c_list_open(c_text(path), list), "list the folder '"//path//"'", error)
      if (allocated(error)) return
      allocate(longer(16))
      n = 0
      do while (c_list_next(list, buffer, size(buffer, kind=c_size_t)) == 1)
         n = n + 1
         if (n > size(longer)) longer = [longer, longer]
         call from_c(buffer, longer(n)%s)
      end do
      call c_list_close(list)
      name = longer(:n)
   end subroutine list_folder

   !> Take the lock of a lock file, which is made if need be. The lock ends with unlock_file or with the process.
   subroutine lock_file(path, holder, fd, state, error, shared)
      character(len=*), intent(in) :: path
      character(len=*), intent(in) :: holder      !! written into the file, for whoever is refused
      integer(c_int), intent(out) :: fd           !! open unless the lock is held by another
      integer, intent(out) :: state               !! one of lock_*
      type(error_type), allocatable, intent(out) :: error
      logical, optional, intent(in) :: shared     !! hold it together with others who share it; default: alone
      integer(c_int) :: found, together

      together = 0
      if (present(shared)) together = merge(1_c_int, 0_c_int, shared)
      call check(c_lock(c_text(path), c_text(holder), together, fd, found), "lock '"//path//"'", error)
      state = found
   end subroutine lock_file

   !> End a lock; the last of its holders removes the file.
   subroutine unlock_file(path, fd)
      character(len=*), intent(in) :: path
      integer(c_int), intent(inout) :: fd         !! negative: nothing is locked

      if (fd >= 0) call c_unlock(c_text(path), fd)
      fd = -1
   end subroutine unlock_file

   !> From now on SIGINT, SIGTERM, SIGUSR1 and SIGHUP are only noted, once; for a program, not for a library's caller.
   subroutine catch_signals(notice, error)
      character(len=*), intent(in) :: notice      !! written to standard error when one comes; may be empty
      type(error_type), allocatable, intent(out) :: error

      call check(c_catch_signals(c_text(notice)), "catch signals", error)
   end subroutine catch_signals

   function signal_seen() result(seen)
      logical :: seen

      seen = c_signal_seen() /= 0
   end function signal_seen

   !> Is file descriptor `fd` (1 output, 2 messages) a terminal?
   function is_terminal(fd) result(yes)
      integer, intent(in) :: fd
      logical :: yes

      yes = c_is_terminal(int(fd, c_int)) /= 0
   end function is_terminal

   !> Columns of the terminal behind `fd`; 0 where there is none.
   function terminal_width(fd) result(columns)
      integer, intent(in) :: fd
      integer :: columns

      columns = c_terminal_width(int(fd, c_int))
   end function terminal_width

   !> Seconds of a clock that never jumps; only differences mean something.
   function seconds() result(t)
      real(wp) :: t                               !! [s]

      t = c_seconds()
   end function seconds

   !> Let the processor go for a while.
   subroutine nap(duration)
      real(wp), intent(in) :: duration            !! [s], >= 0

      call c_nap(duration)
   end subroutine nap

   !> Now, as 2024-05-31T18:00:00Z.
   function utc_date() result(text)
      character(len=:), allocatable :: text
      character(kind=c_char) :: buffer(64)

      call c_date(buffer, size(buffer, kind=c_size_t))
      call from_c(buffer, text)
   end function utc_date

   function host_name() result(text)
      character(len=:), allocatable :: text
      character(kind=c_char) :: buffer(256)

      call c_host(buffer, size(buffer, kind=c_size_t))
      call from_c(buffer, text)
   end function host_name

   function process_number() result(number)
      integer :: number

      number = c_process()
   end function process_number

   !> A number that no other process has, on whatever host, while both run.
   function process_mark() result(mark)
      integer(i8) :: mark

      mark = c_process_mark()
   end function process_mark

   !> Is the process of this mark on this host?
   logical function is_neighbour(mark)
      integer(i8), intent(in) :: mark

      is_neighbour = c_is_neighbour(mark) /= 0
   end function is_neighbour

   !> Has the process of this mark, one of this host, ended?
   logical function is_gone(mark)
      integer(i8), intent(in) :: mark

      is_gone = c_is_gone(mark) /= 0
   end function is_gone

   !> The system's own sentence for an error number.
   subroutine get_reason(number, text)
      integer(c_int), intent(in) :: number
      character(len=:), allocatable, intent(out) :: text
      character(kind=c_char) :: buffer(256)

      call c_reason(number, buffer, size(buffer, kind=c_size_t))
      call from_c(buffer, text)
   end subroutine get_reason

   !> `text` as C wants it. A zero byte inside would cut the name short: it becomes '?'.
   pure function c_text(text) result(copy)
      character(len=*), intent(in) :: text
      character(kind=c_char) :: copy(len(text) + 1)
      integer :: i

      do i = 1, len(text)
         copy(i) = text(i:i)
         if (copy(i) == c_null_char) copy(i) = "?"
      end do
      copy(len(text) + 1) = c_null_char
   end function c_text

   !> What stands in `buffer` before its zero byte.
   !>
   !> No function: gfortran keeps the length of a deferred-length result in a static variable of each call,
   !> and errors of several threads pass here.
   pure subroutine from_c(buffer, text)
      character(kind=c_char), intent(in) :: buffer(:)
      character(len=:), allocatable, intent(out) :: text
      integer :: n, i

      n = 0
      do while (n < size(buffer))
         if (buffer(n + 1) == c_null_char) exit
         n = n + 1
      end do
      allocate(character(len=n) :: text)
      do i = 1, n
         text(i:i) = buffer(i)
      end do
   end subroutine from_c

   subroutine check(number, what, error)
      integer(c_int), intent(in) :: number
      character(len=*), intent(in) :: what
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: reason

      if (number == 0) return
      call get_reason(number, reason)
      call fail(error, rv_io, "cannot "//what//": "//reason)
   end subroutine check

end module rv_posix
