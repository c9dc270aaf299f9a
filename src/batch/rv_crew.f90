!> Who works on a run together: one process with its threads, or many processes that only share some counters.
!>
!> The counters say who runs which block, and how far the run is. Results go through part files alone.
module rv_crew
   use rv_kinds, only : i8
   use rv_error, only : error_type
   implicit none
   private
   public :: crew_type, lone_crew
   public :: n_counters, count_taken, count_done, count_earlier, count_failed, count_new_cases, count_new_blocks, &
      & count_kept_blocks, count_damaged_blocks, count_stops, count_complete

   integer, parameter :: count_taken = 1           !! blocks given out, of those this run may run
   integer, parameter :: count_done = 2            !! cases finished, those of earlier runs included
   integer, parameter :: count_earlier = 3         !! cases found finished
   integer, parameter :: count_failed = 4          !! cases failed among those finished
   integer, parameter :: count_new_cases = 5       !! cases computed
   integer, parameter :: count_new_blocks = 6
   integer, parameter :: count_kept_blocks = 7     !! found finished
   integer, parameter :: count_damaged_blocks = 8  !! found damaged
   integer, parameter :: count_stops = 9           !! who was asked to stop
   integer, parameter :: count_complete = 10       !! 1: the results were there already
   integer, parameter :: n_counters = 10

   type, abstract :: crew_type
      integer :: processes = 1
      integer :: usual_threads = 0   !! of each process, where none are asked for; 0: as many as OpenMP offers
      logical :: leads = .true.      !! this process opens the folder, merges and speaks for all
   contains
      procedure(add_to_counter), deferred :: add
      procedure(share_failure), deferred :: share
   end type crew_type

   !> One process.
   type, extends(crew_type) :: lone_crew
      integer(i8), private :: counter(n_counters) = 0
   contains
      procedure :: add => add_alone
      procedure :: share => share_alone
   end type lone_crew

   abstract interface
      !> Add to a counter of all; `before` is what it was. Only one thread of a process calls it at a time.
      subroutine add_to_counter(self, counter, amount, before)
         import :: crew_type, i8
         class(crew_type), intent(inout) :: self
         integer, intent(in) :: counter              !! one of count_*
         integer(i8), intent(in) :: amount
         integer(i8), intent(out) :: before
      end subroutine add_to_counter

      !> Wait for all; what failed for one has then failed for all. All call it at the same points.
      subroutine share_failure(self, error)
         import :: crew_type, error_type
         class(crew_type), intent(inout) :: self
         type(error_type), allocatable, intent(inout) :: error
      end subroutine share_failure
   end interface

contains

   subroutine add_alone(self, counter, amount, before)
      class(lone_crew), intent(inout) :: self
      integer, intent(in) :: counter
      integer(i8), intent(in) :: amount
      integer(i8), intent(out) :: before

      before = self%counter(counter)
      self%counter(counter) = before + amount
   end subroutine add_alone

   !> Nobody to wait for, nobody to tell.
   subroutine share_alone(self, error)
      class(lone_crew), intent(inout) :: self
      type(error_type), allocatable, intent(inout) :: error

      associate (unused => [self%leads, allocated(error)])
      end associate
   end subroutine share_alone

end module rv_crew
