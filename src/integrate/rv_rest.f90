!> Reeds that have come to rest: nothing is to be integrated until the pressure changes.
!>
!> Between two stops of constant pressure the motion goes to the static equilibrium. Once every lane is nearer to it
!> than a tenth of what one step may be wrong, it is put there and stays.
module rv_rest
   use rv_kinds, only : wp
   use rv_problem, only : problem_type
   use rv_step, only : step_type
   implicit none
   private
   public :: rest_type

   real(wp), parameter :: near = 0.1_wp   !! distance from rest over tolerance [-]

   type :: rest_type
      private
      real(wp) :: until = -huge(1.0_wp)      !! stop up to which `q` is known [s]
      real(wp), allocatable :: q(:, :)       !! equilibrium, (width, dofs) [m]
      logical, allocatable :: found(:)       !! (width)
   contains
      procedure :: reached
      procedure :: stay
   end type rest_type

contains

   !> Whether all lanes are at rest at the step's end, and stay there until t_stop.
   logical function reached(self, problem, step, t_stop)
      class(rest_type), intent(inout) :: self
      type(problem_type), intent(inout) :: problem
      type(step_type), intent(in) :: step
      real(wp), intent(in) :: t_stop   !! [s]
      real(wp) :: inlet, outlet

      reached = .false.
      if (.not. is_below(size(step%v1), near*problem%rtol, step%v1, problem%v_scale)) return
      if (.not. problem%history%is_constant(step%t1, t_stop)) return
      if (abs(self%until - t_stop) > 0.0_wp) then
         if (.not. allocated(self%q)) allocate(self%q, mold=step%q1)
         if (.not. allocated(self%found)) allocate(self%found(step%width))
         call problem%history%factors(t_stop, inlet, outlet)
         call problem%lanes%equilibrium(inlet, outlet, self%q, self%found)
         self%until = t_stop
      end if
      if (.not. all(self%found .or. .not. step%live)) return
      where (spread(.not. step%live, 2, size(self%q, 2))) self%q = step%q1
      reached = is_below(size(self%q), near*problem%rtol, self%q - step%q1, problem%q_scale)
   end function reached

   !> The step that stays at rest until t_stop.
   subroutine stay(self, t_stop, step)
      class(rest_type), intent(in) :: self
      real(wp), intent(in) :: t_stop   !! [s]
      type(step_type), intent(inout) :: step
      real(wp), allocatable :: q(:, :), v(:, :), a(:, :)
      real(wp) :: t
      integer :: k

      t = step%t1
      do k = 1, 2   ! the first one moves there
         q = self%q
         allocate(v, a, mold=q)
         v = 0.0_wp
         a = 0.0_wp
         call step%go_on(t, q, v, a)
         deallocate(v, a)
         t = t_stop
      end do
   end subroutine stay

   !> Whether no number is above a share of its scale; most often the first one says no.
   pure logical function is_below(n, share, x, scale)
      integer, intent(in) :: n
      real(wp), intent(in) :: share, x(n), scale(n)
      integer :: i

      is_below = .false.
      do i = 1, n
         if (.not. abs(x(i)) <= share*scale(i)) return
      end do
      is_below = .true.
   end function is_below

end module rv_rest
