!> How a long run talks to whoever started it: a program with a progress bar, a test, another language.
module rv_monitor
   use rv_kinds, only : wp, i8
   implicit none
   private
   public :: monitor_type, progress_type, phase_cases, phase_merge

   integer, parameter :: phase_cases = 1   !! cases are being computed
   integer, parameter :: phase_merge = 2   !! results.nc and summary.csv are being written

   !> Where a run stands.
   type :: progress_type
      integer :: phase = phase_cases
      integer(i8) :: cases = 0       !! all that this run or slice is to do
      integer(i8) :: done = 0        !! finished in this phase, those of earlier runs and of other processes included
      integer(i8) :: earlier = 0     !! found finished
      integer(i8) :: failed = 0      !! failed among those that are done
      real(wp) :: seconds = 0.0_wp   !! since this phase began [s]
   end type progress_type

   !> Only one thread calls it at a time.
   type, abstract :: monitor_type
   contains
      procedure(report_progress), deferred :: report
      procedure(ask_to_stop), deferred :: stop_asked
   end type monitor_type

   abstract interface
      !> Called at the start of a phase and after every block, found finished or run.
      subroutine report_progress(self, progress)
         import :: monitor_type, progress_type
         class(monitor_type), intent(inout) :: self
         type(progress_type), intent(in) :: progress
      end subroutine report_progress

      !> True: finish the blocks under way and leave a state that can be resumed. Asked before every block.
      function ask_to_stop(self) result(yes)
         import :: monitor_type
         class(monitor_type), intent(inout) :: self
         logical :: yes
      end function ask_to_stop
   end interface

end module rv_monitor
