!> A_land, C_s and lowest pressure of the static shape's film, tabulated once for a planform.
!>
!> Both depend on the gap and the tip displacement through x = 1 + u/g0 = h_tip/g0 alone: A_land = A(x) and
!> C_s = mu/g0^3 / Y(x)^3, where Y is close to linear (a film of even thickness has C_s ~ h^-3). Nodes lie evenly
!> within each octave of x, four an octave; values and exact derivatives at the nodes make a cubic Hermite
!> interpolant, of fourth order: C_s lies within 3e-5 of direct solutions, A_land within 5e-6. With edge elongation
!> the table holds for one gap.
!>
!> The film's pressure above p_out is p = (p_in - p_out) P_0 - u' P_1, so that its lowest over the mesh's nodes is the
!> sum of two pressures' sizes, |p_in - p_out| and the suction (largest P_1) u', times a function of x and of the
!> first's share of the sum. That is tabulated for the tip's and the clamp's side of the hole, since the lowest place
!> jumps from one to the other, and interpolated linearly: within 0.7 % of the sum for x from 0.35 to 64, 1.5 % over
!> the whole table (6 % with edge elongation, where x < 0.01). A reed that closes draws no suction.
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
   integer, parameter :: intervals = (last_octave - first_octave + 1)*parts
   integer, parameter :: shares = 64                            !! intervals of the pressure difference's share, -1..1
   integer, parameter :: sides = 2                              !! of the hole: the tip's and the clamp's

   !> Coefficients of the cubics: value = c0 + c1 s + c2 s^2 + c3 s^3, s from 0 to 1 in the interval.
   type :: film_table
      real(wp) :: lowest = 0.0_wp                  !! smallest x of the table
      real(wp) :: most_suction = 0.0_wp            !! largest suction over C_s u' where x >= 1 [m-2]
      real(wp), private :: highest = 0.0_wp        !! largest x
      real(wp), allocatable, private :: cubic(:, :)  !! (8, intervals): of Y, then of A [m2]
      real(wp), allocatable, private :: suction(:, :)     !! largest P_1 over C_s [m-2], (sides, 0:intervals)
      real(wp), allocatable, private :: low(:, :, :)      !! lowest p over the sum [-], (0:shares, sides, 0:intervals)
   contains
      procedure :: look_up
      procedure :: look_up_all
      procedure :: lowest_pressure
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
      self%highest = 2.0_wp**(last_octave + 1)*(1.0_wp - epsilon(1.0_wp))
      allocate(self%cubic(8, intervals), self%suction(sides, 0:intervals), self%low(0:shares, sides, 0:intervals))
      call node_at(reed, gap, self%lowest, left, self%suction(:, 0), self%low(:, :, 0), error)
      if (allocated(error)) return
      k = 0
      do octave = first_octave, last_octave
         dx = 2.0_wp**octave/real(parts, wp)
         do part = 1, parts
            k = k + 1
            x0 = 2.0_wp**octave + real(part - 1, wp)*dx
            call node_at(reed, gap, x0 + dx, right, self%suction(:, k), self%low(:, :, k), error)
            if (allocated(error)) return
            self%cubic(1:4, k) = hermite(left(1), left(2)*dx, right(1), right(2)*dx)
            self%cubic(5:8, k) = hermite(left(3), left(4)*dx, right(3), right(4)*dx)
            left = right
         end do
      end do
      self%most_suction = maxval(self%suction(:, -first_octave*parts:))
   end subroutine new_film_table

   !> Y, dY/dx, A, dA/dx at one x; suction and lowest pressures.
   subroutine node_at(reed, gap, x, node, suction, low, error)
      type(film_reed), intent(in) :: reed
      real(wp), intent(in) :: gap, x
      real(wp), intent(out) :: node(4), suction(sides), low(0:, :)
      type(error_type), allocatable, intent(out) :: error
      type(film_state) :: state
      real(wp) :: slope(1, 1)
      logical :: at_tip(reed%static_film%mesh%nodes)

      node = 0.0_wp
      suction = 0.0_wp
      low = 0.0_wp
      call reed%static_film%solve(gap, 1.0_wp, [gap*(x - 1.0_wp)], state, error)
      if (allocated(error)) return
      node(1) = 1.0_wp/(state%damping(1, 1)*gap**3)**(1.0_wp/3.0_wp)
      slope = reed%static_film%force_slope(state, [1.0_wp], 0.0_wp)
      node(2) = node(1)*slope(1, 1)*gap/(3.0_wp*state%damping(1, 1))
      node(3) = state%land(1)
      slope = reed%static_film%force_slope(state, [0.0_wp], 1.0_wp)
      node(4) = slope(1, 1)*gap
      at_tip = reed%static_film%mesh%x > reed%plate%form%centre
      call lowest_of_side(state, at_tip, suction(1), low(:, 1))
      call lowest_of_side(state, .not. at_tip, suction(2), low(:, 2))
   end subroutine node_at

   !> Largest P_1 over C_s and the lowest pressures among some of the nodes.
   subroutine lowest_of_side(state, here, suction, low)
      type(film_state), intent(in) :: state
      logical, intent(in) :: here(:)           !! (nodes)
      real(wp), intent(out) :: suction, low(0:)
      real(wp) :: share, by_drop(count(here)), by_motion(count(here))
      integer :: j

      by_drop = pack(state%pressure(:, 0), here)
      by_motion = pack(state%pressure(:, 1), here)
      suction = maxval(by_motion)/state%damping(1, 1)
      by_motion = by_motion/maxval(by_motion)
      do j = 0, shares
         share = real(2*j - shares, wp)/real(shares, wp)
         low(j) = minval(share*by_drop - (1.0_wp - abs(share))*by_motion)
      end do
   end subroutine lowest_of_side

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
      real(wp) :: s, per_x
      integer(i8) :: k

      call find_interval(self%lowest, self%highest, x, k, s, per_x)
      call cubics(self%cubic(:, k), s, per_x, y, y_slope, area, area_slope)
   end subroutine look_up

   !> Both cubics of an interval, and their derivatives with respect to x.
   pure subroutine cubics(c, s, per_x, y, y_slope, area, area_slope)
      real(wp), intent(in) :: c(8), s, per_x
      real(wp), intent(out) :: y, y_slope, area, area_slope

      y = c(1) + s*(c(2) + s*(c(3) + s*c(4)))
      y_slope = (c(2) + s*(2.0_wp*c(3) + s*3.0_wp*c(4)))*per_x
      area = c(5) + s*(c(6) + s*(c(7) + s*c(8)))
      area_slope = (c(6) + s*(2.0_wp*c(7) + s*3.0_wp*c(8)))*per_x
   end subroutine cubics

   !> look_up for many x.
   pure subroutine look_up_all(self, x, y, y_slope, area, area_slope)
      class(film_table), intent(in) :: self
      real(wp), intent(in) :: x(:)
      real(wp), dimension(size(x)), intent(out) :: y, y_slope, area, area_slope

      call interpolate(size(x), self%lowest, self%highest, self%cubic, x, y, y_slope, area, area_slope)
   end subroutine look_up_all

   !> look_up of n numbers: the places in one loop of vector code, then the cubics.
   pure subroutine interpolate(n, lowest, highest, cubic, x, y, y_slope, area, area_slope)
      integer, intent(in) :: n
      real(wp), intent(in) :: lowest, highest
      real(wp), intent(in) :: cubic(8, intervals)
      real(wp), intent(in) :: x(n)
      real(wp), dimension(n), intent(out) :: y, y_slope, area, area_slope
      real(wp), dimension(n) :: s, per_x
      integer(i8) :: k(n)
      integer :: i

      do i = 1, n
         call find_interval(lowest, highest, x(i), k(i), s(i), per_x(i))
      end do
      do i = 1, n
         call cubics(cubic(:, k(i)), s(i), per_x(i), y(i), y_slope(i), area(i), area_slope(i))
      end do
   end subroutine interpolate

   !> Lowest pressure at the film's nodes, relative to p_out [Pa]. Beyond the table as look_up.
   elemental function lowest_pressure(self, x, drop, drag) result(lowest)
      class(film_table), intent(in) :: self
      real(wp), intent(in) :: x
      real(wp), intent(in) :: drop   !! p_in - p_out [Pa]
      real(wp), intent(in) :: drag   !! C_s u' [N]; closing, < 0, draws no suction
      real(wp) :: lowest
      real(wp) :: suction, total, part, s, per_x
      integer(i8) :: k
      integer :: side, j

      call find_interval(self%lowest, self%highest, x, k, s, per_x)
      lowest = huge(lowest)
      do side = 1, sides
         suction = max(0.0_wp, drag)*(self%suction(side, k - 1) + s*(self%suction(side, k) - self%suction(side, k - 1)))
         total = max(abs(drop) + suction, tiny(drop))
         part = 0.5_wp*real(shares, wp)*(drop/total + 1.0_wp)
         j = max(0, min(int(part), shares - 1))   ! whatever int makes of NaN
         part = part - real(j, wp)
         associate (low => self%low(j:j + 1, side, k - 1:k))
            lowest = min(lowest, total*((1.0_wp - s)*(low(1, 1) + part*(low(2, 1) - low(1, 1))) &
               & + s*(low(1, 2) + part*(low(2, 2) - low(1, 2)))))
         end associate
      end do
   end function lowest_pressure

   !> Interval k of x, the place s in it from 0 to 1, and ds/dx. Beyond the table the end next to x; of NaN the lowest.
   elemental subroutine find_interval(lowest, highest, x, k, s, per_x)
      real(wp), intent(in) :: lowest, highest   !! of the table
      real(wp), intent(in) :: x
      integer(i8), intent(out) :: k
      real(wp), intent(out) :: s, per_x
      integer(i8), parameter :: bias = 1023, log2_parts = 2, lowest_bits = 2_i8**(52 - log2_parts) - 1
      integer(i8), parameter :: one = transfer(1.0_wp, 0_i8)
      real(wp) :: inside
      integer(i8) :: bits

      ! 2^octave (1 + fraction): the fraction's highest bits count the parts, the others are the place within one
      inside = merge(x, lowest, x > lowest)
      inside = merge(inside, highest, inside < highest)
      bits = transfer(inside, 0_i8)
      k = shiftr(bits, 52 - log2_parts) - (bias + first_octave)*parts + 1
      s = transfer(ior(shiftl(iand(bits, lowest_bits), int(log2_parts)), one), 0.0_wp) - 1.0_wp
      per_x = transfer(shiftl(2*bias + log2_parts - shiftr(bits, 52), 52), 0.0_wp)
   end subroutine find_interval

end module rv_film_table
