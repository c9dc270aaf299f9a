!> How a case ended, and what it should warn of.
module rv_status
   implicit none
   private
   public :: status_ok, status_step_too_small, status_film_closed, status_not_finite
   public :: status_too_many_steps, status_no_convergence, status_bad_case
   public :: n_statuses, status_name
   public :: warn_reynolds, warn_cavitation, warn_wide_gap, warn_large_slope, warn_not_open, n_warnings, warning_name

   integer, parameter :: status_ok = 0
   integer, parameter :: status_step_too_small = 1  !! the error test cannot be met
   integer, parameter :: status_film_closed = 2     !! the reed reached its seat
   integer, parameter :: status_not_finite = 3      !! NaN or infinity in the solution
   integer, parameter :: status_too_many_steps = 4  !! &solver max_steps reached
   integer, parameter :: status_no_convergence = 5  !! the stage equations cannot be solved
   integer, parameter :: status_bad_case = 6        !! the case's data do not go together
   integer, parameter :: n_statuses = 7

   integer, parameter :: warn_reynolds = 1    !! Re outside the range of the hydrodynamic function
   integer, parameter :: warn_cavitation = 2  !! the film's pressure falls below the vapour pressure
   integer, parameter :: warn_wide_gap = 4    !! lubrication theory overstates the land's load
   integer, parameter :: warn_large_slope = 8 !! the reed bends further than theories of small slopes go
   integer, parameter :: warn_not_open = 16   !! the reed is not open at the event: no times are measured
   integer, parameter :: n_warnings = 5       !! warnings are bits: 1, 2, 4, ...

contains

   !> The word for a status code, as written to results.
   pure function status_name(status) result(name)
      integer, intent(in) :: status   !! 0 to n_statuses - 1
      character(len=:), allocatable :: name
      character(len=14), parameter :: names(0:n_statuses - 1) = [character(len=14) :: &
         & "ok", "step_too_small", "film_closed", "not_finite", "too_many_steps", "no_convergence", "bad_case"]

      name = "unknown"
      if (status >= 0 .and. status < n_statuses) name = trim(names(status))
   end function status_name

   !> The word for a warning bit, as written to results.
   pure function warning_name(bit) result(name)
      integer, intent(in) :: bit      !! 1 to n_warnings, the flag's value is 2**(bit - 1)
      character(len=:), allocatable :: name
      character(len=14), parameter :: names(n_warnings) = [character(len=14) :: "reynolds_range", "cavitation", "wide_gap", &
         & "large_slope", "not_open"]

      name = "unknown"
      if (bit >= 1 .and. bit <= n_warnings) name = trim(names(bit))
   end function warning_name

end module rv_status
