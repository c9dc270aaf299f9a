!> The stage equations of the lumped models: W independent scalar Newton iterations.
!>
!> An implicit Runge-Kutta stage asks for u = base_u + gamma v and v = base_v + gamma a(u, v, t).
!> With u eliminated, g(v) = v - base_v - gamma a(base_u + gamma v, v, t) = 0 is solved lane by lane.
!> For a closing reed g rises steadily, without bound as the film closes: one root. A step that
!> would take more than three quarters of the film is cut, so that h stays positive.
module rv_stage
   use rv_kinds, only : wp
   use rv_lumped, only : lumped_lanes
   implicit none
   private
   public :: solve_stage

   integer, parameter :: max_iterations = 40
   real(wp), parameter :: accuracy = 0.1_wp  !! last correction over tolerance; Newton squares it: error below rtol

contains

   !> Solve for all lanes. On success worst_lane is 0, else the first lane that has no solution.
   pure subroutine solve_stage(lanes, inlet, outlet, gamma, base_u, base_v, weight, u, v, worst_lane)
      type(lumped_lanes), intent(in) :: lanes
      real(wp), intent(in) :: inlet, outlet           !! pressure factors at the stage's time
      real(wp), intent(in) :: gamma                   !! step times diagonal coefficient [s], > 0
      real(wp), intent(in) :: base_u(lanes%width)     !! known part of u [m]
      real(wp), intent(in) :: base_v(lanes%width)     !! known part of v [m s-1]
      real(wp), intent(in) :: weight(lanes%width)     !! one over the allowed error of v [s m-1]
      real(wp), intent(inout) :: u(lanes%width)       !! prediction, then solution [m]
      real(wp), intent(inout) :: v(lanes%width)       !! prediction, then solution [m s-1]
      integer, intent(out) :: worst_lane
      real(wp), dimension(lanes%width) :: a, a_u, a_v, correction
      real(wp) :: film, g
      logical :: open(lanes%width)
      integer :: iteration, i

      do i = 1, lanes%width
         film = base_u(i) + lanes%gap(i)
         if (.not. (film + gamma*v(i) > 0.1_wp*film .and. film + gamma*v(i) > 0.0_wp)) then
            v(i) = (max(0.1_wp*film, 1.0e-3_wp*lanes%gap(i)) - film)/gamma
         end if
      end do
      open = .true.
      do iteration = 1, max_iterations
         u = base_u + gamma*v
         call lanes%acceleration(inlet, outlet, u, v, a)
         call lanes%jacobian(u, v, a_u, a_v)
         do i = 1, lanes%width
            g = v(i) - base_v(i) - gamma*a(i)
            correction(i) = -g/(1.0_wp - gamma*(a_v(i) + gamma*a_u(i)))
            open(i) = .not. abs(correction(i))*weight(i) <= accuracy
            correction(i) = max(correction(i), -0.75_wp*(u(i) + lanes%gap(i))/gamma)
            v(i) = v(i) + correction(i)
         end do
         if (.not. any(open)) exit
      end do
      u = base_u + gamma*v
      worst_lane = findloc_true(open)
      if (worst_lane == 0) worst_lane = findloc_true(.not. u + lanes%gap > 0.0_wp)
   end subroutine solve_stage

   pure integer function findloc_true(mask) result(i)
      logical, intent(in) :: mask(:)

      do i = 1, size(mask)
         if (mask(i)) return
      end do
      i = 0
   end function findloc_true

end module rv_stage
