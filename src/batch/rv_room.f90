!> How much room a run takes on the disk, said before it starts: its parts and its results are there at the same time.
module rv_room
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_io
   use rv_text, only : to_text
   use rv_posix, only : free_bytes
   use rv_block, only : n_facts, n_measures
   use rv_manifest, only : manifest_type
   use rv_results_netcdf, only : expected_size, sample_values
   implicit none
   private
   public :: room_type, expected_room, check_room_for_run, size_text

   !> Bytes, rather more than less; messages left out.
   type :: room_type
      integer(i8) :: parts = 0
      integer(i8) :: netcdf = 0
      integer(i8) :: csv = 0
   end type room_type

   integer, parameter :: bytes_real = 8, bytes_integer = 4
   integer, parameter :: bytes_number = 15   !! of a number in a summary, with its comma
   integer, parameter :: bytes_row = 24      !! of case number, model, status and line end there

contains

   !> What all of a run takes.
   pure function expected_room(manifest) result(room)
      type(manifest_type), intent(in) :: manifest
      type(room_type) :: room
      integer(i8) :: numbers

      numbers = size(manifest%input) + n_measures
      room%parts = manifest%cases*(3*bytes_integer + bytes_real*(numbers + n_facts + sample_values(manifest)))
      room%netcdf = expected_size(manifest)
      if (manifest%has_csv) room%csv = manifest%cases*(bytes_row + bytes_number*numbers)
   end function expected_room

   !> Fail, with the estimate and advice, if the folder's disk has no room for `share` of the parts and, if wanted, the
   !> results.
   subroutine check_room_for_run(path, manifest, share, with_results, begun, error)
      character(len=*), intent(in) :: path        !! of the folder
      type(manifest_type), intent(in) :: manifest
      real(wp), intent(in) :: share               !! of the parts still to be written, 0 to 1
      logical, intent(in) :: with_results
      logical, intent(in) :: begun                !! there are parts: an edited deck could not go on with them
      type(error_type), allocatable, intent(out) :: error
      type(room_type) :: room
      integer(i8) :: free, parts, results
      character(len=:), allocatable :: advice

      room = expected_room(manifest)
      parts = nint(share*real(room%parts, wp), i8)
      results = merge(room%netcdf + room%csv, 0_i8, with_results)
      free = free_bytes(path)
      if (free < 0 .or. parts + results <= free) return
      if (begun) then
         advice = "free some, or take the folder to another disk, and go on there with --resume"
      else
         advice = smaller_run(manifest, free - parts, with_results)//"choose another folder with -o"
      end if
      call fail(error, rv_io, "'"//path//"' has no room for this run: about "//needs(parts, results)//", and " &
         & //size_text(free)//" are free; "//advice)
   end subroutine check_room_for_run

   !> "2 MB of parts and 1 MB of results at the same time", or what there is of it.
   pure function needs(parts, results) result(text)
      integer(i8), intent(in) :: parts, results
      character(len=:), allocatable :: text

      if (results == 0) then
         text = size_text(parts)//" of parts"
      else if (parts == 0) then
         text = size_text(results)//" of results"
      else
         text = size_text(parts)//" of parts and "//size_text(results)//" of results at the same time"
      end if
   end function needs

   !> What to change in the deck, each followed by "or"; only what makes the results fit, but for fewer samples, which
   !> make all of it smaller.
   pure function smaller_run(manifest, free, with_results) result(text)
      type(manifest_type), intent(in) :: manifest
      integer(i8), intent(in) :: free             !! for the results
      logical, intent(in) :: with_results
      character(len=:), allocatable :: text
      type(manifest_type) :: smaller

      text = ""
      if (size(manifest%time) > 0) text = "store fewer samples (run.trace_dt_ms) or no traces, or "
      if (.not. with_results) return
      smaller = manifest
      smaller%compress = 9
      if (expected_size(smaller) > free) return
      if (manifest%compress == 0) text = text//"write a smaller results.nc (run.compress = 4), or "
      if (manifest%has_csv) text = text//"write no summary.csv (run.csv = 'never'), or "
   end function smaller_run

   !> "152 MB"
   pure function size_text(bytes) result(text)
      integer(i8), intent(in) :: bytes
      character(len=:), allocatable :: text
      character(len=2), parameter :: unit(5) = ["B ", "kB", "MB", "GB", "TB"]
      real(wp) :: x
      integer :: i

      x = real(bytes, wp)
      i = 1
      do while (x >= 1000.0_wp .and. i < size(unit))
         x = x/1000.0_wp
         i = i + 1
      end do
      text = to_text(x, 2)//" "//trim(unit(i))
      if (x >= 99.5_wp) text = to_text(nint(x))//" "//trim(unit(i))
   end function size_text

end module rv_room
