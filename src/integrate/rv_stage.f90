!> The stage equations: one Newton iteration a lane.
!>
!> An implicit Runge-Kutta stage asks for q = base_q + gamma v and v = base_v + gamma a(q, v, t).
!> With q eliminated, g(v) = v - base_v - gamma a(base_q + gamma v, v, t) = 0 is solved lane by lane: a scalar
!> equation, or a small dense system (LAPACK dgesv) for models of several degrees of freedom. For a
!> closing lumped reed g rises steadily, without bound as the film closes: one root. A correction that
!> would take more than three quarters of the film is cut, so that h stays positive.
!>
!> Scalar equations are solved a few lanes at a time: few enough that lanes of like cases need the same number of
!> iterations, and enough for the compiler's vectors.
module rv_stage
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: solve_stage, stage_guess

   integer, parameter :: together = 128      !! lanes that iterate side by side
   integer, parameter :: max_iterations = 40
   integer, parameter :: max_halvings = 8   !! of a lane's correction, in one iteration
   real(wp), parameter :: accuracy = 0.1_wp !! last correction of a system over tolerance; Newton squares it: error below rtol
   real(wp), parameter :: remainder = 0.02_wp !! error left in a scalar equation over tolerance

   !> The accelerations of the stages solved last: they lead to those of the next.
   type :: stage_guess
      private
      integer :: known = 0              !! stages; at least one after begin
      real(wp) :: t(2) = 0.0_wp         !! their times, the last one first [s]
      integer :: column(3) = [1, 2, 3]  !! of the accelerations at these times, and of the stage at work
      real(wp), allocatable :: a(:, :)  !! accelerations, one column each [m s-2]
   contains
      procedure :: begin
      procedure, private :: weights
      procedure, private :: keep
   end type stage_guess

   interface
      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv
   end interface

contains

   !> Factors of the last two accelerations that draw them on to time t.
   pure function weights(self, t) result(weight)
      class(stage_guess), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: weight(2)

      weight = [1.0_wp, 0.0_wp]
      if (self%known < 2) return
      weight(2) = -(t - self%t(1))/(self%t(1) - self%t(2))
      weight(1) = 1.0_wp - weight(2)
   end function weights

   !> The stage at work, at time t, is solved. Of two at nearly the same time the newer stays.
   pure subroutine keep(self, t, gamma)
      class(stage_guess), intent(inout) :: self
      real(wp), intent(in) :: t, gamma

      if (abs(t - self%t(1)) > 0.5_wp*gamma) then
         self%column = self%column([3, 1, 2])
         self%t(2) = self%t(1)
         self%known = 2
      else
         self%column = self%column([3, 2, 1])
      end if
      self%t(1) = t
   end subroutine keep

   !> Begin, or begin anew, with accelerations known at time t.
   pure subroutine begin(self, t, a)
      class(stage_guess), intent(inout) :: self
      real(wp), intent(in) :: t            !! [s]
      real(wp), intent(in) :: a(:, :)      !! [m s-2], (width, dofs)

      if (.not. allocated(self%a)) allocate(self%a(size(a), 3), source=0.0_wp)
      self%known = 1
      self%t(1) = t
      self%a(:, self%column(1)) = reshape(a, [size(a)])
   end subroutine begin

   !> Solve q = q_n + known_q + gamma v, v = v_n + known_v + gamma a for all lanes.
   !>
   !> `failed` is the first lane that has no solution, or 0; `closed` tells that its film is closed.
   subroutine solve_stage(lanes, t, inlet, outlet, gamma, q_n, v_n, known_q, known_v, weight, guess, dq, dv, failed, closed)
      class(valve_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: t                                   !! [s]
      real(wp), intent(in) :: inlet, outlet                       !! pressure factors at t
      real(wp), intent(in) :: gamma                               !! step times diagonal coefficient [s], > 0
      real(wp), dimension(lanes%width, lanes%dofs), intent(in) :: q_n, v_n           !! the state the step starts from
      real(wp), dimension(lanes%width, lanes%dofs), intent(in) :: known_q, known_v   !! what earlier stages add
      real(wp), intent(in) :: weight(lanes%width, lanes%dofs)     !! one over the allowed error of v
      type(stage_guess), intent(inout) :: guess
      real(wp), dimension(lanes%width, lanes%dofs), intent(out) :: dq, dv            !! q - q_n and v - v_n
      integer, intent(out) :: failed
      logical, intent(out) :: closed
      real(wp) :: drawn(2)
      integer :: first, last

      drawn = guess%weights(t)
      associate (now => guess%column(3), old => guess%column(1), older => guess%column(2))
         if (lanes%dofs > 1) then
            guess%a(:, now) = drawn(1)*guess%a(:, old) + drawn(2)*guess%a(:, older)
            call solve_system(lanes, inlet, outlet, gamma, q_n + known_q, v_n + known_v, weight, guess%a(:, now), dq, dv, &
               & failed, closed)
            dq = dq - q_n
            dv = dv - v_n
         else
            do first = 1, lanes%width, together
               last = min(first + together - 1, lanes%width)
               call solve_scalar(lanes, first, last, inlet, outlet, gamma, q_n(first:last, 1), v_n(first:last, 1), &
                  & known_q(first:last, 1), known_v(first:last, 1), lanes%gap(first:last), weight(first:last, 1), drawn, &
                  & guess%a(first:last, old), guess%a(first:last, older), guess%a(first:last, now), &
                  & dq(first:last, 1), dv(first:last, 1), failed, closed)
               if (failed > 0) return
            end do
         end if
      end associate
      if (failed == 0) call guess%keep(t, gamma)
   end subroutine solve_stage

   !> Some lanes of one degree of freedom.
   subroutine solve_scalar(lanes, first, last, inlet, outlet, gamma, q_n, v_n, known_q, known_v, gap, weight, &
      & drawn, a_old, a_older, a_now, dq, dv, failed, closed)
      class(valve_lanes), intent(inout) :: lanes
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet, gamma
      real(wp), dimension(first:last), intent(in) :: q_n, v_n, known_q, known_v, gap, weight
      real(wp), intent(in) :: drawn(2)
      real(wp), dimension(first:last), intent(in) :: a_old, a_older
      real(wp), dimension(first:last), intent(out) :: a_now, dq, dv
      integer, intent(out) :: failed
      logical, intent(out) :: closed
      real(wp), dimension(together) :: base_q, base_v, v, step, film, left
      integer :: n, iteration
      logical :: open

      closed = .false.
      n = last - first + 1
      call predict(n, gamma, drawn, q_n, v_n, known_q, known_v, gap, a_old, a_older, base_q, base_v, v)
      do iteration = 1, max_iterations
         call lanes%correction(first, last, inlet, outlet, gamma, base_q, base_v, v, step, film, failed)
         if (failed > 0) then
            closed = .not. ieee_is_nan(film(failed - first + 1))
            return
         end if
         call correct(n, gamma, weight, film, step, v, left, open)
         if (.not. open) exit
      end do
      dq = known_q + gamma*v(:n)
      dv = v(:n) - v_n
      a_now = (1.0_wp/gamma)*(v(:n) - base_v(:n))
      if (.not. open) return
      do failed = first, last
         if (.not. left(failed - first + 1) <= 0.0_wp) return
      end do
   end subroutine solve_scalar

   !> What is known of q and v, and v with accelerations drawn on from earlier ones, but so that no film closes: a
   !> thousandth of the gap stays, or a tenth of the film that is known where that is less.
   pure subroutine predict(n, gamma, drawn, q_n, v_n, known_q, known_v, gap, a_old, a_older, base_q, base_v, v)
      integer, intent(in) :: n
      real(wp), intent(in) :: gamma, drawn(2)
      real(wp), dimension(n), intent(in) :: q_n, v_n, known_q, known_v, gap, a_old, a_older
      real(wp), dimension(n), intent(out) :: base_q, base_v, v
      real(wp) :: film, least, kept, new, old, older, per_gamma
      integer :: i

      old = gamma*drawn(1)
      older = gamma*drawn(2)
      per_gamma = 1.0_wp/gamma
      do i = 1, n
         base_q(i) = q_n(i) + known_q(i)
         base_v(i) = v_n(i) + known_v(i)
         new = base_v(i) + old*a_old(i) + older*a_older(i)
         film = base_q(i) + gap(i)
         least = 0.1_wp*film
         least = merge(least, 1.0e-3_wp*gap(i), least > 1.0e-3_wp*gap(i))
         kept = per_gamma*(least - film)
         v(i) = merge(new, kept, new > kept)
      end do
   end subroutine predict

   !> Add Newton's correction to some lanes; `left` is positive where more remains of their error than may, `open` tells
   !> that some have more.
   !>
   !> With the film's force in h^-3, g'' /(2 g') <= 3 gamma/h for a reed that closes: the error left after a correction dv
   !> is at most 3 gamma dv^2/h. Where the film opens fast the bound may not hold and dv itself is taken;
   !> where v changes its sign, and the film perhaps its law, nothing is known.
   pure subroutine correct(n, gamma, weight, film, dv, v, left, open)
      integer, intent(in) :: n
      real(wp), intent(in) :: gamma
      real(wp), dimension(n), intent(in) :: weight, film, dv
      real(wp), intent(inout) :: v(n)
      real(wp), intent(out) :: left(n)
      logical, intent(out) :: open
      real(wp) :: bend, cut, per_gamma, v_new, turned
      integer(i8) :: some
      integer :: i

      some = 0_i8
      per_gamma = 1.0_wp/gamma
      do i = 1, n
         cut = -0.75_wp*film(i)
         bend = 3.0_wp*gamma*abs(dv(i))
         bend = merge(film(i), bend, max(4.0_wp*bend, 6.0_wp*gamma*v(i)) >= film(i))
         left(i) = abs(dv(i))*weight(i)*bend - remainder*film(i)   ! over the film, which is positive
         v_new = v(i) + merge(per_gamma*cut, dv(i), gamma*dv(i) < cut)   ! max() may drop a NaN
         turned = merge(1.0_wp, 0.0_wp, v(i) > 0.0_wp) - merge(1.0_wp, 0.0_wp, v_new > 0.0_wp)
         left(i) = left(i) + turned*turned*film(i)
         v(i) = v_new
         some = ior(some, merge(0_i8, 1_i8, left(i) <= 0.0_wp))
      end do
      open = some > 0_i8
   end subroutine correct

   !> Some lanes of several degrees of freedom, from predicted accelerations to those found.
   subroutine solve_system(lanes, inlet, outlet, gamma, base_q, base_v, weight, predicted, q, v, failed, closed)
      class(valve_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: inlet, outlet, gamma
      real(wp), dimension(lanes%width, lanes%dofs), intent(in) :: base_q, base_v, weight
      real(wp), dimension(lanes%width, lanes%dofs), intent(inout) :: predicted
      real(wp), dimension(lanes%width, lanes%dofs), intent(out) :: q, v
      integer, intent(out) :: failed
      logical, intent(out) :: closed
      real(wp), dimension(lanes%width, lanes%dofs) :: a, correction
      real(wp), dimension(lanes%width, lanes%dofs, lanes%dofs) :: a_q, a_v
      logical :: unsolved(lanes%width)
      integer :: halvings(lanes%width), iteration, i

      correction = base_v + gamma*predicted
      v = 0.0_wp   ! halving leads from the prediction back to the start of the step
      unsolved = .true.
      do iteration = 1, max_iterations
         halvings = 0
         do
            q = base_q + gamma*(v + correction)
            call lanes%linearise(1, lanes%width, inlet, outlet, q, v + correction, a, a_q, a_v, failed)
            if (failed == 0) exit
            if (halvings(failed) == max_halvings) exit
            halvings(failed) = halvings(failed) + 1
            correction(failed, :) = 0.5_wp*correction(failed, :)
         end do
         v = v + correction
         if (failed > 0) exit
         do i = 1, lanes%width
            call newton(v(i, :) - base_v(i, :) - gamma*a(i, :), a_q(i, :, :), a_v(i, :, :), correction(i, :))
            unsolved(i) = .not. all(abs(correction(i, :))*weight(i, :) <= accuracy)
         end do
         if (any(unsolved)) cycle
         v = v + correction
         exit
      end do
      predicted = (v - base_v)/gamma
      q = base_q + gamma*v
      closed = .false.
      if (failed > 0) closed = .not. any(ieee_is_nan(q(failed, :)))
      if (failed == 0) failed = first_true(unsolved)

   contains

      !> Newton's correction of one lane; too large for any tolerance where the system is singular.
      subroutine newton(residual, slope_q, slope_v, dv)
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
      end subroutine newton

   end subroutine solve_system

   pure integer function first_true(mask) result(i)
      logical, intent(in) :: mask(:)

      do i = 1, size(mask)
         if (mask(i)) return
      end do
      i = 0
   end function first_true

end module rv_stage
