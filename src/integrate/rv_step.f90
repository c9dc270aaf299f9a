!> One accepted step of a group of lanes: displacements, velocities and accelerations at both ends.
module rv_step
   use rv_kinds, only : wp
   use rv_dense, only : cubic, quintic
   implicit none
   private
   public :: step_type, new_step

   !> Arrays of states are (width, dofs), of the tip (width).
   type :: step_type
      integer :: width = 0
      logical, allocatable :: live(:)                          !! lanes that have not failed
      logical :: all_live = .true.
      real(wp) :: t0 = 0.0_wp, t1 = 0.0_wp                     !! the step's ends [s]
      real(wp), allocatable :: q0(:, :), v0(:, :), a0(:, :)    !! at t0
      real(wp), allocatable :: q1(:, :), v1(:, :), a1(:, :)    !! at t1
      real(wp), allocatable :: u0(:), u1(:)                    !! tip displacement at t0 and t1 [m]
      real(wp), allocatable :: w0(:), w1(:)                    !! tip velocity [m s-1]
      real(wp), allocatable, private :: tip(:)                 !! tip displacement per unit of each q, (dofs)
   contains
      procedure :: go_on
      procedure :: path
      procedure :: calm_path
      procedure :: tip_path
      procedure :: tip_accelerations
   end type step_type

contains

   !> A step of no length at t.
   pure subroutine new_step(self, t, q, v, a, tip, live)
      type(step_type), intent(out) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: q(:, :), v(:, :), a(:, :)
      real(wp), intent(in) :: tip(:)
      logical, intent(in) :: live(:)

      self%width = size(q, 1)
      self%live = live
      self%all_live = all(live)
      self%tip = tip
      self%q1 = q
      self%v1 = v
      self%a1 = a
      self%u1 = matmul(q, tip)
      self%w1 = matmul(v, tip)
      self%t0 = t
      self%t1 = t
      self%q0 = q
      self%v0 = v
      self%a0 = a
      self%u0 = self%u1
      self%w0 = self%w1
   end subroutine new_step

   !> The next step, from this one's end to a state at t, which moves in; old arrays come back.
   pure subroutine go_on(self, t, q, v, a)
      class(step_type), intent(inout) :: self
      real(wp), intent(in) :: t   !! [s]
      real(wp), allocatable, intent(inout) :: q(:, :), v(:, :), a(:, :)
      integer :: k

      self%t0 = self%t1
      self%t1 = t
      call turn(self%q0, self%q1, q)
      call turn(self%v0, self%v1, v)
      call turn(self%a0, self%a1, a)
      call exchange(self%u0, self%u1)
      call exchange(self%w0, self%w1)
      self%u1(:) = self%tip(1)*self%q1(:, 1)
      self%w1(:) = self%tip(1)*self%v1(:, 1)
      do k = 2, size(self%tip)
         self%u1(:) = self%u1 + self%tip(k)*self%q1(:, k)
         self%w1(:) = self%w1 + self%tip(k)*self%v1(:, k)
      end do
   end subroutine go_on

   pure subroutine exchange(a, b)
      real(wp), allocatable, intent(inout) :: a(:), b(:)
      real(wp), allocatable :: c(:)

      call move_alloc(a, c)
      call move_alloc(b, a)
      call move_alloc(c, b)
   end subroutine exchange

   !> The new end comes in, the old end becomes the start, and the old start comes out.
   pure subroutine turn(start, end, new)
      real(wp), allocatable, intent(inout) :: start(:, :), end(:, :), new(:, :)
      real(wp), allocatable :: spare(:, :)

      call move_alloc(start, spare)
      call move_alloc(end, start)
      call move_alloc(new, end)
      call move_alloc(spare, new)
   end subroutine turn

   !> Dense output of displacement k of lane i: coefficients of q(s), s = (t - t0)/(t1 - t0).
   pure function path(self, i, k) result(c)
      class(step_type), intent(in) :: self
      integer, intent(in) :: i, k
      real(wp) :: c(0:5)

      call quintic(self%t1 - self%t0, self%q0(i, k), self%v0(i, k), self%a0(i, k), &
         & self%q1(i, k), self%v1(i, k), self%a1(i, k), c)
   end function path

   !> Dense output without accelerations, for what follows its film: there they are the velocities' error times the
   !> film's rate of decay.
   pure function calm_path(self, i, k) result(c)
      class(step_type), intent(in) :: self
      integer, intent(in) :: i, k
      real(wp) :: c(0:5)

      call cubic(self%t1 - self%t0, self%q0(i, k), self%v0(i, k), self%q1(i, k), self%v1(i, k), c)
   end function calm_path

   !> Dense output of the tip displacement of lane i [m].
   pure function tip_path(self, i) result(c)
      class(step_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp) :: c(0:5)
      integer :: k

      c = self%tip(1)*self%path(i, 1)
      do k = 2, size(self%tip)
         c = c + self%tip(k)*self%path(i, k)
      end do
   end function tip_path

   !> Tip accelerations of some lanes at both ends of the step [m s-2].
   pure subroutine tip_accelerations(self, lane, b0, b1)
      class(step_type), intent(in) :: self
      integer, intent(in) :: lane(:)
      real(wp), intent(out) :: b0(:), b1(:)   !! (size(lane))
      integer :: k

      b0 = self%tip(1)*self%a0(lane, 1)
      b1 = self%tip(1)*self%a1(lane, 1)
      do k = 2, size(self%tip)
         b0 = b0 + self%tip(k)*self%a0(lane, k)
         b1 = b1 + self%tip(k)*self%a1(lane, k)
      end do
   end subroutine tip_accelerations

end module rv_step
