!> A whole run: folder, earlier parts, all blocks on all threads, results. Nothing here prints.
module rv_run
   use, intrinsic :: iso_fortran_env, only : int32
   use omp_lib, only : omp_get_max_threads
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_text, only : to_text
   use rv_posix, only : host_name, process_number, seconds, utc_date
   use rv_file, only : file_type, read_whole_file, write_whole_file
   use rv_deck, only : deck_type
   use rv_block, only : block_bounds, run_block
   use rv_status, only : status_ok
   use rv_inputs, only : input_values, new_manifest
   use rv_manifest, only : manifest_type
   use rv_merge, only : merge_parts
   use rv_monitor, only : monitor_type, phase_cases, progress_type
   use rv_parts, only : part_type, read_part, write_part
   use rv_results_folder, only : log_name, manifest_name, netcdf_name, results_folder
   use rv_results_origin, only : read_origin
   use rv_tally, only : tally_type
   use rv_version, only : code_version
   implicit none
   private
   public :: run_options, run_outcome, run_deck, merge_folder

   type :: run_options
      character(len=:), allocatable :: folder   !! for the results
      integer :: threads = 0                    !! 0: as many as OpenMP offers
      logical :: resume = .false.               !! go on with an unfinished run of the same deck
      logical :: force = .false.                !! replace results, drop an unfinished run
   end type run_options

   type :: run_outcome
      type(tally_type) :: tally        !! of all cases; only with the results in place
      integer :: threads = 1
      integer :: blocks = 0
      integer :: kept_blocks = 0       !! finished by earlier runs
      integer :: new_blocks = 0        !! finished by this run
      integer :: damaged_blocks = 0    !! found damaged and computed again
      integer(i8) :: new_cases = 0     !! computed by this run
      real(wp) :: seconds = 0.0_wp     !! computing and merging [s]
      logical :: stopped = .false.     !! on request; can be resumed
      logical :: was_complete = .false.!! the results were there already
      logical :: unlocked = .false.    !! this file system has no locks
      logical :: logged = .true.       !! run.log could be written
   end type run_outcome

   !> What is found in a folder, and what is to be done about it.
   type :: plan_type
      type(manifest_type) :: manifest
      integer(int32) :: identity = 0
      integer, allocatable :: todo(:)          !! blocks to run
      integer(i8) :: kept_cases = 0
      logical :: is_new = .false.              !! the folder of the parts was made, or emptied, by this run
   end type plan_type

contains

   !> Run every case of a deck that has no faults.
   !>
   !> Codes of `error`: rv_bad_input when the folder holds what the options do not allow to replace or to go on
   !> with, rv_io for trouble with files. Finished blocks are kept either way and count in `outcome`.
   subroutine run_deck(deck, options, monitor, outcome, error)
      type(deck_type), intent(in) :: deck
      type(run_options), intent(in) :: options
      class(monitor_type), intent(inout) :: monitor
      type(run_outcome), intent(out) :: outcome
      type(error_type), allocatable, intent(out) :: error
      type(results_folder) :: folder
      type(plan_type) :: plan
      real(wp) :: start

      start = seconds()
      outcome%threads = options%threads
      if (options%threads == 0) outcome%threads = omp_get_max_threads()
      call new_manifest(deck, plan%manifest)
      plan%identity = plan%manifest%identity()
      outcome%blocks = plan%manifest%blocks
      call folder%open(options%folder, .true., error)
      if (allocated(error)) return
      outcome%unlocked = .not. folder%has_lock
      call prepare(folder, options, plan, outcome, error)
      if (.not. (allocated(error) .or. outcome%was_complete)) then
         outcome%threads = min(outcome%threads, max(1, size(plan%todo)))
         call log_line(folder, outcome, "run of '"//deck%name//"' with reedvalve "//code_version//", cases: " &
            & //to_text(plan%manifest%cases)//", blocks: "//to_text(plan%manifest%blocks)//", finished before: " &
            & //to_text(outcome%kept_blocks)//", threads: "//to_text(outcome%threads))
         call run_blocks(deck, folder, plan, monitor, outcome, error)
         if (.not. (allocated(error) .or. outcome%stopped)) call merge_parts(folder, plan%manifest, monitor, &
            & outcome%tally, outcome%stopped, error)
         outcome%seconds = seconds() - start
         call log_end(folder, outcome, error)
      end if
      if (plan%is_new .and. outcome%new_blocks == 0) call drop_empty_parts(folder)
      call folder%close()
   end subroutine run_deck

   !> Write the results of a run whose blocks are all finished, from nothing but its folder.
   subroutine merge_folder(path, monitor, outcome, error)
      character(len=*), intent(in) :: path
      class(monitor_type), intent(inout) :: monitor
      type(run_outcome), intent(out) :: outcome
      type(error_type), allocatable, intent(out) :: error
      type(results_folder) :: folder
      type(manifest_type) :: manifest
      logical :: found
      real(wp) :: start

      start = seconds()
      call folder%open(path, .false., error)
      if (allocated(error)) return
      outcome%unlocked = .not. folder%has_lock
      call read_manifest(folder, manifest, found, error)
      if (.not. (allocated(error) .or. found)) then
         call fail(error, rv_bad_input, "'"//folder%path//"' holds no parts of a run; there is nothing to merge")
      else if (.not. allocated(error) .and. manifest%code_version /= code_version) then
         call fail(error, rv_bad_input, "the parts in '"//folder%path//"' were made by reedvalve " &
            & //manifest%code_version//" and this is "//code_version//"; merge them with that version")
      end if
      if (.not. allocated(error)) then
         outcome%blocks = manifest%blocks
         call merge_parts(folder, manifest, monitor, outcome%tally, outcome%stopped, error)
         outcome%seconds = seconds() - start
         call log_end(folder, outcome, error)
      end if
      call folder%close()
   end subroutine merge_folder

   !> Look at the folder, refuse or make way, and find the blocks to run.
   subroutine prepare(folder, options, plan, outcome, error)
      type(results_folder), intent(in) :: folder
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
      else if (options%resume) then
         if (parts) call check_parts(folder, plan, error)
         if (results .and. .not. parts) call check_results(folder, plan, outcome, error)
      else if (parts) then
         call fail(error, rv_bad_input, "'"//folder%path//"' holds an unfinished run: --resume goes on with it, " &
            & //"--force starts anew")
      else if (results) then
         call fail(error, rv_bad_input, "'"//folder%path//"' holds results: choose another folder with -o, " &
            & //"or replace them with --force")
      end if
      if (allocated(error) .or. outcome%was_complete) return
      plan%is_new = options%force .or. .not. parts
      call folder%make_parts(error)
      if (.not. allocated(error)) call write_whole_file(folder%parts//"/"//manifest_name, &
         & plan%manifest%to_text(), error)
      if (.not. allocated(error)) call find_work(folder, plan, outcome)
   end subroutine prepare

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

   !> Results are there already: fine if they are of this deck, else refused.
   subroutine check_results(folder, plan, outcome, error)
      type(results_folder), intent(in) :: folder
      type(plan_type), intent(in) :: plan
      type(run_outcome), intent(inout) :: outcome
      type(error_type), allocatable, intent(out) :: error
      type(manifest_type) :: found
      character(len=:), allocatable :: difference

      call read_origin(folder%file(netcdf_name), found, outcome%tally%cases, outcome%tally%failed, error)
      if (allocated(error)) then
         difference = error%message
         deallocate(error)
      else
         difference = plan%manifest%difference(found)
      end if
      outcome%was_complete = difference == ""
      if (difference /= "") call fail(error, rv_bad_input, "'"//folder%path//"' holds results that are not of this " &
         & //"run ("//difference//"): choose another folder with -o, or replace them with --force")
   end subroutine check_results

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
      if (allocated(error)) error%message = "cannot use '"//path//"': "//error%message
   end subroutine read_manifest

   !> Every block whose part is not there, or not as it was written, is to be run.
   subroutine find_work(folder, plan, outcome)
      type(results_folder), intent(in) :: folder
      type(plan_type), intent(inout) :: plan
      type(run_outcome), intent(inout) :: outcome
      type(error_type), allocatable :: damage
      type(part_type) :: part
      logical :: found
      integer :: block, n

      allocate(plan%todo(plan%manifest%blocks))
      n = 0
      do block = 1, plan%manifest%blocks
         call read_part(folder%parts, plan%identity, block, part, found, damage)
         if (allocated(damage)) outcome%damaged_blocks = outcome%damaged_blocks + 1
         if (found) then
            outcome%kept_blocks = outcome%kept_blocks + 1
            plan%kept_cases = plan%kept_cases + size(part%result%status)
         else
            n = n + 1
            plan%todo(n) = block
         end if
      end do
      plan%todo = plan%todo(:n)
   end subroutine find_work

   !> Run the blocks that are left, each on one thread.
   subroutine run_blocks(deck, folder, plan, monitor, outcome, error)
      type(deck_type), intent(in) :: deck
      type(results_folder), intent(in) :: folder
      type(plan_type), intent(in) :: plan
      class(monitor_type), intent(inout) :: monitor
      type(run_outcome), intent(inout) :: outcome
      type(error_type), allocatable, intent(out) :: error
      type(progress_type) :: progress
      real(wp) :: start
      integer :: i

      start = seconds()
      progress = progress_type(phase_cases, plan%manifest%cases, plan%kept_cases, plan%kept_cases)
      call monitor%report(progress)
      !$omp parallel do schedule(dynamic, 1) num_threads(outcome%threads) default(none) &
      !$omp & shared(deck, folder, plan, monitor, outcome, error, progress, start)
      do i = 1, size(plan%todo)
         call run_and_write(deck, folder, plan, plan%todo(i), start, monitor, progress, outcome, error)
      end do
      !$omp end parallel do
   end subroutine run_blocks

   !> Run one block and write its part, unless the run is to stop or has failed; several threads do so at a time.
   subroutine run_and_write(deck, folder, plan, block, start, monitor, progress, outcome, error)
      type(deck_type), intent(in) :: deck
      type(results_folder), intent(in) :: folder
      type(plan_type), intent(in) :: plan
      integer, intent(in) :: block
      real(wp), intent(in) :: start                            !! of the phase [s]
      class(monitor_type), intent(inout) :: monitor            !! this and what follows is shared
      type(progress_type), intent(inout) :: progress
      type(run_outcome), intent(inout) :: outcome
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: failure
      type(part_type) :: part
      integer(i8) :: first, last
      logical :: go_on

      !$omp critical (rv_run_state)
      if (.not. outcome%stopped) outcome%stopped = monitor%stop_asked()
      go_on = .not. (outcome%stopped .or. allocated(error))
      !$omp end critical (rv_run_state)
      if (.not. go_on) return

      call block_bounds(deck, block, first, last)
      call input_values(deck, first, last, part%input)
      call run_block(deck, first, last, part%result)
      call write_part(folder%parts, plan%identity, block, part, failure)

      !$omp critical (rv_run_state)
      if (allocated(failure)) then
         if (.not. allocated(error)) call move_alloc(failure, error)
      else
         outcome%new_blocks = outcome%new_blocks + 1
         outcome%new_cases = outcome%new_cases + last - first + 1
         progress%done = progress%done + last - first + 1
         progress%failed = progress%failed + count(part%result%status /= status_ok)
         progress%seconds = seconds() - start
         call monitor%report(progress)
      end if
      !$omp end critical (rv_run_state)
   end subroutine run_and_write

   !> A run that finished no block leaves no unfinished run behind.
   subroutine drop_empty_parts(folder)
      type(results_folder), intent(in) :: folder
      type(error_type), allocatable :: ignored

      call folder%discard_parts(ignored)
   end subroutine drop_empty_parts

   subroutine log_end(folder, outcome, error)
      type(results_folder), intent(in) :: folder
      type(run_outcome), intent(inout) :: outcome
      type(error_type), allocatable, intent(in) :: error
      character(len=:), allocatable :: rate

      rate = "cases computed: "//to_text(outcome%new_cases)//", seconds: "//to_text(outcome%seconds, 4)
      if (allocated(error)) then
         call log_line(folder, outcome, "failed, "//rate//": "//error%message)
      else if (outcome%stopped) then
         call log_line(folder, outcome, "stopped on request, "//rate)
      else
         call log_line(folder, outcome, "finished, "//rate//", cases failed: " &
            & //to_text(outcome%tally%failed)//" of "//to_text(outcome%tally%cases))
      end if
   end subroutine log_end

   !> Add to run.log, with date, host and process. A log that cannot be written spoils no run.
   subroutine log_line(folder, outcome, text)
      type(results_folder), intent(in) :: folder
      type(run_outcome), intent(inout) :: outcome
      character(len=*), intent(in) :: text
      type(error_type), allocatable :: error
      type(file_type) :: file

      call file%append(folder%file(log_name), error)
      if (.not. allocated(error)) call file%put_text(utc_date()//" "//host_name()//" " &
         & //to_text(process_number())//" "//text//new_line("a"), error)
      if (.not. allocated(error)) call file%close(error)
      if (allocated(error)) outcome%logged = .false.
      call file%close()
   end subroutine log_line

end module rv_run
