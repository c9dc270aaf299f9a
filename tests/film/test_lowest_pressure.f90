!> The lowest film pressure of film_table: its table against direct solutions, what the lanes keep of it, a whole run
!> beside the film model's.
program test_lowest_pressure
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_film_lanes, only : film_traces
   use rv_film_reed, only : film_reed
   use rv_film_table, only : film_table
   use rv_film_valve, only : film_valve
   use rv_lanes, only : lane_outcome, lane_settings
   use rv_reynolds, only : film_state
   use rv_table_lanes, only : new_table_lanes, table_lanes
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_film, only : build_paper_table, no_times, paper_case, paper_reed, run_film, run_table
   use paper_valve, only : kpa, mm
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: gap = 0.05_wp*mm
   integer, parameter :: first = -10, last = 16, tip_moves(2) = [-2, 6]   !! powers of two of x: all, where a reed works
   integer :: k
   real(wp), parameter :: share(101) = [(0.02_wp*real(k - 51, wp), k=1, 101)]

   call whole_range(0.0_wp, 1.5e-2_wp)
   call whole_range(0.65_wp, 6.0e-2_wp)
   call nodes_of_the_table()
   call no_suction()
   call beyond_its_ends()
   call lanes_keep_it()
   call runs_beside_film()
   call suite%finish()

contains

   !> Worst of all shares at one x; pressure difference and suction make one pascal, `error` is in parts of it.
   function worst_error(reed, table, x) result(worst)
      type(film_reed), intent(in) :: reed
      type(film_table), intent(in) :: table
      real(wp), intent(in) :: x
      real(wp) :: worst, rate, lowest
      type(film_state) :: state
      type(error_type), allocatable :: error
      integer :: j

      call reed%static_film%solve(gap, 1.0_wp, [gap*(x - 1.0_wp)], state, error)
      if (allocated(error)) error stop "the film is refused"
      worst = 0.0_wp
      do j = 1, size(share)
         rate = (1.0_wp - abs(share(j)))/maxval(state%pressure(:, 1))
         lowest = minval(reed%static_film%pressure_of(state, [rate], share(j)))
         worst = max(worst, abs(table%lowest_pressure(x, share(j), state%damping(1, 1)*rate) - lowest))
      end do
   end function worst_error

   !> Twenty places an octave: where a reed works as the table's head says, and over all of it.
   subroutine whole_range(elongation, limit)
      real(wp), intent(in) :: elongation, limit
      type(film_reed) :: reed
      type(film_table) :: table
      real(wp) :: off, worst, worst_at_work
      integer :: i

      call build_paper_table(reed, table, gap, elongation)
      worst = 0.0_wp
      worst_at_work = 0.0_wp
      do i = 20*first, 20*last
         off = worst_error(reed, table, 2.0_wp**(0.05_wp*real(i, wp)))
         worst = max(worst, off)
         if (i >= 20*tip_moves(1) + 10 .and. i <= 20*tip_moves(2)) worst_at_work = max(worst_at_work, off)
      end do
      call suite%close("elongation "//to_text(elongation)//": x from 0.35 to 64", worst_at_work, 0.0_wp, 0.0_wp, 7.0e-3_wp)
      call suite%close("over the whole table", worst, 0.0_wp, 0.0_wp, limit)
   end subroutine whole_range

   !> No interpolation: pressure difference alone, suction alone, at a quarter of an octave.
   subroutine nodes_of_the_table()
      type(film_reed) :: reed
      type(film_table) :: table
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: x, off(2)
      integer :: i

      call build_paper_table(reed, table, gap, 0.65_wp)
      off = 0.0_wp
      do i = 4*first, 4*last - 1
         x = 2.0_wp**floor(0.25_wp*real(i, wp))*(1.0_wp + 0.25_wp*real(modulo(i, 4), wp))
         call reed%static_film%solve(gap, 1.0_wp, [gap*(x - 1.0_wp)], state, error)
         off = max(off, abs([table%lowest_pressure(x, 2.0_wp*kpa, 0.0_wp)/(2.0_wp*kpa) - minval(state%pressure(:, 0)), &
            & table%lowest_pressure(x, 0.0_wp, 3.0_wp)*state%damping(1, 1)/(3.0_wp*maxval(state%pressure(:, 1))) + 1.0_wp]))
      end do
      call suite%close("at nodes, pressure difference alone", off(1), 0.0_wp, 0.0_wp, 1.0e-12_wp)
      call suite%close("suction alone", off(2), 0.0_wp, 0.0_wp, 1.0e-12_wp)
   end subroutine nodes_of_the_table

   !> At rest and closing the lowest is the lower of the pressures beyond the edges.
   subroutine no_suction()
      type(film_reed) :: reed
      type(film_table) :: table
      real(wp), parameter :: x(3) = [0.1_wp, 1.1_wp, 7.0_wp]

      call build_paper_table(reed, table, gap, 0.0_wp)
      call suite%close("at rest, more pressure inside [Pa]", maxval(abs(table%lowest_pressure(x, 20.0_wp*kpa, 0.0_wp))), &
         & 0.0_wp, 0.0_wp, 1.0e-10_wp)
      call suite%close("closing [Pa]", maxval(abs(table%lowest_pressure(x, 20.0_wp*kpa, -1.0_wp))), 0.0_wp, 0.0_wp, 1.0e-10_wp)
      call suite%close("closing, less pressure inside [kPa]", maxval(table%lowest_pressure(x, -20.0_wp*kpa, -1.0_wp))/kpa, &
         & -20.0_wp, 1.0e-12_wp, 0.0_wp)
      call suite%close("nothing at all [Pa]", maxval(abs(table%lowest_pressure(x, 0.0_wp, 0.0_wp))), 0.0_wp, 0.0_wp, 1.0e-300_wp)
   end subroutine no_suction

   subroutine beyond_its_ends()
      real(wp), parameter :: below(4) = [1.0e-9_wp, 0.0_wp, -3.0_wp, -huge(1.0_wp)]
      type(film_reed) :: reed
      type(film_table) :: table
      real(wp) :: nan, lower, upper

      call build_paper_table(reed, table, gap, 0.0_wp)
      nan = ieee_value(1.0_wp, ieee_quiet_nan)
      lower = table%lowest_pressure(table%lowest, kpa, 0.1_wp)
      upper = table%lowest_pressure(2.0_wp**last, kpa, 0.1_wp)
      call suite%close("below the table: its end", maxval(abs(table%lowest_pressure(below, kpa, 0.1_wp)/lower - 1.0_wp)), &
         & 0.0_wp, 0.0_wp, 1.0e-12_wp)
      call suite%close("above it", maxval(abs(table%lowest_pressure([1.0e9_wp, huge(1.0_wp)], kpa, 0.1_wp)/upper - 1.0_wp)), &
         & 0.0_wp, 0.0_wp, 1.0e-12_wp)
      call suite%close("x NaN: its lower end", table%lowest_pressure(nan, kpa, 0.1_wp), lower, 1.0e-12_wp, 0.0_wp)
      call suite%true("NaN pressures make no low pressure", .not. (table%lowest_pressure(1.0_wp, nan, 0.0_wp) < -kpa &
         & .or. table%lowest_pressure(1.0_wp, kpa, nan) < -kpa))
   end subroutine beyond_its_ends

   !> The lanes keep the lowest they were shown, each its own, and none once silent.
   subroutine lanes_keep_it()
      type(film_reed) :: reed
      type(film_table) :: table
      type(table_lanes) :: lanes
      type(film_valve) :: valve(3)
      real(wp) :: value(film_traces), force, rate, untouched
      real(wp), parameter :: q(1) = 0.7_wp*gap, v(1) = 0.3_wp, still(1) = 0.0_wp

      call build_paper_table(reed, table, gap, 0.0_wp)
      do k = 1, 3
         valve(k) = paper_case(reed, gap*real(k, wp), 10.0_wp*kpa*real(k, wp))
         valve(k)%outlet = kpa*real(k, wp)
      end do
      call new_table_lanes(lanes, reed, table, valve)
      untouched = lanes%lowest_pressure(1)
      call lanes%film_force(2, 0.5_wp, 1.0_wp, q, -v, still, force, rate)
      call suite%close("closing: the outlet's pressure [kPa]", lanes%lowest_pressure(2)/kpa, 2.0_wp, 1.0e-12_wp, 0.0_wp)
      call lanes%film_force(2, 0.0_wp, 1.0_wp, q, -v, still, force, rate)
      call suite%close("or the inlet's [kPa]", lanes%lowest_pressure(2)/kpa, 0.0_wp, 0.0_wp, 1.0e-12_wp)
      call lanes%film_force(2, 0.5_wp, 1.0_wp, q, v, still, force, rate)
      call lanes%trace_values(2, 0.5_wp, 1.0_wp, q, v, value)
      call suite%true("opening it sucks: "//to_text(1.0e-3_wp*value(10), 3)//" kPa", value(10) < -2.0_wp*kpa)
      call suite%close("as the film solved in place [kPa]", lanes%lowest_pressure(2)/kpa, value(10)/kpa, 6.0e-3_wp, 0.0_wp)
      call lanes%film_force(2, 0.5_wp, 1.0_wp, q, 0.1_wp*v, still, force, rate)
      call suite%close("it stays [kPa]", lanes%lowest_pressure(2)/kpa, value(10)/kpa, 6.0e-3_wp, 0.0_wp)
      call suite%true("the others saw nothing", all(lanes%lowest_pressure([1, 3]) >= untouched))
      call lanes%silence(3)
      call lanes%film_force(3, 0.5_wp, 1.0_wp, q, v, still, force, rate)
      call suite%true("nor does a silent lane", lanes%lowest_pressure(3) >= untouched)
   end subroutine lanes_keep_it

   !> Table II at 20 kPa: one static shape sucks some 4 % harder than four modes (-41.1 to -39.3 kPa).
   subroutine runs_beside_film()
      type(film_reed) :: reed
      type(film_valve) :: valve(1)
      type(lane_outcome) :: film, table
      real(wp) :: fine_time(2001), untraced
      integer :: i

      fine_time = [(1.0e-5_wp*real(i, wp), i=0, 2000)]
      reed = paper_reed(4)
      valve(1) = paper_case(reed, gap, 20.0_wp*kpa)
      call run_film(reed, valve(1), lane_settings(t_end=20.0e-3_wp), no_times, film)
      call run_table(reed, valve, lane_settings(t_end=20.0e-3_wp), no_times, table)
      call suite%close("lowest of film [kPa]", film%lowest_pressure(1)/kpa, -39.33_wp, 0.0_wp, 0.1_wp)
      call suite%close("of film_table [kPa]", table%lowest_pressure(1)/kpa, -41.0_wp, 0.0_wp, 0.3_wp)
      untraced = table%lowest_pressure(1)
      call run_table(reed, valve, lane_settings(t_end=20.0e-3_wp), fine_time, table)
      call suite%close("with traces the same [kPa]", table%lowest_pressure(1)/kpa, untraced/kpa, 1.0e-14_wp, 0.0_wp)
      call suite%close("their lowest, each from a solution [kPa]", untraced/kpa, minval(table%trace(:, 10, 1))/kpa, &
         & 0.0_wp, 0.3_wp)
   end subroutine runs_beside_film

end program test_lowest_pressure
