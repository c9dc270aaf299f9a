!> Orders of convergence: fixed steps against the exact or a fine solution, and the tolerance against the error.
program test_convergence
   use rv_kinds, only : wp
   use rv_lanes, only : lane_outcome, lane_settings, run_lanes
   use check, only : suite_type
   use paper_valve, only : valve_at, wave_40ms, kpa, mm, ms
   implicit none
   type(suite_type) :: suite

   call order_of_the_method()
   call tolerance_sets_the_error()
   call suite%finish()

contains

   !> Halving the step divides the error of the displacement by 2^5. The corners of the wave lie on the
   !> grid of steps; the film acts both ways, else its switch would cost the order.
   subroutine order_of_the_method()
      real(wp) :: e(3), fine
      integer :: i

      fine = displacement(2.5e-3_wp*ms)
      do i = 1, 3
         e(i) = abs(displacement(0.1_wp*ms/2.0_wp**i) - fine)
      end do
      call suite%close("observed order, first halving", log(e(1)/e(2))/log(2.0_wp), 5.0_wp, 0.0_wp, 0.5_wp)
      call suite%close("observed order, second halving", log(e(2)/e(3))/log(2.0_wp), 5.0_wp, 0.0_wp, 0.5_wp)
   end subroutine order_of_the_method

   !> Displacement at 20.25 ms, mid in the closing, with fixed steps.
   real(wp) function displacement(step) result(u)
      real(wp), intent(in) :: step
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings

      settings%t_end = 20.25_wp*ms
      settings%fixed_step = step
      settings%rtol = 1.0e-12_wp   ! of the stage equations
      associate (valve => [valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0075_wp)])
         call run_lanes(with_film_both_ways(valve), wave_40ms(), settings, [settings%t_end], outcome)
      end associate
      u = outcome%trace(1, 1, 1)
   end function displacement

   function with_film_both_ways(valve) result(both)
      use rv_lumped, only : lumped_valve
      type(lumped_valve), intent(in) :: valve(:)
      type(lumped_valve) :: both(size(valve))

      both = valve
      both%both_ways = .true.
   end function with_film_both_ways

   !> Error per unit step control of a method of order 5 with an embedded one of order 4: the global error
   !> follows the tolerance like rtol^(4/5) to rtol^1. Four decades of tolerance show it.
   subroutine tolerance_sets_the_error()
      real(wp) :: e(4), reference(2), value(2), slope
      integer :: i

      reference = fall_and_close(1.0e-12_wp)
      do i = 1, 4
         value = fall_and_close(10.0_wp**(-3 - i))
         e(i) = maxval(abs(value/reference - 1.0_wp))
      end do
      slope = log10(e(1)/e(4))/3.0_wp
      call suite%true("each decade of tolerance lowers the error", all(e(2:) < e(:3)))
      call suite%close("decades of error per decade of tolerance", slope, 0.9_wp, 0.0_wp, 0.25_wp)
      call suite%close("relative error of fall and closing time at rtol 1e-6", e(3), 0.0_wp, 0.0_wp, 1.0e-4_wp)
   end subroutine tolerance_sets_the_error

   function fall_and_close(rtol) result(t)
      real(wp), intent(in) :: rtol
      real(wp) :: t(2)
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      real(wp) :: no_times(0)

      settings%t_end = 40.0_wp*ms
      settings%rtol = rtol
      call run_lanes([valve_at(20.0_wp*kpa, 0.05_wp*mm, 0.0075_wp)], wave_40ms(), settings, no_times, outcome)
      t = outcome%measure(5:6, 1)
   end function fall_and_close

end program test_convergence
