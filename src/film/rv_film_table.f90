!> A_land and C_s of the static shape, tabulated once for a planform.
!>
!> Both depend on the gap and the tip displacement through x = 1 + u/g0 = h_tip/g0 alone: A_land = A(x) and
!> C_s = mu/g0^3 / Y(x)^3, where Y is close to linear (a film of even thickness has C_s ~ h^-3). Nodes lie evenly
!> within each octave of x, four an octave; values and exact derivatives at the nodes make a cubic Hermite
!> interpolant, of fourth order: C_s lies within 3e-5 of direct solutions, A_land within 5e-6. With edge elongation
!> the table holds for one gap.
module rv_film_table
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_film_reed, only : film_reed
   use rv_reynolds, only : film_state
   implicit none
   private
   public :: film_table, new_film_table

   integer, parameter :: first_octave = -10, last_octave = 15   !! x from 1e-3 to 3e4
   integer, parameter :: parts = 4                              !! intervals an octave

   !> Coefficients of the cubics: value = c0 + c1 s + c2 s^2 + c3 s^3, s from 0 to 1 in the interval.
   type :: film_table
      real(wp) :: lowest = 0.0_wp                  !! smallest x of the table
      real(wp), private :: highest = 0.0_wp
      real(wp), allocatable, private :: cubic(:, :)  !! (8, intervals): of Y, then of A [m2]
   contains
      procedure :: look_up
   end type film_table

contains

   !> Tabulate. `gap` matters only with edge elongation.
   subroutine new_film_table(self, reed, gap, error)
      type(film_table), intent(out) :: self
      type(film_reed), intent(in) :: reed
      real(wp), intent(in) :: gap      !! g0 [m], > 0
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: left(4), right(4), x0, dx
      integer :: octave, part, k

      self%lowest = 2.0_wp**first_octave
      self%highest = 2.0_wp**(last_octave + 1)
      allocate(self%cubic(8, (last_octave - first_octave + 1)*parts))
      call node_at(reed, gap, self%lowest, left, error)
      if (allocated(error)) return
      k = 0
      do octave = first_octave, last_octave
         dx = 2.0_wp**octave/real(parts, wp)
         do part = 1, parts
            k = k + 1
            x0 = 2.0_wp**octave + real(part - 1, wp)*dx
            call node_at(reed, gap, x0 + dx, right, error)
            if (allocated(error)) return
            self%cubic(1:4, k) = hermite(left(1), left(2)*dx, right(1), right(2)*dx)
            self%cubic(5:8, k) = hermite(left(3), left(4)*dx, right(3), right(4)*dx)
            left = right
         end do
      end do
   end subroutine new_film_table

   !> Y, dY/dx, A, dA/dx at one x.
   subroutine node_at(reed, gap, x, node, error)
      type(film_reed), intent(in) :: reed
      real(wp), intent(in) :: gap, x
      real(wp), intent(out) :: node(4)
      type(error_type), allocatable, intent(out) :: error
      type(film_state) :: state
      real(wp) :: slope(1, 1)

      node = 0.0_wp
      call reed%static_film%solve(gap, 1.0_wp, [gap*(x - 1.0_wp)], state, error)
      if (allocated(error)) return
      node(1) = 1.0_wp/(state%damping(1, 1)*gap**3)**(1.0_wp/3.0_wp)
      slope = reed%static_film%force_slope(state, [1.0_wp], 0.0_wp)
      node(2) = node(1)*slope(1, 1)*gap/(3.0_wp*state%damping(1, 1))
      node(3) = state%land(1)
      slope = reed%static_film%force_slope(state, [0.0_wp], 1.0_wp)
      node(4) = slope(1, 1)*gap
   end subroutine node_at

   !> Cubic on 0..1 with values and slopes given at the ends.
   pure function hermite(y0, d0, y1, d1) result(c)
      real(wp), intent(in) :: y0, d0, y1, d1
      real(wp) :: c(4)

      c = [y0, d0, 3.0_wp*(y1 - y0) - 2.0_wp*d0 - d1, 2.0_wp*(y0 - y1) + d0 + d1]
   end function hermite

   !> Values at x: y = Y and area = A with their derivatives. Beyond the table its ends are used.
   elemental subroutine look_up(self, x, y, y_slope, area, area_slope)
      class(film_table), intent(in) :: self
      real(wp), intent(in) :: x
      real(wp), intent(out) :: y, y_slope         !! [m-1], per unit of x
      real(wp), intent(out) :: area, area_slope   !! [m2]
      real(wp) :: inside, s, per_x
      integer :: octave, part, k

      inside = merge(min(x, self%highest*(1.0_wp - epsilon(x))), self%lowest, x > self%lowest)   ! NaN: lowest
      octave = int(ibits(transfer(inside, 0_i8), 52, 11)) - 1023   ! inside = 2^octave (1 + fraction)
      per_x = real(parts, wp)/2.0_wp**octave
      s = inside*per_x - real(parts, wp)
      part = int(s)
      s = s - real(part, wp)
      k = (octave - first_octave)*parts + part + 1
      associate (c => self%cubic)
         y = c(1, k) + s*(c(2, k) + s*(c(3, k) + s*c(4, k)))
         y_slope = (c(2, k) + s*(2.0_wp*c(3, k) + s*3.0_wp*c(4, k)))*per_x
         area = c(5, k) + s*(c(6, k) + s*(c(7, k) + s*c(8, k)))
         area_slope = (c(6, k) + s*(2.0_wp*c(7, k) + s*3.0_wp*c(8, k)))*per_x
      end associate
   end subroutine look_up

end module rv_film_table
