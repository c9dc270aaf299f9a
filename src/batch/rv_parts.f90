!> Part files: the results of one finished block, whole or not there. They are the only channel between workers.
!>
!> A part is written under a temporary name, then renamed. Its head says to which run and block it belongs and how
!> long it is; both head and body carry a checksum, so a part that is cut short, damaged or foreign is found when
!> it is read. That is why nobody waits until it is on the disk: what a power cut spoils is computed again.
!> Numbers are in the byte order of the machine that wrote them.
module rv_parts
   use, intrinsic :: iso_c_binding, only : c_loc
   use, intrinsic :: iso_fortran_env, only : int32
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_io
   use rv_text, only : text_type, to_text
   use rv_posix, only : path_file, path_kind, remove_file, rename_path
   use rv_file, only : file_type, new_suffix, own_suffix
   use rv_block, only : block_result, n_facts, n_measures
   implicit none
   private
   public :: part_type, part_name, is_part_name, is_unfinished_name, block_of_name, write_part, read_part

   !> A block's results with what tells its cases apart.
   type :: part_type
      real(wp), allocatable :: input(:, :)   !! (inputs, cases): deck's unit, or the index of a word
      type(block_result) :: result
   end type part_type

   character(len=*), parameter :: prefix = "block_"
   character(len=*), parameter :: suffix = ".part"
   integer, parameter :: digits = 9          !! of a block's number in its name

   integer, parameter :: n_head = 14
   integer(i8), parameter :: magic = int(z'5256506172740D0A', i8)   !! also tells the byte order
   integer(i8), parameter :: format_version = 2
   integer(i8), parameter :: bytes_real = storage_size(1.0_wp)/8
   integer(i8), parameter :: bytes_integer = storage_size(1)/8
   integer(i8), parameter :: bytes_word = storage_size(1_i8)/8   !! of the head and the checksums

contains

   !> "block_000000017.part"
   pure function part_name(block) result(name)
      integer, intent(in) :: block
      character(len=len(prefix) + digits + len(suffix)) :: name

      write(name, '(a, i9.9, a)') prefix, block, suffix
   end function part_name

   !> Is `name` a part's, finished or not? Such files may be removed.
   pure logical function is_part_name(name) result(yes)
      character(len=*), intent(in) :: name

      yes = block_of_name(name) > 0 .or. is_unfinished_name(name)
   end function is_part_name

   !> Is `name` that of a part in the making, or of one whose maker was killed?
   pure logical function is_unfinished_name(name) result(yes)
      character(len=*), intent(in) :: name
      integer :: whole

      whole = len(prefix) + digits + len(suffix)
      yes = .false.
      if (len(name) < whole + len(new_suffix)) return
      yes = block_of_name(name(:whole)) > 0 .and. name(whole + 1:whole + len(new_suffix)) == new_suffix
   end function is_unfinished_name

   !> The block whose finished part has that name; 0 for other names.
   pure integer function block_of_name(name) result(block)
      character(len=*), intent(in) :: name
      integer :: behind

      block = 0
      behind = len(prefix) + digits
      if (len(name) /= behind + len(suffix)) return
      if (name(:len(prefix)) /= prefix .or. name(behind + 1:) /= suffix) return
      if (verify(name(len(prefix) + 1:behind), "0123456789") > 0) return
      read(name(len(prefix) + 1:behind), '(i9)') block
   end function block_of_name

   !> Write the part of `block` into `folder`; on failure nothing of it is left.
   subroutine write_part(folder, identity, block, part, error)
      character(len=*), intent(in) :: folder
      integer(int32), intent(in) :: identity      !! of the run's manifest
      integer, intent(in) :: block                !! 1, 2, ...
      type(part_type), intent(in) :: part
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: ignored
      type(file_type) :: file
      character(len=:), allocatable :: path, own

      path = folder//"/"//part_name(block)
      own = path//own_suffix()
      call file%create(own, error)
      if (allocated(error)) return
      call put_part(file, identity, block, part, error)
      if (.not. allocated(error)) call file%close(error)
      if (.not. allocated(error)) call rename_path(own, path, error)
      if (.not. allocated(error)) return
      call file%close()
      call remove_file(own, ignored)
   end subroutine write_part

   !> Read and verify the part of `block`. `found` is false without an error when there is none; a part that
   !> is damaged or foreign is an error whose message says why.
   subroutine read_part(folder, identity, block, part, found, error)
      character(len=*), intent(in) :: folder
      integer(int32), intent(in) :: identity
      integer, intent(in) :: block
      type(part_type), intent(out) :: part
      logical, intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(file_type) :: file
      character(len=:), allocatable :: path
      integer :: kind
      integer(i8) :: size

      path = folder//"/"//part_name(block)
      found = .false.
      call path_kind(path, kind, error, size)
      if (allocated(error) .or. kind /= path_file) return
      call file%open_old(path, error)
      if (allocated(error)) return
      call get_part(file, identity, block, size, part, error)
      call file%close()
      found = .not. allocated(error)
      if (allocated(error)) error%message = "the part '"//path//"' cannot be used: "//error%message
   end subroutine read_part

   subroutine put_part(file, identity, block, part, error)
      type(file_type), intent(inout) :: file
      integer(int32), intent(in) :: identity
      integer, intent(in) :: block
      type(part_type), target, intent(in) :: part
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: messages
      integer(i8), target :: head(n_head)
      integer(i8) :: n

      n = size(part%result%status)
      call join(part%result%message, messages)
      head = [magic, format_version, int(identity, i8), int(block, i8), part%result%first, n, &
         & size(part%input, 1, i8), int(n_measures, i8), int(n_facts, i8), size(part%result%trace, 1, i8), &
         & size(part%result%trace, 2, i8), len(messages, i8), size(part%result%field, 1, i8), size(part%result%field, 2, i8)]
      call file%put(c_loc(head), bytes_word*n_head, error)
      if (allocated(error)) return
      call put_checksum(file, error)
      if (.not. allocated(error)) call put_reals(file, part%input, size(part%input, kind=i8), error)
      if (.not. allocated(error)) call put_reals(file, part%result%measure, n_measures*n, error)
      if (.not. allocated(error)) call put_reals(file, part%result%fact, n_facts*n, error)
      if (.not. allocated(error)) call put_integers(file, part%result%status, n, error)
      if (.not. allocated(error)) call put_integers(file, part%result%warnings, n, error)
      if (.not. allocated(error)) call put_integers(file, lengths(part%result%message), n, error)
      if (.not. allocated(error)) call put_text(file, messages, error)
      if (.not. allocated(error)) call put_reals(file, part%result%trace, size(part%result%trace, kind=i8), error)
      if (.not. allocated(error)) call put_reals(file, part%result%field, size(part%result%field, kind=i8), error)
      if (.not. allocated(error)) call put_checksum(file, error)
   end subroutine put_part

   subroutine get_part(file, identity, block, size, part, error)
      type(file_type), intent(inout) :: file
      integer(int32), intent(in) :: identity
      integer, intent(in) :: block
      integer(i8), intent(in) :: size             !! of the file [byte]
      type(part_type), target, intent(inout) :: part
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: messages
      integer, allocatable :: length(:)
      integer(i8), target :: head(n_head)
      integer(i8) :: n

      call file%get(c_loc(head), bytes_word*n_head, error)
      if (allocated(error)) return
      call get_checksum(file, error)
      if (allocated(error)) return
      call check_head(head, identity, block, size, error)
      if (allocated(error)) return
      n = head(6)
      allocate(part%input(head(7), n), part%result%measure(n_measures, n), part%result%fact(n_facts, n))
      allocate(part%result%status(n), part%result%warnings(n), length(n))
      allocate(part%result%trace(head(10), head(11), n), part%result%field(head(13), head(14), n))
      allocate(character(len=head(12)) :: messages)
      part%result%first = head(5)
      call get_reals(file, part%input, head(7)*n, error)
      if (.not. allocated(error)) call get_reals(file, part%result%measure, n_measures*n, error)
      if (.not. allocated(error)) call get_reals(file, part%result%fact, n_facts*n, error)
      if (.not. allocated(error)) call get_integers(file, part%result%status, n, error)
      if (.not. allocated(error)) call get_integers(file, part%result%warnings, n, error)
      if (.not. allocated(error)) call get_integers(file, length, n, error)
      if (.not. allocated(error)) call get_text(file, messages, error)
      if (.not. allocated(error)) call get_reals(file, part%result%trace, head(10)*head(11)*n, error)
      if (.not. allocated(error)) call get_reals(file, part%result%field, head(13)*head(14)*n, error)
      if (.not. allocated(error)) call get_checksum(file, error)
      if (.not. allocated(error)) part%result%message = split(messages, length)
   end subroutine get_part

   !> The head of a part of this run and block, in a file of the size it promises?
   subroutine check_head(head, identity, block, size, error)
      integer(i8), intent(in) :: head(n_head)
      integer(int32), intent(in) :: identity
      integer, intent(in) :: block
      integer(i8), intent(in) :: size
      type(error_type), allocatable, intent(out) :: error
      integer(i8) :: n, expected

      n = head(6)
      expected = bytes_word*(n_head + 2) + bytes_real*((head(7) + n_measures + n_facts + head(10)*head(11) &
         & + head(13)*head(14))*n) &
         & + 3*bytes_integer*n + head(12)
      if (head(1) /= magic .or. head(2) /= format_version .or. head(8) /= n_measures &
         & .or. head(9) /= n_facts) then
         call fail(error, rv_io, "it is no part of this version of reedvalve, or of a machine of another byte order")
      else if (head(3) /= identity .or. head(4) /= block) then
         call fail(error, rv_io, "it belongs to another run")
      else if (size /= expected) then
         call fail(error, rv_io, "it has "//to_text(size)//" bytes instead of "//to_text(expected))
      end if
   end subroutine check_head

   !> The checksum of what was put since the last one.
   subroutine put_checksum(file, error)
      type(file_type), intent(inout) :: file
      type(error_type), allocatable, intent(out) :: error
      integer(i8), target :: sum

      sum = file%crc
      call file%put(c_loc(sum), bytes_word, error)
      file%crc = 0
   end subroutine put_checksum

   subroutine get_checksum(file, error)
      type(file_type), intent(inout) :: file
      type(error_type), allocatable, intent(out) :: error
      integer(i8), target :: sum
      integer(i8) :: expected

      expected = file%crc
      call file%get(c_loc(sum), bytes_word, error)
      if (.not. allocated(error) .and. sum /= expected) call fail(error, rv_io, "its checksum is wrong")
      file%crc = 0
   end subroutine get_checksum

   subroutine put_reals(file, x, n, error)
      type(file_type), intent(inout) :: file
      integer(i8), intent(in) :: n
      real(wp), target, intent(in) :: x(n)
      type(error_type), allocatable, intent(out) :: error

      if (n > 0) call file%put(c_loc(x), bytes_real*n, error)
   end subroutine put_reals

   subroutine get_reals(file, x, n, error)
      type(file_type), intent(inout) :: file
      integer(i8), intent(in) :: n
      real(wp), target, intent(inout) :: x(n)
      type(error_type), allocatable, intent(out) :: error

      if (n > 0) call file%get(c_loc(x), bytes_real*n, error)
   end subroutine get_reals

   subroutine put_integers(file, x, n, error)
      type(file_type), intent(inout) :: file
      integer(i8), intent(in) :: n
      integer, target, intent(in) :: x(n)
      type(error_type), allocatable, intent(out) :: error

      if (n > 0) call file%put(c_loc(x), bytes_integer*n, error)
   end subroutine put_integers

   subroutine get_integers(file, x, n, error)
      type(file_type), intent(inout) :: file
      integer(i8), intent(in) :: n
      integer, target, intent(inout) :: x(n)
      type(error_type), allocatable, intent(out) :: error

      if (n > 0) call file%get(c_loc(x), bytes_integer*n, error)
   end subroutine get_integers

   subroutine put_text(file, text, error)
      type(file_type), intent(inout) :: file
      character(len=*), target, intent(in) :: text
      type(error_type), allocatable, intent(out) :: error

      if (len(text) > 0) call file%put(c_loc(text), len(text, i8), error)
   end subroutine put_text

   subroutine get_text(file, text, error)
      type(file_type), intent(inout) :: file
      character(len=*), target, intent(inout) :: text
      type(error_type), allocatable, intent(out) :: error

      if (len(text) > 0) call file%get(c_loc(text), len(text, i8), error)
   end subroutine get_text

   pure function lengths(message) result(length)
      type(text_type), intent(in) :: message(:)
      integer :: length(size(message))
      integer :: i

      do i = 1, size(message)
         length(i) = 0
         if (allocated(message(i)%s)) length(i) = len(message(i)%s)
      end do
   end function lengths

   !> All messages one behind the other; no function, for threads' sake (see rv_posix).
   pure subroutine join(message, text)
      type(text_type), intent(in) :: message(:)
      character(len=:), allocatable, intent(out) :: text
      integer :: length(size(message)), i, at

      length = lengths(message)
      allocate(character(len=sum(length)) :: text)
      at = 0
      do i = 1, size(message)
         if (length(i) > 0) text(at + 1:at + length(i)) = message(i)%s
         at = at + length(i)
      end do
   end subroutine join

   pure function split(text, length) result(message)
      character(len=*), intent(in) :: text
      integer, intent(in) :: length(:)
      type(text_type) :: message(size(length))
      integer :: i, at

      at = 0
      do i = 1, size(length)
         message(i)%s = text(at + 1:at + length(i))
         at = at + length(i)
      end do
   end function split

end module rv_parts
