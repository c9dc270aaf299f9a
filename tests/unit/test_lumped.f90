!> The lumped models: forces against their terms, Jacobian against differences, the switch, lanes that do not mix.
program test_lumped
   use rv_kinds, only : wp
   use rv_lumped, only : lumped_valve, lumped_lanes, new_lumped_lanes, squeeze_coefficient
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   integer, parameter :: n_states = 60
   real(wp), parameter :: some_ulp = 16.0_wp*epsilon(1.0_wp)
   real(wp), parameter :: inlet = 0.75_wp, outlet = 1.0_wp   !! factors of the pressure history
   type(lumped_valve) :: valve(n_states)   !! one third each: closing only, both ways, no film
   logical :: suite_agrees = .true.        !! acceleration and linearise gave the same accelerations so far
   real(wp) :: u(n_states), v(n_states)    !! half of them near the seat, half of them closing

   call spread_states()
   call test_squeeze_coefficient()
   call test_equilibrium()
   call test_acceleration()
   call test_jacobian()
   call test_film()
   call test_power()
   call test_switch()
   call test_traditional()
   call test_lanes_apart()
   call test_silence()
   call test_force_rate()
   call suite%true("both ways to the acceleration agree", suite_agrees)
   call suite%finish()

contains

   !> A valve like the paper's, 20 kPa.
   pure function paper_valve() result(one)
      type(lumped_valve) :: one

      one = lumped_valve(mass=1.15e-4_wp, damping=0.269_wp, stiffness=2691.9_wp, area=12.56e-6_wp, &
         & squeeze=5.88e-13_wp, gap=5.0e-5_wp, both_ways=.false., inlet=20.0e3_wp, outlet=0.0_wp)
   end function paper_valve

   !> Valves and states scattered evenly (multiples of irrational numbers), the same on every machine: film thickness
   !> from 1e-3 g0 to 3 g0, speed from 1e-6 to 1 m/s.
   subroutine spread_states()
      real(wp) :: r(4)
      integer :: n

      do n = 1, n_states
         r = real(n, wp)*[0.6180339887498949_wp, 0.4142135623730951_wp, 0.7320508075688772_wp, 0.2360679774997898_wp]
         r = modulo(r, 1.0_wp)
         valve(n) = paper_valve()
         valve(n)%mass = valve(n)%mass*(0.5_wp + r(3))
         valve(n)%damping = valve(n)%damping*2.0_wp*r(4)
         valve(n)%inlet = 40.0e3_wp*r(4)
         valve(n)%outlet = 10.0e3_wp*(r(3) - 0.5_wp)
         valve(n)%both_ways = mod(n, 3) == 1
         if (mod(n, 3) == 2) valve(n)%squeeze = 0.0_wp
         u(n) = valve(n)%gap*(merge(10.0_wp**(-3.0_wp*r(1)), 3.0_wp*r(1) + 0.001_wp, mod(n, 4) < 2) - 1.0_wp)
         v(n) = merge(-1.0_wp, 1.0_wp, mod(n, 2) == 0)*10.0_wp**(-6.0_wp*r(2))
      end do
   end subroutine spread_states

   !> PAPER's value, and 2 k_s times the integral of the pressure (25) over the half width: a parabola, exact with
   !> Simpson.
   subroutine test_squeeze_coefficient()
      real(wp), parameter :: k_s = 0.008_wp, mu = 0.0484_wp, l = 7.5e-3_wp, b = 6.0e-3_wp
      real(wp), parameter :: y(3) = [0.0_wp, 0.25_wp, 0.5_wp]*b
      real(wp) :: pressure(3)

      call suite%close("C for k_s = 0.008 [N s m2]", squeeze_coefficient(k_s, mu, l, b), 6.27264e-13_wp, &
         & rtol=some_ulp, atol=0.0_wp)
      pressure = 6.0_wp*mu*(0.25_wp*b**2 - y**2)   ! at u'/h^3 = 1
      call suite%close("C as an integral of the pressure [N s m2]", squeeze_coefficient(k_s, mu, l, b), &
         & 2.0_wp*k_s*l*sum([1.0_wp, 4.0_wp, 1.0_wp]*pressure)*0.5_wp*b/6.0_wp, rtol=some_ulp, atol=0.0_wp)
   end subroutine test_squeeze_coefficient

   !> The steady displacement of the paper at 20 kPa, and no acceleration there.
   subroutine test_equilibrium()
      type(lumped_valve) :: one
      type(lumped_lanes) :: lanes
      real(wp) :: a(1)

      one = paper_valve()
      one%stiffness = 2691.932270916335_wp
      call suite%close("steady displacement at 20 kPa [m]", equilibrium(one, 1.0_wp, 1.0_wp), 0.093316e-3_wp, &
         & rtol=0.0_wp, atol=0.5e-9_wp)
      one%outlet = 5.0e3_wp
      call suite%close("both pressures count [m]", equilibrium(one, 0.5_wp, 0.25_wp), &
         & (10.0e3_wp - 1.25e3_wp)*12.56e-6_wp/one%stiffness, rtol=some_ulp, atol=0.0_wp)
      call new_lumped_lanes(lanes, [one])
      call acceleration(lanes, 0.5_wp, 0.25_wp, [equilibrium(one, 0.5_wp, 0.25_wp)], [0.0_wp], a)
      call suite%close("no acceleration at equilibrium [m/s2]", a(1), 0.0_wp, rtol=0.0_wp, &
         & atol=some_ulp*10.0e3_wp*one%area/one%mass)
   end subroutine test_equilibrium

   !> Eq. (15) term by term.
   subroutine test_acceleration()
      type(lumped_lanes) :: lanes
      real(wp) :: a(n_states)
      integer :: n

      call new_lumped_lanes(lanes, valve)
      call acceleration(lanes, inlet, outlet, u, v, a)
      do n = 1, n_states
         call suite%close("acceleration, "//state(n)//" [m/s2]", a(n), &
            & (pressure_force(n) - valve(n)%stiffness*u(n) - valve(n)%damping*v(n) - film(n)*v(n))/valve(n)%mass, &
            & rtol=some_ulp, atol=some_ulp*size_of_terms(n))
      end do
   end subroutine test_acceleration

   !> Central differences. Along u the step is epsilon**(1/3) = 6e-6 of the film: the difference's own error is
   !> (10/3) step^2 = 1.3e-10 of the film's part, below sqrt(epsilon). Along v the force is straight on each side of the
   !> switch. Rounding: epsilon times the terms over the step.
   subroutine test_jacobian()
      type(lumped_lanes) :: lanes
      real(wp) :: a_u(n_states), a_v(n_states), step(n_states), ahead(n_states), behind(n_states)
      integer :: n

      call new_lumped_lanes(lanes, valve)
      call jacobian(lanes, u, v, a_u, a_v)
      step = epsilon(1.0_wp)**(1.0_wp/3.0_wp)*(u + valve%gap)
      call acceleration(lanes, inlet, outlet, u + step, v, ahead)
      call acceleration(lanes, inlet, outlet, u - step, v, behind)
      do n = 1, n_states
         call suite%close("da/du, "//state(n)//" [s-2]", a_u(n), (ahead(n) - behind(n))/(2.0_wp*step(n)), &
            & rtol=sqrt(epsilon(1.0_wp)), atol=4.0_wp*epsilon(1.0_wp)*size_of_terms(n)/step(n))
      end do
      step = epsilon(1.0_wp)**(1.0_wp/3.0_wp)*abs(v)
      call acceleration(lanes, inlet, outlet, u, v + step, ahead)
      call acceleration(lanes, inlet, outlet, u, v - step, behind)
      do n = 1, n_states
         call suite%close("da/dv, "//state(n)//" [s-1]", a_v(n), (ahead(n) - behind(n))/(2.0_wp*step(n)), &
            & rtol=sqrt(epsilon(1.0_wp)), atol=4.0_wp*epsilon(1.0_wp)*size_of_terms(n)/step(n))
      end do
   end subroutine test_jacobian

   !> Closing: the film pushes the reed open, with C |v|/h^3. Opening: nothing, or the same pull when it acts both ways.
   subroutine test_film()
      type(lumped_lanes) :: lanes
      real(wp) :: force(n_states), thick(1), thin(1)
      integer :: n

      call new_lumped_lanes(lanes, valve)
      call film_force(lanes, u, v, force)
      do n = 1, n_states
         call suite%close("film force, "//state(n)//" [N]", force(n), -film(n)*v(n), rtol=some_ulp, atol=0.0_wp)
      end do
      call suite%true("every closing film pushes the reed open", &
         & all(force > 0.0_wp .or. v > 0.0_wp .or. valve%squeeze <= 0.0_wp))
      call suite%true("a film that acts both ways holds the opening reed back", &
         & all(force < 0.0_wp .or. v < 0.0_wp .or. .not. valve%both_ways))
      call suite%true("a film that acts while closing lets the reed open", &
         & all(abs(force) <= 0.0_wp .or. v < 0.0_wp .or. valve%both_ways))
      call new_lumped_lanes(lanes, [paper_valve()])
      call film_force(lanes, [0.0_wp], [-0.01_wp], thick)
      call film_force(lanes, [-2.5e-5_wp], [-0.01_wp], thin)
      call suite%close("half the film, eight times the force [N]", thin(1), 8.0_wp*thick(1), rtol=some_ulp, atol=0.0_wp)
   end subroutine test_film

   !> Power: d/dt (m v^2/2 + k u^2/2) = pressure work - damping + film work, and the film never gives energy.
   subroutine test_power()
      type(lumped_lanes) :: lanes
      real(wp) :: a(n_states), force(n_states)
      integer :: n

      call new_lumped_lanes(lanes, valve)
      call acceleration(lanes, inlet, outlet, u, v, a)
      call film_force(lanes, u, v, force)
      do n = 1, n_states
         call suite%close("power, "//state(n)//" [W]", (valve(n)%mass*a(n) + valve(n)%stiffness*u(n))*v(n), &
            & (pressure_force(n) - valve(n)%damping*v(n) + force(n))*v(n), &
            & rtol=some_ulp, atol=some_ulp*size_of_terms(n)*valve(n)%mass*abs(v(n)))
      end do
      call suite%true("the film never gives energy", all(force*v <= 0.0_wp))
      call suite%true("and takes some from every closing reed", &
         & all(force*v < 0.0_wp .or. v > 0.0_wp .or. valve%squeeze <= 0.0_wp))
   end subroutine test_power

   !> At v = 0 the force is continuous and zero; the slope jumps by the film's and is the closing side's at the switch.
   subroutine test_switch()
      type(lumped_lanes) :: lanes
      real(wp), dimension(n_states) :: zero, before, after, at, force, slope_before, slope_after, slope_at, unused
      real(wp) :: jump
      integer :: n

      zero = 0.0_wp
      call new_lumped_lanes(lanes, valve)
      call acceleration(lanes, inlet, outlet, u, zero, at)
      call acceleration(lanes, inlet, outlet, u, zero - tiny(1.0_wp), before)
      call acceleration(lanes, inlet, outlet, u, zero + tiny(1.0_wp), after)
      call film_force(lanes, u, zero, force)
      call suite%true("no film force at v = 0", all(abs(force) <= 0.0_wp))
      call suite%true("acceleration continuous at v = 0", &
         & all(abs(before - at) <= some_ulp*abs(at)) .and. all(abs(after - at) <= some_ulp*abs(at)))
      call jacobian(lanes, u, zero, unused, slope_at)
      call jacobian(lanes, u, zero - tiny(1.0_wp), unused, slope_before)
      call jacobian(lanes, u, zero + tiny(1.0_wp), unused, slope_after)
      do n = 1, n_states
         jump = valve(n)%squeeze/(u(n) + valve(n)%gap)**3/valve(n)%mass
         if (valve(n)%both_ways) jump = 0.0_wp
         call suite%close("da/dv at the switch, lane "//to_text(n), slope_at(n), slope_before(n), rtol=0.0_wp, &
            & atol=0.0_wp)
         call suite%close("jump of da/dv at the switch, lane "//to_text(n), slope_after(n) - slope_before(n), jump, &
            & rtol=some_ulp, atol=some_ulp*abs(slope_before(n)))
      end do
   end subroutine test_switch

   !> The traditional model is the squeeze model with C = 0: the limit of a weak film, and nothing happens at the seat.
   subroutine test_traditional()
      type(lumped_lanes) :: plain, weak
      type(lumped_valve) :: without(n_states)
      real(wp) :: a_plain(n_states), a_weak(n_states), a_u(n_states), a_v(n_states)

      without = valve
      without%squeeze = 0.0_wp
      call new_lumped_lanes(plain, without)
      call acceleration(plain, inlet, outlet, u, v, a_plain)
      call jacobian(plain, u, v, a_u, a_v)
      without%squeeze = 1.0e-40_wp
      call new_lumped_lanes(weak, without)
      call acceleration(weak, inlet, outlet, u, v, a_weak)
      call suite%true("a vanishing film is none", all(abs(a_weak - a_plain) <= some_ulp*abs(a_plain)))
      call suite%true("traditional da/du = -k/m", &
         & all(abs(a_u + valve%stiffness/valve%mass) <= some_ulp*valve%stiffness/valve%mass))
      call suite%true("traditional da/dv = -c/m", &
         & all(abs(a_v + valve%damping/valve%mass) <= some_ulp*valve%damping/valve%mass))
      call acceleration(plain, inlet, outlet, -valve%gap, v, a_plain)
      call acceleration(plain, inlet, outlet, -2.0_wp*valve%gap, v, a_weak)
      call suite%true("traditional: through the seat with the spring alone", &
         & all(abs(a_weak - a_plain - valve%stiffness*valve%gap/valve%mass) <= some_ulp*(abs(a_weak) + abs(a_plain))))
   end subroutine test_traditional

   !> A case gives the same bits alone, among others, and in another place among them.
   subroutine test_lanes_apart()
      type(lumped_lanes) :: all_lanes, turned, alone
      real(wp), dimension(n_states) :: a, a_u, a_v, force, other, other_u, other_v, other_force
      real(wp), dimension(1) :: one, one_u, one_v, one_force
      logical :: same
      integer :: n

      call new_lumped_lanes(all_lanes, valve)
      call suite%equal("lanes", all_lanes%width, n_states)
      call acceleration(all_lanes, inlet, outlet, u, v, a)
      call jacobian(all_lanes, u, v, a_u, a_v)
      call film_force(all_lanes, u, v, force)
      call new_lumped_lanes(turned, cshift(valve, 7))
      call acceleration(turned, inlet, outlet, cshift(u, 7), cshift(v, 7), other)
      call jacobian(turned, cshift(u, 7), cshift(v, 7), other_u, other_v)
      call film_force(turned, cshift(u, 7), cshift(v, 7), other_force)
      call suite%true("lanes in another order, same bits", same_bits(cshift(a, 7), other) .and. &
         & same_bits(cshift(a_u, 7), other_u) .and. same_bits(cshift(a_v, 7), other_v) .and. &
         & same_bits(cshift(force, 7), other_force))
      same = .true.
      do n = 1, n_states
         call new_lumped_lanes(alone, valve(n:n))
         call acceleration(alone, inlet, outlet, u(n:n), v(n:n), one)
         call jacobian(alone, u(n:n), v(n:n), one_u, one_v)
         call film_force(alone, u(n:n), v(n:n), one_force)
         same = same .and. same_bits([one, one_u, one_v, one_force], [a(n), a_u(n), a_v(n), force(n)])
      end do
      call suite%true("each lane alone, same bits", same)
   end subroutine test_lanes_apart

   !> A silenced lane feels no force, at rest or not; its neighbours feel nothing of it.
   subroutine test_silence()
      type(lumped_lanes) :: lanes
      real(wp), dimension(n_states) :: a, a_u, a_v, force, quiet, quiet_u, quiet_v, quiet_force
      logical :: others(n_states)

      call new_lumped_lanes(lanes, valve)
      call acceleration(lanes, inlet, outlet, u, v, a)
      call jacobian(lanes, u, v, a_u, a_v)
      call film_force(lanes, u, v, force)
      call lanes%silence(4)
      others = .true.
      others(4) = .false.
      call acceleration(lanes, inlet, outlet, merge(u, 0.0_wp, others), merge(v, 0.0_wp, others), quiet)
      call suite%close("silent lane at rest [m/s2]", quiet(4), 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call acceleration(lanes, inlet, outlet, u, v, quiet)
      call jacobian(lanes, u, v, quiet_u, quiet_v)
      call film_force(lanes, u, v, quiet_force)
      call suite%true("the lane was not silent before", abs(a(4)) > 0.0_wp .and. abs(force(4)) > 0.0_wp)
      call suite%close("silent lane: acceleration [m/s2]", quiet(4), 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("silent lane: da/du [s-2]", quiet_u(4), 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("silent lane: da/dv [s-1]", quiet_v(4), 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("silent lane: film force [N]", quiet_force(4), 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%true("the others go on as before", same_bits(pack(a, others), pack(quiet, others)) .and. &
         & same_bits(pack(a_u, others), pack(quiet_u, others)) .and. &
         & same_bits(pack(a_v, others), pack(quiet_v, others)) .and. &
         & same_bits(pack(force, others), pack(quiet_force, others)))
   end subroutine test_silence

   !> The force's rate against differences along a path u(t), v(t), a(t).
   subroutine test_force_rate()
      type(lumped_lanes) :: lanes
      real(wp) :: force, rate, ahead, behind, unused, dt, a
      integer :: n

      call new_lumped_lanes(lanes, valve)
      do n = 1, n_states
         a = 10.0_wp*v(n)/1.0e-3_wp
         dt = 1.0e-6_wp*min(1.0e-3_wp, (u(n) + valve(n)%gap)/abs(v(n)))
         call lanes%film_force(n, inlet, outlet, u(n:n), v(n:n), [a], force, rate)
         call lanes%film_force(n, inlet, outlet, [u(n) + v(n)*dt], [v(n) + a*dt], [a], ahead, unused)
         call lanes%film_force(n, inlet, outlet, [u(n) - v(n)*dt], [v(n) - a*dt], [a], behind, unused)
         call suite%close("rate of the film force, "//state(n)//" [N/s]", rate, (ahead - behind)/(2.0_wp*dt), &
            & rtol=1.0e-6_wp, atol=1.0e-9_wp*abs(force)/dt)
      end do
   end subroutine test_force_rate

   ! The lanes' interface with one degree of freedom, seen as plain arrays.

   subroutine acceleration(lanes, inlet, outlet, u, v, a)
      type(lumped_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: inlet, outlet, u(:), v(:)
      real(wp), intent(out) :: a(:)
      real(wp), dimension(size(u), 1) :: a_out, a_again
      real(wp), dimension(size(u), 1, 1) :: a_u, a_v
      integer :: closed

      call lanes%acceleration(1, lanes%width, inlet, outlet, as_state(u), as_state(v), a_out, closed)
      call lanes%linearise(1, lanes%width, inlet, outlet, as_state(u), as_state(v), a_again, a_u, a_v, closed)
      suite_agrees = suite_agrees .and. all(abs(a_out - a_again) <= 1.0e-9_wp*(abs(a_out) + 1.0_wp) .or. closed > 0)
      a = a_out(:, 1)
   end subroutine acceleration

   subroutine jacobian(lanes, u, v, a_u, a_v)
      type(lumped_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: u(:), v(:)
      real(wp), intent(out) :: a_u(:), a_v(:)
      real(wp) :: a(size(u), 1), slope_u(size(u), 1, 1), slope_v(size(u), 1, 1)
      integer :: closed

      call lanes%linearise(1, lanes%width, inlet, outlet, as_state(u), as_state(v), a, slope_u, slope_v, closed)
      a_u = slope_u(:, 1, 1)
      a_v = slope_v(:, 1, 1)
   end subroutine jacobian

   subroutine film_force(lanes, u, v, force)
      type(lumped_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: u(:), v(:)
      real(wp), intent(out) :: force(:)
      real(wp) :: rate
      integer :: n

      do n = 1, size(u)
         call lanes%film_force(n, inlet, outlet, u(n:n), v(n:n), [0.0_wp], force(n), rate)
      end do
   end subroutine film_force

   real(wp) function equilibrium(one, inlet, outlet)
      type(lumped_valve), intent(in) :: one
      real(wp), intent(in) :: inlet, outlet
      type(lumped_lanes) :: lanes
      real(wp) :: q(1, 1)
      logical :: found(1)

      call new_lumped_lanes(lanes, [one])
      call lanes%equilibrium(inlet, outlet, q, found)
      equilibrium = q(1, 1)
   end function equilibrium

   pure function as_state(x) result(state)
      real(wp), intent(in) :: x(:)
      real(wp) :: state(size(x), 1)

      state(:, 1) = x
   end function as_state

   pure logical function same_bits(x, y)
      real(wp), intent(in) :: x(:), y(:)

      same_bits = all(abs(x - y) <= 0.0_wp)
   end function same_bits

   !> C/h^3 where the film acts [N s/m].
   real(wp) function film(n)
      integer, intent(in) :: n

      film = 0.0_wp
      if (v(n) < 0.0_wp .or. valve(n)%both_ways) film = valve(n)%squeeze/(u(n) + valve(n)%gap)**3
   end function film

   real(wp) function pressure_force(n)
      integer, intent(in) :: n

      pressure_force = (valve(n)%inlet*inlet - valve(n)%outlet*outlet)*valve(n)%area
   end function pressure_force

   !> Sum of the terms' sizes over the mass [m/s2]: rounding is some epsilon of it.
   real(wp) function size_of_terms(n)
      integer, intent(in) :: n

      size_of_terms = ((abs(valve(n)%inlet*inlet) + abs(valve(n)%outlet*outlet))*valve(n)%area &
         & + valve(n)%stiffness*abs(u(n)) + valve(n)%damping*abs(v(n)) + film(n)*abs(v(n)))/valve(n)%mass
   end function size_of_terms

   function state(n) result(text)
      integer, intent(in) :: n
      character(len=:), allocatable :: text

      text = "lane "//to_text(n)//", h = "//to_text(u(n) + valve(n)%gap, 3)//" m, v = "//to_text(v(n), 3)//" m/s"
   end function state

end program test_lumped
