!> One accepted step of a group of lanes: tip displacement, velocity and acceleration at both ends.
module rv_step
   use rv_kinds, only : wp
   use rv_dense, only : quintic
   implicit none
   private
   public :: step_type, new_step

   !> All arrays are (width).
   type :: step_type
      integer :: width = 0
      real(wp) :: t0 = 0.0_wp, t1 = 0.0_wp                 !! the step's ends [s]
      real(wp), allocatable :: u0(:), v0(:), a0(:)         !! at t0 [m], [m s-1], [m s-2]
      real(wp), allocatable :: u1(:), v1(:), a1(:)         !! at t1
   contains
      procedure :: path
      procedure :: advance
   end type step_type

contains

   !> A step of no length at t.
   pure subroutine new_step(self, t, u, v, a)
      type(step_type), intent(out) :: self
      real(wp), intent(in) :: t
      real(wp), intent(in) :: u(:), v(:), a(:)

      self%width = size(u)
      self%t0 = t
      self%t1 = t
      self%u0 = u
      self%v0 = v
      self%a0 = a
      self%u1 = u
      self%v1 = v
      self%a1 = a
   end subroutine new_step

   !> Let the next step begin where this one ended.
   pure subroutine advance(self)
      class(step_type), intent(inout) :: self

      self%t0 = self%t1
      self%u0(:) = self%u1
      self%v0(:) = self%v1
      self%a0(:) = self%a1
   end subroutine advance

   !> Dense output of lane i: coefficients of u(s), s = (t - t0)/(t1 - t0).
   pure function path(self, i) result(c)
      class(step_type), intent(in) :: self
      integer, intent(in) :: i
      real(wp) :: c(0:5)   !! [m]

      c = quintic(self%t1 - self%t0, self%u0(i), self%v0(i), self%a0(i), self%u1(i), self%v1(i), self%a1(i))
   end function path

end module rv_step
