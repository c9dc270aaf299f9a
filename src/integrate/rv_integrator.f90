!> What marches lanes on, one step at a time.
module rv_integrator
   use rv_problem, only : problem_type
   use rv_kinds, only : wp
   use rv_step, only : step_type
   implicit none
   private
   public :: integrator_type, step_done, step_at_stop, step_failed, step_not_finite

   ! How a step ended; what is below 0 left the step as it was.
   integer, parameter :: step_done = 0
   integer, parameter :: step_at_stop = 1      !! and the stop is reached
   integer, parameter :: step_failed = -1
   integer, parameter :: step_not_finite = -2  !! the state of lane problem%failed

   type, abstract :: integrator_type
   contains
      procedure(step_of), deferred :: take_step
      procedure(restart_of), deferred :: restart
      procedure(worst_of), deferred :: worst_lane
      procedure(reason_of), deferred :: get_reason
   end type integrator_type

   abstract interface
      !> Go on from the step's end, not beyond t_stop.
      subroutine step_of(self, problem, t_stop, step, flag)
         import :: integrator_type, problem_type, step_type, wp
         class(integrator_type), intent(inout) :: self
         type(problem_type), intent(inout), target :: problem
         real(wp), intent(in) :: t_stop   !! [s]
         type(step_type), intent(inout) :: step
         integer, intent(out) :: flag     !! step_
      end subroutine step_of

      !> Begin anew at the step's end, whose state has been changed.
      subroutine restart_of(self, problem, step, flag)
         import :: integrator_type, problem_type, step_type
         class(integrator_type), intent(inout) :: self
         type(problem_type), intent(inout), target :: problem
         type(step_type), intent(in) :: step
         integer, intent(out) :: flag
      end subroutine restart_of

      !> The lane that shortened the last step that was tried most: by its error, or where the method is stable.
      integer function worst_of(self, problem, step)
         import :: integrator_type, problem_type, step_type
         class(integrator_type), intent(in) :: self
         type(problem_type), intent(inout) :: problem
         type(step_type), intent(in) :: step   !! the last one that was good
      end function worst_of

      !> Why the last call failed.
      subroutine reason_of(self, text)
         import :: integrator_type
         class(integrator_type), intent(in) :: self
         character(len=:), allocatable, intent(out) :: text
      end subroutine reason_of
   end interface

end module rv_integrator
