!> The response of the paper's valve by the film models: displacement and times, undershoot, forces on the land's parts.
program test_film_response
   use rv_kinds, only : wp
   use rv_film_reed, only : film_reed
   use rv_film_valve, only : film_valve
   use rv_lanes, only : lane_outcome, lane_settings
   use rv_status, only : status_name, status_ok
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_film, only : no_times, paper_case, paper_reed, run_film, run_table
   use paper_valve, only : kpa, mm, ms
   implicit none
   type(suite_type) :: suite
   integer, parameter :: steady = 1, fall = 5, closing = 6, undershoot = 8
   real(wp), parameter :: inlet(3) = [5.0_wp, 20.0_wp, 40.0_wp]*kpa
   real(wp), parameter :: until = 26.0_wp*ms   !! the reed has closed long before
   type(film_reed) :: reed

   reed = paper_reed(4)
   call film_times()
   call table_times()
   call wide_gap()
   call parts_of_the_land()
   call suite%finish()

contains

   function settings_until(t_end) result(settings)
      real(wp), intent(in) :: t_end
      type(lane_settings) :: settings

      settings%t_end = t_end
   end function settings_until

   !> Measures of one case of the film model.
   function measures(gap, pressure) result(measure)
      real(wp), intent(in) :: gap, pressure
      real(wp), allocatable :: measure(:)
      type(lane_outcome) :: outcome

      call run_film(reed, paper_case(reed, gap, pressure), settings_until(until), no_times, outcome)
      call suite%text("status", status_name(outcome%status(1)), "ok")
      measure = outcome%measure(:, 1)
   end function measures

   subroutine film_times()
      real(wp), parameter :: u(3) = [0.03267_wp, 0.13053_wp, 0.26143_wp]   !! [mm]
      real(wp), parameter :: t_fall(3) = [2.619_wp, 1.547_wp, 1.056_wp]    !! [ms]
      real(wp), parameter :: t_close(3) = [5.443_wp, 3.894_wp, 3.035_wp]   !! [ms]
      real(wp), allocatable :: measure(:)
      integer :: k

      do k = 1, 3
         measure = measures(0.05_wp*mm, inlet(k))
         call suite%close(to_text(inlet(k)/kpa)//" kPa: steady displacement [mm]", measure(steady)/mm, u(k), 2.0e-3_wp, 0.0_wp)
         call suite%close("fall time [ms]", measure(fall)/ms, t_fall(k), 5.0e-3_wp, 0.0_wp)
         call suite%close("closing time [ms]", measure(closing)/ms, t_close(k), 5.0e-3_wp, 0.0_wp)
         call suite%close("undershoot [mm]", measure(undershoot)/mm, 0.0_wp, 0.0_wp, 0.0_wp)
      end do
   end subroutine film_times

   subroutine table_times()
      real(wp), parameter :: t_fall(3) = [2.547_wp, 1.500_wp, 1.048_wp]    !! [ms]
      real(wp), parameter :: t_close(3) = [5.328_wp, 3.790_wp, 2.938_wp]   !! [ms]
      type(film_valve) :: valve(3)
      type(lane_outcome) :: outcome
      integer :: k

      do k = 1, 3
         valve(k) = paper_case(reed, 0.05_wp*mm, inlet(k))
      end do
      call run_table(reed, valve, settings_until(until), no_times, outcome)
      call suite%true("film_table: all cases end well", all(outcome%status == status_ok))
      do k = 1, 3
         call suite%close("film_table, "//to_text(inlet(k)/kpa)//" kPa: fall time [ms]", outcome%measure(fall, k)/ms, t_fall(k), &
            & 3.0e-3_wp, 0.0_wp)
         call suite%close("closing time [ms]", outcome%measure(closing, k)/ms, t_close(k), 3.0e-3_wp, 0.0_wp)
      end do
   end subroutine table_times

   !> A gap three times as wide lets the reed swing through u = 0.
   subroutine wide_gap()
      real(wp), allocatable :: measure(:)

      measure = measures(0.15_wp*mm, 20.0_wp*kpa)
      call suite%close("gap 0.15 mm: undershoot over steady displacement [%]", 100.0_wp*measure(undershoot)/measure(steady), &
         & 7.1_wp, 0.0_wp, 0.3_wp)
   end subroutine wide_gap

   !> The pressure on part A (land before the hole) overtakes that on part C (hole) while the inlet falls.
   subroutine parts_of_the_land()
      integer, parameter :: n = 500
      type(lane_outcome) :: outcome
      real(wp) :: t(n), excess(n), crossing
      integer :: k

      t = [(19.4_wp*ms + 0.001_wp*ms*real(k, wp), k = 1, n)]
      call run_film(reed, paper_case(reed, 0.05_wp*mm, 20.0_wp*kpa), settings_until(19.95_wp*ms), t, outcome)
      excess = outcome%trace(:, 6, 1) - outcome%trace(:, 8, 1)
      crossing = 0.0_wp
      do k = 2, n
         if (excess(k) <= 0.0_wp) cycle
         crossing = t(k - 1) - excess(k - 1)*(t(k) - t(k - 1))/(excess(k) - excess(k - 1))
         exit
      end do
      call suite%close("force on A exceeds that on C from [ms]", crossing/ms, 19.692_wp, 0.0_wp, 0.01_wp)
      call suite%true("at the event it does not", all(excess(:101) < 0.0_wp))
   end subroutine parts_of_the_land

end program test_film_response
