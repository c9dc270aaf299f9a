!> The stage equations: solved to tolerance from any state, each lane on its own, and what has no solution is named.
program test_stage
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_positive_inf, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_lumped, only : lumped_lanes, lumped_valve, new_lumped_lanes
   use rv_stage, only : solve_stage, stage_guess
   use rv_text, only : to_text
   use check, only : suite_type
   use rv_valve_lanes, only : valve_lanes
   use spring_lanes, only : spring_valve, new_spring_valve
   implicit none
   type(suite_type) :: suite
   integer, parameter :: n = 2000                              !! lanes of the scattered cases
   real(wp), parameter :: rtol = 1.0e-8_wp, inlet = 0.8_wp, outlet = 1.0_wp
   real(wp), parameter :: some_ulp = 8.0_wp*epsilon(1.0_wp)

   call scattered_lumped()
   call company()
   call without_film()
   call film_too_thin()
   call lane_without_solution()
   call endless_demands()
   call linear_systems(2)
   call linear_systems(3)
   call system_as_scalar()
   call many_predictions_beyond_the_seat()
   call system_without_solution()
   call suite%finish()

contains

   !> A stage from a prediction of v, in the state at the step's start q = v = 0.
   subroutine solve(lanes, inlet, outlet, gamma, base_q, base_v, weight, q, v, failed, closed)
      class(valve_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: inlet, outlet, gamma
      real(wp), dimension(lanes%width, lanes%dofs), intent(in) :: base_q, base_v, weight
      real(wp), dimension(lanes%width, lanes%dofs), intent(inout) :: q, v
      integer, intent(out) :: failed
      logical, intent(out) :: closed
      type(stage_guess) :: guess
      real(wp) :: at_rest(lanes%width, lanes%dofs)

      at_rest = 0.0_wp
      call guess%begin(0.0_wp, (v - base_v)/gamma)
      call solve_stage(lanes, 0.0_wp, inlet, outlet, gamma, at_rest, at_rest, base_q, base_v, weight, guess, q, v, failed, closed)
   end subroutine solve

   !> The paper's valve with everything spread: film at rest 1 um to 1 mm, base of the stage from a millionth of that
   !> film to ten times it, speed 1e-6 to 10 m/s both ways, pressure to 1 MPa.
   subroutine scatter(valve, q, v)
      type(lumped_valve), intent(out) :: valve(n)
      real(wp), intent(out) :: q(n, 1), v(n, 1)
      real(wp) :: r(6)
      integer :: i

      do i = 1, n
         r = modulo(real(i, wp)*[0.6180339887498949_wp, 0.4142135623730951_wp, 0.7320508075688772_wp, 0.2360679774997898_wp, &
            & 0.6457513110645906_wp, 0.3166247903553998_wp], 1.0_wp)
         valve(i) = lumped_valve(mass=1.15e-4_wp*(0.1_wp + r(1)), damping=0.5_wp*r(2), stiffness=2691.9_wp*(0.1_wp + r(3)), &
            & area=12.56e-6_wp, squeeze=5.9e-13_wp*10.0_wp**(2.0_wp*r(4) - 1.0_wp), gap=1.0e-6_wp*10.0_wp**(3.0_wp*r(5)), &
            & inlet=1.0e6_wp*r(6)**3, outlet=2.0e5_wp*(r(1) - 0.5_wp))
         q(i, 1) = valve(i)%gap*(10.0_wp**(7.0_wp*modulo(11.0_wp*r(2), 1.0_wp) - 6.0_wp) - 1.0_wp)
         v(i, 1) = sign(10.0_wp**(7.0_wp*modulo(11.0_wp*r(4), 1.0_wp) - 6.0_wp), r(6) - 0.7_wp)
      end do
   end subroutine scatter

   !> Over ten decades of gamma every lane's velocity is within rtol of the stage's only root.
   subroutine scattered_lumped()
      type(lumped_valve) :: valve(n)
      type(lumped_lanes) :: lanes
      real(wp), dimension(n, 1) :: base_q, base_v, weight, q, v
      real(wp) :: gamma
      integer :: failed, decade, i
      logical :: closed

      call scatter(valve, base_q, base_v)
      call new_lumped_lanes(lanes, valve)
      weight = 1.0_wp/(rtol*(abs(base_v) + 1.0e-3_wp))
      do decade = -12, -2
         gamma = 3.0_wp*10.0_wp**decade
         v = base_v
         q = base_q
         call solve(lanes, inlet, outlet, gamma, base_q, base_v, weight, q, v, failed, closed)
         call suite%true("gamma = "//to_text(gamma, 1)//" s: every lane has a solution", failed == 0 .and. .not. closed)
         call suite%equal("lanes further than 0.04 of rtol from their root", &
            & count([(.not. has_root(valve(i), gamma, base_q(i, 1), base_v(i, 1), v(i, 1), 0.04_wp/weight(i, 1)), i=1, n)]), 0)
         call suite%true("q follows v", all(abs(q - (base_q + gamma*v)) <= some_ulp*(abs(base_q) + abs(gamma*v))))
         call suite%true("every film is open", all(q(:, 1) + valve%gap > 0.0_wp))
      end do
   end subroutine scattered_lumped

   !> Whether the rising function g(v) = v - base_v - gamma a(base_q + gamma v, v) changes sign within `near` of v,
   !> as far as its rounding lets one see.
   pure logical function has_root(valve, gamma, base_q, base_v, v, near)
      type(lumped_valve), intent(in) :: valve
      real(wp), intent(in) :: gamma, base_q, base_v, v, near
      real(wp) :: below, above, noise_below, noise_above

      call residual(valve, gamma, base_q, base_v, v - near, below, noise_below)
      call residual(valve, gamma, base_q, base_v, v + near, above, noise_above)
      has_root = below <= noise_below .and. above >= -noise_above
   end function has_root

   !> g(v), written out anew, and the size of its rounding. Minus infinity at and beyond the seat.
   pure subroutine residual(valve, gamma, base_q, base_v, v, g, noise)
      type(lumped_valve), intent(in) :: valve
      real(wp), intent(in) :: gamma, base_q, base_v, v
      real(wp), intent(out) :: g, noise
      real(wp) :: h, force(5), u

      u = base_q + gamma*v
      h = u + valve%gap
      noise = 0.0_wp
      g = -huge(1.0_wp)
      if (.not. h > 0.0_wp) return
      force = [valve%inlet*inlet*valve%area, -valve%outlet*outlet*valve%area, -valve%stiffness*u, -valve%damping*v, &
         & -valve%squeeze*min(v, 0.0_wp)/h**3]
      g = v - base_v - gamma*sum(force)/valve%mass
      ! h is known to rounding of its terms only, and the film's force follows its cube
      noise = some_ulp*(abs(v) + abs(base_v) + gamma*sum(abs(force))/valve%mass &
         & + 3.0_wp*gamma*abs(force(5))/valve%mass*(abs(base_q) + abs(gamma*v) + valve%gap)/h)
   end subroutine residual

   !> A lane's solution does not depend on its company beyond its tolerance, nor does its place matter more.
   subroutine company()
      type(lumped_valve) :: valve(n)
      type(lumped_lanes) :: lanes
      real(wp), dimension(n, 1) :: base_q, base_v, weight, q, v
      real(wp), dimension(n) :: turned_q, turned_v
      real(wp), parameter :: gamma = 1.0e-5_wp
      real(wp) :: worst
      integer :: failed, i
      logical :: closed

      call scatter(valve, base_q, base_v)
      weight = 1.0_wp/(rtol*(abs(base_v) + 1.0e-3_wp))
      call new_lumped_lanes(lanes, valve)
      q = base_q
      v = base_v
      call solve(lanes, inlet, outlet, gamma, base_q, base_v, weight, q, v, failed, closed)
      call new_lumped_lanes(lanes, valve(n:1:-1))
      turned_q = base_q(n:1:-1, 1)
      turned_v = base_v(n:1:-1, 1)
      call solve(lanes, inlet, outlet, gamma, base_q(n:1:-1, :), base_v(n:1:-1, :), weight(n:1:-1, :), turned_q, turned_v, &
         & failed, closed)
      call suite%close("in any order: distance over rtol", maxval(abs(turned_v(n:1:-1) - v(:, 1))*weight(:, 1)), 0.0_wp, &
         & 0.0_wp, 0.01_wp)
      worst = 0.0_wp
      do i = 1, n, 17
         call new_lumped_lanes(lanes, valve(i:i))
         turned_q(1) = base_q(i, 1)
         turned_v(1) = base_v(i, 1)
         call solve(lanes, inlet, outlet, gamma, base_q(i:i, :), base_v(i:i, :), weight(i:i, :), turned_q(1:1), &
            & turned_v(1:1), failed, closed)
         worst = max(worst, abs(turned_v(1) - v(i, 1))*weight(i, 1))
      end do
      call suite%close("alone and in company: distance over rtol", worst, 0.0_wp, 0.0_wp, 0.04_wp)
   end subroutine company

   !> Without film the equation is linear: solved at once, to rounding.
   subroutine without_film()
      type(lumped_valve) :: valve(1)
      type(lumped_lanes) :: lanes
      real(wp), dimension(1, 1) :: q, v
      real(wp), parameter :: gamma = 2.0e-4_wp, base_q = -3.0e-4_wp, base_v = 0.2_wp
      integer :: failed
      logical :: closed

      valve(1) = lumped_valve(mass=1.0e-4_wp, damping=0.3_wp, stiffness=2500.0_wp, area=1.0e-5_wp, inlet=3.0e4_wp)
      call new_lumped_lanes(lanes, valve)
      q = base_q
      v = base_v
      call solve(lanes, inlet, outlet, gamma, reshape([base_q], [1, 1]), reshape([base_v], [1, 1]), &
         & reshape([1.0e6_wp], [1, 1]), q, v, failed, closed)
      call suite%close("velocity without film", v(1, 1), (base_v + gamma/1.0e-4_wp*(0.3_wp*inlet - 2500.0_wp*base_q)) &
         & /(1.0_wp + gamma/1.0e-4_wp*(0.3_wp + gamma*2500.0_wp)), 2.0_wp*some_ulp, 0.0_wp)
      call suite%true("far below where a film would be", failed == 0 .and. q(1, 1) < 0.0_wp)
   end subroutine without_film

   !> A film so weak that it yields down to the rounding of u: the reed is on its seat. The lane is named.
   subroutine film_too_thin()
      type(lumped_valve) :: valve(5)
      type(lumped_lanes) :: lanes
      real(wp), dimension(5, 1) :: base_q, base_v, q, v
      integer :: failed
      logical :: closed

      valve = lumped_valve(mass=1.0e-4_wp, damping=0.3_wp, stiffness=2500.0_wp, area=1.0e-5_wp, squeeze=5.9e-13_wp, gap=5.0e-5_wp, &
         & outlet=1.0e5_wp)
      valve(4)%squeeze = 1.0e-75_wp
      call new_lumped_lanes(lanes, valve)
      base_q = 1.0e-5_wp
      base_v = -0.1_wp
      q = base_q
      v = base_v
      call solve(lanes, inlet, outlet, 1.0e-3_wp, base_q, base_v, 1.0e6_wp + 0.0_wp*base_v, q, v, failed, closed)
      call suite%equal("lane whose film closes", failed, 4)
      call suite%true("it closes", closed)
   end subroutine film_too_thin

   !> Data that are not numbers: the first such lane is named, and its film did not close.
   subroutine lane_without_solution()
      type(lumped_valve) :: valve(5)
      type(lumped_lanes) :: lanes
      real(wp), dimension(5, 1) :: base_q, base_v, q, v
      integer :: failed
      logical :: closed

      valve = lumped_valve(mass=1.0e-4_wp, damping=0.3_wp, stiffness=2500.0_wp, area=1.0e-5_wp, squeeze=5.9e-13_wp, gap=5.0e-5_wp)
      valve(3)%damping = ieee_value(1.0_wp, ieee_quiet_nan)
      valve(5)%inlet = ieee_value(1.0_wp, ieee_quiet_nan)
      call new_lumped_lanes(lanes, valve)
      base_q = 1.0e-5_wp
      base_v = -0.1_wp
      q = base_q
      v = base_v
      call solve(lanes, inlet, outlet, 1.0e-5_wp, base_q, base_v, 1.0e6_wp + 0.0_wp*base_v, q, v, failed, closed)
      call suite%equal("first lane without a solution", failed, 3)
      call suite%true("its film is not to blame", .not. closed)
      call new_lumped_lanes(lanes, valve(5:5))
      call solve(lanes, inlet, outlet, 1.0e-5_wp, base_q(5:5, :), base_v(5:5, :), 1.0e6_wp + 0.0_wp*base_v(5:5, :), &
         & q(5:5, :), v(5:5, :), failed, closed)
      call suite%equal("alone it is the first", failed, 1)
      call suite%true("its film is not to blame either", .not. closed)
   end subroutine lane_without_solution

   !> Without any allowed error no iteration ends well: the lane that asks for it is named.
   subroutine endless_demands()
      type(lumped_valve) :: valve(3)
      type(lumped_lanes) :: lanes
      type(spring_valve) :: springs
      real(wp), dimension(3, 1) :: q, v, weight
      real(wp), dimension(3, 2) :: base_q, base_v, weights, q2, v2
      integer :: failed
      logical :: closed

      valve = lumped_valve(mass=1.0e-4_wp, damping=0.3_wp, stiffness=2500.0_wp, area=1.0e-5_wp, inlet=2.0e4_wp)
      call new_lumped_lanes(lanes, valve)
      q = 0.0_wp
      v = 0.0_wp
      weight(:, 1) = [1.0_wp, ieee_value(1.0_wp, ieee_positive_inf), 1.0_wp]
      call solve(lanes, inlet, outlet, 1.0e-5_wp, 0.0_wp*q, 0.0_wp*q, weight, q, v, failed, closed)
      call suite%equal("lane that is never exact enough", failed, 2)
      weight = weight([2, 1, 3], :)
      call solve(lanes, inlet, outlet, 1.0e-5_wp, 0.0_wp*q, 0.0_wp*q, weight, q, v, failed, closed)
      call suite%equal("the first lane, likewise", failed, 1)
      call suite%true("no film is to blame", .not. closed)
      call some_springs(springs, 3, 2, base_q, base_v)
      q2 = base_q
      v2 = base_v
      weights = 1.0_wp
      weights(3, 2) = weight(1, 1)
      call solve(springs, inlet, outlet, 1.0e-2_wp, base_q, base_v, weights, q2, v2, failed, closed)
      call suite%equal("nor is a lane of two degrees of freedom with one exact enough", failed, 3)
      call suite%true("nor is its film to blame", .not. closed)
   end subroutine endless_demands

   !> Coupled springs and dampers of several degrees of freedom: Newton's first correction is the direct solution.
   subroutine linear_systems(dofs)
      integer, intent(in) :: dofs
      integer, parameter :: width = 7
      type(spring_valve) :: lanes
      real(wp), dimension(width, dofs) :: base_q, base_v, q, v
      real(wp) :: matrix(dofs, dofs), rhs(dofs), worst, gamma
      integer :: failed, i, decade
      logical :: closed

      call some_springs(lanes, width, dofs, base_q, base_v)
      worst = 0.0_wp
      do decade = -8, -1
         gamma = 10.0_wp**decade
         q = base_q
         v = 0.7_wp*base_v
         call solve(lanes, inlet, outlet, gamma, base_q, base_v, 1.0e9_wp + 0.0_wp*base_v, q, v, failed, closed)
         if (failed > 0) worst = huge(1.0_wp)
         do i = 1, width
            matrix = gamma*(lanes%damping(i, :, :) + gamma*lanes%stiffness(i, :, :))
            rhs = base_v(i, :) + gamma*(lanes%load(i, :)*lanes%inlet(i)*inlet - matmul(lanes%stiffness(i, :, :), base_q(i, :)))
            call eliminate(matrix, rhs)
            worst = max(worst, maxval(abs(v(i, :) - rhs))/maxval(abs(rhs)))
            worst = max(worst, maxval(abs(q(i, :) - base_q(i, :) - gamma*v(i, :)))/maxval(abs(base_q(i, :))))
         end do
      end do
      call suite%close(to_text(dofs)//" degrees of freedom: distance to the direct solution", worst, 0.0_wp, 0.0_wp, 1.0e-12_wp)
      call suite%true("in two rounds", lanes%calls <= 16)
   end subroutine linear_systems

   !> Unsymmetric, so that rows and columns cannot be mistaken; different in every lane.
   subroutine some_springs(lanes, width, dofs, base_q, base_v)
      type(spring_valve), intent(out) :: lanes
      integer, intent(in) :: width, dofs
      real(wp), intent(out) :: base_q(width, dofs), base_v(width, dofs)
      integer :: i, j, k

      call new_spring_valve(lanes, width, dofs)
      do i = 1, width
         lanes%inlet(i) = real(i, wp)
         do j = 1, dofs
            lanes%load(i, j) = real(10*j - 3*i, wp)
            base_q(i, j) = 0.1_wp*real(i + 2*j, wp)
            base_v(i, j) = real(j - i, wp) + 0.5_wp
            do k = 1, dofs
               lanes%stiffness(i, j, k) = real(5*i + 3*j - k, wp)
               lanes%damping(i, j, k) = real(i - j + 4*k, wp)
            end do
            lanes%stiffness(i, j, j) = lanes%stiffness(i, j, j) + 400.0_wp
            lanes%damping(i, j, j) = lanes%damping(i, j, j) + 20.0_wp
         end do
      end do
   end subroutine some_springs

   !> Solve (1 + matrix) x = rhs by Gauss' elimination; the diagonal is large.
   pure subroutine eliminate(matrix, rhs)
      real(wp), intent(inout) :: matrix(:, :), rhs(:)
      integer :: j, k

      do j = 1, size(rhs)
         matrix(j, j) = 1.0_wp + matrix(j, j)
      end do
      do j = 1, size(rhs)
         do k = 1, size(rhs)
            if (k == j) cycle
            rhs(k) = rhs(k) - matrix(k, j)/matrix(j, j)*rhs(j)
            matrix(k, :) = matrix(k, :) - matrix(k, j)/matrix(j, j)*matrix(j, :)
         end do
      end do
      rhs = [(rhs(j)/matrix(j, j), j=1, size(rhs))]
   end subroutine eliminate

   !> A film under the tip of two equal displacements, each half of it: the system's root is the lumped model's.
   subroutine system_as_scalar()
      integer, parameter :: width = 60
      type(spring_valve) :: lanes
      type(lumped_valve) :: valve(width)
      type(lumped_lanes) :: lumped
      real(wp), dimension(width, 2) :: base_q, base_v, weight, q, v
      real(wp), dimension(width, 1) :: u, w
      real(wp) :: gamma, r(3)
      integer :: failed, i, decade
      logical :: closed

      call new_spring_valve(lanes, width, 2)
      do i = 1, width
         r = modulo(real(i, wp)*[0.6180339887498949_wp, 0.4142135623730951_wp, 0.7320508075688772_wp], 1.0_wp)
         valve(i) = lumped_valve(mass=1.0_wp, damping=2.0e3_wp, stiffness=2.5e7_wp, area=1.0_wp, squeeze=1.0e-8_wp, &
            & gap=5.0e-5_wp, both_ways=.true., inlet=-2.0e3_wp*r(1))
         base_q(i, :) = 0.5_wp*valve(i)%gap*(10.0_wp**(-2.0_wp*r(2)) - 1.0_wp)
         base_v(i, :) = -0.1_wp*r(3)
         lanes%stiffness(i, :, :) = 0.5_wp*valve(i)%stiffness   ! of the sum, shared by the two
         lanes%damping(i, :, :) = 0.5_wp*valve(i)%damping
         lanes%load(i, :) = 0.5_wp*valve(i)%inlet
         lanes%squeeze(i) = 0.5_wp*valve(i)%squeeze
         lanes%gap(i) = valve(i)%gap
      end do
      call new_lumped_lanes(lumped, valve)
      weight = 1.0_wp/(rtol*(abs(base_v) + 1.0e-3_wp))
      do decade = -9, -6
         gamma = 10.0_wp**decade
         v = base_v
         q = base_q
         call solve(lanes, inlet, outlet, gamma, base_q, base_v, weight, q, v, failed, closed)
         call suite%true("gamma = "//to_text(gamma, 1)//" s: the system is solved", failed == 0)
         w = reshape(sum(base_v, 2), [width, 1])
         u = w
         call solve(lumped, inlet, outlet, gamma, reshape(sum(base_q, 2), [width, 1]), reshape(sum(base_v, 2), [width, 1]), &
            & weight(:, 1:1), u, w, failed, closed)
         call suite%close("its sum is the lumped reed's velocity, over rtol", maxval(abs(sum(v, 2) - w(:, 1))*weight(:, 1)), &
            & 0.0_wp, 0.0_wp, 1.0e-3_wp)
         v = base_v
         call solve(lanes, inlet, outlet, gamma, base_q, base_v, 1.0e-6_wp*weight, q, v, failed, closed)
         call suite%true("q follows v, however rough", all(abs(q - (base_q + gamma*v)) &
            & <= some_ulp*(abs(base_q) + abs(gamma*v))))
      end do
   end subroutine system_as_scalar

   !> The prediction of every lane of a wide group lies beyond the seat: each is led back, none at another's cost.
   subroutine many_predictions_beyond_the_seat()
      integer, parameter :: width = 50
      real(wp), parameter :: gamma = 1.0e-5_wp
      type(spring_valve) :: lanes
      real(wp), dimension(width, 2) :: base_q, base_v, q, v
      integer :: failed
      logical :: closed

      call new_spring_valve(lanes, width, 2)
      lanes%gap = 1.0e-4_wp
      lanes%squeeze = 1.0e-8_wp
      base_q = -1.0e-5_wp
      base_v = -1.0e-3_wp
      q = base_q
      v = -100.0_wp
      call solve(lanes, inlet, outlet, gamma, base_q, base_v, 1.0e9_wp + 0.0_wp*base_v, q, v, failed, closed)
      call suite%equal("lane without a solution among 50", failed, 0)
      call suite%true("all films stay open", all(sum(q, 2) + lanes%gap > 0.0_wp))
   end subroutine many_predictions_beyond_the_seat

   !> A singular matrix, and a base that lies on the seat already.
   subroutine system_without_solution()
      integer, parameter :: width = 4
      type(spring_valve) :: lanes
      real(wp), dimension(width, 2) :: base_q, base_v, q, v
      integer :: failed
      logical :: closed

      call some_springs(lanes, width, 2, base_q, base_v)
      lanes%damping(3, :, :) = 0.0_wp
      lanes%stiffness(3, :, :) = -2.0_wp   ! 1 + gamma^2 K = 1 - 1/2 (1 1; 1 1)
      q = base_q
      v = base_v
      call solve(lanes, inlet, outlet, 0.5_wp, base_q, base_v, 1.0e6_wp + 0.0_wp*base_v, q, v, failed, closed)
      call suite%equal("lane with a singular matrix", failed, 3)
      call suite%true("its film is not to blame", .not. closed)

      call some_springs(lanes, width, 2, base_q, base_v)
      lanes%gap(2) = -sum(base_q(2, :)) - 1.0e-3_wp
      q = base_q
      v = base_v
      call solve(lanes, inlet, outlet, 1.0e-12_wp, base_q, base_v, 1.0e6_wp + 0.0_wp*base_v, q, v, failed, closed)
      call suite%equal("lane on its seat", failed, 2)
      call suite%true("it is closed", closed)
   end subroutine system_without_solution

end program test_stage
