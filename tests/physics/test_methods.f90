!> The explicit method: its agreement with the implicit one, and how `auto` chooses between the two.
program test_methods
   use rv_kinds, only : wp
   use rv_lanes, only : lane_outcome, lane_settings, method_auto, method_explicit, method_implicit
   use rv_lumped, only : lumped_lanes, lumped_valve, new_lumped_lanes
   use rv_status, only : status_ok, status_step_too_small
   use check, only : suite_type
   use paper_valve, only : run_lumped, valve_at, wave_40ms, kpa, mm, ms
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: k_s = 0.0075_wp
   real(wp) :: no_times(0)

   call agreement(1.0e-4_wp)
   call agreement(1.0e-7_wp)
   call choice()
   call closed_film()
   call hopeless_film()
   call trial_stages()
   call suite%finish()

contains

   !> Both methods, from gaps that are stiff to gaps that are not: no further apart than some tolerances.
   subroutine agreement(rtol)
      real(wp), intent(in) :: rtol
      real(wp), parameter :: most = 10.0_wp
      type(lane_outcome) :: one, other
      type(lumped_valve) :: valve(8)
      integer :: i

      valve = [(valve_at(5.0_wp*kpa*i, 0.02_wp*mm*i, k_s), i=1, 8)]
      call run_lumped(valve, wave_40ms(), settings_of(method_implicit, rtol), no_times, one)
      call run_lumped(valve, wave_40ms(), settings_of(method_explicit, rtol), no_times, other)
      call suite%true("all end well", all(one%status == status_ok) .and. all(other%status == status_ok))
      call suite%true("one says implicit, the other explicit", other%is_explicit .and. .not. one%is_explicit)
      call suite%close("fall and closing: distance over rtol", &
         & maxval(abs(other%measure(5:6, :)/one%measure(5:6, :) - 1.0_wp))/rtol, 0.0_wp, 0.0_wp, most)
      call suite%true("they are not the same numbers", any(abs(other%measure(5, :) - one%measure(5, :)) > 0.0_wp))
   end subroutine agreement

   type(lane_settings) function settings_of(method, rtol) result(settings)
      integer, intent(in) :: method
      real(wp), intent(in) :: rtol

      settings%t_end = 40.0_wp*ms
      settings%method = method
      settings%rtol = rtol
   end function settings_of

   !> (c_a + C/g0^3)/sqrt(k m) of the stiffest lane decides.
   subroutine choice()
      type(lumped_lanes) :: lanes
      type(lumped_valve) :: valve(2)

      valve = [valve_at(20.0_wp*kpa, 0.2_wp*mm, k_s), valve_at(20.0_wp*kpa, 0.03_wp*mm, k_s)]
      call new_lumped_lanes(lanes, valve)
      call suite%close("stiffness of the easy and the stiff lane", maxval(abs(lanes%stiffness_ratio() &
         & /((valve%damping + valve%squeeze/valve%gap**3)/sqrt(valve%stiffness*valve%mass)) - 1.0_wp)), 0.0_wp, 0.0_wp, 1.0e-14_wp)
      call suite%true("easy lanes: explicit", chooses_explicit(valve(1:1)))
      call suite%true("stiff lanes: implicit", .not. chooses_explicit(valve(2:2)))
      call suite%true("one stiff lane: implicit for all", .not. chooses_explicit(valve))
      valve%squeeze = 0.0_wp
      call suite%true("without film: explicit", chooses_explicit(valve))
   end subroutine choice

   logical function chooses_explicit(valve)
      type(lumped_valve), intent(in) :: valve(:)
      type(lane_outcome) :: outcome

      call run_lumped(valve, wave_40ms(), settings_of(method_auto, 1.0e-4_wp), no_times, outcome)
      chooses_explicit = outcome%is_explicit .and. all(outcome%status == status_ok)
   end function chooses_explicit

   !> A pressure that closes the film of one lane ends that lane, not its neighbour.
   subroutine closed_film()
      type(lane_outcome) :: outcome
      type(lumped_valve) :: valve(2)

      valve = valve_at(20.0_wp*kpa, 0.1_wp*mm, k_s)
      valve(1)%outlet = 1.0e5_wp*kpa
      valve(1)%squeeze = 1.0e-30_wp
      call run_lumped(valve, wave_40ms(), settings_of(method_explicit, 1.0e-4_wp), no_times, outcome)
      call suite%true("the lane on its seat fails: "//outcome%message(1)%s, outcome%status(1) /= status_ok)
      call suite%true("its neighbour ends well", outcome%status(2) == status_ok)
   end subroutine closed_film

   !> A film that settles faster than time can be told apart ends its own lane, whichever its place, and no other: at the
   !> first step, and after steps that no longer move the time. Every lane's error is then next to nothing.
   subroutine hopeless_film()
      type(lane_outcome) :: outcome
      type(lumped_valve) :: valve(3)
      real(wp), parameter :: gap(2) = [1.0e-7_wp*mm, 2.0e-6_wp*mm]
      integer :: i, k

      do k = 1, size(gap)
         do i = 1, 3
            valve = valve_at(20.0_wp*kpa, 0.1_wp*mm, k_s)
            valve(i)%gap = gap(k)
            valve(i)%both_ways = .true.
            call run_lumped(valve, wave_40ms(), settings_of(method_explicit, 1.0e-4_wp), no_times, outcome)
            call suite%equal("lane that fails: "//outcome%message(i)%s, outcome%status(i), status_step_too_small)
            call suite%equal("lanes that end well", count(outcome%status == status_ok), 2)
         end do
      end do
   end subroutine hopeless_film

   !> A trial stage that runs through the seat costs the step, not the case: thin oil, far openings, one case at a time.
   subroutine trial_stages()
      type(lane_outcome) :: outcome
      integer :: i, j, k, failed

      failed = 0
      do i = 0, 3
         do j = 0, 3
            do k = 0, 3
               call run_lumped([valve_at(4.0_wp*5.0_wp**i*kpa, 0.05_wp*2.0_wp**j*mm, k_s, 1.0e-3_wp*4.0_wp**k)], wave_40ms(), &
                  & settings_of(method_explicit, 1.0e-4_wp), no_times, outcome)
               if (outcome%status(1) /= status_ok) failed = failed + 1
            end do
         end do
      end do
      call suite%equal("explicit cases that fail, of 64", failed, 0)
   end subroutine trial_stages

end program test_methods
