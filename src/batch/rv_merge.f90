!> From parts to results.nc and summary.csv: block by block in constant memory, into place in one step each.
!>
!> Threads read parts and make the rows of the summary, a block each; one at a time writes what it has, in the order
!> of the blocks (HDF5 takes one thread only). So the files do not depend on how many threads there are.
module rv_merge
   use, intrinsic :: iso_fortran_env, only : int32
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_io
   use rv_text, only : to_text
   use rv_posix, only : check_room, free_bytes, path_kind, path_none, remove_file, rename_path, seconds, sync_folder
   use rv_file, only : file_type, new_suffix
   use rv_block, only : block_result
   use rv_manifest, only : manifest_type
   use rv_monitor, only : monitor_type, phase_merge, progress_type
   use rv_parts, only : part_type, read_part
   use rv_row_text, only : row_text
   use rv_results_csv, only : csv_writer
   use rv_results_folder, only : csv_name, netcdf_name, results_folder
   use rv_results_netcdf, only : expected_size, netcdf_writer
   use rv_tally, only : tally_type
   implicit none
   private
   public :: merge_parts

   integer, parameter :: blocks_on_their_way = 8   !! are sent to the disk together

   !> Both results in the making.
   type :: writers_type
      type(netcdf_writer) :: netcdf
      type(csv_writer) :: csv
      type(file_type) :: netcdf_bytes, csv_bytes   !! the same files once more, to have them on their way to the disk
      logical :: has_csv = .true.
   end type writers_type

   !> Where the merge stands. Its threads touch it in the order of the blocks only, but for `is_over`.
   type :: state_type
      type(tally_type) :: tally
      type(progress_type) :: progress
      type(error_type), allocatable :: error
      logical :: stopped = .false.
      logical :: is_over = .false.                !! stopped or failed: there is nothing more to do
      real(wp) :: start = 0.0_wp                  !! [s]
   end type state_type

   !> What a thread has ready for writing.
   type :: load_type
      type(part_type) :: part
      type(row_text) :: rows
      type(error_type), allocatable :: error
   end type load_type

contains

   !> Write both results from the parts and remove the parts. On failure, or when the monitor asks to stop,
   !> the parts stay and no half of a result is left.
   subroutine merge_parts(folder, manifest, threads, monitor, tally, stopped, error)
      type(results_folder), intent(in) :: folder
      type(manifest_type), intent(in) :: manifest
      integer, intent(in) :: threads
      class(monitor_type), intent(inout) :: monitor
      type(tally_type), intent(out) :: tally
      logical, intent(out) :: stopped
      type(error_type), allocatable, intent(out) :: error
      type(writers_type) :: writers

      stopped = .false.
      call check_room(folder%file(netcdf_name//new_suffix), expected_size(manifest), error)
      if (allocated(error)) return
      call write_both(folder, manifest, threads, monitor, writers, tally, stopped, error)
      if (allocated(error) .or. stopped) then
         call abandon(folder, writers, error)
         return
      end if
      call into_place(folder, manifest%has_csv, error)
   end subroutine merge_parts

   subroutine write_both(folder, manifest, threads, monitor, writers, tally, stopped, error)
      type(results_folder), intent(in) :: folder
      type(manifest_type), intent(in) :: manifest
      integer, intent(in) :: threads
      class(monitor_type), intent(inout) :: monitor
      type(writers_type), intent(inout) :: writers
      type(tally_type), intent(out) :: tally
      logical, intent(out) :: stopped
      type(error_type), allocatable, intent(out) :: error
      type(state_type) :: state
      integer(int32) :: identity

      stopped = .false.
      state%start = seconds()
      identity = manifest%identity()
      state%progress = progress_type(phase=phase_merge, cases=manifest%cases)
      call writers%netcdf%create(folder%file(netcdf_name//new_suffix), manifest, error)
      writers%has_csv = manifest%has_csv
      if (manifest%has_csv .and. .not. allocated(error)) call writers%csv%create(folder%file(csv_name//new_suffix), manifest, error)
      if (.not. allocated(error)) call writers%netcdf_bytes%open_old(folder%file(netcdf_name//new_suffix), error)
      if (manifest%has_csv .and. .not. allocated(error)) call writers%csv_bytes%open_old(folder%file(csv_name//new_suffix), error)
      if (allocated(error)) return
      !$omp parallel num_threads(min(threads, max(1, manifest%blocks))) default(none) &
      !$omp & shared(folder, manifest, identity, writers, monitor, state)
      call work(folder, manifest%blocks, identity, writers, monitor, state)
      !$omp end parallel
      call writers%netcdf_bytes%close()
      call writers%csv_bytes%close()
      tally = state%tally
      stopped = state%stopped
      call move_alloc(state%error, error)
      if (allocated(error) .or. stopped) return
      if (state%progress%done /= manifest%cases) call fail(error, rv_io, "the parts in '"//folder%parts//"' hold " &
         & //to_text(state%progress%done)//" cases instead of "//to_text(manifest%cases))
      if (manifest%has_csv .and. .not. allocated(error)) call writers%csv%close(error)
      if (.not. allocated(error)) call writers%netcdf%close(error)
   end subroutine write_both

   !> One thread: a load of its own, and a state that others share.
   subroutine work(folder, blocks, identity, writers, monitor, state)
      type(results_folder), intent(in) :: folder
      integer, intent(in) :: blocks
      integer(int32), intent(in) :: identity
      type(writers_type), intent(inout) :: writers
      class(monitor_type), intent(inout) :: monitor
      type(state_type), intent(inout) :: state
      type(load_type) :: load
      integer :: block

      !$omp do ordered schedule(monotonic:dynamic, 1)
      do block = 1, blocks
         call get_load(folder, identity, block, writers, state, load)
         !$omp ordered
         call put_load(folder, load, writers, monitor, state)
         !$omp end ordered
         if (modulo(block, blocks_on_their_way) > 0) cycle
         call writers%netcdf_bytes%start_sync()
         call writers%csv_bytes%start_sync()
      end do
      !$omp end do
   end subroutine work

   !> Read the part of a block, which must be there, and make its rows.
   subroutine get_load(folder, identity, block, writers, state, load)
      type(results_folder), intent(in) :: folder
      integer(int32), intent(in) :: identity
      integer, intent(in) :: block
      type(writers_type), intent(in) :: writers
      type(state_type), intent(inout) :: state
      type(load_type), intent(inout) :: load
      logical :: is_over, found

      if (allocated(load%error)) deallocate(load%error)
      !$omp atomic read
      is_over = state%is_over
      if (is_over) return
      call read_part(folder%parts, identity, block, load%part, found, load%error)
      if (allocated(load%error)) return
      if (.not. found) then
         call fail(load%error, rv_io, "block "//to_text(block)//" is not finished; resume the run")
      else if (writers%has_csv) then
         call writers%csv%get_rows(load%part, load%rows)
      end if
   end subroutine get_load

   !> Write what one thread has; it must follow on the cases before it.
   subroutine put_load(folder, load, writers, monitor, state)
      type(results_folder), intent(in) :: folder
      type(load_type), intent(inout) :: load
      type(writers_type), intent(inout) :: writers
      class(monitor_type), intent(inout) :: monitor
      type(state_type), intent(inout) :: state

      if (state%is_over) return
      state%stopped = monitor%stop_asked()
      if (.not. state%stopped) then
         if (allocated(load%error)) then
            call move_alloc(load%error, state%error)
         else if (load%part%result%first /= state%progress%done + 1) then
            call fail(state%error, rv_io, "a part in '"//folder%parts//"' begins with case " &
               & //to_text(load%part%result%first)//" instead of "//to_text(state%progress%done + 1))
         end if
         if (.not. allocated(state%error)) call writers%netcdf%put(load%part, state%error)
         if (writers%has_csv .and. .not. allocated(state%error)) call writers%csv%put_rows(load%rows, state%error)
      end if
      if (state%stopped .or. allocated(state%error)) then
         !$omp atomic write
         state%is_over = .true.
         return
      end if
      call state%tally%add(load%part%result)
      state%progress%done = state%progress%done + size(load%part%result%status)
      state%progress%failed = state%tally%failed
      state%progress%seconds = seconds() - state%start
      call monitor%report(state%progress)
   end subroutine put_load

   !> Leave nothing of a result that did not come about.
   !>
   !> The summary goes first: where the disk is full, that makes the room that HDF5 needs to close its file.
   subroutine abandon(folder, writers, error)
      type(results_folder), intent(in) :: folder
      type(writers_type), intent(inout) :: writers
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: ignored
      integer(i8) :: room

      room = free_bytes(folder%path)
      call writers%csv%close()
      call remove_file(folder%file(csv_name//new_suffix), ignored)
      call writers%netcdf%close()
      call remove_file(folder%file(netcdf_name//new_suffix), ignored)
      if (.not. allocated(error)) return
      ! HDF5 does not say why a write failed
      if (room < 0 .or. room > 65536) return
      error%message = error%message//"; the disk is full, "//to_text(room)//" bytes are left"
   end subroutine abandon

   !> Give both results their names once they are on the disk, then remove the parts. An older summary goes either way.
   subroutine into_place(folder, has_csv, error)
      type(results_folder), intent(in) :: folder
      logical, intent(in) :: has_csv
      type(error_type), allocatable, intent(out) :: error
      type(file_type) :: file
      integer :: old

      call file%open_old(folder%file(netcdf_name//new_suffix), error)
      if (.not. allocated(error)) call file%sync(error)
      call file%close()
      if (.not. allocated(error)) call rename_path(folder%file(netcdf_name//new_suffix), &
         & folder%file(netcdf_name), error)
      if (has_csv) then
         if (.not. allocated(error)) call rename_path(folder%file(csv_name//new_suffix), folder%file(csv_name), error)
      else
         if (.not. allocated(error)) call path_kind(folder%file(csv_name), old, error)
         if (.not. allocated(error) .and. old /= path_none) call remove_file(folder%file(csv_name), error)
      end if
      if (.not. allocated(error)) call sync_folder(folder%path, error)
      if (.not. allocated(error)) call folder%discard_parts(error)
   end subroutine into_place

end module rv_merge
