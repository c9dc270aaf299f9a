!> Checksums, files as bytes, records, locks: what parts and results lean on.
program test_bytes
   use, intrinsic :: iso_c_binding, only : c_int, c_loc
   use, intrinsic :: iso_fortran_env, only : int32
   use check, only : suite_type
   use rv_checksum, only : crc32_of, crc32_text, hex_text
   use rv_error, only : error_type
   use rv_file, only : claim_whole_file, file_type, read_whole_file, write_whole_file
   use rv_kinds, only : wp, i8
   use rv_posix, only : list_folder, lock_file, lock_held, lock_ours, nap, path_folder, path_kind, path_none, &
      & process_mark, remove_file, seconds, unlock_file
   use rv_records, only : add_record, next_record, record_count, record_value
   use rv_text, only : text_type, to_text
   implicit none
   type(suite_type) :: suite

   call test_checksum()
   call test_whole_files()
   call test_claims()
   call test_pieces()
   call test_records()
   call test_locks()
   call test_shared_locks()
   call test_clock()
   call suite%finish()

contains

   !> The check value of CRC-32 and others from Python's zlib.
   subroutine test_checksum()
      character(len=70), target :: text
      integer(int32) :: split
      integer :: i

      call suite%text("CRC-32 of 123456789", hex_text(crc32_text("123456789")), "CBF43926")
      call suite%text("CRC-32 of nothing", hex_text(crc32_text("")), "00000000")
      text = "The quick brown fox jumps over the lazy dog"
      call suite%text("CRC-32 of the fox", hex_text(crc32_text(trim(text))), "414FA339")
      do i = 0, 24
         split = crc32_of(c_loc(text), int(i, i8))
         split = crc32_of(c_loc(text(i + 1:i + 1)), 70_i8 - i, split)
         call suite%true("the same in two pieces, cut after "//to_text(i), split == crc32_text(text))
      end do
   end subroutine test_checksum

   subroutine test_whole_files()
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      logical :: found
      integer :: kind
      integer(i8) :: size

      call write_whole_file("whole.txt", "two"//new_line("a")//"lines"//achar(0), error)
      call suite%no_error("write a file", error)
      call read_whole_file("whole.txt", text, found, error)
      call suite%true("read it back", found .and. text == "two"//new_line("a")//"lines"//achar(0))
      call path_kind("whole.txt.new", kind, error)
      call suite%equal("no temporary file is left", kind, path_none)
      call path_kind("whole.txt", kind, error, size)
      call suite%equal("its size", int(size), 10)
      call remove_file("whole.txt", error)
      call suite%no_error("remove it", error)
      call remove_file("whole.txt", error)
      call suite%fails("remove it again", error, "cannot remove 'whole.txt': No such file")
      call read_whole_file("whole.txt", text, found, error)
      call suite%true("a file that is not there", .not. (found .or. allocated(error)))
      call read_whole_file(".", text, found, error)
      call suite%fails("read a folder", error, "is not a file")
      call path_kind("/", kind, error)
      call suite%equal("the root is a folder", kind, path_folder)
      call write_whole_file("no/such/folder.txt", "x", error)
      call suite%fails("write where there is no folder", error, "cannot write 'no/such/folder.txt': No such file")
   end subroutine test_whole_files

   !> Who comes second finds the first one's file, and leaves nothing.
   subroutine test_claims()
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      type(text_type), allocatable :: before(:), after(:)
      logical :: found, taken

      call list_folder(".", before, error)
      call claim_whole_file("claimed.txt", "the first", taken, error)
      call suite%no_error("claim a name", error)
      call suite%true("which nobody had", .not. taken)
      call claim_whole_file("claimed.txt", "the second", taken, error)
      call suite%no_error("claim it again", error)
      call suite%true("somebody has it", taken)
      call read_whole_file("claimed.txt", text, found, error)
      call suite%text("the first stays", text, "the first")
      call list_folder(".", after, error)
      call suite%equal("files more than before", size(after) - size(before), 1)
      call remove_file("claimed.txt", error)
      call claim_whole_file("no/such/folder.txt", "x", taken, error)
      call suite%fails("claim where there is no folder", error, "No such file")
   end subroutine test_claims

   !> Text in pieces larger than the buffer, and a device without room.
   subroutine test_pieces()
      type(file_type) :: file
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text, piece
      logical :: found
      integer :: i

      piece = repeat("0123456789", 3001)
      call file%create("pieces.txt", error)
      do i = 1, 20
         call file%put_text(piece, error)
      end do
      call file%close(error)
      call suite%no_error("close", error)
      call read_whole_file("pieces.txt", text, found, error)
      call suite%true("all pieces arrived", text == repeat(piece, 20))
      call remove_file("pieces.txt", error)

      call file%append("/dev/full", error)
      call suite%no_error("open a full device", error)
      call file%put_text(piece, error)
      call suite%no_error("text waits in the buffer", error)
      call file%sync(error)
      call suite%fails("a full device", error, "cannot write '/dev/full': No space left on device")
      call file%close()
   end subroutine test_pieces

   subroutine test_records()
      character(len=:), allocatable :: text, name, value
      integer :: at, cut

      text = ""
      call add_record(text, "one", "")
      call add_record(text, "two", "three 5"//new_line("a")//"hello"//new_line("a"))
      call add_record(text, "two", " blanks ")
      at = 1
      call next_record(text, at, name, value)
      call suite%text("an empty value", name//"="//value, "one=")
      call next_record(text, at, name, value)
      call suite%true("a value like a record", value == "three 5"//new_line("a")//"hello"//new_line("a"))
      call next_record(text, at, name, value)
      call suite%text("blanks stay", value, " blanks ")
      call next_record(text, at, name, value)
      call suite%text("the end", name, "")
      call suite%equal("count", record_count(text, "two"), 2)
      call suite%text("the first of a name", record_value(text, "one"), "")
      do cut = 0, len(text) - 2
         if (record_count(text(:cut), "two") > 1) exit
      end do
      call suite%equal("a text cut short never has all records", cut, len(text) - 1)
   end subroutine test_records

   subroutine test_locks()
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      integer(c_int) :: first, second
      integer :: state
      logical :: found

      call lock_file("test.lock", "the first", first, state, error)
      call suite%equal("take a lock", state, lock_ours)
      call lock_file("test.lock", "the second", second, state, error)
      call suite%equal("it is taken", state, lock_held)
      call read_whole_file("test.lock", text, found, error)
      call suite%text("the holder's name", text, "the first")
      call unlock_file("test.lock", first)
      call lock_file("test.lock", "short", second, state, error)
      call suite%equal("take it when it is free", state, lock_ours)
      call read_whole_file("test.lock", text, found, error)
      call suite%text("the new holder's name", text, "short")
      call remove_file("test.lock", error)
      call lock_file("test.lock", "a third", first, state, error)
      call suite%equal("a removed file is a new lock", state, lock_ours)
      call unlock_file("test.lock", first)
      call unlock_file("test.lock", second)
      call remove_file("test.lock", error)
      call lock_file("no/such/lock", "x", first, state, error)
      call suite%fails("lock where there is no folder", error, "cannot lock 'no/such/lock'")
   end subroutine test_locks

   !> Several share a lock; who wants it alone has to wait for the last of them, whose file goes with it.
   subroutine test_shared_locks()
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      integer(c_int) :: first, second, alone
      integer :: state, kind
      logical :: found

      call lock_file("shared.lock", "one ", first, state, error, shared=.true.)
      call suite%equal("share a lock", state, lock_ours)
      call lock_file("shared.lock", "two", second, state, error, shared=.true.)
      call suite%equal("share it again", state, lock_ours)
      call read_whole_file("shared.lock", text, found, error)
      call suite%text("both names", text, "one two")
      call lock_file("shared.lock", "three", alone, state, error)
      call suite%equal("nobody has it alone", state, lock_held)
      call unlock_file("shared.lock", first)
      call path_kind("shared.lock", kind, error)
      call suite%true("it stays while one is left", kind /= path_none)
      call lock_file("shared.lock", "three", alone, state, error)
      call suite%equal("still nobody has it alone", state, lock_held)
      call unlock_file("shared.lock", second)
      call path_kind("shared.lock", kind, error)
      call suite%equal("it goes with the last", kind, path_none)
      call lock_file("shared.lock", "three", alone, state, error)
      call suite%equal("now it can be had alone", state, lock_ours)
      call lock_file("shared.lock", "one", first, state, error, shared=.true.)
      call suite%equal("and not be shared", state, lock_held)
      call unlock_file("shared.lock", alone)
   end subroutine test_shared_locks

   subroutine test_clock()
      real(wp) :: start, later
      integer(i8) :: mark, again

      start = seconds()
      later = seconds()
      call suite%true("the clock does not run backwards", later >= start)
      call nap(0.002_wp)
      call suite%true("a nap takes its time", seconds() - start >= 0.002_wp)
      mark = process_mark()
      again = process_mark()
      call suite%true("a process keeps its mark", mark == again .and. mark /= 0_i8)
   end subroutine test_clock

end program test_bytes
