!> A run as a library sees it: reports, stops on request, resumes, and merges to the same bytes.
module stopping_monitor
   use rv_kinds, only : i8
   use rv_monitor, only : monitor_type, phase_cases, phase_merge, progress_type
   implicit none
   private
   public :: counting_monitor

   !> Counts what it hears and asks to stop after some blocks.
   type, extends(monitor_type) :: counting_monitor
      integer :: stop_after = huge(1)    !! blocks of this run
      integer :: stop_merge_after = huge(1)
      integer :: blocks = 0              !! run, not found finished
      integer :: merged = 0
      logical :: in_order = .true.       !! cases done never fell and never passed all there are
      type(progress_type) :: last
   contains
      procedure :: report
      procedure :: stop_asked
   end type counting_monitor

contains

   subroutine report(self, progress)
      class(counting_monitor), intent(inout) :: self
      type(progress_type), intent(in) :: progress

      if (progress%phase == phase_cases) then
         if (progress%done - progress%earlier > self%last%done - self%last%earlier) self%blocks = self%blocks + 1
      end if
      if (progress%phase == phase_merge) self%merged = self%merged + 1
      if (progress%phase == self%last%phase) self%in_order = self%in_order .and. progress%done >= self%last%done
      self%in_order = self%in_order .and. progress%done <= progress%cases .and. progress%done >= 0_i8
      self%last = progress
   end subroutine report

   logical function stop_asked(self)
      class(counting_monitor), intent(inout) :: self

      stop_asked = self%blocks >= self%stop_after .or. self%merged >= self%stop_merge_after
   end function stop_asked

end module stopping_monitor

program test_run
   use check, only : suite_type
   use rv_deck, only : deck_type, read_deck
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_file, only : read_whole_file, write_whole_file
   use rv_posix, only : path_kind, path_none
   use rv_run, only : merge_folder, run_deck, run_options, run_outcome
   use stopping_monitor, only : counting_monitor
   implicit none
   character(len=*), parameter :: deck_text = "&run model = 'traditional', 'squeeze', block_size = 3 /"//new_line("a") &
      & //"&sweep key = 'pressure.inlet_kpa', from = 5.0, to = 40.0, count = 8 /"//new_line("a")
   type(suite_type) :: suite
   type(deck_type) :: deck

   call read_the_deck()
   call test_whole()
   call test_stops()
   call test_stopped_merge()
   call suite%finish()

contains

   subroutine read_the_deck()
      type(fault_list) :: faults
      type(error_type), allocatable :: error

      call write_whole_file("library.nml", deck_text, error)
      call suite%no_error("write a deck", error)
      call read_deck("library.nml", deck, faults, error)
      call suite%no_error("read it", error)
      call suite%equal("its faults", faults%errors(), 0)
   end subroutine read_the_deck

   subroutine test_whole()
      type(counting_monitor) :: monitor
      type(run_outcome) :: outcome
      type(error_type), allocatable :: error

      call run_deck(deck, run_options(folder="run_whole", force=.true.), monitor, outcome, error)
      call suite%no_error("run", error)
      call suite%equal("blocks reported", monitor%blocks, 6)
      call suite%equal("blocks merged", monitor%merged, 6)
      call suite%true("reports in order", monitor%in_order)
      call suite%equal("cases", int(outcome%tally%cases), 16)
      call suite%equal("cases failed", int(outcome%tally%failed), 0)
      call suite%true("not stopped", .not. outcome%stopped)
      call run_deck(deck, run_options(folder="run_whole"), monitor, outcome, error)
      call suite%fails("run again", error, "holds results")
   end subroutine test_whole

   !> Stopped twice, then finished, each time with another number of threads.
   subroutine test_stops()
      type(counting_monitor) :: first, second, third
      type(run_outcome) :: outcome
      type(error_type), allocatable :: error
      integer :: kind

      first%stop_after = 2
      call run_deck(deck, run_options(folder="run_stops", threads=1, force=.true.), first, outcome, error)
      call suite%no_error("a run that is stopped", error)
      call suite%true("it is stopped", outcome%stopped)
      call suite%equal("with two blocks", outcome%new_blocks, 2)
      second%stop_after = 1
      call run_deck(deck, run_options(folder="run_stops", threads=2, resume=.true.), second, outcome, error)
      call suite%equal("two blocks are kept", outcome%kept_blocks, 2)
      call suite%true("it is stopped again", outcome%stopped .and. outcome%new_blocks >= 1)
      call run_deck(deck, run_options(folder="run_stops", threads=3, resume=.true.), third, outcome, error)
      call suite%no_error("it is resumed", error)
      call suite%equal("all blocks", outcome%kept_blocks + outcome%new_blocks, 6)
      call same_bytes("run_stops")
      first = counting_monitor(stop_after=0)
      call run_deck(deck, run_options(folder="run_none", force=.true.), first, outcome, error)
      call suite%true("stopped before the first block", outcome%stopped .and. outcome%new_blocks == 0)
      call path_kind("run_none/parts", kind, error)
      call suite%equal("which leaves nothing to resume", kind, path_none)
   end subroutine test_stops

   !> A merge can be stopped and done later, from the folder alone.
   subroutine test_stopped_merge()
      type(counting_monitor) :: stopper, other
      type(run_outcome) :: outcome
      type(error_type), allocatable :: error
      integer :: kind

      stopper%stop_merge_after = 3
      call run_deck(deck, run_options(folder="run_merge", force=.true.), stopper, outcome, error)
      call suite%true("stopped in its merge", outcome%stopped .and. .not. allocated(error))
      call path_kind("run_merge/results.nc.new", kind, error)
      call suite%equal("nothing half-written is left", kind, path_none)
      call merge_folder("run_merge", 2, other, outcome, error)
      call suite%no_error("merge", error)
      call suite%equal("cases", int(outcome%tally%cases), 16)
      call same_bytes("run_merge")
      call merge_folder("run_merge", 2, other, outcome, error)
      call suite%fails("merge again", error, "nothing to merge")
   end subroutine test_stopped_merge

   subroutine same_bytes(folder)
      character(len=*), intent(in) :: folder
      type(error_type), allocatable :: error
      character(len=:), allocatable :: whole, text
      logical :: found

      call read_whole_file("run_whole/results.nc", whole, found, error)
      call read_whole_file(folder//"/results.nc", text, found, error)
      call suite%true(folder//"/results.nc is the same bytes", found .and. text == whole)
      call read_whole_file("run_whole/summary.csv", whole, found, error)
      call read_whole_file(folder//"/summary.csv", text, found, error)
      call suite%true(folder//"/summary.csv is the same bytes", found .and. text == whole)
   end subroutine same_bytes

end program test_run
