!> Lanes in random company: blocks of easy and hard cases, 0.01 to 1 mm of gap, 0.1 to 500 kPa, 0.001 to 1 Pa s.
!>
!> drivers/benchmarks/lane_accuracy.py prints the same for thousands of cases.
program test_company
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8
   use rv_lanes, only : lane_outcome, lane_settings
   use rv_lumped, only : lumped_valve
   use rv_status, only : status_ok
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_valve, only : run_lumped, valve_at, wave_40ms, kpa, mm, ms
   implicit none
   integer, parameter :: w = 32, blocks = 2
   integer, parameter :: steady = 1, fall = 5, closing = 6, undershoot = 8   !! places of measures

   !> Errors over the tolerance. The local error of a step is held below rtol; over a few hundred steps, and amplified
   !> where a reed creeps home or swings through a level slowly, it comes to twenty times that.
   real(wp), parameter :: most = 30.0_wp
   !> An undershoot below ten times rtol counts as none: rv_measures.
   real(wp), parameter :: resolution = 10.0_wp

   type(suite_type) :: suite
   type(lumped_valve) :: valve(w, blocks)
   type(lane_outcome) :: exact(w, blocks)
   real(wp), parameter :: rtols(2) = [1.0e-4_wp, 1.0e-6_wp]
   real(wp) :: no_times(0)
   integer(i8) :: seed = 20240501_i8
   integer :: b, k

   call draw_cases()
   do b = 1, blocks
      call solve_alone(b)
      do k = 1, size(rtols)
         call in_company(b, rtols(k))
      end do
   end do
   do k = 1, size(rtols)
      call one_among_many("a stiff one", valve_at(40.0_wp*kpa, 0.03_wp*mm, 0.0075_wp, 0.04_wp), rtols(k))
      call one_among_many("a lively one", valve_at(500.0_wp*kpa, 0.05_wp*mm, 0.0075_wp, 1.0e-3_wp), rtols(k))
   end do
   call suite%finish()

contains

   subroutine draw_cases()
      real(wp) :: inlet, gap, viscosity
      integer :: i, j

      do j = 1, blocks
         do i = 1, w
            inlet = drawn(0.1_wp*kpa, 500.0_wp*kpa)
            gap = drawn(0.01_wp*mm, 1.0_wp*mm)
            viscosity = drawn(1.0e-3_wp, 1.0_wp)
            valve(i, j) = valve_at(inlet, gap, 0.0075_wp, viscosity)
         end do
      end do
   end subroutine draw_cases

   !> Evenly in the logarithm; the same numbers with every compiler (Lehmer, doi:10.1145/63039.63042).
   real(wp) function drawn(low, high)
      real(wp), intent(in) :: low, high
      integer(i8), parameter :: factor = 48271_i8, modulus = 2147483647_i8

      seed = mod(factor*seed, modulus)
      drawn = low*(high/low)**(real(seed, wp)/real(modulus, wp))
   end function drawn

   type(lane_settings) function settings_at(rtol) result(settings)
      real(wp), intent(in) :: rtol

      settings%t_end = 40.0_wp*ms
      settings%rtol = rtol
   end function settings_at

   subroutine solve_alone(block)
      integer, intent(in) :: block
      integer :: i

      do i = 1, w
         call run_lumped(valve(i:i, block), wave_40ms(), settings_at(1.0e-11_wp), no_times, exact(i, block))
         call suite%true("a case alone at 1e-11 ends well: "//exact(i, block)%message(1)%s, &
            & exact(i, block)%status(1) == status_ok)
      end do
   end subroutine solve_alone

   subroutine in_company(block, rtol)
      integer, intent(in) :: block
      real(wp), intent(in) :: rtol
      type(lane_outcome) :: outcome
      real(wp) :: worst(3), worst_undershoot
      integer :: i

      call run_lumped(valve(:, block), wave_40ms(), settings_at(rtol), no_times, outcome)
      call suite%true("all lanes of block "//to_text(block)//" end well", all(outcome%status == status_ok))
      worst = 0.0_wp
      worst_undershoot = 0.0_wp
      do i = 1, w
         associate (got => outcome%measure(:, i), due => exact(i, block)%measure(:, 1))
            worst = max(worst, distance(got([steady, fall, closing]), due([steady, fall, closing])))
            worst_undershoot = max(worst_undershoot, abs(got(undershoot) - due(undershoot))/due(steady))
         end associate
      end do
      call suite%close("steady displacement, a static one", worst(1), 0.0_wp, 0.0_wp, 10.0_wp*epsilon(1.0_wp))
      call suite%close("worst relative error of a fall over rtol", worst(2)/rtol, 0.0_wp, 0.0_wp, most)
      call suite%close("worst relative error of a closing over rtol", worst(3)/rtol, 0.0_wp, 0.0_wp, most)
      call suite%close("worst error of an undershoot over rtol and steady displacement", worst_undershoot/rtol, 0.0_wp, &
         & 0.0_wp, most + resolution)
   end subroutine in_company

   !> Relative distance; a number beside none is as bad as can be.
   elemental real(wp) function distance(got, due)
      real(wp), intent(in) :: got, due

      distance = 0.0_wp
      if (ieee_is_nan(got) .neqv. ieee_is_nan(due)) distance = huge(1.0_wp)
      if (.not. (ieee_is_nan(got) .or. ieee_is_nan(due))) distance = abs(got/due - 1.0_wp)
   end function distance

   !> One hard case among easy ones: it is as accurate as if it were alone, so nobody's error is averaged away, and so
   !> are they.
   subroutine one_among_many(what, hard, rtol)
      character(len=*), intent(in) :: what
      type(lumped_valve), intent(in) :: hard
      real(wp), intent(in) :: rtol
      type(lumped_valve) :: company(w)
      type(lane_outcome) :: outcome, tight
      real(wp) :: error(2)
      integer :: i

      company = [(valve_at((5.0_wp + i)*kpa, 0.3_wp*mm, 0.0075_wp), i=1, w)]
      company(w/2) = hard   ! lanes 1 and w - 1 are looked at, too
      call run_lumped(company, wave_40ms(), settings_at(rtol), no_times, outcome)
      do i = 1, w, w/2 - 1
         call run_lumped(company(i:i), wave_40ms(), settings_at(1.0e-11_wp), no_times, tight)
         error = distance(outcome%measure([fall, closing], i), tight%measure([fall, closing], 1))
         call suite%close(what//" among many, error of lane "//to_text(i)//" over rtol", maxval(error)/rtol, 0.0_wp, 0.0_wp, &
            & most)
      end do
   end subroutine one_among_many

end program test_company
