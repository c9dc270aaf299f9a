!> The stage equations: one Newton iteration a lane.
!>
!> An implicit Runge-Kutta stage asks for q = base_q + gamma v and v = base_v + gamma a(q, v, t).
!> With q eliminated, g(v) = v - base_v - gamma a(base_q + gamma v, v, t) = 0 is solved lane by lane: a scalar
!> equation, or a small dense system (LAPACK dgesv) for models of several degrees of freedom. For a
!> closing lumped reed g rises steadily, without bound as the film closes: one root. A correction that
!> would take more than three quarters of the film is cut, so that h stays positive.
module rv_stage
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: solve_stage

   integer, parameter :: max_iterations = 40
   integer, parameter :: max_halvings = 8   !! of a lane's correction, in one iteration
   real(wp), parameter :: accuracy = 0.1_wp  !! last correction over tolerance; Newton squares it: error below rtol

   interface
      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv
   end interface

contains

   !> Solve for all lanes. `failed` is the first lane that has no solution, or 0; `closed` tells that its film is closed.
   subroutine solve_stage(lanes, inlet, outlet, gamma, base_q, base_v, weight, q, v, failed, closed)
      class(valve_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: inlet, outlet                       !! pressure factors at the stage's time
      real(wp), intent(in) :: gamma                               !! step times diagonal coefficient [s], > 0
      real(wp), intent(in) :: base_q(lanes%width, lanes%dofs)     !! known part of q
      real(wp), intent(in) :: base_v(lanes%width, lanes%dofs)     !! known part of v
      real(wp), intent(in) :: weight(lanes%width, lanes%dofs)     !! one over the allowed error of v
      real(wp), intent(inout) :: q(lanes%width, lanes%dofs)       !! prediction, then solution
      real(wp), intent(inout) :: v(lanes%width, lanes%dofs)       !! prediction, then solution
      integer, intent(out) :: failed
      logical, intent(out) :: closed

      if (lanes%dofs == 1) then
         call solve_scalar(lanes, inlet, outlet, gamma, base_q(:, 1), base_v(:, 1), weight(:, 1), q(:, 1), v(:, 1), &
            & failed, closed)
      else
         call solve_system(lanes, inlet, outlet, gamma, base_q, base_v, weight, q, v, failed, closed)
      end if
   end subroutine solve_stage

   subroutine solve_scalar(lanes, inlet, outlet, gamma, base_q, base_v, weight, q, v, failed, closed)
      class(valve_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: inlet, outlet, gamma
      real(wp), dimension(lanes%width), intent(in) :: base_q, base_v, weight
      real(wp), dimension(lanes%width), intent(inout) :: q, v
      integer, intent(out) :: failed
      logical, intent(out) :: closed
      real(wp), dimension(lanes%width) :: a, a_q, a_v
      real(wp) :: film, correction, limit
      logical :: open(lanes%width)
      integer :: iteration, i

      do i = 1, lanes%width
         film = base_q(i) + lanes%gap(i)
         if (.not. (film + gamma*v(i) > 0.1_wp*film .and. film + gamma*v(i) > 0.0_wp)) then
            v(i) = (max(0.1_wp*film, 1.0e-3_wp*lanes%gap(i)) - film)/gamma
         end if
      end do
      do iteration = 1, max_iterations
         q = base_q + gamma*v
         call lanes%linearise(inlet, outlet, q, v, a, a_q, a_v, failed)
         if (failed > 0) exit
         do i = 1, lanes%width
            correction = -(v(i) - base_v(i) - gamma*a(i))/(1.0_wp - gamma*(a_v(i) + gamma*a_q(i)))
            open(i) = .not. abs(correction)*weight(i) <= accuracy
            limit = -0.75_wp*(q(i) + lanes%gap(i))/gamma
            if (correction < limit) correction = limit   ! max() may drop a NaN
            v(i) = v(i) + correction
         end do
         if (.not. any(open)) exit
      end do
      q = base_q + gamma*v
      closed = .false.
      if (failed > 0) closed = .not. ieee_is_nan(q(failed))
      if (failed == 0) failed = first_true(open)
   end subroutine solve_scalar

   subroutine solve_system(lanes, inlet, outlet, gamma, base_q, base_v, weight, q, v, failed, closed)
      class(valve_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: inlet, outlet, gamma
      real(wp), dimension(lanes%width, lanes%dofs), intent(in) :: base_q, base_v, weight
      real(wp), dimension(lanes%width, lanes%dofs), intent(inout) :: q, v
      integer, intent(out) :: failed
      logical, intent(out) :: closed
      real(wp), dimension(lanes%width, lanes%dofs) :: a, correction
      real(wp), dimension(lanes%width, lanes%dofs, lanes%dofs) :: a_q, a_v
      logical :: open(lanes%width)
      integer :: halvings(lanes%width), iteration, i

      correction = v
      v = 0.0_wp   ! halving leads from the prediction back to the start of the step
      open = .true.
      do iteration = 1, max_iterations
         halvings = 0
         do
            q = base_q + gamma*(v + correction)
            call lanes%linearise(inlet, outlet, q, v + correction, a, a_q, a_v, failed)
            if (failed == 0) exit
            if (halvings(failed) == max_halvings) exit
            halvings(failed) = halvings(failed) + 1
            correction(failed, :) = 0.5_wp*correction(failed, :)
         end do
         v = v + correction
         if (failed > 0) exit
         do i = 1, lanes%width
            call correct(v(i, :) - base_v(i, :) - gamma*a(i, :), a_q(i, :, :), a_v(i, :, :), correction(i, :))
            open(i) = .not. all(abs(correction(i, :))*weight(i, :) <= accuracy)
         end do
         if (any(open)) cycle
         v = v + correction
         exit
      end do
      q = base_q + gamma*v
      closed = .false.
      if (failed > 0) closed = .not. any(ieee_is_nan(q(failed, :)))
      if (failed == 0) failed = first_true(open)

   contains

      !> Newton's correction of one lane; too large for any tolerance where the system is singular.
      subroutine correct(residual, slope_q, slope_v, dv)
         real(wp), intent(in) :: residual(:), slope_q(:, :), slope_v(:, :)
         real(wp), intent(out) :: dv(:)
         real(wp) :: matrix(size(dv), size(dv)), rhs(size(dv), 1)
         integer :: pivot(size(dv)), info, k

         matrix = -gamma*(slope_v + gamma*slope_q)
         do k = 1, size(dv)
            matrix(k, k) = matrix(k, k) + 1.0_wp
         end do
         rhs(:, 1) = -residual
         call dgesv(size(dv), 1, matrix, size(dv), pivot, rhs, size(dv), info)
         dv = rhs(:, 1)
         if (info /= 0) dv = huge(1.0_wp)
      end subroutine correct

   end subroutine solve_system

   pure integer function first_true(mask) result(i)
      logical, intent(in) :: mask(:)

      do i = 1, size(mask)
         if (mask(i)) return
      end do
      i = 0
   end function first_true

end module rv_stage
