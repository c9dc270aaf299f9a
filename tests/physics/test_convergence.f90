!> Orders of convergence: fixed steps against the exact or a fine solution, and the tolerance against the error.
program test_convergence
   use rv_kinds, only : wp
   use rv_lanes, only : lane_outcome, lane_settings, method_explicit, method_implicit
   use rv_lumped, only : lumped_valve
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_valve, only : run_lumped, valve_at, wave_40ms, kpa, mm, ms
   implicit none
   type(suite_type) :: suite

   call order_of("implicit", method_implicit, 0.05_wp*mm, 0.05_wp*ms)
   call order_of("explicit", method_explicit, 0.1_wp*mm, 0.025_wp*ms)
   call tolerance_sets_the_error()
   call suite%finish()

contains

   !> Halving the step divides the error of the displacement in mid closing, at 20.25 ms, by 2^5. The corners of the wave
   !> lie on the grid of steps; the film acts both ways, else its switch would cost the order.
   subroutine order_of(name, method, gap, longest)
      character(len=*), intent(in) :: name
      integer, intent(in) :: method
      real(wp), intent(in) :: gap       !! [m]
      real(wp), intent(in) :: longest   !! step [s]
      real(wp) :: e(3)
      integer :: i

      e = [(displacement(method, gap, longest/2.0_wp**i), i=0, 2)]
      e = abs(e - displacement(method, gap, 2.5e-3_wp*ms))
      do i = 1, 2
         call suite%close(name//": observed order, halving "//to_text(i), log(e(i)/e(i + 1))/log(2.0_wp), 5.0_wp, 0.0_wp, 0.5_wp)
      end do
   end subroutine order_of

   real(wp) function displacement(method, gap, step) result(u)
      integer, intent(in) :: method
      real(wp), intent(in) :: gap, step
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      type(lumped_valve) :: valve(1)

      settings%t_end = 20.25_wp*ms
      settings%fixed_step = step
      settings%method = method
      settings%rtol = 1.0e-12_wp   ! of the stage equations
      valve = valve_at(20.0_wp*kpa, gap, 0.0075_wp)
      valve%both_ways = .true.
      call run_lumped(valve, wave_40ms(), settings, [settings%t_end], outcome)
      u = outcome%trace(1, 1, 1)
   end function displacement

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
