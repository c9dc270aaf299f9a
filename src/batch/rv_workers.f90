!> The work itself: a worker takes the next block, runs it, writes its part, until none is left. Every run is this,
!> on threads, ranks or slices; who takes which block is the crew's business, and makes no difference to a result.
module rv_workers
   use rv_kinds, only : wp, i8
   use rv_film_case, only : planform_cache
   use rv_error, only : error_type
   use rv_posix, only : seconds
   use rv_block, only : block_bounds, run_block
   use rv_crew, only : count_damaged_blocks, count_done, count_earlier, count_failed, count_kept_blocks, &
      & count_new_blocks, count_new_cases, count_stops, count_taken, crew_type
   use rv_deck, only : deck_type
   use rv_inputs, only : input_values
   use rv_monitor, only : monitor_type, phase_cases, progress_type
   use rv_parts, only : part_type, read_part, write_part
   use rv_results_folder, only : results_folder
   use rv_run_plan, only : plan_type
   use rv_run_terms, only : run_options
   use rv_status, only : status_ok
   implicit none
   private
   public :: run_blocks

   integer(i8), parameter :: past_all = 2_i8**40   !! blocks: given out so many, none is left for anybody

   !> What the threads of a process share, each of them alone with it at a time.
   type :: state_type
      logical :: stopped = .false.
      type(error_type), allocatable :: error      !! of the first that failed
      type(progress_type) :: progress
      real(wp) :: start = 0.0_wp                  !! [s]
   end type state_type

contains

   !> Run the blocks of this run or slice that have no sound part yet, each on one of the threads of the crew.
   subroutine run_blocks(deck, folder, options, plan, threads, crew, monitor, error)
      type(deck_type), intent(in) :: deck
      type(results_folder), intent(in) :: folder
      type(run_options), intent(in) :: options
      type(plan_type), intent(in) :: plan
      integer, intent(in) :: threads              !! of this process
      class(crew_type), intent(inout) :: crew
      class(monitor_type), intent(inout) :: monitor
      type(error_type), allocatable, intent(out) :: error
      type(state_type) :: state

      state%start = seconds()
      state%progress = progress_type(phase=phase_cases, cases=own_cases(deck, options, plan%manifest%blocks))
      call monitor%report(state%progress)
      !$omp parallel num_threads(threads) default(none) shared(deck, folder, options, plan, crew, monitor, state)
      call work(deck, folder%parts, options, plan, crew, monitor, state)
      !$omp end parallel
      call move_alloc(state%error, error)
   end subroutine run_blocks

   !> One worker: its own blocks and parts, and a state that others share.
   subroutine work(deck, parts, options, plan, crew, monitor, state)
      type(deck_type), intent(in) :: deck
      character(len=*), intent(in) :: parts       !! their folder
      type(run_options), intent(in) :: options
      type(plan_type), intent(in) :: plan
      class(crew_type), intent(inout) :: crew
      class(monitor_type), intent(inout) :: monitor
      type(state_type), intent(inout) :: state
      type(error_type), allocatable :: damage, failure
      type(part_type) :: part
      type(planform_cache) :: cache
      integer :: block
      logical :: found

      do
         !$omp critical (rv_run_state)
         call take_block(options, plan%manifest%blocks, crew, monitor, state, block)
         !$omp end critical (rv_run_state)
         if (block == 0) exit
         call read_part(parts, plan%identity, block, part, found, damage)
         if (.not. found) call run_and_write(deck, parts, plan, block, cache, part, failure)
         !$omp critical (rv_run_state)
         call note_block(part, found, allocated(damage), crew, monitor, state, failure)
         !$omp end critical (rv_run_state)
      end do
   end subroutine work

   !> The next block for who asks; 0 when none is left, the run is to stop, or anything has failed.
   subroutine take_block(options, blocks, crew, monitor, state, block)
      type(run_options), intent(in) :: options
      integer, intent(in) :: blocks
      class(crew_type), intent(inout) :: crew
      class(monitor_type), intent(inout) :: monitor
      type(state_type), intent(inout) :: state
      integer, intent(out) :: block
      integer(i8) :: taken

      block = 0
      if (.not. state%stopped) then
         state%stopped = monitor%stop_asked()
         if (state%stopped) call end_all(crew, count_stops)
      end if
      if (state%stopped .or. allocated(state%error)) return
      call crew%add(count_taken, 1_i8, taken)
      taken = options%block_at(min(taken, past_all))
      if (taken <= blocks) block = int(taken)
   end subroutine take_block

   !> Let the others, too, find no block left, and count why.
   subroutine end_all(crew, why)
      class(crew_type), intent(inout) :: crew
      integer, intent(in) :: why
      integer(i8) :: before

      call crew%add(count_taken, past_all, before)
      call crew%add(why, 1_i8, before)
   end subroutine end_all

   subroutine run_and_write(deck, parts, plan, block, cache, part, error)
      type(deck_type), intent(in) :: deck
      character(len=*), intent(in) :: parts
      type(plan_type), intent(in) :: plan
      integer, intent(in) :: block
      type(planform_cache), intent(inout) :: cache
      type(part_type), intent(out) :: part
      type(error_type), allocatable, intent(out) :: error
      integer(i8) :: first, last

      call block_bounds(deck, block, first, last)
      call input_values(deck, first, last, part%input)
      call run_block(deck, first, last, part%result, cache)
      call write_part(parts, plan%identity, block, part, error)
   end subroutine run_and_write

   !> Count a block that is finished, or note why it is not.
   subroutine note_block(part, was_there, was_damaged, crew, monitor, state, failure)
      type(part_type), intent(in) :: part
      logical, intent(in) :: was_there, was_damaged
      class(crew_type), intent(inout) :: crew
      class(monitor_type), intent(inout) :: monitor
      type(state_type), intent(inout) :: state
      type(error_type), allocatable, intent(inout) :: failure
      integer(i8) :: n, failed, before

      if (was_damaged) call crew%add(count_damaged_blocks, 1_i8, before)
      if (allocated(failure)) then
         if (.not. allocated(state%error)) call move_alloc(failure, state%error)
         call crew%add(count_taken, past_all, before)
         return
      end if
      n = size(part%result%status)
      failed = count(part%result%status /= status_ok)
      call crew%add(merge(count_kept_blocks, count_new_blocks, was_there), 1_i8, before)
      if (.not. was_there) call crew%add(count_new_cases, n, before)
      call crew%add(count_earlier, merge(n, 0_i8, was_there), before)
      state%progress%earlier = before + merge(n, 0_i8, was_there)
      call crew%add(count_failed, failed, before)
      state%progress%failed = before + failed
      call crew%add(count_done, n, before)
      state%progress%done = before + n
      state%progress%seconds = seconds() - state%start
      call monitor%report(state%progress)
   end subroutine note_block

   !> Cases in all blocks of this run or slice; all blocks but the last are as large as the first.
   integer(i8) function own_cases(deck, options, blocks) result(n)
      type(deck_type), intent(in) :: deck
      type(run_options), intent(in) :: options
      integer, intent(in) :: blocks
      integer(i8) :: first, last, size
      integer :: own

      own = options%block_total(blocks)
      n = 0
      if (own == 0) return
      call block_bounds(deck, 1, first, size)
      n = own*size
      if (options%block_at(own - 1_i8) < blocks) return
      call block_bounds(deck, blocks, first, last)
      n = n - size + last - first + 1
   end function own_cases

end module rv_workers
