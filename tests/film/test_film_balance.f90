!> Conservation along a run: volume at every step, energy over a closing event; and films that close to nothing.
program test_film_balance
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_film_reed, only : film_reed
   use rv_film_valve, only : film_valve
   use rv_lanes, only : lane_outcome, lane_settings, run_lanes
   use rv_reynolds, only : film_state
   use rv_status, only : status_film_closed, status_name, status_ok
   use rv_text, only : to_text
   use rv_valve_lanes, only : valve_lanes
   use check, only : suite_type
   use paper_film, only : no_times, oil, paper_case, paper_reed, run_film, run_table
   use paper_valve, only : kpa, mm, ms, wave_40ms
   use watched_film, only : balance_type, new_watched_lanes, watched_lanes
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: start = 19.5_wp*ms, corner = 20.5_wp*ms, until = 23.5_wp*ms   !! of the closing event
   integer, parameter :: parts = 300   !! samples a millisecond

   call volume()
   call energy(1.0e-6_wp, 1.0e-6_wp)
   call energy(1.0e-7_wp, 2.0e-8_wp)
   call pulled_shut()
   call hard_cases()
   call suite%finish()

contains

   subroutine run_watched(reed, valve, rtol, time, outcome, balance)
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(in) :: valve
      real(wp), intent(in) :: rtol, time(:)
      type(lane_outcome), intent(out) :: outcome
      type(balance_type), target, intent(inout) :: balance
      type(watched_lanes), allocatable :: watched
      class(valve_lanes), allocatable :: lanes
      type(lane_settings) :: settings

      settings%t_end = until
      settings%rtol = rtol
      allocate(watched)
      call new_watched_lanes(watched, reed, valve, balance)
      call move_alloc(watched, lanes)
      call run_lanes(lanes, wave_40ms(), settings, time, outcome)
   end subroutine run_watched

   !> Inflow less outflow is the swept rate at every step of opening and closing.
   subroutine volume()
      real(wp), parameter :: beta(2) = [0.0_wp, 0.65_wp]
      type(film_reed) :: reed
      type(lane_outcome) :: outcome
      type(balance_type), target :: balance
      integer :: i

      do i = 1, 2
         balance = balance_type()
         reed = paper_reed(4, beta(i))
         call run_watched(reed, paper_case(reed, 0.05_wp*mm, 40.0_wp*kpa), 1.0e-6_wp, no_times, outcome, balance)
         call suite%true("elongation "//to_text(beta(i))//": "//to_text(balance%states)//" states of "//to_text(outcome%steps) &
            & //" steps seen", balance%states >= outcome%steps .and. outcome%steps > 50)
         call suite%close("volume balance, worst of them", balance%worst, 0.0_wp, 0.0_wp, 1.0e-10_wp)
      end do
   end subroutine volume

   !> The pressure's work over a closing event is the energy gained plus what liquid and film take, by Simpson's rule.
   subroutine energy(rtol, limit)
      real(wp), intent(in) :: rtol, limit
      type(film_reed) :: reed
      type(film_valve) :: valve
      type(lane_outcome) :: outcome
      type(balance_type), target :: balance
      real(wp), allocatable :: time(:)
      real(wp) :: work, loss, gained, power(2), weight, stored
      integer :: k, last

      reed = paper_reed(4)
      valve = paper_case(reed, 0.05_wp*mm, 20.0_wp*kpa)
      last = nint((until - start)/ms)*parts
      time = [(start + (until - start)*real(k, wp)/real(last, wp), k = 0, last)]
      time(parts + 1) = corner
      time(last + 1) = until
      call run_watched(reed, valve, rtol, time, outcome, balance)
      work = 0.0_wp
      loss = 0.0_wp
      do k = 0, last
         weight = ms/real(3*parts, wp)*merge(4.0_wp, 2.0_wp, mod(k, 2) == 1)
         if (k == 0 .or. k == last) weight = 0.5_wp*weight
         power = powers(reed, valve, time(k + 1), outcome%trace(k + 1, :4, 1), outcome%trace(k + 1, 5:, 1))
         work = work + weight*power(1)
         loss = loss + weight*power(2)
      end do
      stored = energy_of(valve, outcome%trace(1, :4, 1), outcome%trace(1, 5:, 1))
      gained = energy_of(valve, outcome%trace(last + 1, :4, 1), outcome%trace(last + 1, 5:, 1)) - stored
      call suite%true("tolerance "//to_text(rtol)//": stored "//to_text(1.0e6_wp*stored, 4)//" uJ, gained " &
         & //to_text(1.0e6_wp*gained, 4)//" uJ, work "//to_text(1.0e6_wp*work, 4)//" uJ, lost "//to_text(1.0e6_wp*loss, 4) &
         & //" uJ", loss > 0.0_wp)
      call suite%close("work less gain and loss, over the energy stored", (work - gained - loss)/stored, 0.0_wp, 0.0_wp, limit)
   end subroutine energy

   !> Power of the pressure, and that taken by liquid and film [W].
   function powers(reed, valve, time, q, v) result(power)
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(in) :: valve
      real(wp), intent(in) :: time, q(:), v(:)
      real(wp) :: power(2), inlet, outlet
      type(film_state) :: state
      type(error_type), allocatable :: error

      associate (wave => wave_40ms())
         call wave%factors(time, inlet, outlet)
      end associate
      call reed%film%solve(valve%gap, oil%viscosity, q, state, error)
      if (allocated(error)) error stop "the film has closed"
      power(1) = (valve%inlet*inlet - valve%outlet*outlet)*dot_product(reed%hole + state%land, v)
      power(2) = dot_product(v, matmul(valve%damping + state%damping, v))
   end function powers

   !> Kinetic and elastic energy [J].
   pure real(wp) function energy_of(valve, q, v)
      type(film_valve), intent(in) :: valve
      real(wp), intent(in) :: q(:), v(:)

      energy_of = 0.5_wp*(dot_product(v, matmul(valve%mass, v)) + dot_product(q, valve%stiffness*q))
   end function energy_of

   !> An outlet pressure pulls the reed into its seat: the film is closed in the end, told with time and place.
   subroutine pulled_shut()
      type(film_reed) :: reed
      type(film_valve) :: valve
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      integer :: n

      settings%t_end = 10.0_wp*ms
      do n = 1, 4, 3
         reed = paper_reed(n)
         valve = paper_case(reed, 0.05_wp*mm, 20.0_wp*kpa)
         valve%outlet = 300.0_wp*kpa
         call run_film(reed, valve, settings, [0.0_wp, 10.0_wp*ms], outcome)
         call check_closed(to_text(n)//" modes pulled shut", outcome)
         call suite%true("traces up to then", .not. any(ieee_is_nan(outcome%trace(1, :, 1))))
         call suite%true("and NaN after it", all(ieee_is_nan(outcome%trace(2, :, 1))))
      end do
      call run_table(reed, [valve], settings, no_times, outcome)
      call check_closed("film_table pulled shut", outcome)
      settings%from_equilibrium = .true.
      call run_film(reed, valve, settings, no_times, outcome)
      call check_closed("no equilibrium to start from", outcome)
      call run_table(reed, [valve], settings, no_times, outcome)
      call check_closed("nor for film_table", outcome)
   end subroutine pulled_shut

   subroutine check_closed(name, outcome)
      character(len=*), intent(in) :: name
      type(lane_outcome), intent(in) :: outcome

      call suite%text(name, status_name(outcome%status(1)), "film_closed")
      associate (message => outcome%message(1)%s)
         call suite%true("message: "//message, index(message, "at t = ") == 1 .and. index(message, "close") > 0)
      end associate
   end subroutine check_closed

   !> Tiny and wide gaps, small and huge pressures, either way: numbers and status ok, or an end with a reason.
   subroutine hard_cases()
      real(wp), parameter :: gap(3) = [1.0e-6_wp, 1.0e-3_wp, 0.3_wp]*mm
      real(wp), parameter :: inlet(4) = [1.0e-6_wp, 20.0_wp, 1.0e4_wp, 0.0_wp]*kpa
      type(film_reed) :: reed
      type(film_valve) :: valve
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      integer :: i, k, closed

      reed = paper_reed(2)
      settings%t_end = 21.0_wp*ms
      settings%rtol = 1.0e-4_wp
      settings%max_steps = 20000
      closed = 0
      do i = 1, size(gap)
         do k = 1, size(inlet)
            valve = paper_case(reed, gap(i), inlet(k))
            valve%outlet = merge(0.0_wp, 100.0_wp*kpa, inlet(k) > 0.0_wp)
            call run_film(reed, valve, settings, [10.0_wp, 21.0_wp]*ms, outcome)
            call check_end("film, gap "//to_text(gap(i)/mm)//" mm, "//to_text(inlet(k)/kpa)//" kPa", outcome, closed)
            call run_table(reed, [valve], settings, [10.0_wp, 21.0_wp]*ms, outcome)
            call check_end("film_table", outcome, closed)
         end do
      end do
      call suite%true("films that closed: "//to_text(closed), closed > 0)
   end subroutine hard_cases

   subroutine check_end(name, outcome, closed)
      character(len=*), intent(in) :: name
      type(lane_outcome), intent(in) :: outcome
      integer, intent(inout) :: closed
      logical :: numbers

      numbers = .not. any(ieee_is_nan(outcome%trace(:, :4, 1)))
      associate (status => outcome%status(1), message => outcome%message(1)%s)
         if (status == status_film_closed) closed = closed + 1
         call suite%true(name//": "//status_name(status)//" "//message, any(status == [status_ok, status_film_closed]) &
            & .and. ((status == status_ok) .eqv. numbers) .and. ((status == status_ok) .eqv. message == ""))
      end associate
   end subroutine check_end

end program test_film_balance
