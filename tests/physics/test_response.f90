!> Responses against closed forms: the linear oscillator under ramps, the overdamped film, the energy balance.
program test_response
   use rv_kinds, only : wp
   use rv_lanes, only : lane_outcome, lane_settings
   use rv_lumped, only : lumped_valve
   use rv_pressure, only : pressure_trace, new_pressure_trace, square_wave
   use rv_error, only : error_type
   use check, only : suite_type
   use paper_valve, only : run_lumped, valve_at, wave_40ms, kpa, mm, ms
   implicit none
   type(suite_type) :: suite

   call linear_oscillator()
   call stefan_closure()
   call energy_balance()
   call equilibrium_stays()
   call creeping_home()
   call suite%finish()

contains

   !> Traditional model: within ten tolerances of the exact response at all times, and its measures scale-free.
   subroutine linear_oscillator()
      type(lumped_valve) :: valve(2)
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      real(wp) :: time(401), exact(401), steady
      integer :: i

      valve = [valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0_wp), valve_at(40.0_wp*kpa, 0.05_wp*mm, 0.0_wp)]
      settings%t_end = 40.0_wp*ms
      settings%rtol = 1.0e-8_wp
      time = [(0.1_wp*ms*real(i, wp), i=0, 400)]
      call run_lumped(valve, wave_40ms(), settings, time, outcome)
      call exact_response(valve(1), time, exact)
      steady = 20.0_wp*kpa*valve(1)%area/valve(1)%stiffness
      call suite%close("steady displacement of the paper's valve at 20 kPa [mm]", outcome%measure(1, 1)/mm, &
         & 0.093316_wp, 1.0e-5_wp, 0.0_wp)
      call suite%close("largest distance to the exact response over the steady displacement", &
         & maxval(abs(outcome%trace(:, 1, 1) - exact))/steady, 0.0_wp, 0.0_wp, 10.0_wp*settings%rtol)
      call suite%close("linear: the fall time does not depend on the pressure", outcome%measure(5, 2), &
         & outcome%measure(5, 1), 1.0e-7_wp, 0.0_wp)
      call suite%close("overshoot of the exact response [mm]", outcome%measure(4, 1)/mm, &
         & (peak_of(valve(1)) - steady)/mm, 1.0e-5_wp, 0.0_wp)
   end subroutine linear_oscillator

   !> m u'' + c u' + k u = A p with p linear between the corners: exact, corner to corner.
   subroutine exact_response(valve, time, u)
      type(lumped_valve), intent(in) :: valve
      real(wp), intent(in) :: time(:)
      real(wp), intent(out) :: u(:)
      real(wp), parameter :: corner(0:5) = [0.0_wp, 0.5_wp, 19.5_wp, 20.5_wp, 39.5_wp, 40.5_wp]*ms
      real(wp), parameter :: factor(0:5) = [0.5_wp, 1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]
      real(wp) :: x, v, rate
      integer :: i, k

      do i = 1, size(time)
         x = 0.0_wp
         v = 0.0_wp
         do k = 0, 4
            if (k > 0 .and. time(i) <= corner(k)) exit
            rate = (factor(k + 1) - factor(k))/(corner(k + 1) - corner(k))
            call propagate(valve, factor(k), rate, min(time(i), corner(k + 1)) - corner(k), x, v)
         end do
         u(i) = x
      end do
   end subroutine exact_response

   !> Exact step of length dt under p = p0 (f + rate s): particular solution plus damped oscillation.
   subroutine propagate(valve, f, rate, dt, x, v)
      type(lumped_valve), intent(in) :: valve
      real(wp), intent(in) :: f, rate, dt
      real(wp), intent(inout) :: x, v
      real(wp) :: f0, f1, decay, omega, a, b, e

      f0 = valve%inlet*valve%area*f
      f1 = valve%inlet*valve%area*rate
      decay = 0.5_wp*valve%damping/valve%mass
      omega = sqrt(valve%stiffness/valve%mass - decay**2)
      a = x - f0/valve%stiffness + valve%damping*f1/valve%stiffness**2
      b = (v - f1/valve%stiffness + decay*a)/omega
      e = exp(-decay*dt)
      x = (f0 + f1*dt)/valve%stiffness - valve%damping*f1/valve%stiffness**2 &
         & + e*(a*cos(omega*dt) + b*sin(omega*dt))
      v = f1/valve%stiffness + e*((b*omega - decay*a)*cos(omega*dt) - (a*omega + decay*b)*sin(omega*dt))
   end subroutine propagate

   !> First maximum of the exact response, by golden-section search on the exact solution.
   real(wp) function peak_of(valve) result(peak)
      type(lumped_valve), intent(in) :: valve
      real(wp), parameter :: golden = 0.6180339887498949_wp
      real(wp) :: lo, hi, left(1), right(1), ul(1), ur(1)
      integer :: i

      lo = 0.5_wp*ms
      hi = 1.4_wp*ms
      do i = 1, 80
         left = hi - golden*(hi - lo)
         right = lo + golden*(hi - lo)
         call exact_response(valve, left, ul)
         call exact_response(valve, right, ur)
         if (ul(1) > ur(1)) then
            hi = right(1)
         else
            lo = left(1)
         end if
      end do
      peak = max(ul(1), ur(1))
   end function peak_of

   !> A weightless plate pressed on a film: P A = -C h'/h^3, so 1/h^2 = 1/h0^2 + 2 P A t/C.
   !>
   !> The valve's mass is made so small that its relaxation time m h^3/C is 1e-6 of the run.
   subroutine stefan_closure()
      type(lumped_valve) :: valve(1)
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      type(pressure_trace) :: history
      type(error_type), allocatable :: error
      real(wp), parameter :: gap = 0.1_wp*mm, load = 20.0_wp*kpa, t_end = 5.0_wp*ms
      real(wp) :: film, time(5)
      integer :: i

      valve = valve_at(1.0_wp, gap, 0.0075_wp)
      valve%mass = 3.0e-9_wp
      valve%damping = 0.0_wp
      valve%stiffness = 1.0e-9_wp
      valve%outlet = 1.0_wp
      call new_pressure_trace(history, [0.0_wp, t_end], [0.0_wp, 0.0_wp], [load, load], 0.0_wp, error)
      call suite%no_error("constant pressure", error)
      settings%t_end = t_end
      settings%rtol = 1.0e-8_wp
      time = [(t_end*0.2_wp*real(i, wp), i=1, 5)]
      call run_lumped(valve, history, settings, time, outcome)
      call suite%equal("the film never closes in finite time: status", outcome%status(1), 0)
      do i = 1, 5
         film = gap/sqrt(1.0_wp + 2.0_wp*load*valve(1)%area*time(i)*gap**2/valve(1)%squeeze)
         call suite%close("film thickness of the closing plate [mm]", (outcome%trace(i, 1, 1) + gap)/mm, film/mm, &
            & 1.0e-4_wp, 0.0_wp)
      end do
   end subroutine stefan_closure

   !> Kinetic + elastic energy gained = work of the pressure - loss in oil and film, over a whole cycle.
   subroutine energy_balance()
      integer, parameter :: n = 40000
      type(lumped_valve) :: valve(2)
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      real(wp) :: time(0:n), power(0:n), stored, supplied, dt
      integer :: lane, i

      valve = valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0075_wp)
      valve(2)%both_ways = .true.
      settings%t_end = 40.0_wp*ms
      settings%rtol = 1.0e-9_wp
      dt = settings%t_end/real(n, wp)
      time = [(dt*real(i, wp), i=0, n)]
      time(n) = settings%t_end
      call run_lumped(valve, wave_40ms(), settings, time, outcome)
      do lane = 1, 2
         associate (u => outcome%trace(:, 1, lane), v => outcome%trace(:, 2, lane), p => outcome%trace(:, 3, lane), &
            & force => outcome%trace(:, 5, lane))
            power = v*(p*valve(lane)%area + force - valve(lane)%damping*v)
            supplied = dt/3.0_wp*(power(0) + power(n) + 4.0_wp*sum(power(1:n - 1:2)) + 2.0_wp*sum(power(2:n - 2:2)))
            stored = 0.5_wp*(valve(lane)%mass*v(n + 1)**2 + valve(lane)%stiffness*u(n + 1)**2)
            call suite%close("energy stored less energy supplied over the work of one opening [-]", &
               & (stored - supplied)/(0.5_wp*valve(lane)%stiffness*maxval(u)**2), 0.0_wp, 0.0_wp, 1.0e-6_wp)
            call suite%true("the film never does work on the reed", all(force*v <= 0.0_wp))
         end associate
      end do
   end subroutine energy_balance

   !> From the static equilibrium nothing moves until the pressure does.
   subroutine equilibrium_stays()
      type(lumped_valve) :: valve(1)
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      type(pressure_trace) :: history
      type(error_type), allocatable :: error
      real(wp) :: p(6)

      p = [30.0_wp, 30.0_wp, 30.0_wp, 20.0_wp, 10.0_wp, 0.0_wp]*kpa
      call new_pressure_trace(history, [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp]*ms, p, 0.0_wp*p, 2.0_wp*ms, error)
      call suite%no_error("falling trace", error)
      valve = valve_at(1.0_wp, 0.05_wp*mm, 0.0075_wp)
      settings%t_end = 5.0_wp*ms
      settings%from_equilibrium = .true.
      call run_lumped(valve, history, settings, [2.0_wp*ms], outcome)
      call suite%close("displacement before the event [mm]", outcome%trace(1, 1, 1)/mm, outcome%measure(1, 1)/mm, &
         & 1.0e-3_wp*settings%rtol, 0.0_wp)
      call suite%close("no overshoot [mm]", outcome%measure(4, 1)/mm, 0.0_wp, 0.0_wp, 1.0e-3_wp*settings%rtol)
      call suite%true("no rise, no opening", all(.not. abs(outcome%measure(2:3, 1)) >= 0.0_wp))
   end subroutine equilibrium_stays

   !> A narrow gap lets the reed creep home from above: no crossing of zero, no undershoot, though rounding makes some.
   subroutine creeping_home()
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      real(wp) :: none(0)
      integer :: i

      settings%t_end = 40.0_wp*ms
      call run_lumped([(valve_at(20.0_wp*kpa, (0.04_wp + 0.01_wp*real(i, wp))*mm, 0.0075_wp), i = 1, 6)], wave_40ms(), &
         & settings, none, outcome)
      call suite%true("gaps up to 0.08 mm: the reed does not come to zero", &
         & all(.not. abs(outcome%measure(7, :4)) >= 0.0_wp) .and. all(abs(outcome%measure(8, :4)) <= 0.0_wp))
      call suite%true("gaps of 0.09 and 0.10 mm: it swings through", &
         & all(outcome%measure(7, 5:) > outcome%measure(6, 5:)) .and. all(outcome%measure(8, 5:) > 1.0e-4_wp*mm))
   end subroutine creeping_home

end program test_response
