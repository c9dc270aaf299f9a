!> What a run is asked for, and what it answers.
module rv_run_terms
   use rv_kinds, only : wp, i8
   use rv_tally, only : tally_type
   implicit none
   private
   public :: run_options, run_outcome

   type :: run_options
      character(len=:), allocatable :: folder   !! for the results
      integer :: threads = 0                    !! of each process; 0: as many as OpenMP offers
      logical :: resume = .false.               !! go on with an unfinished run of the same deck
      logical :: force = .false.                !! replace results, drop an unfinished run; not of a slice
      integer :: slice = 1                      !! run blocks slice, slice + slices, ...
      integer :: slices = 0                     !! 0: run all blocks and merge; else other slices may work here, too
   contains
      procedure :: is_slice
      procedure :: block_at
      procedure :: block_total
   end type run_options

   type :: run_outcome
      type(tally_type) :: tally        !! of all cases, with the results in place; of a slice only how many, and how many failed
      integer :: processes = 1
      integer :: threads = 1           !! of each process
      integer :: blocks = 0            !! of the whole run
      integer :: own_blocks = 0        !! of this slice; all where there are no slices
      integer :: finished_blocks = 0   !! of the whole run, when it ended
      integer :: kept_blocks = 0       !! found finished
      integer :: new_blocks = 0        !! finished by this run
      integer :: damaged_blocks = 0    !! found damaged and computed again
      integer(i8) :: new_cases = 0     !! computed by this run
      real(wp) :: seconds = 0.0_wp     !! computing and merging [s]
      logical :: stopped = .false.     !! on request; can be resumed
      logical :: was_complete = .false.!! the results were there already
      logical :: unlocked = .false.    !! this file system has no locks
      logical :: logged = .true.       !! run.log could be written
      logical :: has_csv = .true.      !! there is a summary.csv, not results.nc alone
   end type run_outcome

contains

   pure logical function is_slice(self)
      class(run_options), intent(in) :: self

      is_slice = self%slices > 0
   end function is_slice

   !> The block that comes after `before` others of this run or slice; it may lie past the last one.
   pure integer(i8) function block_at(self, before) result(block)
      class(run_options), intent(in) :: self
      integer(i8), intent(in) :: before

      block = 1 + before
      if (self%is_slice()) block = self%slice + before*self%slices
   end function block_at

   !> How many of so many blocks are this slice's.
   pure integer function block_total(self, blocks) result(total)
      class(run_options), intent(in) :: self
      integer, intent(in) :: blocks

      total = blocks
      if (self%is_slice()) total = (blocks - self%slice + self%slices)/self%slices
   end function block_total

end module rv_run_terms
