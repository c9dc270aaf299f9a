!> The film models as the integrator sees them: accelerations, their derivatives, film force and rate, equilibrium,
!> silence, the closed film.
program test_film_lanes
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_film_lanes, only : film_lanes, film_traces, new_film_lanes
   use rv_film_reed, only : film_reed
   use rv_film_table, only : film_table, new_film_table
   use rv_film_valve, only : film_valve
   use rv_reynolds, only : film_state
   use rv_table_lanes, only : new_table_lanes, table_lanes
   use rv_text, only : to_text
   use rv_valve_lanes, only : valve_lanes
   use check, only : suite_type
   use paper_film, only : oil, paper_case, paper_reed, scatter
   use paper_valve, only : kpa, mm
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: gap = 0.05_wp*mm
   real(wp), parameter :: thicker(3) = [1.0_wp, 0.6_wp, 1.5_wp]   !! liquids of the lanes side by side

   call with_elongation(0.0_wp)
   call with_elongation(0.65_wp)
   call equation_of_motion()
   call table_agrees()
   call traces()
   call suite%finish()

contains

   subroutine with_elongation(beta)
      real(wp), intent(in) :: beta
      class(valve_lanes), allocatable :: lanes

      call new_film(lanes, beta)
      call check_lanes("film, elongation "//to_text(beta), lanes)
      call new_table(lanes, beta)
      call check_lanes("film_table, elongation "//to_text(beta), lanes)
   end subroutine with_elongation

   subroutine new_film(lanes, beta)
      class(valve_lanes), allocatable, intent(out) :: lanes
      real(wp), intent(in) :: beta
      type(film_lanes), allocatable :: film
      type(film_reed) :: reed
      type(film_valve) :: valve

      reed = paper_reed(4, beta)
      valve = paper_case(reed, gap, 20.0_wp*kpa)
      valve%outlet = 3.0_wp*kpa
      allocate(film)
      call new_film_lanes(film, reed, valve)
      call move_alloc(film, lanes)
   end subroutine new_film

   !> Three cases side by side; the gap is one with elongation.
   subroutine new_table(lanes, beta)
      class(valve_lanes), allocatable, intent(out) :: lanes
      real(wp), intent(in) :: beta
      type(table_lanes), allocatable :: tabled
      type(film_table) :: table
      type(film_reed) :: reed
      type(film_valve) :: valve(3)
      type(error_type), allocatable :: error
      integer :: k

      reed = paper_reed(1, beta)
      do k = 1, 3
         valve(k) = paper_case(reed, gap*merge(1.0_wp, real(k, wp), beta > 0.0_wp), 10.0_wp*kpa*real(k, wp))
         valve(k)%outlet = 1.0_wp*kpa*real(k, wp)
         valve(k)%viscosity = oil%viscosity*thicker(k)
      end do
      call new_film_table(table, reed, gap, error)
      if (allocated(error)) error stop "the paper's film table is refused"
      allocate(tabled)
      call new_table_lanes(tabled, reed, table, valve)
      call move_alloc(tabled, lanes)
   end subroutine new_table

   !> What must hold for lanes of any model with a film.
   subroutine check_lanes(name, lanes)
      character(len=*), intent(in) :: name
      class(valve_lanes), intent(inout) :: lanes

      call check_derivatives(name, lanes, 1.0e-6_wp)
      call check_film_force(name, lanes, 1.0e-6_wp)
      call check_equilibrium(name, lanes)
      call check_scales(name, lanes)
      call check_closed(name, lanes)
      call check_silence(name, lanes)
   end subroutine check_lanes

   !> Open states: lifted by -0.9 to 4.5 gaps, higher modes by a tenth of the film, up to 0.1 m/s.
   subroutine some_state(lanes, number, q, v)
      class(valve_lanes), intent(in) :: lanes
      integer, intent(in) :: number
      real(wp), intent(out) :: q(lanes%width, lanes%dofs), v(lanes%width, lanes%dofs)
      integer :: k

      q = reshape(scatter(size(q), number), shape(q))
      v = 0.1_wp*reshape(scatter(size(v), number + 500), shape(v))
      q(:, 1) = lanes%gap*(10.0_wp**(0.87_wp*q(:, 1) - 0.13_wp) - 1.0_wp)
      do k = 2, lanes%dofs
         q(:, k) = 0.1_wp*(lanes%gap + q(:, 1))*q(:, k)
      end do
   end subroutine some_state

   !> linearise gives acceleration's a, and the derivatives that central differences find, lane by lane.
   subroutine check_derivatives(name, lanes, limit)
      character(len=*), intent(in) :: name
      class(valve_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: limit
      real(wp), dimension(lanes%width, lanes%dofs) :: q, v, a, again, up, down, step
      real(wp), dimension(lanes%width, lanes%dofs, lanes%dofs) :: a_q, a_v
      real(wp) :: inlet, off(2), apart, pressure(2)
      integer :: number, k, w, closed

      off = 0.0_wp
      apart = 0.0_wp
      do number = 1, 20
         call some_state(lanes, number, q, v)
         pressure = scatter(2, number + 900)
         inlet = pressure(1)
         call lanes%linearise(1, lanes%width, inlet, pressure(2), q, v, a, a_q, a_v, closed)
         call lanes%acceleration(1, lanes%width, inlet, pressure(2), q, v, again, closed)
         apart = max(apart, maxval(abs(again - a))/maxval(abs(a)))
         do k = 1, lanes%dofs
            step = 0.0_wp
            step(:, k) = 1.0e-5_wp*(lanes%gap + q(:, 1))
            call lanes%acceleration(1, lanes%width, inlet, pressure(2), q + step, v, up, closed)
            call lanes%acceleration(1, lanes%width, inlet, pressure(2), q - step, v, down, closed)
            do w = 1, lanes%width
               off(1) = max(off(1), maxval(abs((up(w, :) - down(w, :))/(2.0_wp*step(w, k)) - a_q(w, :, k))) &
                  & /maxval(abs(a_q(w, :, :))))
            end do
            step = 0.0_wp
            step(:, k) = 0.01_wp
            call lanes%acceleration(1, lanes%width, inlet, pressure(2), q, v + step, up, closed)
            call lanes%acceleration(1, lanes%width, inlet, pressure(2), q, v - step, down, closed)
            off(2) = max(off(2), maxval(abs((up - down)/0.02_wp - a_v(:, :, k)))/maxval(abs(a_v)))
         end do
      end do
      call suite%close(name//": the two accelerations", apart, 0.0_wp, 0.0_wp, 1.0e-12_wp)
      call suite%close("da/dq against differences", off(1), 0.0_wp, 0.0_wp, limit)
      call suite%close("da/dv against differences", off(2), 0.0_wp, 0.0_wp, 1.0e-9_wp)
   end subroutine check_derivatives

   !> Its rate along a path q(t), q', q'' by central differences; positive against closing.
   subroutine check_film_force(name, lanes, limit)
      character(len=*), intent(in) :: name
      class(valve_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: limit
      real(wp), dimension(lanes%width, lanes%dofs) :: q, v, a
      real(wp) :: force(3), rate(3), dt, off
      integer :: number, w, k
      logical :: against

      off = 0.0_wp
      against = .true.
      do number = 1, 20
         call some_state(lanes, number, q, v)
         a = 1.0e3_wp*reshape(scatter(size(a), number + 700), shape(a))
         do w = 1, lanes%width
            dt = 1.0e-5_wp*(lanes%gap(w) + q(w, 1))/0.1_wp
            do k = 1, 3
               associate (t => dt*real(k - 2, wp))
                  call lanes%film_force(w, 1.0_wp, 1.0_wp, q(w, :) + t*(v(w, :) + 0.5_wp*t*a(w, :)), &
                     & v(w, :) + t*a(w, :), a(w, :), force(k), rate(k))
               end associate
            end do
            off = max(off, abs((force(3) - force(1))/(2.0_wp*dt) - rate(2)) &
               & /(abs(rate(2)) + 0.1_wp*abs(force(2))/(lanes%gap(w) + q(w, 1))))
            call lanes%film_force(w, 1.0_wp, 1.0_wp, q(w, :), -v(w, :)*[1.0_wp, spread(0.0_wp, 1, lanes%dofs - 1)], a(w, :), &
               & force(1), rate(1))
            against = against .and. force(1)*v(w, 1) > 0.0_wp
         end do
      end do
      call suite%close(name//": rate of the film force against differences", off, 0.0_wp, 0.0_wp, limit)
      call suite%true("it acts against the motion of the first shape", against)
   end subroutine check_film_force

   !> The acceleration vanishes there, next to what the pressure alone would make of it.
   subroutine check_equilibrium(name, lanes)
      character(len=*), intent(in) :: name
      class(valve_lanes), intent(inout) :: lanes
      real(wp), parameter :: inlet(3) = [1.0_wp, 0.1_wp, 25.0_wp], too_much(4) = [7.5_wp, 30.0_wp, 300.0_wp, 1.0e5_wp]
      real(wp), dimension(lanes%width, lanes%dofs) :: q, a, free
      logical :: found(lanes%width), all_found
      real(wp) :: off
      integer :: k, closed

      off = 0.0_wp
      all_found = .true.
      do k = 1, 3
         call lanes%equilibrium(inlet(k), 0.0_wp, q, found)
         all_found = all_found .and. all(found)
         call lanes%acceleration(1, lanes%width, inlet(k), 0.0_wp, q, 0.0_wp*q, a, closed)
         call lanes%acceleration(1, lanes%width, inlet(k), 0.0_wp, 0.0_wp*q, 0.0_wp*q, free, closed)
         off = max(off, maxval(abs(a)/maxval(abs(free))))
      end do
      call suite%true(name//": equilibria found", all_found)
      call suite%close("acceleration left there", off, 0.0_wp, 0.0_wp, 1.0e-10_wp)
      call lanes%equilibrium(0.0_wp, 0.0_wp, q, found)
      call suite%close("without pressure at rest on u = 0", maxval(abs(q)), 0.0_wp, 0.0_wp, 0.0_wp)
      call lanes%equilibrium(0.0_wp, 0.1_wp, q, found)
      call suite%true("a slight pressure the other way has one below u = 0", all(found) .and. all(q(:, 1) < 0.0_wp))
      associate (most => 6.5_wp*kpa/gap/maxval(lanes%outlet/lanes%gap))
         call lanes%equilibrium(0.0_wp, most, q, found)
         off = minval(matmul(q, lanes%tip)/lanes%gap)
         call suite%true("one presses a tip almost on its seat, to "//to_text(off, 3)//" gaps", all(found) .and. off > -1.0_wp &
            & .and. off < -0.85_wp)
         call lanes%acceleration(1, lanes%width, 0.0_wp, most, q, 0.0_wp*q, a, closed)
         call lanes%acceleration(1, lanes%width, 0.0_wp, most, 0.0_wp*q, 0.0_wp*q, free, closed)
         call suite%close("acceleration left there", maxval(abs(a)/maxval(abs(free))), 0.0_wp, 0.0_wp, 1.0e-10_wp)
      end associate
      do k = 1, size(too_much)
         call lanes%equilibrium(0.0_wp, too_much(k)*kpa/gap/minval(lanes%outlet/lanes%gap), q, found)
         call suite%true("a larger one closes the film: none", .not. any(found))
      end do
   end subroutine check_equilibrium

   !> Tolerances stay above zero without pressure, and follow the pressure up to a third of the gap.
   subroutine check_scales(name, lanes)
      character(len=*), intent(in) :: name
      class(valve_lanes), intent(inout) :: lanes
      real(wp), dimension(lanes%width, lanes%dofs) :: q, v, q_twice, v_twice

      call lanes%scales(spread(0.0_wp, 1, lanes%width), q, v)
      call suite%true(name//": scales without pressure above zero", all(q > 0.0_wp) .and. all(v > 0.0_wp))
      call lanes%scales(spread(1.0_wp*kpa, 1, lanes%width), q, v)
      call suite%true("velocities go with displacements by the wet frequency, 900 Hz", all(v/q > 1.0e3_wp .and. v/q < 1.0e4_wp))
      call lanes%scales(spread(2.0_wp*kpa, 1, lanes%width), q_twice, v_twice)
      call suite%close("they follow the pressure", maxval(abs(q_twice/q - 2.0_wp) + abs(v_twice/v - 2.0_wp)), 0.0_wp, 0.0_wp, &
         & 1.0e-12_wp)
      call lanes%scales(spread(1.0e6_wp*kpa, 1, lanes%width), q, v)
      call suite%close("up to a third of the gap", maxval(abs(q/spread(lanes%gap/3.0_wp, 2, lanes%dofs) - 1.0_wp)), 0.0_wp, &
         & 0.0_wp, 1.0e-12_wp)
   end subroutine check_scales

   subroutine check_closed(name, lanes)
      character(len=*), intent(in) :: name
      class(valve_lanes), intent(inout) :: lanes
      real(wp), dimension(lanes%width, lanes%dofs) :: q, a
      real(wp), dimension(lanes%width, lanes%dofs, lanes%dofs) :: a_q, a_v
      integer :: closed, w

      q = 0.0_wp
      call lanes%acceleration(1, lanes%width, 1.0_wp, 0.0_wp, q, q, a, closed)
      call suite%equal(name//": an open film", closed, 0)
      do w = lanes%width, 1, -1
         q(w, 1) = -1.01_wp*lanes%gap(w)
         call lanes%acceleration(1, lanes%width, 1.0_wp, 0.0_wp, q, 0.0_wp*q, a, closed)
         call suite%equal("lane "//to_text(w)//" the first in its seat", closed, w)
         call lanes%linearise(1, lanes%width, 1.0_wp, 0.0_wp, q, 0.0_wp*q, a, a_q, a_v, closed)
         call suite%equal("linearised", closed, w)
      end do
   end subroutine check_closed

   !> A silent lane feels nothing; its neighbours do not notice.
   subroutine check_silence(name, lanes)
      character(len=*), intent(in) :: name
      class(valve_lanes), intent(inout) :: lanes
      real(wp), dimension(lanes%width, lanes%dofs) :: q, v, a, before
      real(wp), dimension(lanes%width, lanes%dofs, lanes%dofs) :: a_q, a_v
      real(wp) :: force, rate
      logical :: found(lanes%width)
      integer :: closed, last

      last = lanes%width
      call some_state(lanes, 5, q, v)
      q(last, :) = 0.0_wp
      v(last, :) = 0.0_wp
      call lanes%acceleration(1, lanes%width, 1.0_wp, 0.0_wp, q, v, before, closed)
      call lanes%silence(last)
      call lanes%linearise(1, lanes%width, 1.0_wp, 0.0_wp, q, v, a, a_q, a_v, closed)
      call suite%equal(name//": silenced, not closed", closed, 0)
      call suite%close("no acceleration, no derivative", maxval(abs(a(last, :))) + maxval(abs(a_q(last, :, :))) &
         & + maxval(abs(a_v(last, :, :))), 0.0_wp, 0.0_wp, 0.0_wp)
      call suite%true("the others as before, but for rounding", all(abs(a(:last - 1, :) - before(:last - 1, :)) &
         & <= 8.0_wp*epsilon(1.0_wp)*abs(before(:last - 1, :))))
      call lanes%film_force(last, 1.0_wp, 1.0_wp, q(last, :), 0.1_wp + v(last, :), v(last, :), force, rate)
      call suite%true("no film to measure", .not. lanes%has_film(last) .and. abs(force) + abs(rate) <= 0.0_wp)
      call lanes%equilibrium(1.0_wp, 0.0_wp, q, found)
      call suite%true("no equilibrium", .not. found(last) .and. all(found(:last - 1)))
      q(last, 1) = -2.0_wp*gap
      call lanes%acceleration(1, lanes%width, 1.0_wp, 0.0_wp, q, v, a, closed)
      call suite%equal("no seat", closed, 0)
   end subroutine check_silence

   !> M a = drop (int_hole phi + land) - (C_a + C) v - K q, from the valve's own matrices.
   subroutine equation_of_motion()
      type(film_lanes) :: lanes
      type(film_reed) :: reed
      type(film_valve) :: valve
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: q(1, 4), v(1, 4), a(1, 4), force(4)
      integer :: closed

      reed = paper_reed(4)
      valve = paper_case(reed, gap, 20.0_wp*kpa)
      valve%outlet = 7.0_wp*kpa
      call new_film_lanes(lanes, reed, valve)
      call some_state(lanes, 3, q, v)
      call lanes%acceleration(1, lanes%width, 0.8_wp, 0.5_wp, q, v, a, closed)
      call reed%film%solve(gap, oil%viscosity, q(1, :), state, error)
      force = (0.8_wp*20.0_wp - 0.5_wp*7.0_wp)*kpa*(reed%hole + state%land) - matmul(valve%damping + state%damping, v(1, :)) &
         & - valve%stiffness*q(1, :)
      call suite%close("M a less the forces", maxval(abs(matmul(valve%mass, a(1, :)) - force))/maxval(abs(force)), 0.0_wp, &
         & 0.0_wp, 1.0e-10_wp)
   end subroutine equation_of_motion

   !> The table's lanes are the one-shape equation with the film solved in place.
   subroutine table_agrees()
      class(valve_lanes), allocatable :: lanes
      type(film_reed) :: reed
      type(film_valve) :: valve
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: q(3, 1), v(3, 1), a(3, 1), force, off
      integer :: k, closed

      call new_table(lanes, 0.0_wp)
      reed = paper_reed(1)
      off = 0.0_wp
      call some_state(lanes, 8, q, v)
      call lanes%acceleration(1, lanes%width, 1.0_wp, 0.0_wp, q, v, a, closed)
      do k = 1, 3
         valve = paper_case(reed, gap*real(k, wp), 10.0_wp*kpa*real(k, wp))
         call reed%static_film%solve(valve%gap, oil%viscosity*thicker(k), q(k, :), state, error)
         force = valve%inlet*(reed%static_hole + state%land(1)) - valve%static_stiffness*q(k, 1) &
            & - (valve%static_damping + state%damping(1, 1))*v(k, 1)
         off = max(off, abs(a(k, 1)*(valve%static_mass + valve%static_added_mass)/force - 1.0_wp))
      end do
      call suite%close("film_table against the film solved in place", off, 0.0_wp, 0.0_wp, 1.0e-4_wp)
   end subroutine table_agrees

   !> Displacement, velocity, pressures; parts A, B and C; volume balance; NaN where the film is closed.
   subroutine traces()
      class(valve_lanes), allocatable :: lanes
      real(wp) :: value(film_traces), rest(film_traces), q(4), v(4), force, rate

      call new_film(lanes, 0.0_wp)
      q = [1.5_wp, 0.1_wp, 0.0_wp, 0.0_wp]*gap
      v = [-0.02_wp, 0.001_wp, 0.0_wp, 0.0_wp]
      call suite%equal("values of a sample", lanes%traces, film_traces)
      call lanes%trace_values(1, 0.5_wp, 1.0_wp, q, v, value)
      call suite%close("tip displacement [mm]", value(1)/mm, 0.08_wp, 1.0e-14_wp, 0.0_wp)
      call suite%close("tip velocity [m/s]", value(2), -0.019_wp, 1.0e-14_wp, 0.0_wp)
      call suite%close("inlet [kPa]", value(3)/kpa, 10.0_wp, 1.0e-14_wp, 0.0_wp)
      call suite%close("outlet [kPa]", value(4)/kpa, 3.0_wp, 1.0e-14_wp, 0.0_wp)
      call suite%close("part C [N]", value(8), 7.0_wp*kpa*12.566370614359172_wp*mm**2, 1.0e-12_wp, 0.0_wp)
      call suite%true("closing: parts A and B press, the film force too", all(value(5:7) > 0.0_wp))
      call suite%close("lowest film pressure: the outlet's [kPa]", value(10)/kpa, 3.0_wp, 1.0e-12_wp, 0.0_wp)
      call lanes%trace_values(1, 0.5_wp, 1.0_wp, q, -v, value)
      call suite%true("opening as fast: it sucks, below the outlet's pressure", value(5) < 0.0_wp .and. value(10) < 3.0_wp*kpa)
      call lanes%film_force(1, 0.5_wp, 1.0_wp, q, -v, 0.0_wp*v, force, rate)
      call suite%close("the lowest pressure is kept [kPa]", lanes%lowest_pressure(1)/kpa, value(10)/kpa, 1.0e-12_wp, 0.0_wp)
      call lanes%film_force(1, 0.5_wp, 1.0_wp, q, v, 0.0_wp*v, force, rate)
      call suite%close("whatever comes later [kPa]", lanes%lowest_pressure(1)/kpa, value(10)/kpa, 1.0e-12_wp, 0.0_wp)
      call lanes%trace_values(1, 0.5_wp, 1.0_wp, q, 0.0_wp*v, value)
      call lanes%trace_values(1, 1.0_wp, 2.0_wp, q, 0.0_wp*v, rest)
      call suite%close("flow and land forces follow the pressure difference", maxval(abs(rest(6:9)/value(6:9) - 2.0_wp)), &
         & 0.0_wp, 0.0_wp, 1.0e-12_wp)
      call lanes%trace_values(1, 0.5_wp, 1.0_wp, -1.01_wp*[gap, 0.0_wp, 0.0_wp, 0.0_wp], v, value)
      call suite%true("closed: what needs a film is NaN", all(ieee_is_nan(value(5:))) .and. .not. any(ieee_is_nan(value(:4))))
   end subroutine traces

end program test_film_lanes
