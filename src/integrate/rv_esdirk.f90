!> The implicit method: ARKODE, with error weights, stages and right-hand side from here.
module rv_esdirk
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_f_pointer, c_funloc, c_int, c_loc, c_null_char, c_null_ptr, &
      & c_ptr
   use rv_kinds, only : wp, i8
   use rv_arkode, only : rv_arkode_new, rv_arkode_step, rv_arkode_restart, rv_arkode_fix_step, &
      & rv_arkode_worst_lane, rv_arkode_free, get_arkode_message, rv_at_stop
   use rv_integrator, only : integrator_type, step_at_stop, step_done, step_failed, step_not_finite
   use rv_problem, only : problem_type
   use rv_stage, only : solve_stage, stage_guess
   use rv_step, only : step_type
   implicit none
   private
   public :: esdirk, new_esdirk

   !> Butcher table: fifth order, stiffly accurate, L-stable (Kennedy & Carpenter 2019, doi:10.1016/j.apnum.2019.07.008).
   !> Not its relatives ESDIRK547L2SA and ESDIRK436L2SA: they have a stage behind the end of the step, which at a corner
   !> of the pressure sees what comes after it and costs them their order (2 in place of 5). The longer steps of
   !> ARK548L2SA would leave the dense output less accurate than the steps.
   character(kind=c_char, len=*), parameter :: table = "ARKODE_ESDIRK547L2SA2_7_4_5"//c_null_char

   !> What ARKODE's callbacks see.
   type :: stage_problem
      type(problem_type), pointer :: problem => null()
      type(stage_guess) :: guess
      real(wp), allocatable :: v_weight(:, :)   !! last error weights of v, (width, dofs)
   end type stage_problem

   type, extends(integrator_type) :: esdirk
      private
      type(c_ptr) :: arkode = c_null_ptr
      type(stage_problem), pointer :: stages => null()
      real(wp), allocatable :: q(:, :), v(:, :), a(:, :)   !! at the end of a step, (width, dofs)
   contains
      procedure :: take_step
      procedure :: restart
      procedure :: worst_lane
      procedure :: get_reason
      final :: free
   end type esdirk

contains

   !> Make ready for a problem, which must outlive this, at the step's end.
   subroutine new_esdirk(self, problem, step, first_step, fixed_step, flag)
      type(esdirk), intent(inout) :: self
      type(problem_type), intent(in), target :: problem
      type(step_type), intent(in) :: step
      real(wp), intent(in) :: first_step   !! to try [s], > 0
      real(wp), intent(in) :: fixed_step   !! [s]; > 0: all steps are of this length
      integer, intent(out) :: flag
      integer(c_int) :: answer

      allocate(self%stages)
      self%stages%problem => problem
      self%stages%v_weight = 1.0_wp/(problem%rtol*problem%v_scale)
      call self%stages%guess%begin(step%t1, step%a1)
      allocate(self%q, self%v, self%a, mold=problem%q_scale)
      answer = rv_arkode_new(int(problem%lanes%width, c_int), int(2*problem%lanes%dofs, c_int), step%t1, step%q1, step%v1, &
         & table, first_step, c_funloc(rhs), c_funloc(stage), c_funloc(weights), c_loc(self%stages), self%arkode)
      if (answer >= 0 .and. fixed_step > 0.0_wp) answer = rv_arkode_fix_step(self%arkode, fixed_step)
      flag = merge(step_done, step_failed, answer >= 0)
   end subroutine new_esdirk

   subroutine take_step(self, problem, t_stop, step, flag)
      class(esdirk), intent(inout) :: self
      type(problem_type), intent(inout), target :: problem
      real(wp), intent(in) :: t_stop
      type(step_type), intent(inout) :: step
      integer, intent(out) :: flag
      real(c_double) :: t
      real(wp) :: inlet, outlet
      integer(c_int) :: answer
      integer :: closed

      t = step%t1
      answer = rv_arkode_step(self%arkode, t_stop, t, self%q, self%v)
      flag = step_failed
      if (answer < 0) return
      flag = step_not_finite
      problem%failed = first_not_finite(problem%lanes%width, size(self%q), self%q, self%v)
      if (problem%failed > 0) return
      flag = step_done
      if (answer == rv_at_stop) then
         t = t_stop
         flag = step_at_stop
      end if
      call problem%history%factors(t, inlet, outlet)
      call problem%lanes%acceleration(1, problem%lanes%width, inlet, outlet, self%q, self%v, self%a, closed)
      call step%go_on(t, self%q, self%v, self%a)
   end subroutine take_step

   !> The first lane with a number that is not finite, or 0; in a loop that vectors can do.
   pure integer function first_not_finite(width, n, q, v) result(lane)
      integer, intent(in) :: width, n
      real(wp), intent(in) :: q(n), v(n)
      integer(i8) :: some
      integer :: i

      some = 0_i8
      do i = 1, n
         some = ior(some, merge(0_i8, 1_i8, abs(q(i)) <= huge(q)))
         some = ior(some, merge(0_i8, 1_i8, abs(v(i)) <= huge(v)))
      end do
      lane = 0
      if (some == 0_i8) return
      do lane = 1, width
         if (.not. (all(abs(q(lane::width)) <= huge(q)) .and. all(abs(v(lane::width)) <= huge(v)))) return
      end do
   end function first_not_finite

   subroutine restart(self, problem, step, flag)
      class(esdirk), intent(inout) :: self
      type(problem_type), intent(inout), target :: problem
      type(step_type), intent(in) :: step
      integer, intent(out) :: flag

      associate (unused => problem%rtol)
      end associate
      call self%stages%guess%begin(step%t1, step%a1)
      flag = merge(step_done, step_failed, rv_arkode_restart(self%arkode, step%t1, step%q1, step%v1) >= 0)
   end subroutine restart

   integer function worst_lane(self, problem, step)
      class(esdirk), intent(in) :: self
      type(problem_type), intent(inout) :: problem
      type(step_type), intent(in) :: step

      associate (unused => [problem%rtol, step%t1])
      end associate
      worst_lane = rv_arkode_worst_lane(self%arkode) + 1
   end function worst_lane

   subroutine get_reason(self, text)
      class(esdirk), intent(in) :: self
      character(len=:), allocatable, intent(out) :: text

      call get_arkode_message(self%arkode, text)
   end subroutine get_reason

   impure elemental subroutine free(self)
      type(esdirk), intent(inout) :: self

      call rv_arkode_free(self%arkode)
      if (associated(self%stages)) deallocate(self%stages)
   end subroutine free

   !> ARKODE's right-hand side. 1 where a film is closed: ARKODE then tries a smaller step.
   integer(c_int) function rhs(t, y, ydot, data) bind(C)
      real(c_double), value :: t
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(inout) :: ydot(*)
      type(c_ptr), value :: data
      type(stage_problem), pointer :: self
      real(wp) :: inlet, outlet
      integer :: closed

      call c_f_pointer(data, self)
      associate (problem => self%problem, n => size(self%v_weight))
         call problem%history%factors(t, inlet, outlet)
         call problem%lanes%acceleration(1, problem%lanes%width, inlet, outlet, y(:n), y(n + 1:2*n), ydot(n + 1:2*n), closed)
         ydot(:n) = y(n + 1:2*n)
         rhs = 0
         if (closed == 0) return
         problem%failed = closed
         problem%hindrance = closed
         problem%closed = .true.
         rhs = 1
      end associate
   end function rhs

   !> ARKODE's stage. 1 where a lane has no solution.
   integer(c_int) function stage(t, gamma, predicted, known, correction, data) bind(C)
      real(c_double), value :: t, gamma
      real(c_double), intent(in) :: predicted(*), known(*)
      real(c_double), intent(inout) :: correction(*)
      type(c_ptr), value :: data
      type(stage_problem), pointer :: self
      real(wp) :: inlet, outlet

      call c_f_pointer(data, self)
      associate (problem => self%problem, n => size(self%v_weight))
         call problem%history%factors(t, inlet, outlet)
         call solve_stage(problem%lanes, t, inlet, outlet, gamma, predicted(:n), predicted(n + 1:2*n), known(:n), &
            & known(n + 1:2*n), self%v_weight, self%guess, correction(:n), correction(n + 1:2*n), &
            & problem%failed, problem%closed)
         if (problem%failed > 0) problem%hindrance = problem%failed
         stage = merge(0_c_int, 1_c_int, problem%failed == 0)
      end associate
   end function stage

   !> ARKODE's error weights: one over rtol (|y| + scale).
   integer(c_int) function weights(y, weight, data) bind(C)
      real(c_double), intent(in) :: y(*)
      real(c_double), intent(inout) :: weight(*)
      type(c_ptr), value :: data
      type(stage_problem), pointer :: self

      call c_f_pointer(data, self)
      associate (problem => self%problem, n => size(self%v_weight))
         call weigh(n, problem%rtol, problem%q_scale, y(:n), weight(:n))
         call weigh(n, problem%rtol, problem%v_scale, y(n + 1:2*n), weight(n + 1:2*n))
         call keep(n, weight(n + 1:2*n), self%v_weight)
      end associate
      weights = 0
   end function weights

   pure subroutine weigh(n, rtol, scale, y, weight)
      integer, intent(in) :: n
      real(wp), intent(in) :: rtol, scale(n), y(n)
      real(wp), intent(out) :: weight(n)

      weight = 1.0_wp/(rtol*(abs(y) + scale))
   end subroutine weigh

   pure subroutine keep(n, weight, kept)
      integer, intent(in) :: n
      real(wp), intent(in) :: weight(n)
      real(wp), intent(out) :: kept(n)

      kept = weight
   end subroutine keep

end module rv_esdirk
