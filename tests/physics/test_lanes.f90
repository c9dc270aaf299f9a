!> Lanes keep to themselves: company, order, hard and failing neighbours change a case by no more than its tolerance.
program test_lanes
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_value, ieee_quiet_nan
   use rv_error, only : error_type
   use rv_kinds, only : wp
   use rv_lanes, only : lane_outcome, lane_settings
   use rv_lumped, only : lumped_valve
   use rv_pressure, only : new_square_wave, square_wave
   use rv_status, only : status_film_closed, status_ok, status_name, status_too_many_steps
   use check, only : suite_type
   use paper_valve, only : run_lumped, valve_at, wave_40ms, kpa, mm, ms
   implicit none
   type(suite_type) :: suite
   integer, parameter :: w = 16
   real(wp), parameter :: rtol = 1.0e-6_wp
   real(wp) :: no_times(0)

   call alone_and_in_company()
   call failing_neighbour()
   call neighbour_on_its_seat()
   call neighbour_in_motion()
   call end_of_cycle()
   call step_limit()
   call stiff_films()
   call suite%finish()

contains

   !> Mixed easy and hard cases: 0.01 to 1 mm of gap, 0.1 to 500 kPa.
   function mixed_cases() result(valve)
      type(lumped_valve) :: valve(w)
      integer :: i

      do i = 1, w
         valve(i) = valve_at(0.1_wp*kpa*5000.0_wp**(real(mod(7*i, w), wp)/real(w - 1, wp)), &
            & 0.01_wp*mm*100.0_wp**(real(mod(5*i, w), wp)/real(w - 1, wp)), 0.0075_wp)
      end do
      valve(3)%squeeze = 0.0_wp
   end function mixed_cases

   subroutine alone_and_in_company()
      type(lumped_valve) :: valve(w)
      type(lane_outcome) :: together, backwards, alone
      type(lane_settings) :: settings, tight
      real(wp) :: worst, worst_alone
      integer :: i

      valve = mixed_cases()
      settings%t_end = 40.0_wp*ms
      settings%rtol = rtol
      tight = settings
      tight%rtol = 1.0e-11_wp
      call run_lumped(valve, wave_40ms(), settings, no_times, together)
      call run_lumped(valve(w:1:-1), wave_40ms(), settings, no_times, backwards)
      worst = 0.0_wp
      worst_alone = 0.0_wp
      do i = 1, w
         call run_lumped(valve(i:i), wave_40ms(), tight, no_times, alone)
         worst = max(worst, distance(together%measure(:, i), alone%measure(:, 1)))
         call run_lumped(valve(i:i), wave_40ms(), settings, no_times, alone)
         worst_alone = max(worst_alone, distance(together%measure(:, i), alone%measure(:, 1)))
      end do
      call suite%true("all lanes end well", all(together%status == status_ok))
      call suite%close("worst relative distance of a measured time to a converged single run", worst, 0.0_wp, 0.0_wp, 1.0e-4_wp)
      call suite%close("worst relative distance to the same case run alone", worst_alone, 0.0_wp, 0.0_wp, 1.0e-4_wp)
      call suite%true("the order of the lanes does not matter", &
         & .not. any(abs(together%measure - backwards%measure(:, w:1:-1)) > 0.0_wp))
   end subroutine alone_and_in_company

   !> Largest relative distance of fall and closing time; one missing and the other not counts as 1.
   real(wp) function distance(a, b)
      real(wp), intent(in) :: a(:), b(:)
      integer :: k

      distance = 0.0_wp
      do k = 5, 6
         if (ieee_is_nan(a(k)) .neqv. ieee_is_nan(b(k))) distance = 1.0_wp
         if (.not. ieee_is_nan(a(k))) distance = max(distance, abs(a(k)/b(k) - 1.0_wp))
      end do
   end function distance

   !> A lane that is not finite, one at the start and one in mid-run: recorded, the others go on.
   subroutine failing_neighbour()
      type(lumped_valve) :: valve(w)
      type(lane_outcome) :: with, without
      type(lane_settings) :: settings
      logical :: others(w)
      real(wp) :: worst
      integer :: i

      settings%t_end = 40.0_wp*ms
      settings%rtol = rtol
      valve = mixed_cases()
      call run_lumped(valve, wave_40ms(), settings, no_times, without)
      valve(5)%damping = ieee_value(1.0_wp, ieee_quiet_nan)
      valve(9)%damping = -30.0_wp   ! grows without bound: fails late, by overflow or by step size
      call run_lumped(valve, wave_40ms(), settings, no_times, with)
      others = .true.
      others([5, 9]) = .false.
      call suite%true("the lane with a NaN fails ("//status_name(with%status(5))//", "//with%message(5)%s//")", &
         & with%status(5) /= status_ok)
      call suite%true("the unstable lane fails ("//status_name(with%status(9))//", "//with%message(9)%s//")", &
         & with%status(9) /= status_ok)
      call suite%true("its message names the time", index(with%message(9)%s, "at t = ") == 1)
      call suite%true("the other lanes end well", all(with%status == status_ok .eqv. others))
      worst = 0.0_wp
      do i = 1, w
         if (others(i)) worst = max(worst, distance(with%measure(:, i), without%measure(:, i)))
      end do
      call suite%close("and are where they were without the failures", worst, 0.0_wp, 0.0_wp, 1.0e-4_wp)
      call run_lumped(valve(5:5), wave_40ms(), settings, [0.0_wp, 1.0_wp*ms], with)
      call suite%close("of the lane with a NaN the start is known", with%trace(1, 1, 1), 0.0_wp, 0.0_wp, 0.0_wp)
      call suite%true("but no more", all(ieee_is_nan(with%trace(2, :, 1))))
   end subroutine failing_neighbour

   !> A reed that strikes its seat while another one moves, in a cycle too short to come to rest: the other goes on from
   !> there, neither from another state nor from another time.
   subroutine neighbour_in_motion()
      integer, parameter :: n = 100
      type(lumped_valve) :: valve(2)
      type(lane_outcome) :: with, without
      type(lane_settings) :: settings
      type(square_wave) :: wave
      type(error_type), allocatable :: error
      real(wp) :: time(0:n)
      integer :: i, last

      settings%t_end = 2.0_wp*ms
      settings%rtol = rtol
      time = [(settings%t_end*real(i, wp)/real(n, wp), i=0, n)]
      call new_square_wave(wave, 2.0_wp*ms, 0.1_wp*ms, error)
      valve = [valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0075_wp), valve_at(20.0_wp*kpa, 0.001_wp*mm, 1.0e-70_wp)]
      call run_lumped(valve, wave, settings, time, with)
      call run_lumped(valve(:1), wave, settings, time, without)
      last = count(.not. ieee_is_nan(with%trace(:, 1, 2))) - 1
      call suite%true("the reed strikes its seat ("//with%message(2)%s//")", with%status(2) == status_film_closed)
      call suite%true("between the event and the end", last > n/2 .and. last < n - 5)
      call suite%close("largest distance of the other's displacement", &
         & maxval(abs(with%trace(:, 1, 1) - without%trace(:, 1, 1)))/with%measure(1, 1), 0.0_wp, 0.0_wp, 1.0e-5_wp)
   end subroutine neighbour_in_motion

   !> What happens after the end of the cycle is not measured.
   subroutine end_of_cycle()
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      type(square_wave) :: wave

      settings%t_end = 40.0_wp*ms
      wave = wave_40ms()
      wave%cycle_end = 22.0_wp*ms
      call run_lumped([valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0075_wp)], wave, settings, no_times, outcome)
      call suite%true("a cycle that ends 2.5 ms after the event: fall, but no closing", outcome%measure(5, 1) > 0.0_wp .and. &
         & ieee_is_nan(outcome%measure(6, 1)))
   end subroutine end_of_cycle

   !> A film too weak to slow its reed, which strikes the seat in mid-closing: up to then it is as it is alone, then
   !> it is missing; the other lanes do not notice at any time.
   subroutine neighbour_on_its_seat()
      integer, parameter :: n = 400
      type(lumped_valve) :: valve(3)
      type(lane_outcome) :: with, without, alone
      type(lane_settings) :: settings
      real(wp) :: time(0:n), scale
      integer :: i, last

      settings%t_end = 40.0_wp*ms
      settings%rtol = rtol
      time = [(settings%t_end*real(i, wp)/real(n, wp), i=0, n)]
      valve = [valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0075_wp), valve_at(20.0_wp*kpa, 0.001_wp*mm, 1.0e-70_wp), &
         & valve_at(10.0_wp*kpa, 0.1_wp*mm, 0.0_wp)]
      call run_lumped(valve, wave_40ms(), settings, time, with)
      call run_lumped(valve([1, 3]), wave_40ms(), settings, time, without)
      call run_lumped(valve(2:2), wave_40ms(), settings, time, alone)
      call suite%true("the reed strikes its seat ("//with%message(2)%s//")", with%status(2) == status_film_closed)
      call suite%true("the others do not", all(with%status([1, 3]) == status_ok))
      scale = with%measure(1, 1)
      call suite%close("largest distance of the others' displacements to those without it", &
         & maxval(abs(with%trace(:, 1, [1, 3]) - without%trace(:, 1, :)))/scale, 0.0_wp, 0.0_wp, 1.0e-4_wp)
      last = count(.not. ieee_is_nan(with%trace(:, 1, 2))) - 1
      call suite%true("it fails after the event and before the end", time(last) > 19.5_wp*ms .and. time(last) < 22.0_wp*ms)
      call suite%true("as early as alone", last == count(.not. ieee_is_nan(alone%trace(:, 1, 1))) - 1)
      call suite%true("nothing is known of it after that", all(ieee_is_nan(with%trace(last + 2:, :, 2))))
      call suite%close("before that it is as it is alone", maxval(abs(with%trace(:last + 1, 1, 2) &
         & - alone%trace(:last + 1, 1, 1)))/scale, 0.0_wp, 0.0_wp, 1.0e-4_wp)
      call suite%true("the same measures are missing", all(ieee_is_nan(with%measure(:, 2)) .eqv. ieee_is_nan(alone%measure(:, 1))))
      call suite%close("largest force of the others' film [N]", with%measure(9, 1), without%measure(9, 1), 1.0e-4_wp, 0.0_wp)
   end subroutine neighbour_on_its_seat

   subroutine step_limit()
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings

      settings%t_end = 40.0_wp*ms
      settings%max_steps = 20
      call run_lumped([valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0075_wp)], wave_40ms(), settings, no_times, outcome)
      call suite%equal("status at the step limit", outcome%status(1), status_too_many_steps)
      call suite%true("message: "//outcome%message(1)%s, index(outcome%message(1)%s, "after 20 steps") == 1)
      settings%max_steps = 1000000
      call run_lumped([valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0075_wp)], wave_40ms(), settings, no_times, outcome)
      settings%max_steps = outcome%steps
      call run_lumped([valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0075_wp)], wave_40ms(), settings, no_times, outcome)
      call suite%equal("as many steps as it takes are enough", outcome%status(1), status_ok)
      settings%max_steps = outcome%steps - 1
      call run_lumped([valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0075_wp)], wave_40ms(), settings, no_times, outcome)
      call suite%equal("one less is not", outcome%status(1), status_too_many_steps)
   end subroutine step_limit

   !> Films that settle the velocity a thousand times within a step: their force is that of a converged run, its peak and
   !> its history.
   subroutine stiff_films()
      type(lane_outcome) :: outcome, exact
      type(lane_settings) :: settings
      type(lumped_valve) :: valve(2)
      real(wp), parameter :: limit = 2.0e-3_wp   ! before the dense output knew of them: 0.1 and 0.04
      real(wp) :: time(2001)
      integer :: i

      time = [(40.0_wp*ms*real(i, wp)/2000.0_wp, i=0, 2000)]
      valve = [valve_at(0.33892_wp*kpa, 0.0161054_wp*mm, 0.0075_wp, 0.499593_wp), valve_at(1.0_wp*kpa, 0.01_wp*mm, 0.0075_wp)]
      settings%t_end = 40.0_wp*ms
      settings%rtol = rtol
      do i = 1, 2
         settings%rtol = 1.0e-11_wp
         call run_lumped(valve(i:i), wave_40ms(), settings, time, exact)
         settings%rtol = rtol
         call run_lumped(valve(i:i), wave_40ms(), settings, time, outcome)
         call suite%close("peak of the film force [N]", outcome%measure(9, 1), exact%measure(9, 1), limit, 0.0_wp)
         call suite%close("film force at all times, over its peak", maxval(abs(outcome%trace(:, 5, 1) - exact%trace(:, 5, 1))) &
            & /exact%measure(9, 1), 0.0_wp, 0.0_wp, limit)
      end do
   end subroutine stiff_films

end program test_lanes
