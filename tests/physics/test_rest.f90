!> Reeds at rest: they are left there until the pressure changes, and nothing else is taken for rest.
program test_rest
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_lanes, only : lane_outcome, lane_settings, method_explicit, method_implicit
   use rv_lumped, only : lumped_lanes, lumped_valve, new_lumped_lanes
   use rv_pressure, only : pressure_trace, square_wave, new_pressure_trace, new_square_wave
   use rv_problem, only : problem_type, pose
   use rv_rest, only : rest_type
   use rv_status, only : status_ok
   use rv_step, only : step_type, new_step
   use rv_valve_lanes, only : valve_lanes
   use check, only : suite_type
   use paper_valve, only : run_lumped, valve_at, kpa, mm, ms
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: rtol = 1.0e-5_wp, period = 400.0_wp*ms, k_s = 0.0075_wp
   integer, parameter :: method(2) = [method_implicit, method_explicit]
   character(len=*), parameter :: name(2) = ["implicit", "explicit"]
   integer :: m

   call conditions()
   do m = 1, 2
      call long_plateaus()
      call slow_trace()
   end do
   call suite%finish()

contains

   !> Plateaus ten times as long cost no step more, and the reed lies on its equilibrium through them. A noise of the
   !> step control, as explicit methods at the end of their stability have it, would stay as large as the tolerance.
   subroutine long_plateaus()
      type(lane_outcome) :: short, long
      type(lumped_valve) :: valve(2)
      real(wp) :: steady(2), off

      valve = [valve_at(20.0_wp*kpa, 0.1_wp*mm, k_s), valve_at(10.0_wp*kpa, 0.2_wp*mm, 0.0_wp)]
      steady = valve%inlet*valve%area/valve%stiffness
      call run_lumped(valve, wave_of(0.1_wp*period), settings_of(0.1_wp*period), [real(wp) ::], short)
      call run_lumped(valve, wave_of(period), settings_of(period), [0.1_wp, 0.15_wp, 0.19_wp, 0.36_wp, 0.39_wp], long)
      call suite%true(name(m)//": both end well", all(short%status == status_ok) .and. all(long%status == status_ok))
      call suite%true("long plateaus take as many steps as short ones", long%steps <= short%steps + 8)
      off = maxval(abs(long%trace(1:3, 1, :) - spread(steady, 1, 3))/spread(steady, 1, 3))
      off = max(off, maxval(abs(long%trace(4:5, 1, :))/spread(steady, 1, 2)))
      call suite%close("distance from equilibrium over the steady displacement", off, 0.0_wp, 0.0_wp, 1.0e-15_wp)
      call suite%close("fall of the reed without film, whose rise and rest are the same in both", &
         & long%measure(5, 2)/short%measure(5, 2), 1.0_wp, 0.0_wp, 10.0_wp*rtol)
   end subroutine long_plateaus

   !> At rest is who neither moves nor is off its equilibrium, by a tenth of the tolerance, while the pressure stays.
   subroutine conditions()
      real(wp), parameter :: plateau(2) = [5.0_wp*ms, 19.5_wp*ms], ramp(2) = [19.5_wp*ms, 20.5_wp*ms], some = 0.09_wp*rtol
      type(lumped_valve) :: valve(2)
      real(wp) :: steady, q_scale, v_scale
      real(wp), parameter :: zero(2) = 0.0_wp

      valve = [valve_at(20.0_wp*kpa, 0.1_wp*mm, k_s), valve_at(10.0_wp*kpa, 0.2_wp*mm, k_s)]
      steady = valve(2)%inlet*valve(2)%area/valve(2)%stiffness
      q_scale = min(steady, valve(2)%gap/3.0_wp)
      v_scale = q_scale*sqrt(valve(2)%stiffness/valve(2)%mass)
      call suite%true("on the equilibrium: at rest", rests(valve, zero, zero, plateau))
      call suite%true("a little beside it too", rests(valve, [0.0_wp, some*q_scale], [0.0_wp, some*v_scale], plateau))
      call suite%true("one lane beside it: not", .not. rests(valve, [0.0_wp, 1.3_wp*some*q_scale], zero, plateau))
      call suite%true("on the other side: not", .not. rests(valve, [0.0_wp, -1.3_wp*some*q_scale], zero, plateau))
      call suite%true("one lane moves: not", .not. rests(valve, zero, [0.0_wp, 1.3_wp*some*v_scale], plateau))
      call suite%true("before a ramp: not", .not. rests(valve, zero, zero, ramp))
   end subroutine conditions

   !> Whether lanes so far off the equilibrium of the first instant, and so fast, are at rest until the second.
   logical function rests(valve, off, v, t)
      type(lumped_valve), intent(in) :: valve(2)
      real(wp), intent(in) :: off(2), v(2), t(2)   !! [m], [m s-1], [s]
      class(valve_lanes), allocatable :: lanes
      type(lumped_lanes) :: lumped
      type(problem_type) :: problem
      type(rest_type) :: rest
      type(step_type) :: step
      logical :: found(2)
      real(wp) :: q(2, 1), inlet, outlet

      call new_lumped_lanes(lumped, valve)
      allocate(lanes, source=lumped)
      call pose(problem, lanes, wave_of(0.1_wp*period), rtol)
      call problem%history%factors(t(1), inlet, outlet)
      call problem%lanes%equilibrium(inlet, outlet, q, found)
      call new_step(step, t(1), q + reshape(off, [2, 1]), reshape(v, [2, 1]), 0.0_wp*q, problem%lanes%tip, [.true., .true.])
      rests = rest%reached(problem, step, t(2))
   end function rests

   !> Of a trace it is not known whether it is constant: nothing is skipped, least of all a second pulse.
   subroutine slow_trace()
      type(pressure_trace) :: trace
      type(error_type), allocatable :: error
      type(lane_outcome) :: outcome
      type(lumped_valve) :: valve(1)

      call new_pressure_trace(trace, [0.0_wp, 0.1_wp, 0.101_wp, 0.2_wp, 0.201_wp, 0.3_wp], &
         & kpa*[0.0_wp, 0.0_wp, 20.0_wp, 20.0_wp, 0.0_wp, 0.0_wp], spread(0.0_wp, 1, 6), 0.2_wp, error)
      call suite%no_error(name(m)//": a trace", error)
      valve = valve_at(1.0_wp, 0.1_wp*mm, k_s)
      call run_lumped(valve, trace, settings_of(0.3_wp), [0.15_wp], outcome)
      call suite%close("open on the pulse", outcome%trace(1, 1, 1), 20.0_wp*kpa*valve(1)%area/valve(1)%stiffness, &
         & 10.0_wp*rtol, 0.0_wp)
   end subroutine slow_trace

   type(square_wave) function wave_of(length) result(wave)
      real(wp), intent(in) :: length   !! period [s]
      type(error_type), allocatable :: error

      call new_square_wave(wave, length, 1.0_wp*ms, error)
      if (allocated(error)) error stop "the wave is refused"
   end function wave_of

   type(lane_settings) function settings_of(t_end) result(settings)
      real(wp), intent(in) :: t_end

      settings%t_end = t_end
      settings%rtol = rtol
      settings%method = method(m)
   end function settings_of

end program test_rest
