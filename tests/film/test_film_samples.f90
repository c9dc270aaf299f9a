!> Trace samples and pressure fields of the film models, lane by lane, against the film solved beside them.
program test_film_samples
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_film_lanes, only : film_lanes, film_traces, new_film_lanes
   use rv_film_reed, only : film_reed
   use rv_film_table, only : film_table, new_film_table
   use rv_film_valve, only : film_valve
   use rv_reynolds, only : film_state, film_type
   use rv_table_lanes, only : new_table_lanes, table_lanes
   use rv_text, only : to_text
   use rv_valve_lanes, only : valve_lanes
   use check, only : suite_type
   use paper_film, only : oil, paper_case, paper_reed
   use paper_valve, only : kpa, mm
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: gap = 0.05_wp*mm
   real(wp), parameter :: inlet = 0.7_wp, outlet = 0.4_wp   !! factors of the pressure history
   real(wp), parameter :: speed(2) = [-0.03_wp, 0.02_wp]    !! of the tip, closing and opening [m s-1]

   call samples_of_film()
   call samples_of_table()
   call suite%finish()

contains

   !> A case with everything its own: gap, liquid, pressures.
   function own_case(reed, number) result(valve)
      type(film_reed), intent(in) :: reed
      integer, intent(in) :: number
      type(film_valve) :: valve

      valve = paper_case(reed, gap*real(number, wp), 10.0_wp*kpa*real(number + 1, wp))
      valve%outlet = 3.0_wp*kpa*real(number, wp)
      valve%viscosity = oil%viscosity*(1.5_wp - 0.3_wp*real(number, wp))
   end function own_case

   subroutine samples_of_film()
      type(film_lanes) :: lanes
      type(film_reed) :: reed
      type(film_valve) :: valve
      integer :: i

      reed = paper_reed(4, 0.65_wp)
      valve = own_case(reed, 1)
      call new_film_lanes(lanes, reed, valve)
      do i = 1, 2
         call check_sample("film, "//to_text(speed(i))//" m/s", lanes, 1, valve, reed, reed%film, &
            & gap*[1.2_wp, 0.1_wp, -0.05_wp, 0.02_wp], speed(i)*[1.0_wp, 0.1_wp, 0.05_wp, -0.1_wp])
      end do
      call check_closed("film closed", lanes, [-1.01_wp*gap, 0.0_wp, 0.0_wp, 0.0_wp])
   end subroutine samples_of_film

   subroutine samples_of_table()
      type(table_lanes) :: lanes
      type(film_reed) :: reed
      type(film_table) :: table
      type(film_valve) :: valve(3)
      type(error_type), allocatable :: error
      integer :: i, k

      reed = paper_reed(1)
      do k = 1, 3
         valve(k) = own_case(reed, k)
      end do
      call new_film_table(table, reed, gap, error)
      if (allocated(error)) error stop "the paper's film table is refused"
      call new_table_lanes(lanes, reed, table, valve)
      do k = 1, 3
         do i = 1, 2
            call check_sample("film_table, lane "//to_text(k)//", "//to_text(speed(i))//" m/s", lanes, k, valve(k), reed, &
               & reed%static_film, [1.2_wp*gap], [speed(i)])
         end do
      end do
      call check_closed("film_table closed", lanes, [-1.01_wp*gap])
   end subroutine samples_of_table

   !> One sample and its field against the film of that case.
   subroutine check_sample(name, lanes, lane, valve, reed, film, q, v)
      character(len=*), intent(in) :: name
      class(valve_lanes), intent(inout) :: lanes
      integer, intent(in) :: lane
      type(film_valve), intent(in) :: valve
      type(film_reed), intent(in) :: reed
      type(film_type), intent(in) :: film
      real(wp), intent(in) :: q(:), v(:)
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: value(film_traces), field(lanes%nodes), p(lanes%nodes), p_in, p_out, in, out, force, rate

      p_in = inlet*valve%inlet
      p_out = outlet*valve%outlet
      call film%solve(valve%gap, valve%viscosity, q, state, error)
      if (allocated(error)) error stop "the film is refused"
      p = film%pressure_of(state, v, p_in - p_out)
      call film%inflow(state, v, p_in - p_out, in, out)
      call lanes%trace_values(lane, inlet, outlet, q, v, value)
      call suite%close(name//": tip [mm]", value(1)/mm, sum(q)/mm, 1.0e-14_wp, 0.0_wp)
      call suite%close("its velocity [m/s]", value(2), sum(v), 1.0e-14_wp, 0.0_wp)
      call suite%close("inlet [kPa]", value(3)/kpa, p_in/kpa, 1.0e-14_wp, 0.0_wp)
      call suite%close("outlet [kPa]", value(4)/kpa, p_out/kpa, 1.0e-14_wp, 0.0_wp)
      call suite%close("film force [N]", value(5), -sum(state%damping(1, :)*v), 1.0e-12_wp, 0.0_wp)
      call lanes%film_force(lane, inlet, outlet, q, v, 0.0_wp*v, force, rate)
      call suite%close("as the run sees it [N], to the table's accuracy", force, value(5), 1.0e-4_wp, 0.0_wp)
      call suite%close("part A [N]", value(6), sum(reed%root_weight*p), 1.0e-12_wp, 0.0_wp)
      call suite%close("parts A and B [N]", value(6) + value(7), sum(reed%land_weight*p), 1.0e-12_wp, 0.0_wp)
      call suite%close("part C [N]", value(8), (p_in - p_out)*reed%hole_area, 1.0e-12_wp, 0.0_wp)
      call suite%close("flow out at the free edges [mm3/s]", value(9)/mm**3, out/mm**3, 1.0e-12_wp, 0.0_wp)
      call suite%true("it is not the flow in at the hole", abs(in - out) > 1.0e-3_wp*abs(out))
      call suite%close("lowest film pressure [kPa]", value(10)/kpa, (p_out + minval(p))/kpa, 1.0e-12_wp, 0.0_wp)
      call lanes%pressure_field(lane, inlet, outlet, q, v, field)
      call suite%close("pressure field, furthest [kPa]", maxval(abs(field - p_out - p))/kpa, 0.0_wp, 0.0_wp, 1.0e-10_wp)
      call suite%close("its lowest [kPa]", minval(field)/kpa, value(10)/kpa, 1.0e-12_wp, 0.0_wp)
   end subroutine check_sample

   !> What needs a film is not a number.
   subroutine check_closed(name, lanes, q)
      character(len=*), intent(in) :: name
      class(valve_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: q(:)
      real(wp) :: value(film_traces), field(lanes%nodes)

      call lanes%trace_values(1, inlet, outlet, q, 0.0_wp*q, value)
      call suite%true(name//": motion and pressures of its sample are numbers, no more", &
         & .not. any(ieee_is_nan(value(:4))) .and. all(ieee_is_nan(value(5:))))
      call lanes%pressure_field(1, inlet, outlet, q, 0.0_wp*q, field)
      call suite%true("nor is its field", all(ieee_is_nan(field)))
   end subroutine check_closed

end program test_film_samples
