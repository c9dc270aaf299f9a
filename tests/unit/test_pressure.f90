!> Pressure histories: the square wave of Eq. (20), its corners and stops; traces between, at and outside their samples.
program test_pressure
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan, ieee_positive_inf
   use rv_kinds, only : wp
   use rv_error, only : error_type, rv_bad_input
   use rv_monotone_cubic, only : monotone_slopes, cubic_value
   use rv_pressure, only : pressure_history, square_wave, new_square_wave, pressure_trace, new_pressure_trace
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: ms = 1.0e-3_wp

   call test_equation_20()
   call test_corners()
   call test_period()
   call test_square_stops()
   call test_square_events()
   call test_event_stops()
   call test_square_span()
   call test_square_refused()
   call test_trace_values()
   call test_trace_stops()
   call test_trace_refused()
   call suite%finish()

contains

   !> Every branch of the print, T = 40 ms, t_d = 1 ms; R times the slope of the ramp bounds the error of t.
   subroutine test_equation_20()
      type(square_wave) :: wave
      real(wp) :: t, r, outlet
      integer :: n

      wave = paper_wave()
      do n = 0, 800
         t = 0.05_wp*ms*real(n, wp)
         call wave%factors(t, r, outlet)
         call suite%close("R at "//to_text(0.05_wp*real(n, wp), 4)//" ms", r, printed_r(t, 40.0_wp*ms, ms), &
            & rtol=0.0_wp, atol=4.0_wp*epsilon(1.0_wp)*40.0_wp)
      end do
      call suite%close("outlet factor", outlet, 1.0_wp, rtol=0.0_wp, atol=0.0_wp)
   end subroutine test_equation_20

   real(wp) function printed_r(t, period, ramp) result(r)
      real(wp), intent(in) :: t, period, ramp

      if (t < 0.5_wp*ramp) then
         r = 0.5_wp + t/ramp
      else if (t < 0.5_wp*period - 0.5_wp*ramp) then
         r = 1.0_wp
      else if (t < 0.5_wp*period + 0.5_wp*ramp) then
         r = 1.0_wp - (t - 0.5_wp*period + 0.5_wp*ramp)/ramp
      else if (t < period - 0.5_wp*ramp) then
         r = 0.0_wp
      else
         r = (t - period + 0.5_wp*ramp)/ramp
      end if
   end function printed_r

   !> At the corners and centres, in binary fractions that lose nothing: exact.
   subroutine test_corners()
      type(square_wave) :: wave
      type(error_type), allocatable :: error
      real(wp), parameter :: t(9) = [0.0_wp, 0.25_wp, 3.75_wp, 4.0_wp, 4.25_wp, 7.75_wp, 8.0_wp, 8.25_wp, 12.125_wp]
      real(wp), parameter :: r(9) = [0.5_wp, 1.0_wp, 1.0_wp, 0.5_wp, 0.0_wp, 0.0_wp, 0.5_wp, 1.0_wp, 0.25_wp]
      real(wp) :: inlet, outlet
      integer :: n

      call new_square_wave(wave, 8.0_wp, 0.5_wp, error)
      call suite%no_error("wave of 8 s", error)
      do n = 1, size(t)
         call wave%factors(t(n), inlet, outlet)
         call suite%close("R at "//to_text(t(n))//" s", inlet, r(n), rtol=0.0_wp, atol=0.0_wp)
      end do
      wave = paper_wave()
      call wave%factors(0.0_wp, inlet, outlet)
      call suite%close("R at the start", inlet, 0.5_wp, rtol=0.0_wp, atol=0.0_wp)
   end subroutine test_corners

   !> R repeats after each period; the rounding of t, divided by t_d, is all that may differ.
   subroutine test_period()
      type(square_wave) :: wave
      real(wp) :: t, first, later, outlet
      integer :: n, cycle_number

      wave = paper_wave()
      do n = 0, 40
         t = (19.0_wp + 0.05_wp*real(n, wp))*ms
         call wave%factors(t, first, outlet)
         do cycle_number = 1, 1000, 333
            call wave%factors(t + 40.0_wp*ms*real(cycle_number, wp), later, outlet)
            call suite%close("R at "//to_text(t/ms, 5)//" ms, cycle "//to_text(cycle_number), later, first, &
               & rtol=0.0_wp, atol=2.0_wp*epsilon(1.0_wp)*40.0_wp*real(cycle_number + 1, wp))
         end do
      end do
   end subroutine test_period

   subroutine test_square_stops()
      type(square_wave) :: wave

      wave = paper_wave()
      call close_list("one period", wave%stops(40.0_wp*ms), [0.5_wp, 19.5_wp, 20.5_wp, 39.5_wp, 40.0_wp]*ms)
      call close_list("half a ramp", wave%stops(0.25_wp*ms), [0.25_wp]*ms)
      call close_list("end on a corner", wave%stops(19.5_wp*ms), [0.5_wp, 19.5_wp]*ms)
      call close_list("end in a ramp", wave%stops(20.0_wp*ms), [0.5_wp, 19.5_wp, 20.0_wp]*ms)
      call close_list("end in the rising ramp", wave%stops(39.75_wp*ms), [0.5_wp, 19.5_wp, 20.5_wp, 39.5_wp, &
         & 39.75_wp]*ms)
      call close_list("two periods and a half", wave%stops(100.0_wp*ms), &
         & [0.5_wp, 19.5_wp, 20.5_wp, 39.5_wp, 40.5_wp, 59.5_wp, 60.5_wp, 79.5_wp, 80.5_wp, 99.5_wp, 100.0_wp]*ms)
   end subroutine test_square_stops

   !> Event and cycle's end are stops to the last bit: no step begins before and ends after them by a rounding.
   subroutine test_event_stops()
      type(square_wave) :: wave
      type(error_type), allocatable :: error
      real(wp) :: period, transition
      integer :: i, k, missed

      missed = 0
      do i = 1, 60
         do k = 1, 20
            period = real(i, wp)*ms/3.0_wp
            transition = 0.021_wp*real(k, wp)*period
            call new_square_wave(wave, period, transition, error)
            associate (stop => wave%stops(1.2_wp*period))
               if (all(abs(stop - wave%event) > 0.0_wp) .or. all(abs(stop - wave%cycle_end) > 0.0_wp)) missed = missed + 1
            end associate
         end do
      end do
      call suite%equal("waves whose event or cycle's end is no stop", missed, 0)
   end subroutine test_event_stops

   !> The event is the start of the falling ramp unless given; given, it is a stop too.
   subroutine test_square_events()
      type(square_wave) :: wave
      type(error_type), allocatable :: error

      wave = paper_wave()
      call suite%close("start [s]", wave%start, 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("event [s]", wave%event, 19.5_wp*ms, rtol=1.0e-15_wp, atol=0.0_wp)
      call suite%close("end of the first closing [s]", wave%cycle_end, 39.5_wp*ms, rtol=1.0e-15_wp, atol=0.0_wp)
      call new_square_wave(wave, 40.0_wp*ms, ms, error, event=10.0_wp*ms)
      call suite%no_error("wave with its own event", error)
      call suite%close("own event [s]", wave%event, 10.0_wp*ms, rtol=0.0_wp, atol=0.0_wp)
      call close_list("stops with own event", wave%stops(40.0_wp*ms), &
         & [0.5_wp, 10.0_wp, 19.5_wp, 20.5_wp, 39.5_wp, 40.0_wp]*ms)
      call new_square_wave(wave, 40.0_wp*ms, ms, error, event=19.5_wp*ms*(1.0_wp + 1.0e-10_wp))
      call suite%no_error("wave with its event next to a corner", error)
      call close_list("an event next to a corner takes its place", wave%stops(40.0_wp*ms), &
         & [0.5_wp, 19.5_wp*(1.0_wp + 1.0e-10_wp), 20.5_wp, 39.5_wp, 40.0_wp]*ms)
      call new_square_wave(wave, 40.0_wp*ms, ms, error, event=20.5_wp*ms*(1.0_wp - 1.0e-10_wp))
      call suite%no_error("wave with its event just before a corner", error)
      call close_list("an event just before a corner takes its place", wave%stops(40.0_wp*ms), &
         & [0.5_wp, 19.5_wp, 20.5_wp*(1.0_wp - 1.0e-10_wp), 39.5_wp, 40.0_wp]*ms)
      call new_square_wave(wave, 40.0_wp*ms, ms, error, event=10.0_wp*ms)
      call suite%no_error("wave with its own event", error)
      call close_list("event after the end", wave%stops(5.0_wp*ms), [0.5_wp, 5.0_wp]*ms)
      call new_square_wave(wave, 40.0_wp*ms, ms, error, event=59.5_wp*ms)
      call suite%no_error("event in the second cycle", error)
      call suite%close("end of the second closing [s]", wave%cycle_end, 79.5_wp*ms, rtol=1.0e-15_wp, atol=0.0_wp)
      call new_square_wave(wave, 40.0_wp*ms, ms, error, event=39.4_wp*ms)
      call suite%close("end of a closing just before the rise [s]", wave%cycle_end, 39.5_wp*ms, rtol=1.0e-15_wp, atol=0.0_wp)
      call new_square_wave(wave, 40.0_wp*ms, ms, error, event=-ms)
      call suite%fails("event before the wave", error, "must not start before")
      call suite%close("a default wave is left", wave%event + wave%cycle_end, 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
   end subroutine test_square_events

   !> The pressure difference swings between that of R = 0 and that of R = 1.
   subroutine test_square_span()
      type(square_wave) :: wave

      wave = paper_wave()
      call suite%close("span, inlet alone [Pa]", wave%span(20.0e3_wp, 0.0_wp), 20.0e3_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("span, small back pressure [Pa]", wave%span(20.0e3_wp, 5.0e3_wp), 15.0e3_wp, rtol=0.0_wp, &
         & atol=0.0_wp)
      call suite%close("span, large back pressure [Pa]", wave%span(20.0e3_wp, 15.0e3_wp), 15.0e3_wp, rtol=0.0_wp, &
         & atol=0.0_wp)
      call suite%close("span, suction inlet [Pa]", wave%span(-20.0e3_wp, 5.0e3_wp), 25.0e3_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("span, suction outlet [Pa]", wave%span(2.0e3_wp, -5.0e3_wp), 7.0e3_wp, rtol=0.0_wp, atol=0.0_wp)
   end subroutine test_square_span

   subroutine test_square_refused()
      real(wp), parameter :: period(6) = [0.0_wp, -40.0_wp, 40.0_wp, 40.0_wp, 40.0_wp, 40.0_wp]
      real(wp), parameter :: ramp(6) = [1.0_wp, 1.0_wp, 0.0_wp, -1.0_wp, 20.0_wp, 30.0_wp]
      real(wp) :: nan
      integer :: n

      do n = 1, 6
         call refused_wave(period(n), ramp(n))
      end do
      nan = ieee_value(1.0_wp, ieee_quiet_nan)
      call refused_wave(nan, 1.0_wp)
      call refused_wave(40.0_wp, nan)
   end subroutine test_square_refused

   subroutine refused_wave(period, ramp)
      real(wp), intent(in) :: period, ramp
      type(square_wave) :: wave
      type(error_type), allocatable :: error
      character(len=:), allocatable :: what

      what = "period "//to_text(period)//", ramp "//to_text(ramp)
      call new_square_wave(wave, period, ramp, error)
      call suite%fails(what, error, "0 < transition < period/2")
      if (allocated(error)) call suite%equal(what//": code", error%code, rv_bad_input)
      call suite%close(what//": a default wave is left", wave%event + wave%cycle_end, 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
   end subroutine refused_wave

   !> Samples come back, straight stretches stay straight, knees do not overshoot, inlet and outlet keep apart,
   !> and outside the samples the first and last value hold.
   subroutine test_trace_values()
      type(pressure_trace) :: trace
      real(wp) :: inlet, outlet, slope(6)
      real(wp), parameter :: t(6) = [500.0_wp, 501.0_wp, 502.0_wp, 502.5_wp, 504.0_wp, 505.0_wp]*ms
      real(wp), parameter :: inlet_at(6) = [60.0e3_wp, 60.0e3_wp, 40.0e3_wp, 30.0e3_wp, 0.0_wp, 0.0_wp]
      real(wp), parameter :: outlet_at(6) = [1.0e3_wp, 2.0e3_wp, 3.0e3_wp, 3.5e3_wp, 5.0e3_wp, 6.0e3_wp]
      real(wp) :: x
      integer :: n

      trace = sample_trace(t, inlet_at, outlet_at, 501.0_wp*ms)
      do n = 1, 6
         call trace%factors(t(n), inlet, outlet)
         call suite%close("inlet at sample "//to_text(n)//" [Pa]", inlet, inlet_at(n), rtol=1.0e-15_wp, atol=1.0e-11_wp)
         call suite%close("outlet at sample "//to_text(n)//" [Pa]", outlet, outlet_at(n), rtol=1.0e-15_wp, atol=0.0_wp)
      end do
      call suite%close("span of the samples [Pa]", trace%span(1.0_wp, 1.0_wp), 59.0e3_wp, rtol=1.0e-15_wp, atol=0.0_wp)
      call suite%close("span, outlet outweighing [Pa]", trace%span(0.0_wp, 2.0_wp), 12.0e3_wp, rtol=1.0e-15_wp, &
         & atol=0.0_wp)
      slope = monotone_slopes(t, inlet_at)
      do n = 1, 5
         x = t(n) + 0.3_wp*(t(n + 1) - t(n))
         call trace%factors(x, inlet, outlet)
         call suite%close("inlet between the samples at "//to_text(x, 7)//" s [Pa]", inlet, &
            & cubic_value(t(n:n + 1), inlet_at(n:n + 1), slope(n:n + 1), x), rtol=1.0e-15_wp, atol=1.0e-11_wp)
         ! the rounding of t, some 1e-16 s, times the outlet's 1e6 Pa/s, is 1e-10 Pa
         call suite%close("straight outlet at "//to_text(x, 7)//" s [Pa]", outlet, &
            & 1.0e3_wp + 1.0e6_wp*(x - 500.0_wp*ms), rtol=0.0_wp, atol=1.0e-9_wp)
      end do
      call outside(trace, 0.0_wp, 60.0e3_wp, 1.0e3_wp)
      call outside(trace, -huge(1.0_wp), 60.0e3_wp, 1.0e3_wp)
      call outside(trace, 505.1_wp*ms, 0.0_wp, 6.0e3_wp)
      call outside(trace, huge(1.0_wp), 0.0_wp, 6.0e3_wp)
   end subroutine test_trace_values

   subroutine outside(trace, t, inlet_reference, outlet_reference)
      type(pressure_trace), intent(in) :: trace
      real(wp), intent(in) :: t, inlet_reference, outlet_reference
      real(wp) :: inlet, outlet

      call trace%factors(t, inlet, outlet)
      call suite%close("inlet held at "//to_text(t, 6)//" s [Pa]", inlet, inlet_reference, rtol=1.0e-15_wp, &
         & atol=1.0e-11_wp)
      call suite%close("outlet held at "//to_text(t, 6)//" s [Pa]", outlet, outlet_reference, rtol=1.0e-15_wp, &
         & atol=0.0_wp)
   end subroutine outside

   subroutine test_trace_stops()
      type(pressure_trace) :: trace
      real(wp), parameter :: t(3) = [500.0_wp, 502.0_wp, 510.0_wp]*ms
      real(wp), parameter :: p(3) = [9.0_wp, 8.0_wp, 1.0_wp]

      trace = sample_trace(t, p, p, 502.0_wp*ms)
      call suite%close("trace: start [s]", trace%start, 500.0_wp*ms, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("trace: event [s]", trace%event, 502.0_wp*ms, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("trace: end of the closing [s]", trace%cycle_end, 510.0_wp*ms, rtol=0.0_wp, atol=0.0_wp)
      call close_list("trace", trace%stops(505.0_wp*ms), [502.0_wp, 505.0_wp]*ms)
      call close_list("trace that ends before its event", trace%stops(501.0_wp*ms), [501.0_wp]*ms)
      trace = sample_trace(t, p, p, t(1))
      call close_list("trace with the event at its start", trace%stops(505.0_wp*ms), [505.0_wp]*ms)
      trace = sample_trace(t, p, p, t(3))
      call close_list("trace with the event at its end", trace%stops(510.0_wp*ms), [510.0_wp]*ms)
   end subroutine test_trace_stops

   subroutine test_trace_refused()
      real(wp), parameter :: t(3) = [0.0_wp, 1.0_wp, 2.0_wp]
      real(wp), parameter :: p(3) = [5.0_wp, 4.0_wp, 3.0_wp]
      real(wp) :: nan, infinity

      nan = ieee_value(1.0_wp, ieee_quiet_nan)
      infinity = ieee_value(1.0_wp, ieee_positive_inf)
      call refused_trace("no sample", t(:0), p(:0), p(:0), 0.0_wp, "two or more samples")
      call refused_trace("one sample", t(:1), p(:1), p(:1), 0.0_wp, "two or more samples")
      call refused_trace("inlet too short", t, p(:2), p, 1.0_wp, "two or more samples")
      call refused_trace("outlet too short", t, p, p(:2), 1.0_wp, "two or more samples")
      call refused_trace("NaN in time", [0.0_wp, nan, 2.0_wp], p, p, 1.0_wp, "NaN or infinity")
      call refused_trace("NaN in the inlet", t, [5.0_wp, nan, 3.0_wp], p, 1.0_wp, "NaN or infinity")
      call refused_trace("infinite outlet", t, p, [5.0_wp, 4.0_wp, infinity], 1.0_wp, "NaN or infinity")
      call refused_trace("equal times", [0.0_wp, 1.0_wp, 1.0_wp], p, p, 1.0_wp, "must rise")
      call refused_trace("falling times", [0.0_wp, 2.0_wp, 1.0_wp], p, p, 1.0_wp, "must rise")
      call refused_trace("event before", t, p, p, -0.1_wp, "within the pressure trace")
      call refused_trace("event after", t, p, p, 2.1_wp, "within the pressure trace")
      call refused_trace("event NaN", t, p, p, nan, "within the pressure trace")
   end subroutine test_trace_refused

   subroutine refused_trace(what, time, inlet, outlet, event, part)
      character(len=*), intent(in) :: what, part
      real(wp), intent(in) :: time(:), inlet(:), outlet(:), event
      type(pressure_trace) :: trace
      type(error_type), allocatable :: error

      call new_pressure_trace(trace, time, inlet, outlet, event, error)
      call suite%fails(what, error, part)
      if (allocated(error)) call suite%equal(what//": code", error%code, rv_bad_input)
      call suite%close(what//": a default trace is left", trace%event + trace%cycle_end, 0.0_wp, rtol=0.0_wp, &
         & atol=0.0_wp)
   end subroutine refused_trace

   function paper_wave() result(wave)
      type(square_wave) :: wave
      type(error_type), allocatable :: error

      call new_square_wave(wave, 40.0_wp*ms, ms, error)
      if (allocated(error)) call suite%no_error("the paper's wave", error)
   end function paper_wave

   function sample_trace(time, inlet, outlet, event) result(trace)
      real(wp), intent(in) :: time(:), inlet(:), outlet(:), event
      type(pressure_trace) :: trace
      type(error_type), allocatable :: error

      call new_pressure_trace(trace, time, inlet, outlet, event, error)
      if (allocated(error)) call suite%no_error("a valid trace", error)
   end function sample_trace

   subroutine close_list(what, value, reference)
      character(len=*), intent(in) :: what
      real(wp), intent(in) :: value(:), reference(:)
      integer :: n

      call suite%equal("stops, "//what//": how many", size(value), size(reference))
      do n = 1, min(size(value), size(reference))
         call suite%close("stops, "//what//": number "//to_text(n)//" [s]", value(n), reference(n), &
            & rtol=4.0_wp*epsilon(1.0_wp), atol=0.0_wp)
      end do
   end subroutine close_list

end program test_pressure
