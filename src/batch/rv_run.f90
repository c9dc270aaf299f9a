!> A whole run: folder, earlier parts, all blocks, results. Nothing here prints.
module rv_run
   use omp_lib, only : omp_get_max_threads
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_bad_input, rv_io
   use rv_text, only : to_text
   use rv_posix, only : host_name, process_number, seconds, utc_date
   use rv_file, only : file_type
   use rv_crew, only : count_complete, count_damaged_blocks, count_done, count_failed, count_kept_blocks, count_new_blocks, &
      & count_new_cases, count_stops, crew_type, lone_crew
   use rv_deck, only : deck_type
   use rv_inputs, only : new_manifest
   use rv_manifest, only : manifest_type
   use rv_merge, only : merge_parts
   use rv_monitor, only : monitor_type
   use rv_room, only : check_room_for_run
   use rv_results_folder, only : csv_name, log_name, results_folder, to_merge, to_run, to_run_slice
   use rv_run_plan, only : check_parts, plan_type, prepare_folder, read_manifest
   use rv_run_terms, only : run_options, run_outcome
   use rv_version, only : code_version
   use rv_workers, only : run_blocks
   implicit none
   private
   public :: run_options, run_outcome, run_deck, run_with_crew, merge_folder

   integer, parameter :: most_named = 6   !! missing blocks told one by one

contains

   !> Run every case of a deck that has no faults, or those of a slice, in this process.
   !>
   !> Codes of `error`: rv_bad_input when the folder holds what the options do not allow to replace or to go on
   !> with, rv_io for trouble with files. Finished blocks are kept either way and count in `outcome`.
   subroutine run_deck(deck, options, monitor, outcome, error)
      type(deck_type), intent(in) :: deck
      type(run_options), intent(in) :: options
      class(monitor_type), intent(inout) :: monitor
      type(run_outcome), intent(out) :: outcome
      type(error_type), allocatable, intent(out) :: error
      type(lone_crew) :: crew

      call run_with_crew(deck, options, crew, monitor, outcome, error)
   end subroutine run_deck

   !> The same by a crew, all of whose processes call this with the same deck and options. An error is everyone's;
   !> `outcome` is told to the leader.
   subroutine run_with_crew(deck, options, crew, monitor, outcome, error)
      type(deck_type), intent(in) :: deck
      type(run_options), intent(in) :: options
      class(crew_type), intent(inout) :: crew
      class(monitor_type), intent(inout) :: monitor
      type(run_outcome), intent(out) :: outcome
      type(error_type), allocatable, intent(out) :: error
      type(results_folder) :: folder
      type(plan_type) :: plan

      call new_manifest(deck, plan%manifest)
      plan%identity = plan%manifest%identity()
      outcome%processes = crew%processes
      outcome%blocks = plan%manifest%blocks
      outcome%has_csv = plan%manifest%has_csv
      outcome%own_blocks = options%block_total(outcome%blocks)
      outcome%threads = options%threads
      if (options%threads == 0) outcome%threads = omp_get_max_threads()
      outcome%threads = min(outcome%threads, max(1, outcome%own_blocks))
      call enter_folder(folder, options, plan, crew, outcome, error)
      if (.not. (allocated(error) .or. outcome%was_complete)) then
         call run_and_merge(deck, folder, options, plan, crew, monitor, outcome, error)
      end if
      if (.not. crew%leads) return
      if (plan%is_new .and. outcome%new_blocks == 0) call drop_empty_parts(folder)
      call folder%close()
   end subroutine run_with_crew

   !> The leader opens and prepares the folder for all.
   subroutine enter_folder(folder, options, plan, crew, outcome, error)
      type(results_folder), intent(inout) :: folder
      type(run_options), intent(in) :: options
      type(plan_type), intent(inout) :: plan
      class(crew_type), intent(inout) :: crew
      type(run_outcome), intent(inout) :: outcome
      type(error_type), allocatable, intent(out) :: error
      integer(i8) :: before

      if (crew%leads) then
         call folder%open(options%folder, merge(to_run_slice, to_run, options%is_slice()), error)
         outcome%unlocked = .not. folder%has_lock
         if (.not. allocated(error)) call prepare_folder(folder, options, plan, outcome, error)
         if (outcome%was_complete) call crew%add(count_complete, 1_i8, before)
      else
         call folder%name(options%folder)
      end if
      call crew%share(error)
      if (allocated(error)) return
      outcome%was_complete = counted(crew, count_complete) > 0
      if (crew%leads .and. .not. outcome%was_complete) then
         call count_finished(folder, outcome)
         call check_disk(folder, options, plan%manifest, outcome, error)
      else if (.not. crew%leads) then
         ! who sees another folder or another deck has to say so before it writes parts
         call check_parts(folder, plan, error)
      end if
      call crew%share(error)
   end subroutine enter_folder

   !> All blocks, then the results; the leader alone writes what is not a part.
   subroutine run_and_merge(deck, folder, options, plan, crew, monitor, outcome, error)
      type(deck_type), intent(in) :: deck
      type(results_folder), intent(in) :: folder
      type(run_options), intent(in) :: options
      type(plan_type), intent(in) :: plan
      class(crew_type), intent(inout) :: crew
      class(monitor_type), intent(inout) :: monitor
      type(run_outcome), intent(inout) :: outcome
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: start

      start = seconds()
      if (crew%leads) then
         call log_line(folder, outcome, "run of '"//deck%name//"'"//slice_text(options)//" with reedvalve "//code_version &
            & //", cases: "//to_text(plan%manifest%cases)//", blocks: "//to_text(plan%manifest%blocks) &
            & //", finished before: "//to_text(outcome%finished_blocks)//", processes: "//to_text(outcome%processes) &
            & //", threads of each: "//to_text(outcome%threads))
      end if
      call run_blocks(deck, folder, options, plan, outcome%threads, crew, monitor, error)
      call crew%share(error)
      call sum_up(crew, outcome)
      if (crew%leads) then
         call count_finished(folder, outcome)
         if (.not. (allocated(error) .or. outcome%stopped .or. options%is_slice())) call merge_parts(folder, &
            & plan%manifest, outcome%threads, monitor, outcome%tally, outcome%stopped, error)
         outcome%seconds = seconds() - start
         call log_end(folder, outcome, error)
      end if
      call crew%share(error)
   end subroutine run_and_merge

   !> Room for the parts that are left and, where this run writes them, the results?
   subroutine check_disk(folder, options, manifest, outcome, error)
      type(results_folder), intent(in) :: folder
      type(run_options), intent(in) :: options
      type(manifest_type), intent(in) :: manifest
      type(run_outcome), intent(in) :: outcome
      type(error_type), allocatable, intent(out) :: error
      integer :: left

      left = min(outcome%own_blocks, outcome%blocks - outcome%finished_blocks)
      call check_room_for_run(folder%path, manifest, real(left, wp)/real(max(1, outcome%blocks), wp), &
         & .not. options%is_slice(), outcome%finished_blocks > 0, error)
   end subroutine check_disk

   !> What the counters of the crew say.
   subroutine sum_up(crew, outcome)
      class(crew_type), intent(inout) :: crew
      type(run_outcome), intent(inout) :: outcome

      outcome%tally%cases = counted(crew, count_done)
      outcome%tally%failed = counted(crew, count_failed)
      outcome%new_cases = counted(crew, count_new_cases)
      outcome%new_blocks = int(counted(crew, count_new_blocks))
      outcome%kept_blocks = int(counted(crew, count_kept_blocks))
      outcome%damaged_blocks = int(counted(crew, count_damaged_blocks))
      outcome%stopped = counted(crew, count_stops) > 0
   end subroutine sum_up

   !> What a counter stands at.
   integer(i8) function counted(crew, counter)
      class(crew_type), intent(inout) :: crew
      integer, intent(in) :: counter

      call crew%add(counter, 0_i8, counted)
   end function counted

   !> Write the results of a run whose blocks are all finished, from nothing but its folder.
   subroutine merge_folder(path, threads, monitor, outcome, error)
      character(len=*), intent(in) :: path
      integer, intent(in) :: threads              !! 0: as many as OpenMP offers
      class(monitor_type), intent(inout) :: monitor
      type(run_outcome), intent(out) :: outcome
      type(error_type), allocatable, intent(out) :: error
      type(results_folder) :: folder
      type(manifest_type) :: manifest
      logical :: found
      real(wp) :: start

      start = seconds()
      call folder%open(path, to_merge, error)
      if (allocated(error)) return
      outcome%unlocked = .not. folder%has_lock
      call read_manifest(folder, manifest, found, error)
      if (.not. (allocated(error) .or. found)) then
         call fail(error, rv_bad_input, "'"//folder%path//"' holds no parts of a run: there is nothing to merge, " &
            & //"or its results are in place already")
      else if (.not. allocated(error) .and. manifest%code_version /= code_version) then
         call fail(error, rv_bad_input, "the parts in '"//folder%path//"' were made by reedvalve " &
            & //manifest%code_version//" and this is "//code_version//"; merge them with that version")
      end if
      if (.not. allocated(error)) then
         outcome%blocks = manifest%blocks
         outcome%threads = threads
         outcome%has_csv = manifest%has_csv
         if (threads == 0) outcome%threads = omp_get_max_threads()
         call check_all_there(folder, manifest%blocks, error)
         if (.not. allocated(error)) call merge_parts(folder, manifest, outcome%threads, monitor, &
            & outcome%tally, outcome%stopped, error)
         outcome%seconds = seconds() - start
         call log_end(folder, outcome, error)
      end if
      call folder%close()
   end subroutine merge_folder

   !> Fail if blocks are missing, and say which.
   subroutine check_all_there(folder, blocks, error)
      type(results_folder), intent(in) :: folder
      integer, intent(in) :: blocks
      type(error_type), allocatable, intent(out) :: error
      logical, allocatable :: finished(:)
      character(len=:), allocatable :: names
      integer :: block, named

      call folder%find_finished(blocks, finished, error)
      if (allocated(error)) return
      if (all(finished)) return
      names = ""
      named = 0
      do block = 1, blocks
         if (finished(block)) cycle
         named = named + 1
         if (named > most_named) exit
         names = names//", "//to_text(block)
      end do
      if (named > most_named) names = names//", ..."
      call fail(error, rv_io, to_text(count(.not. finished))//" of "//to_text(blocks)//" blocks are not finished ("//names(3:) &
         & //"): run the slices that are missing, or all that is left with run ... --resume")
   end subroutine check_all_there

   subroutine count_finished(folder, outcome)
      type(results_folder), intent(in) :: folder
      type(run_outcome), intent(inout) :: outcome
      type(error_type), allocatable :: ignored
      logical, allocatable :: finished(:)

      call folder%find_finished(outcome%blocks, finished, ignored)
      outcome%finished_blocks = count(finished)
   end subroutine count_finished

   !> A run that finished no block leaves no unfinished run behind.
   subroutine drop_empty_parts(folder)
      type(results_folder), intent(in) :: folder
      type(error_type), allocatable :: ignored

      call folder%discard_parts(ignored)
   end subroutine drop_empty_parts

   !> ", slice 2/7"
   pure function slice_text(options) result(text)
      type(run_options), intent(in) :: options
      character(len=:), allocatable :: text

      text = ""
      if (options%is_slice()) text = ", slice "//to_text(options%slice)//"/"//to_text(options%slices)
   end function slice_text

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
            & //to_text(outcome%tally%failed)//" of "//to_text(outcome%tally%cases) &
            & //repeat(", no "//csv_name, merge(0, 1, outcome%has_csv)))
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
