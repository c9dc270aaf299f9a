!> What is to be integrated: lanes under a pressure history, and how accurately.
module rv_problem
   use rv_kinds, only : wp
   use rv_pressure, only : pressure_history
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: problem_type, pose

   type :: problem_type
      class(valve_lanes), allocatable :: lanes
      class(pressure_history), allocatable :: history
      real(wp) :: rtol = 0.0_wp
      real(wp), allocatable :: q_scale(:, :), v_scale(:, :)  !! added to |q| and |v| in the tolerance, (width, dofs)
      integer :: failed = 0          !! lane that the step failed for, if that is known
      integer :: hindrance = 0       !! lane whose film was closed, or whose stage had no solution, most recently
      logical :: closed = .false.    !! because its film was closed
   end type problem_type

contains

   !> The lanes move in.
   subroutine pose(self, lanes, history, rtol)
      type(problem_type), intent(out) :: self
      class(valve_lanes), allocatable, intent(inout) :: lanes
      class(pressure_history), intent(in) :: history
      real(wp), intent(in) :: rtol
      real(wp) :: span(lanes%width)
      integer :: i

      call move_alloc(lanes, self%lanes)
      allocate(self%history, source=history)
      self%rtol = rtol
      do i = 1, size(span)
         span(i) = history%span(self%lanes%inlet(i), self%lanes%outlet(i))
      end do
      allocate(self%q_scale(self%lanes%width, self%lanes%dofs), self%v_scale(self%lanes%width, self%lanes%dofs))
      call self%lanes%scales(span, self%q_scale, self%v_scale)
   end subroutine pose

end module rv_problem
