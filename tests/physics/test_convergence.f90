!> Orders of convergence: fixed steps against the exact or a fine solution, and the tolerance against the error.
program test_convergence
   use rv_kinds, only : wp
   use rv_lanes, only : lane_outcome, lane_settings
   use check, only : suite_type
   use paper_valve, only : run_lumped, valve_at, wave_40ms, kpa, mm, ms
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
         call run_lumped(with_film_both_ways(valve), wave_40ms(), settings, [settings%t_end], outcome)
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

   !> Step control of a method of order 5 by an embedded one of order 4: the global error follows the
   !> tolerance about in proportion. The worst of eight pressures over five decades shows it.
   subroutine tolerance_sets_the_error()
      integer, parameter :: decades = 5
      real(wp) :: e(decades), reference(2, 8)
      integer :: i

      reference = fall_and_close(1.0e-12_wp)
      do i = 1, decades
         e(i) = maxval(abs(fall_and_close(10.0_wp**(-3 - i))/reference - 1.0_wp))
      end do
      call suite%true("each decade of tolerance lowers the error", all(e(2:) < e(:decades - 1)))
      call suite%close("decades of error per decade of tolerance", log10(e(1)/e(decades))/real(decades - 1, wp), &
         & 1.0_wp, 0.0_wp, 0.2_wp)
      call suite%close("relative error of fall and closing time at rtol 1e-6", e(3), 0.0_wp, 0.0_wp, 1.0e-5_wp)
   end subroutine tolerance_sets_the_error

   !> Fall and closing time of the paper's eight pressures.
   function fall_and_close(rtol) result(t)
      real(wp), intent(in) :: rtol
      real(wp) :: t(2, 8)
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      real(wp) :: no_times(0)
      integer :: i

      settings%t_end = 40.0_wp*ms
      settings%rtol = rtol
      call run_lumped([(valve_at(5.0_wp*kpa*real(i, wp), 0.05_wp*mm, 0.0075_wp), i=1, 8)], wave_40ms(), settings, &
         & no_times, outcome)
      t = outcome%measure(5:6, :)
   end function fall_and_close

end program test_convergence
