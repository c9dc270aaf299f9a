!> From parts to results.nc and summary.csv: block by block in constant memory, into place in one step each.
module rv_merge
   use, intrinsic :: iso_fortran_env, only : int32
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_io
   use rv_text, only : to_text
   use rv_posix, only : check_room, free_bytes, remove_file, rename_path, seconds, sync_folder
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

   !> Both results in the making.
   type :: writers_type
      type(netcdf_writer) :: netcdf
      type(csv_writer) :: csv
   end type writers_type

contains

   !> Write both results from the parts and remove the parts. On failure, or when the monitor asks to stop,
   !> the parts stay and no half of a result is left.
   subroutine merge_parts(folder, manifest, monitor, tally, stopped, error)
      type(results_folder), intent(in) :: folder
      type(manifest_type), intent(in) :: manifest
      class(monitor_type), intent(inout) :: monitor
      type(tally_type), intent(out) :: tally
      logical, intent(out) :: stopped
      type(error_type), allocatable, intent(out) :: error
      type(writers_type) :: writers

      stopped = .false.
      call check_room(folder%file(netcdf_name//new_suffix), expected_size(manifest), error)
      if (allocated(error)) return
      call write_both(folder, manifest, monitor, writers, tally, stopped, error)
      if (allocated(error) .or. stopped) then
         call abandon(folder, writers, error)
         return
      end if
      call into_place(folder, error)
   end subroutine merge_parts

   subroutine write_both(folder, manifest, monitor, writers, tally, stopped, error)
      type(results_folder), intent(in) :: folder
      type(manifest_type), intent(in) :: manifest
      class(monitor_type), intent(inout) :: monitor
      type(writers_type), intent(inout) :: writers
      type(tally_type), intent(out) :: tally
      logical, intent(out) :: stopped
      type(error_type), allocatable, intent(out) :: error
      type(part_type) :: part
      type(row_text) :: rows
      type(progress_type) :: progress
      integer(int32) :: identity
      integer :: block
      real(wp) :: start

      stopped = .false.
      start = seconds()
      identity = manifest%identity()
      progress = progress_type(phase=phase_merge, cases=manifest%cases)
      call writers%netcdf%create(folder%file(netcdf_name//new_suffix), manifest, error)
      if (.not. allocated(error)) call writers%csv%create(folder%file(csv_name//new_suffix), manifest, error)
      if (allocated(error)) return
      do block = 1, manifest%blocks
         stopped = monitor%stop_asked()
         if (stopped) return
         call next_part(folder, identity, block, progress%done, part, error)
         if (.not. allocated(error)) call writers%netcdf%put(part, error)
         if (.not. allocated(error)) call writers%csv%get_rows(part, rows)
         if (.not. allocated(error)) call writers%csv%put_rows(rows, error)
         if (allocated(error)) return
         call tally%add(part%result)
         progress%done = progress%done + size(part%result%status)
         progress%failed = tally%failed
         progress%seconds = seconds() - start
         call monitor%report(progress)
      end do
      if (progress%done /= manifest%cases) call fail(error, rv_io, "the parts in '"//folder%parts//"' hold " &
         & //to_text(progress%done)//" cases instead of "//to_text(manifest%cases))
      if (.not. allocated(error)) call writers%csv%close(error)
      if (.not. allocated(error)) call writers%netcdf%close(error)
   end subroutine write_both

   !> The part of a block, which must be there and follow on the cases before it.
   subroutine next_part(folder, identity, block, done, part, error)
      type(results_folder), intent(in) :: folder
      integer(int32), intent(in) :: identity
      integer, intent(in) :: block
      integer(i8), intent(in) :: done             !! cases before it
      type(part_type), intent(out) :: part
      type(error_type), allocatable, intent(out) :: error
      logical :: found

      call read_part(folder%parts, identity, block, part, found, error)
      if (allocated(error)) return
      if (.not. found) then
         call fail(error, rv_io, "block "//to_text(block)//" is not finished; resume the run")
      else if (part%result%first /= done + 1) then
         call fail(error, rv_io, "the part of block "//to_text(block)//" in '"//folder%parts//"' begins with case " &
            & //to_text(part%result%first)//" instead of "//to_text(done + 1))
      end if
   end subroutine next_part

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

   !> Give both results their names once they are on the disk, then remove the parts.
   subroutine into_place(folder, error)
      type(results_folder), intent(in) :: folder
      type(error_type), allocatable, intent(out) :: error
      type(file_type) :: file

      call file%open_old(folder%file(netcdf_name//new_suffix), error)
      if (.not. allocated(error)) call file%sync(error)
      call file%close()
      if (.not. allocated(error)) call rename_path(folder%file(netcdf_name//new_suffix), &
         & folder%file(netcdf_name), error)
      if (.not. allocated(error)) call rename_path(folder%file(csv_name//new_suffix), folder%file(csv_name), error)
      if (.not. allocated(error)) call sync_folder(folder%path, error)
      if (.not. allocated(error)) call folder%discard_parts(error)
   end subroutine into_place

end module rv_merge
