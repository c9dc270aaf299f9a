!> Before a run: what its folder holds, whether that may stay, go on or go, and the manifest that all parts are of.
module rv_run_plan
   use, intrinsic :: iso_fortran_env, only : int32
   use rv_kinds, only : i8
   use rv_error, only : error_type, fail, rv_bad_input, rv_io
   use rv_text, only : to_text
   use rv_file, only : claim_whole_file, read_whole_file, write_whole_file
   use rv_manifest, only : manifest_type
   use rv_results_folder, only : manifest_name, netcdf_name, results_folder
   use rv_results_origin, only : read_origin
   use rv_run_terms, only : run_options, run_outcome
   implicit none
   private
   public :: plan_type, prepare_folder, check_parts, read_manifest

   type :: plan_type
      type(manifest_type) :: manifest
      integer(int32) :: identity = 0   !! of the manifest
      logical :: is_new = .false.      !! the folder of the parts was made, or emptied, by this run, for itself alone
   end type plan_type

contains

   !> Look at the folder, refuse or make way, and leave the manifest in it.
   subroutine prepare_folder(folder, options, plan, outcome, error)
      type(results_folder), intent(inout) :: folder
      type(run_options), intent(in) :: options
      type(plan_type), intent(inout) :: plan
      type(run_outcome), intent(inout) :: outcome
      type(error_type), allocatable, intent(out) :: error
      logical :: results, parts

      call folder%has_results(results, error)
      if (.not. allocated(error)) call folder%has_parts(parts, error)
      if (allocated(error)) return
      if (options%force) then
         call folder%discard_parts(error)
      else if (parts) then
         call check_unfinished(folder, options, plan, error)
      else if (results .and. options%resume) then
         call check_results(folder, plan, outcome, error)
      else if (results) then
         call fail(error, rv_bad_input, "'"//folder%path//"' holds results: choose another folder with -o, " &
            & //"or replace them with --force")
      end if
      if (allocated(error) .or. outcome%was_complete) return
      plan%is_new = (options%force .or. .not. parts) .and. .not. options%is_slice()
      call folder%make_parts(error)
      if (.not. allocated(error)) call leave_manifest(folder, options, plan, error)
      if (allocated(error) .or. .not. options%is_slice()) return
      call folder%take_slice(options%slice, options%slices, error)
   end subroutine prepare_folder

   !> There is an unfinished run: go on with it only if that was asked for, or if it is other slices' alone.
   subroutine check_unfinished(folder, options, plan, error)
      type(results_folder), intent(in) :: folder
      type(run_options), intent(in) :: options
      type(plan_type), intent(in) :: plan
      type(error_type), allocatable, intent(out) :: error
      logical, allocatable :: finished(:)

      if (.not. (options%resume .or. options%is_slice())) then
         call fail(error, rv_bad_input, "'"//folder%path//"' holds an unfinished run: --resume goes on with it, " &
            & //"--force starts anew")
         return
      end if
      call check_parts(folder, plan, error)
      if (allocated(error) .or. options%resume) return
      call folder%find_finished(plan%manifest%blocks, finished, error)
      if (allocated(error)) return
      if (any(finished(options%slice::options%slices))) call fail(error, rv_bad_input, "'"//folder%path &
         & //"' holds finished blocks of slice "//to_text(options%slice)//"/"//to_text(options%slices) &
         & //": --resume goes on with it")
   end subroutine check_unfinished

   !> Fail unless the parts in the folder are of this very run.
   subroutine check_parts(folder, plan, error)
      type(results_folder), intent(in) :: folder
      type(plan_type), intent(in) :: plan
      type(error_type), allocatable, intent(out) :: error
      type(manifest_type) :: found
      character(len=:), allocatable :: difference
      integer(int32) :: identity
      logical :: exists

      call read_manifest(folder, found, exists, error)
      if (allocated(error) .or. .not. exists) return
      difference = plan%manifest%difference(found)
      identity = found%identity()
      if (difference == "" .and. identity /= plan%identity) difference = "it was made by another build of reedvalve"
      if (difference /= "") call fail(error, rv_bad_input, "cannot resume the run in '"//folder%path//"': " &
         & //difference//"; choose another folder with -o, or start anew with --force")
   end subroutine check_parts

   !> Results are there already: fine if they are of this deck, else refused; also if that cannot be seen.
   subroutine check_results(folder, plan, outcome, error)
      type(results_folder), intent(in) :: folder
      type(plan_type), intent(in) :: plan
      type(run_outcome), intent(inout) :: outcome
      type(error_type), allocatable, intent(out) :: error
      type(manifest_type) :: found
      character(len=:), allocatable :: difference
      integer(i8) :: cases, failed

      call read_origin(folder%file(netcdf_name), found, cases, failed, error)
      if (allocated(error)) then
         difference = error%message
         if (error%code == rv_io) then
            error%message = "cannot tell whether the results in '"//folder%path//"' are of this run: "//difference &
               & //"; put that right, choose another folder with -o, or replace them with --force"
            return
         end if
         deallocate(error)
      else
         difference = plan%manifest%difference(found)
      end if
      outcome%was_complete = difference == ""
      outcome%tally%cases = cases
      outcome%tally%failed = failed
      if (difference /= "") call fail(error, rv_bad_input, "'"//folder%path//"' holds results that are not of this " &
         & //"run ("//difference//"): choose another folder with -o, or replace them with --force")
   end subroutine check_results

   !> Of several slices that start at once one leaves the manifest; all others must find their own in it.
   subroutine leave_manifest(folder, options, plan, error)
      type(results_folder), intent(in) :: folder
      type(run_options), intent(in) :: options
      type(plan_type), intent(in) :: plan
      type(error_type), allocatable, intent(out) :: error
      logical :: taken

      if (options%is_slice()) then
         call claim_whole_file(folder%parts//"/"//manifest_name, plan%manifest%to_text(), taken, error)
         if (.not. allocated(error)) call check_parts(folder, plan, error)
      else
         call folder%drop_unfinished(error)
         if (.not. allocated(error)) call write_whole_file(folder%parts//"/"//manifest_name, plan%manifest%to_text(), error)
      end if
   end subroutine leave_manifest

   subroutine read_manifest(folder, manifest, found, error)
      type(results_folder), intent(in) :: folder
      type(manifest_type), intent(out) :: manifest
      logical, intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: text, path

      path = folder%parts//"/"//manifest_name
      call read_whole_file(path, text, found, error)
      if (allocated(error) .or. .not. found) return
      call manifest%from_text(text, error)
      if (.not. allocated(error)) return
      error%message = "cannot use '"//path//"': "//error%message
      if (error%code == rv_io) then
         error%message = error%message//"; remove it, and run ... --resume makes it anew and keeps the blocks that are " &
            & //"finished, or start anew with run ... --force"
      else
         error%message = error%message//"; go on with that version, or start anew with run ... --force"
      end if
   end subroutine read_manifest

end module rv_run_plan
