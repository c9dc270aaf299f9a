!> Part files: what is written is read, and no damage passes.
program test_parts
   use, intrinsic :: iso_fortran_env, only : int32
   use check, only : suite_type
   use rv_block, only : n_facts, n_measures, n_traces
   use rv_error, only : error_type
   use rv_file, only : read_whole_file, write_whole_file
   use rv_kinds, only : wp, i8
   use rv_parts, only : block_of_name, is_part_name, is_unfinished_name, part_name, part_type, read_part, write_part
   use rv_text, only : to_text
   implicit none
   integer(int32), parameter :: identity = -77_int32
   type(suite_type) :: suite

   call test_names()
   call test_round_trip(cases=5, times=4)
   call test_round_trip(cases=1, times=0)
   call test_foreign()
   call test_damage()
   call suite%finish()

contains

   subroutine test_names()
      call suite%text("name", part_name(17), "block_000000017.part")
      call suite%true("a part's name", is_part_name("block_000000017.part"))
      call suite%true("a part in the making", is_part_name("block_000000017.part.new"))
      call suite%true("of a process of its own", is_part_name("block_000000017.part.new00c0ffee00000001"))
      call suite%true("which is unfinished", is_unfinished_name("block_000000017.part.new00c0ffee00000001"))
      call suite%true("others are not", .not. (is_unfinished_name("block_000000017.part") .or. is_unfinished_name("a.new")))
      call suite%equal("the block of a name", block_of_name("block_000000017.part"), 17)
      call suite%equal("and of no part", block_of_name("block_000000017.part.new") + block_of_name("block_00000001x.part"), 0)
      call suite%true("other names", .not. (is_part_name("block_17.part") .or. is_part_name("manifest") &
         & .or. is_part_name("block_000000017.party") .or. is_part_name("block_00000001x.part") .or. is_part_name("")))
   end subroutine test_names

   subroutine test_round_trip(cases, times)
      integer, intent(in) :: cases, times
      type(part_type) :: part, back
      type(error_type), allocatable :: error
      logical :: found
      integer :: i

      call make_part(part, cases, times)
      call write_part(".", identity, 3, part, error)
      call suite%no_error("write "//to_text(cases)//" cases", error)
      call read_part(".", identity, 3, back, found, error)
      call suite%no_error("read them", error)
      call suite%true("found", found)
      call suite%true("first case", back%result%first == part%result%first)
      call suite%true("inputs", all(same(back%input, part%input)))
      call suite%true("measures, NaN too", all(same(back%result%measure, part%result%measure)))
      call suite%true("facts", all(same(back%result%fact, part%result%fact)))
      call suite%true("status", all(back%result%status == part%result%status))
      call suite%true("warnings", all(back%result%warnings == part%result%warnings))
      call suite%true("traces", all(same(back%result%trace, part%result%trace)))
      call suite%true("fields", all(same(back%result%field, part%result%field)))
      call suite%equal("size of the traces", size(back%result%trace, 1), times)
      do i = 1, cases - 1
         call suite%text("message "//to_text(i), back%result%message(i)%s, part%result%message(i)%s)
      end do
      call suite%text("a message that was not there", back%result%message(cases)%s, "")
   end subroutine test_round_trip

   subroutine test_foreign()
      type(part_type) :: part, back
      type(error_type), allocatable :: error
      character(len=:), allocatable :: bytes
      logical :: found

      call make_part(part, 3, 2)
      call write_part(".", identity, 1, part, error)
      call read_part(".", identity + 1_int32, 1, back, found, error)
      call suite%fails("a part of another run", error, "belongs to another run")
      call read_whole_file(part_name(1), bytes, found, error)
      call write_whole_file(part_name(2), bytes, error)
      call read_part(".", identity, 2, back, found, error)
      call suite%fails("a part of another block", error, "belongs to another run")
      call read_part(".", identity, 999, back, found, error)
      call suite%true("a part that is not there", .not. (found .or. allocated(error)))
      call write_part("no/such/folder", identity, 1, part, error)
      call suite%fails("a folder that is not there", error, "No such file")
   end subroutine test_foreign

   !> Every byte changed, every length too short, one too long: never taken for a part.
   subroutine test_damage()
      type(part_type) :: part, back
      type(error_type), allocatable :: error
      character(len=:), allocatable :: bytes, damaged
      logical :: found
      integer :: i, passed

      call make_part(part, 2, 1)
      call write_part(".", identity, 1, part, error)
      call read_whole_file(part_name(1), bytes, found, error)
      passed = 0
      do i = 1, len(bytes)
         damaged = bytes
         damaged(i:i) = achar(ieor(iachar(bytes(i:i)), 1 + mod(i, 127)))
         call write_whole_file(part_name(1), damaged, error)
         call read_part(".", identity, 1, back, found, error)
         if (found) passed = passed + 1
      end do
      call suite%equal("bytes of "//to_text(len(bytes))//" whose change is not noticed", passed, 0)
      passed = 0
      do i = 0, len(bytes) - 1, 7
         call write_whole_file(part_name(1), bytes(:i), error)
         call read_part(".", identity, 1, back, found, error)
         if (found .or. .not. allocated(error)) passed = passed + 1
      end do
      call suite%equal("lengths that are taken for the whole", passed, 0)
      call write_whole_file(part_name(1), bytes//"x", error)
      call read_part(".", identity, 1, back, found, error)
      call suite%fails("one byte too many", error, "bytes instead of")
   end subroutine test_damage

   subroutine make_part(part, cases, times)
      type(part_type), intent(out) :: part
      integer, intent(in) :: cases, times
      integer :: i

      part%result%first = 8193_i8
      part%input = reshape([(0.1_wp*i, i=1, 3*cases)], [3, cases])
      part%result%measure = reshape([(sqrt(real(i - 3, wp)), i=1, n_measures*cases)], [n_measures, cases])
      part%result%fact = reshape([(1.0e-7_wp/i, i=1, n_facts*cases)], [n_facts, cases])
      part%result%field = reshape([(1.0_wp/i, i=1, 6*cases)], [3, 2, cases])
      part%result%trace = reshape([(-1.0_wp/i, i=1, times*n_traces*cases)], [times, n_traces, cases])
      part%result%status = [(mod(i, 3), i=1, cases)]
      part%result%warnings = [(mod(i, 2), i=1, cases)]
      allocate(part%result%message(cases))
      do i = 1, cases - 1
         part%result%message(i)%s = repeat("message, ", i - 1)
      end do
   end subroutine make_part

   !> To the bit.
   elemental logical function same(a, b)
      real(wp), intent(in) :: a, b

      same = transfer(a, 1_i8) == transfer(b, 1_i8)
   end function same

end program test_parts
