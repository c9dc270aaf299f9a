!> The folder of a run: what lies where, who works in it, whether it holds results or an unfinished run.
!>
!>     results.nc  summary.csv  run.log      what a run leaves
!>     run.lock                              while one works here, or several slices; says who
!>     parts/manifest  parts/block_*.part    finished blocks of a run whose results are not in place yet
!>     parts/slice_*.lock                    while a slice is at work: nobody else runs that one
!>     parts.old/                            parts being removed
module rv_results_folder
   use, intrinsic :: iso_c_binding, only : c_int
   use rv_error, only : error_type, fail, rv_bad_input, rv_io
   use rv_text, only : text_type, to_text
   use rv_posix, only : host_name, list_folder, lock_file, lock_held, lock_none, make_folder, path_folder, path_kind, &
      & path_none, process_number, remove_file, remove_folder, rename_path, sync_folder, unlock_file, utc_date
   use rv_file, only : new_suffix, read_whole_file
   use rv_parts, only : block_of_name, is_part_name, is_unfinished_name
   implicit none
   private
   public :: results_folder, to_run, to_run_slice, to_merge, netcdf_name, csv_name, log_name, manifest_name

   !> What a folder is opened for.
   integer, parameter :: to_run = 1         !! alone; a folder that is not there is made
   integer, parameter :: to_run_slice = 2   !! together with other slices; it is made, too
   integer, parameter :: to_merge = 3       !! alone

   character(len=*), parameter :: netcdf_name = "results.nc"
   character(len=*), parameter :: csv_name = "summary.csv"
   character(len=*), parameter :: log_name = "run.log"
   character(len=*), parameter :: manifest_name = "manifest"
   character(len=*), parameter :: lock_name = "run.lock"
   character(len=*), parameter :: parts_name = "parts"
   character(len=*), parameter :: old_parts_name = "parts.old"
   character(len=*), parameter :: slice_prefix = "slice_", slice_suffix = ".lock"

   !> A folder in use by this process: open, then close on every path.
   type :: results_folder
      character(len=:), allocatable :: path    !! without a slash at the end
      character(len=:), allocatable :: parts   !! folder of the parts; it need not be there
      logical :: has_lock = .true.             !! false: this file system has no locks
      logical, private :: is_shared = .false.  !! other slices may work here at the same time
      integer(c_int), private :: lock = -1
      integer(c_int), private :: slice_lock = -1
      character(len=:), allocatable, private :: slice_name   !! of the lock's file
      logical, private :: made_here = .false.
   contains
      procedure :: open => open_folder
      procedure :: name => name_folder
      procedure :: close => close_folder
      procedure :: file
      procedure :: has_results
      procedure :: has_parts
      procedure :: find_finished
      procedure :: make_parts
      procedure :: take_slice
      procedure :: drop_unfinished
      procedure :: discard_parts
      procedure, private :: find_or_make
      procedure, private :: take_lock
   end type results_folder

contains

   !> Take the folder for this process, or for slices of one run, making it if need be.
   subroutine open_folder(self, path, purpose, error)
      class(results_folder), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer, intent(in) :: purpose              !! one of to_*
      type(error_type), allocatable, intent(out) :: error

      call self%name(path)
      self%is_shared = purpose == to_run_slice
      self%lock = -1
      self%made_here = .false.
      call self%find_or_make(purpose /= to_merge, error)
      if (allocated(error)) return
      call self%take_lock(error)
      if (.not. (allocated(error) .or. self%is_shared)) call empty_folder(self%file(old_parts_name), error)
      if (allocated(error)) call self%close()
   end subroutine open_folder

   !> Know the folder's places without taking it, for those who work on a run whose leader has it open.
   subroutine name_folder(self, path)
      class(results_folder), intent(inout) :: self
      character(len=*), intent(in) :: path

      self%path = without_slash(path)
      self%parts = self%file(parts_name)
   end subroutine name_folder

   !> Let others work here. A folder that this run made and left empty goes, too.
   subroutine close_folder(self)
      class(results_folder), intent(inout) :: self
      type(error_type), allocatable :: ignored

      if (allocated(self%slice_name)) call unlock_file(self%slice_name, self%slice_lock)
      call unlock_file(self%file(lock_name), self%lock)
      if (self%made_here) call remove_folder(self%path, ignored)
   end subroutine close_folder

   !> The path of a file of that name in the folder.
   pure function file(self, name) result(path)
      class(results_folder), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: path

      path = self%path//"/"//name
   end function file

   !> Is there a finished result, or half of one?
   subroutine has_results(self, yes, error)
      class(results_folder), intent(in) :: self
      logical, intent(out) :: yes
      type(error_type), allocatable, intent(out) :: error
      integer :: netcdf, csv

      yes = .false.
      call path_kind(self%file(netcdf_name), netcdf, error)
      if (allocated(error)) return
      call path_kind(self%file(csv_name), csv, error)
      yes = netcdf /= path_none .or. csv /= path_none
   end subroutine has_results

   !> Is there an unfinished run?
   subroutine has_parts(self, yes, error)
      class(results_folder), intent(in) :: self
      logical, intent(out) :: yes
      type(error_type), allocatable, intent(out) :: error
      type(text_type), allocatable :: name(:)
      integer :: kind, i

      yes = .false.
      call path_kind(self%parts, kind, error)
      if (allocated(error) .or. kind /= path_folder) return
      call list_folder(self%parts, name, error)
      do i = 1, size(name)
         yes = yes .or. name(i)%s == manifest_name .or. is_part_name(name(i)%s)
      end do
   end subroutine has_parts

   !> Which blocks have a part, by the names alone: whether it is sound is seen when it is read.
   subroutine find_finished(self, blocks, finished, error)
      class(results_folder), intent(in) :: self
      integer, intent(in) :: blocks               !! of the run
      logical, allocatable, intent(out) :: finished(:)
      type(error_type), allocatable, intent(out) :: error
      type(text_type), allocatable :: name(:)
      integer :: kind, i, block

      allocate(finished(blocks), source=.false.)
      call path_kind(self%parts, kind, error)
      if (allocated(error) .or. kind /= path_folder) return
      call list_folder(self%parts, name, error)
      do i = 1, size(name)
         block = block_of_name(name(i)%s)
         if (block >= 1 .and. block <= blocks) finished(block) = .true.
      end do
   end subroutine find_finished

   !> Make the folder of the parts, if it is not there.
   subroutine make_parts(self, error)
      class(results_folder), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error

      call make_if_missing(self%parts, error)
      if (allocated(error)) return
      call sync_folder(self%path, error)
   end subroutine make_parts

   !> Keep others from running the same slice at the same time; its parts' folder must be there.
   subroutine take_slice(self, slice, slices, error)
      class(results_folder), intent(inout) :: self
      integer, intent(in) :: slice, slices
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: holder

      self%slice_name = self%parts//"/"//slice_prefix//to_text(slice)//"_of_"//to_text(slices)//slice_suffix
      call lock_here(self%slice_name, .false., self%slice_lock, self%has_lock, holder, error)
      if (allocated(error) .or. holder == "") return
      call fail(error, rv_io, "slice "//to_text(slice)//"/"//to_text(slices)//" is at work in '"//self%path &
         & //"' already ("//holder//"): wait until it ends")
   end subroutine take_slice

   pure logical function is_slice_lock(name)
      character(len=*), intent(in) :: name

      is_slice_lock = index(name, slice_prefix) == 1 .and. index(name, slice_suffix, back=.true.) == len(name) - 4
   end function is_slice_lock

   !> Remove what killed workers left: half-written parts, locks of slices; only for who is alone here.
   subroutine drop_unfinished(self, error)
      class(results_folder), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      type(text_type), allocatable :: name(:)
      integer :: i

      call list_folder(self%parts, name, error)
      do i = 1, size(name)
         if (allocated(error)) return
         if (is_unfinished_name(name(i)%s) .or. is_slice_lock(name(i)%s)) call remove_file(self%parts//"/"//name(i)%s, error)
      end do
   end subroutine drop_unfinished

   !> Remove all parts. They vanish in one step, so that a killed removal leaves no half of a run.
   subroutine discard_parts(self, error)
      class(results_folder), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      integer :: kind

      call path_kind(self%parts, kind, error)
      if (allocated(error) .or. kind == path_none) return
      call rename_path(self%parts, self%file(old_parts_name), error)
      if (.not. allocated(error)) call sync_folder(self%path, error)
      if (.not. allocated(error)) call empty_folder(self%file(old_parts_name), error)
   end subroutine discard_parts

   subroutine find_or_make(self, may_make, error)
      class(results_folder), intent(inout) :: self
      logical, intent(in) :: may_make
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: parent
      integer :: kind, parent_kind

      parent = parent_of(self%path)
      call path_kind(self%path, kind, error)
      if (.not. allocated(error)) call path_kind(parent, parent_kind, error)
      if (allocated(error) .or. kind == path_folder) return
      if (kind /= path_none) then
         call fail(error, rv_io, "'"//self%path//"' is a file, and the results need a folder" &
            & //repeat(": choose one with -o", merge(1, 0, may_make)))
      else if (.not. may_make) then
         call fail(error, rv_io, "there is no folder '"//self%path//"'")
      else if (parent_kind == path_none) then
         call fail(error, rv_io, "cannot make the folder '"//self%path//"': there is no folder '"//parent//"'")
      else
         call make_if_missing(self%path, error)
         self%made_here = .not. allocated(error)
      end if
   end subroutine find_or_make

   !> Make a folder; another slice may have been quicker.
   subroutine make_if_missing(path, error)
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: ignored
      integer :: kind

      call path_kind(path, kind, error)
      if (allocated(error) .or. kind == path_folder) return
      call make_folder(path, error)
      if (.not. allocated(error)) return
      call path_kind(path, kind, ignored)
      if (kind == path_folder) deallocate(error)
   end subroutine make_if_missing

   subroutine take_lock(self, error)
      class(results_folder), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: holder

      call lock_here(self%file(lock_name), self%is_shared, self%lock, self%has_lock, holder, error)
      if (allocated(error) .or. holder == "") return
      call fail(error, rv_io, "another run is at work in '"//self%path//"' ("//holder &
         & //"): wait until it ends, or choose another folder")
   end subroutine take_lock

   !> Lock a file in this process's name, or find who holds it.
   subroutine lock_here(path, shared, lock, has_lock, holder, error)
      character(len=*), intent(in) :: path
      logical, intent(in) :: shared
      integer(c_int), intent(out) :: lock
      logical, intent(out) :: has_lock                     !! false: this file system has no locks
      character(len=:), allocatable, intent(out) :: holder !! empty: the lock is ours
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: ignored
      integer :: state
      logical :: found

      holder = ""
      call lock_file(path, "process "//to_text(process_number())//" on "//host_name() &
         & //" since "//utc_date()//new_line("a"), lock, state, error, shared=shared)
      has_lock = state /= lock_none
      if (allocated(error) .or. state /= lock_held) return
      lock = -1
      call read_whole_file(path, holder, found, ignored)
      holder = last_line(holder)
      if (holder == "") holder = "of unknown name"
   end subroutine lock_here

   !> Remove a folder with the parts in it; harmless when there is none. What is not ours stays, and so does the folder.
   subroutine empty_folder(path, error)
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: ignored
      type(text_type), allocatable :: name(:)
      integer :: kind, i

      call path_kind(path, kind, error)
      if (allocated(error) .or. kind /= path_folder) return
      call list_folder(path, name, error)
      if (allocated(error)) return
      do i = 1, size(name)
         if (.not. (is_part_name(name(i)%s) .or. name(i)%s == manifest_name .or. is_slice_lock(name(i)%s) &
            & .or. index(name(i)%s, manifest_name//new_suffix) == 1)) cycle
         call remove_file(path//"/"//name(i)%s, error)
         if (allocated(error)) return
      end do
      call remove_folder(path, ignored)
   end subroutine empty_folder

   !> Of the holders of a lock, the one that came last.
   pure function last_line(text) result(line)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: line

      line = text(:max(0, len(text) - 1))
      line = line(index(line, new_line("a"), back=.true.) + 1:)
   end function last_line

   pure function without_slash(path) result(bare)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: bare
      integer :: n

      n = len(path)
      do while (n > 1)
         if (path(n:n) /= "/") exit
         n = n - 1
      end do
      bare = path(:n)
   end function without_slash

   pure function parent_of(path) result(parent)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: parent

      parent = path(:index(path, "/", back=.true.))
      if (parent == "") parent = "."
      if (parent /= "/") parent = without_slash(parent)
   end function parent_of

end module rv_results_folder
