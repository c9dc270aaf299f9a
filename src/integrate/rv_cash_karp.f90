!> The explicit method of Cash & Karp (1990, doi:10.1145/79505.79507): six stages, order 5 with an estimate of order 4.
!>
!> For q'' = a(q, q', t) the stages of q follow from those of q': with A the coefficients of the table,
!> v_k = v + dt sum A_kl a_l and q_k = q + c_k dt v + dt^2 sum (A A)_kl a_l. Accelerations are all that is kept, of a
!> few lanes at a time: all they need stays in the first cache.
module rv_cash_karp
   use rv_kinds, only : wp
   use rv_largest, only : largest
   use rv_integrator, only : integrator_type, step_at_stop, step_done, step_failed
   use rv_problem, only : problem_type
   use rv_step, only : step_type
   implicit none
   private
   public :: cash_karp, new_cash_karp

   integer, parameter :: together = 128       !! lanes that step side by side
   integer, parameter :: most_failures = 30   !! of one step

   real(wp), parameter :: c(6) = [0.0_wp, 0.2_wp, 0.3_wp, 0.6_wp, 1.0_wp, 0.875_wp]
   real(wp), parameter :: table(6, 6) = reshape([real(wp) :: 0, 0, 0, 0, 0, 0, &
      & 1.0_wp/5.0_wp, 0, 0, 0, 0, 0, &
      & 3.0_wp/40.0_wp, 9.0_wp/40.0_wp, 0, 0, 0, 0, &
      & 3.0_wp/10.0_wp, -9.0_wp/10.0_wp, 6.0_wp/5.0_wp, 0, 0, 0, &
      & -11.0_wp/54.0_wp, 5.0_wp/2.0_wp, -70.0_wp/27.0_wp, 35.0_wp/27.0_wp, 0, 0, &
      & 1631.0_wp/55296.0_wp, 175.0_wp/512.0_wp, 575.0_wp/13824.0_wp, 44275.0_wp/110592.0_wp, 253.0_wp/4096.0_wp, 0], &
      & [6, 6], order=[2, 1])
   real(wp), parameter :: b(6) = [37.0_wp/378.0_wp, 0.0_wp, 250.0_wp/621.0_wp, 125.0_wp/594.0_wp, 0.0_wp, 512.0_wp/1771.0_wp]
   real(wp), parameter :: fourth(6) = [2825.0_wp/27648.0_wp, 0.0_wp, 18575.0_wp/48384.0_wp, 13525.0_wp/55296.0_wp, &
      & 277.0_wp/14336.0_wp, 0.25_wp]
   real(wp), parameter :: e(6) = b - fourth
   real(wp), parameter :: table_q(6, 6) = matmul(table, table), b_q(6) = matmul(b, table), e_q(6) = matmul(e, table)

   ! Step control by the last three errors, as ARKODE's PID controller has it.
   real(wp), parameter :: power(3) = [-0.58_wp, 0.21_wp, -0.1_wp]/4.0_wp
   real(wp), parameter :: bias = 1.5_wp, safety = 0.96_wp, fastest_growth = 10.0_wp, worth_it = 1.1_wp
   real(wp), parameter :: least_cut = 0.9_wp, largest_cut = 0.1_wp   !! after a step that failed
   !> Step times natural frequency or rate of decay. Up to there the errors of a lane that has come to rest shrink, if its
   !> damping is 0.1 of the critical one or more; from 2.88 to 3.7 on they grow until they fill the tolerance.
   real(wp), parameter :: stable = 2.75_wp
   real(wp), parameter :: least_error = 1.0e-10_wp
   real(wp), parameter :: refused = 1.0e20_wp                        !! error of a step that has none

   type, extends(integrator_type) :: cash_karp
      private
      real(wp) :: first_step = 0.0_wp   !! [s]
      real(wp) :: fixed_step = 0.0_wp   !! [s]; > 0: no step control
      real(wp) :: next_step = 0.0_wp    !! [s]
      real(wp) :: frequency = 0.0_wp    !! the highest of all lanes [s-1]
      real(wp) :: past(2) = 0.0_wp      !! logarithms of errors over tolerance, of the last two steps, the last one first
      logical :: is_bounded = .false.   !! the step that is tried, by stability
      real(wp), allocatable :: q(:, :), v(:, :), a(:, :)   !! at the end of the step that is tried, (width, dofs)
      real(wp), allocatable :: error(:)                    !! square of its error over tolerance, (width)
   contains
      procedure :: take_step
      procedure :: restart
      procedure :: worst_lane
      procedure :: get_reason
   end type cash_karp

contains

   !> Make ready for a problem.
   subroutine new_cash_karp(self, problem, first_step, fixed_step)
      type(cash_karp), intent(out) :: self
      type(problem_type), intent(in) :: problem
      real(wp), intent(in) :: first_step   !! to try [s], > 0
      real(wp), intent(in) :: fixed_step   !! [s]; > 0: all steps are of this length

      self%first_step = first_step
      self%fixed_step = fixed_step
      self%next_step = first_step
      self%frequency = maxval(problem%v_scale/problem%q_scale)
      allocate(self%q, self%v, self%a, mold=problem%q_scale)
      allocate(self%error(problem%lanes%width), source=0.0_wp)
   end subroutine new_cash_karp

   subroutine take_step(self, problem, t_stop, step, flag)
      class(cash_karp), intent(inout) :: self
      type(problem_type), intent(inout), target :: problem
      real(wp), intent(in) :: t_stop
      type(step_type), intent(inout) :: step
      integer, intent(out) :: flag
      real(wp) :: dt, error, longest, t
      integer :: failures
      logical :: at_end

      problem%failed = 0
      flag = step_failed
      longest = stable/max(self%frequency, problem%lanes%fastest_decay(step%q1, step%v1))
      do failures = 0, most_failures
         self%is_bounded = self%next_step >= longest
         call choose_step(self, longest, t_stop - step%t1, dt, at_end)
         if (dt <= 4.0_wp*epsilon(dt)*max(abs(step%t1), abs(t_stop))) return
         call try_step(self, problem, step, dt, error)
         if (error <= 1.0_wp .or. self%fixed_step > 0.0_wp) exit
         self%next_step = dt*max(largest_cut, min(least_cut, safety*(bias*error)**(-0.2_wp)))
      end do
      if (failures > most_failures) return
      call lengthen(self, dt, error, failures, is_cut=dt < min(self%next_step, longest))
      t = step%t1 + dt
      if (at_end) t = t_stop
      flag = merge(step_at_stop, step_done, at_end)
      call step%go_on(t, self%q, self%v, self%a)
   end subroutine take_step

   !> The next step, of which the last two before a stop share what is left.
   pure subroutine choose_step(self, longest, left, dt, at_end)
      class(cash_karp), intent(in) :: self
      real(wp), intent(in) :: longest  !! stable step [s]
      real(wp), intent(in) :: left     !! time to the stop [s]
      real(wp), intent(out) :: dt      !! [s]
      logical, intent(out) :: at_end
      real(wp), parameter :: rounding = 1.0e-6_wp

      dt = min(self%next_step, longest)
      if (self%fixed_step > 0.0_wp) dt = self%fixed_step
      at_end = left <= (1.0_wp + rounding)*dt
      if (at_end) then
         dt = left
      else if (.not. self%fixed_step > 0.0_wp) then
         dt = min(dt, 0.5_wp*left)
      end if
   end subroutine choose_step

   !> The step after one that was good. A step that a stop has cut says nothing against the length before it.
   subroutine lengthen(self, dt, error, failures, is_cut)
      class(cash_karp), intent(inout) :: self
      real(wp), intent(in) :: dt, error
      integer, intent(in) :: failures
      logical, intent(in) :: is_cut   !! by a stop
      real(wp) :: now, factor, least

      now = max(bias*error, least_error)
      factor = min(fastest_growth, safety*exp(dot_product(power, [log(now), self%past])))
      if (failures > 0) factor = min(1.0_wp, factor)
      if (factor > 1.0_wp .and. factor < worth_it) factor = 1.0_wp
      least = merge(self%next_step, 0.0_wp, is_cut)
      self%next_step = max(least, dt*factor)
      self%past = [log(now), self%past(1)]
   end subroutine lengthen

   !> Try a step: state and acceleration at its end, and the largest of the lanes' errors over tolerance.
   subroutine try_step(self, problem, step, dt, error)
      class(cash_karp), intent(inout) :: self
      type(problem_type), intent(inout) :: problem
      type(step_type), intent(in) :: step
      real(wp), intent(in) :: dt
      real(wp), intent(out) :: error
      real(wp) :: inlet(6), outlet(6)
      integer :: closed, k

      do k = 2, 6
         call problem%history%factors(step%t1 + c(k)*dt, inlet(k), outlet(k))
      end do
      call try_lanes(problem, size(self%q), problem%lanes%dofs, dt, inlet, outlet, step%q1, step%v1, step%a1, &
         & problem%q_scale, problem%v_scale, self%q, self%v, self%a, self%error, closed)
      if (closed > 0) then
         problem%hindrance = closed
         problem%closed = .true.
         self%error = 0.0_wp
         self%error(closed) = refused**2
      end if
      error = largest(self%error)
      error = sqrt(merge(error, refused**2, error <= refused**2))
   end subroutine try_step

   !> try_step for states as plain arrays of n numbers. `closed` is a lane whose film is closed in a stage, or 0.
   subroutine try_lanes(problem, n, dofs, dt, inlet, outlet, q0, v0, a0, q_scale, v_scale, q, v, a, error, closed)
      type(problem_type), intent(inout) :: problem
      integer, intent(in) :: n, dofs
      real(wp), intent(in) :: dt, inlet(6), outlet(6)
      real(wp), dimension(n), intent(in) :: q0, v0, a0, q_scale, v_scale
      real(wp), dimension(n), intent(out) :: q, v, a
      real(wp), intent(out) :: error(n/dofs)
      integer, intent(out) :: closed
      integer :: first, last, lo, hi, chunk

      chunk = merge(together, n/dofs, dofs == 1)
      do first = 1, n/dofs, chunk
         last = min(first + chunk - 1, n/dofs)
         lo = (first - 1)*dofs + 1
         hi = last*dofs
         call try_some(problem, first, last, hi - lo + 1, dt, inlet, outlet, q0(lo:hi), v0(lo:hi), a0(lo:hi), &
            & q_scale(lo:hi), v_scale(lo:hi), q(lo:hi), v(lo:hi), a(lo:hi), error(first:last), closed)
         if (closed > 0) return
      end do
   end subroutine try_lanes

   !> try_lanes for lanes first..last, whose states are n numbers.
   subroutine try_some(problem, first, last, n, dt, inlet, outlet, q0, v0, a0, q_scale, v_scale, q, v, a, error, closed)
      type(problem_type), intent(inout) :: problem
      integer, intent(in) :: first, last, n
      real(wp), intent(in) :: dt, inlet(6), outlet(6)
      real(wp), dimension(n), intent(in) :: q0, v0, a0, q_scale, v_scale
      real(wp), dimension(n), intent(out) :: q, v, a
      real(wp), intent(out) :: error(first:last)
      integer, intent(out) :: closed
      real(wp), dimension(n) :: a2, a3, a4, a5, a6, off
      integer :: k

      call stage_2(n, dt, q0, v0, a0, q, v)
      call problem%lanes%acceleration(first, last, inlet(2), outlet(2), q, v, a2, closed)
      if (closed > 0) return
      call stage_3(n, dt, q0, v0, a0, a2, q, v)
      call problem%lanes%acceleration(first, last, inlet(3), outlet(3), q, v, a3, closed)
      if (closed > 0) return
      call stage_4(n, dt, q0, v0, a0, a2, a3, q, v)
      call problem%lanes%acceleration(first, last, inlet(4), outlet(4), q, v, a4, closed)
      if (closed > 0) return
      call stage_5(n, dt, q0, v0, a0, a2, a3, a4, q, v)
      call problem%lanes%acceleration(first, last, inlet(5), outlet(5), q, v, a5, closed)
      if (closed > 0) return
      call stage_6(n, dt, q0, v0, a0, a2, a3, a4, a5, q, v)
      call problem%lanes%acceleration(first, last, inlet(6), outlet(6), q, v, a6, closed)
      if (closed > 0) return
      call finish(n, dt, problem%rtol, q0, v0, a0, a2, a3, a4, a5, a6, q_scale, v_scale, q, v, off)
      call problem%lanes%acceleration(first, last, inlet(5), outlet(5), q, v, a, closed)
      error = 0.0_wp
      do k = 1, n, size(error)
         error = error + off(k:k + size(error) - 1)/real(2*n/size(error), wp)
      end do
   end subroutine try_some

   pure subroutine stage_2(n, dt, q0, v0, a1, q, v)
      integer, intent(in) :: n
      real(wp), intent(in) :: dt
      real(wp), dimension(n), intent(in) :: q0, v0, a1
      real(wp), dimension(n), intent(out) :: q, v
      integer :: i

      do i = 1, n
         q(i) = q0(i) + dt*c(2)*v0(i)
         v(i) = v0(i) + dt*table(2, 1)*a1(i)
      end do
   end subroutine stage_2

   pure subroutine stage_3(n, dt, q0, v0, a1, a2, q, v)
      integer, intent(in) :: n
      real(wp), intent(in) :: dt
      real(wp), dimension(n), intent(in) :: q0, v0, a1, a2
      real(wp), dimension(n), intent(out) :: q, v
      integer :: i

      do i = 1, n
         q(i) = q0(i) + dt*(c(3)*v0(i) + dt*table_q(3, 1)*a1(i))
         v(i) = v0(i) + dt*(table(3, 1)*a1(i) + table(3, 2)*a2(i))
      end do
   end subroutine stage_3

   pure subroutine stage_4(n, dt, q0, v0, a1, a2, a3, q, v)
      integer, intent(in) :: n
      real(wp), intent(in) :: dt
      real(wp), dimension(n), intent(in) :: q0, v0, a1, a2, a3
      real(wp), dimension(n), intent(out) :: q, v
      integer :: i

      do i = 1, n
         q(i) = q0(i) + dt*(c(4)*v0(i) + dt*(table_q(4, 1)*a1(i) + table_q(4, 2)*a2(i)))
         v(i) = v0(i) + dt*(table(4, 1)*a1(i) + table(4, 2)*a2(i) + table(4, 3)*a3(i))
      end do
   end subroutine stage_4

   pure subroutine stage_5(n, dt, q0, v0, a1, a2, a3, a4, q, v)
      integer, intent(in) :: n
      real(wp), intent(in) :: dt
      real(wp), dimension(n), intent(in) :: q0, v0, a1, a2, a3, a4
      real(wp), dimension(n), intent(out) :: q, v
      integer :: i

      do i = 1, n
         q(i) = q0(i) + dt*(c(5)*v0(i) + dt*(table_q(5, 1)*a1(i) + table_q(5, 2)*a2(i) + table_q(5, 3)*a3(i)))
         v(i) = v0(i) + dt*(table(5, 1)*a1(i) + table(5, 2)*a2(i) + table(5, 3)*a3(i) + table(5, 4)*a4(i))
      end do
   end subroutine stage_5

   pure subroutine stage_6(n, dt, q0, v0, a1, a2, a3, a4, a5, q, v)
      integer, intent(in) :: n
      real(wp), intent(in) :: dt
      real(wp), dimension(n), intent(in) :: q0, v0, a1, a2, a3, a4, a5
      real(wp), dimension(n), intent(out) :: q, v
      integer :: i

      do i = 1, n
         q(i) = q0(i) + dt*(c(6)*v0(i) + dt*(table_q(6, 1)*a1(i) + table_q(6, 2)*a2(i) + table_q(6, 3)*a3(i) &
            & + table_q(6, 4)*a4(i)))
         v(i) = v0(i) + dt*(table(6, 1)*a1(i) + table(6, 2)*a2(i) + table(6, 3)*a3(i) + table(6, 4)*a4(i) &
            & + table(6, 5)*a5(i))
      end do
   end subroutine stage_6

   !> State at the end of the step, and the sum of the squares of both errors over their tolerances.
   pure subroutine finish(n, dt, rtol, q0, v0, a1, a2, a3, a4, a5, a6, q_scale, v_scale, q, v, error)
      integer, intent(in) :: n
      real(wp), intent(in) :: dt, rtol
      real(wp), dimension(n), intent(in) :: q0, v0, a1, a2, a3, a4, a5, a6, q_scale, v_scale
      real(wp), dimension(n), intent(out) :: q, v, error
      real(wp) :: off_q, off_v, per_q, per_v, size_q, size_v
      integer :: i

      per_q = dt*dt/rtol
      per_v = dt/rtol
      do i = 1, n
         q(i) = q0(i) + dt*(v0(i) + dt*(b_q(1)*a1(i) + b_q(2)*a2(i) + b_q(3)*a3(i) + b_q(4)*a4(i) + b_q(5)*a5(i)))
         v(i) = v0(i) + dt*(b(1)*a1(i) + b(3)*a3(i) + b(4)*a4(i) + b(6)*a6(i))
         off_q = e_q(1)*a1(i) + e_q(2)*a2(i) + e_q(3)*a3(i) + e_q(4)*a4(i) + e_q(5)*a5(i)
         off_v = e(1)*a1(i) + e(3)*a3(i) + e(4)*a4(i) + e(5)*a5(i) + e(6)*a6(i)
         size_q = abs(q0(i)) + q_scale(i)
         size_v = abs(v0(i)) + v_scale(i)
         off_q = per_q*off_q*size_v
         off_v = per_v*off_v*size_q
         error(i) = (off_q*off_q + off_v*off_v)/((size_q*size_q)*(size_v*size_v))   ! one division, not two
      end do
   end subroutine finish

   subroutine restart(self, problem, step, flag)
      class(cash_karp), intent(inout) :: self
      type(problem_type), intent(inout), target :: problem
      type(step_type), intent(in) :: step
      integer, intent(out) :: flag

      associate (unused => [problem%rtol, step%t1])
      end associate
      self%next_step = self%first_step
      self%past = 0.0_wp
      flag = step_done
   end subroutine restart

   integer function worst_lane(self, problem, step)
      class(cash_karp), intent(in) :: self
      type(problem_type), intent(inout) :: problem
      type(step_type), intent(in) :: step

      if (self%is_bounded) then
         worst_lane = stiffest_lane(problem, problem%lanes%width, step)
         return
      end if
      do worst_lane = 1, size(self%error)
         if (.not. self%error(worst_lane) <= huge(1.0_wp)) return
      end do
      worst_lane = maxloc(self%error, dim=1)
   end function worst_lane

   !> The lane whose velocity decays fastest, of those whose film acts.
   integer function stiffest_lane(problem, width, step) result(lane)
      type(problem_type), intent(inout) :: problem
      integer, intent(in) :: width
      type(step_type), intent(in) :: step
      real(wp), dimension(width, 1) :: a
      real(wp), dimension(width, 1, 1) :: a_q, a_v
      real(wp) :: inlet, outlet
      integer :: closed

      call problem%history%factors(step%t1, inlet, outlet)
      call problem%lanes%linearise(1, width, inlet, outlet, step%q1, step%v1, a, a_q, a_v, closed)
      lane = minloc(a_v(:, 1, 1), dim=1)
   end function stiffest_lane

   subroutine get_reason(self, text)
      class(cash_karp), intent(in) :: self
      character(len=:), allocatable, intent(out) :: text

      associate (unused => self%next_step)
      end associate
      text = "the step became too small for the tolerance"
   end subroutine get_reason

end module rv_cash_karp
