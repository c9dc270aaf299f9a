!> Pressure histories: how inlet and outlet pressure run with time.
!>
!> A history gives two factors; a case multiplies them with its own amplitudes, so that
!> cases of different pressure share one history. The square wave's factors are R(t) of
!> Eq. (20) and 1, on amplitudes in Pa; a trace's are the pressures themselves in Pa, on amplitude 1.
module rv_pressure
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use rv_kinds, only : wp
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_monotone_cubic, only : monotone_slopes, cubic_value
   implicit none
   private
   public :: pressure_history, square_wave, new_square_wave, pressure_trace, new_pressure_trace

   !> One history over start <= t.
   type, abstract :: pressure_history
      real(wp) :: start = 0.0_wp      !! first instant [s]
      real(wp) :: event = 0.0_wp      !! start of the closing event [s]
      real(wp) :: cycle_end = 0.0_wp  !! end of the first closing event: the next rise, or the history's end [s]
   contains
      procedure(factors_at), deferred :: factors
      procedure(span_of), deferred :: span
      procedure(stops_until), deferred :: stops
      procedure :: is_constant => not_known
   end type pressure_history

   abstract interface
      !> The two factors at time t.
      pure subroutine factors_at(self, t, inlet, outlet)
         import :: pressure_history, wp
         class(pressure_history), intent(in) :: self
         real(wp), intent(in) :: t               !! [s]
         real(wp), intent(out) :: inlet, outlet  !! [-] or [Pa]
      end subroutine factors_at

      !> Largest |p_in - p_out| of a case with given amplitudes, over all time.
      pure real(wp) function span_of(self, inlet, outlet)
         import :: pressure_history, wp
         class(pressure_history), intent(in) :: self
         real(wp), intent(in) :: inlet, outlet   !! amplitudes [Pa] or [-]
      end function span_of

      !> Instants where an integrator must not step across: corners and the event, rising, the last one t_end.
      pure function stops_until(self, t_end) result(t)
         import :: pressure_history, wp
         class(pressure_history), intent(in) :: self
         real(wp), intent(in) :: t_end   !! [s]
         real(wp), allocatable :: t(:)   !! [s]
      end function stops_until
   end interface

   !> Square wave of period T with linear ramps of duration t_d centred on 0, T/2, T, ..., Eq. (20).
   type, extends(pressure_history) :: square_wave
      private
      real(wp) :: period = 1.0_wp      !! T [s]
      real(wp) :: transition = 0.1_wp  !! t_d [s]
   contains
      procedure :: factors => square_factors
      procedure :: span => square_span
      procedure :: stops => square_stops
      procedure :: is_constant => square_is_constant
   end type square_wave

   !> Sampled pressures with a shape-preserving cubic between the samples; constant outside them.
   type, extends(pressure_history) :: pressure_trace
      private
      real(wp), allocatable :: time(:)           !! [s], rising
      real(wp), allocatable :: inlet(:)          !! [Pa]
      real(wp), allocatable :: outlet(:)         !! [Pa]
      real(wp), allocatable :: inlet_slope(:)    !! [Pa/s]
      real(wp), allocatable :: outlet_slope(:)   !! [Pa/s]
   contains
      procedure :: factors => trace_factors
      procedure :: span => trace_span
      procedure :: stops => trace_stops
   end type pressure_trace

contains

   !> Whether the factors are constant between two instants, neither behind the next stop; false where that is not known.
   pure logical function not_known(self, from, to)
      class(pressure_history), intent(in) :: self
      real(wp), intent(in) :: from, to   !! [s]

      associate (unused => [self%start, from, to])
      end associate
      not_known = .false.
   end function not_known

   !> Check the data and build a square wave. On failure `self` is a default wave.
   subroutine new_square_wave(self, period, transition, error, event)
      type(square_wave), intent(out) :: self
      real(wp), intent(in) :: period       !! T [s], > 0
      real(wp), intent(in) :: transition   !! t_d [s], 0 < t_d < T/2
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: event  !! start of the closing event [s], >= 0; T/2 - t_d/2 unless given
      real(wp) :: start

      if (.not. (period > 0.0_wp .and. transition > 0.0_wp .and. transition < 0.5_wp*period)) then
         call fail(error, rv_bad_input, "a square wave needs 0 < transition < period/2")
         return
      end if
      start = 0.5_wp*(period - transition)
      if (present(event)) start = event
      if (.not. start >= 0.0_wp) then
         call fail(error, rv_bad_input, "the closing event must not start before the square wave does, at 0")
         return
      end if
      self%period = period
      self%transition = transition
      self%event = start
      self%cycle_end = period*(1.0_wp + aint((start + 0.5_wp*transition)/period)) - 0.5_wp*transition
   end subroutine new_square_wave

   !> R(t) and 1. Only the distance to the nearest centre of a ramp matters, so that R is exact at the corners.
   pure subroutine square_factors(self, t, inlet, outlet)
      class(square_wave), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out) :: inlet, outlet
      real(wp) :: half, ramp
      integer :: number

      half = 0.5_wp*self%period
      number = int(t/half + 0.5_wp)   ! t >= 0
      ramp = max(-0.5_wp, min(0.5_wp, (t - real(number, wp)*half)/self%transition))
      if (mod(number, 2) == 0) then
         inlet = 0.5_wp + ramp
      else
         inlet = 0.5_wp - ramp
      end if
      outlet = 1.0_wp
   end subroutine square_factors

   pure logical function square_is_constant(self, from, to)
      class(square_wave), intent(in) :: self
      real(wp), intent(in) :: from, to
      real(wp) :: before, after, outlet

      call self%factors(from, before, outlet)
      call self%factors(to, after, outlet)
      square_is_constant = .not. abs(before - after) > 0.0_wp
   end function square_is_constant

   pure real(wp) function square_span(self, inlet, outlet) result(span)
      class(square_wave), intent(in) :: self
      real(wp), intent(in) :: inlet, outlet

      span = 0.0_wp
      if (self%period > 0.0_wp) span = max(abs(inlet - outlet), abs(outlet))
   end function square_span

   pure function square_stops(self, t_end) result(t)
      class(square_wave), intent(in) :: self
      real(wp), intent(in) :: t_end
      real(wp), allocatable :: t(:)
      real(wp), allocatable :: corner(:)
      integer :: ramps, n

      ramps = int(2.0_wp*t_end/self%period) + 1
      allocate(corner(2*ramps + 2))
      do n = 0, ramps
         corner(2*n + 1) = 0.5_wp*(real(n, wp)*self%period - self%transition)
         corner(2*n + 2) = 0.5_wp*(real(n, wp)*self%period + self%transition)
      end do
      t = merge_stops(corner, self%start, self%event, t_end)
   end function square_stops

   !> Check the samples and build a trace. On failure `self` is a default trace.
   subroutine new_pressure_trace(self, time, inlet, outlet, event, error)
      type(pressure_trace), intent(out) :: self
      real(wp), intent(in) :: time(:)     !! [s], rising, at least two
      real(wp), intent(in) :: inlet(:)    !! [Pa], (size(time))
      real(wp), intent(in) :: outlet(:)   !! [Pa], (size(time))
      real(wp), intent(in) :: event       !! start of the closing event [s], within the samples
      type(error_type), allocatable, intent(out) :: error
      integer :: n

      n = size(time)
      if (n < 2 .or. size(inlet) /= n .or. size(outlet) /= n) then
         call fail(error, rv_bad_input, "a pressure trace needs two or more samples of time, inlet and outlet")
         return
      end if
      if (.not. (all(ieee_is_finite(time)) .and. all(ieee_is_finite(inlet)) .and. all(ieee_is_finite(outlet)))) then
         call fail(error, rv_bad_input, "a pressure trace must not hold NaN or infinity")
         return
      end if
      if (.not. all(time(2:) > time(:n - 1))) then
         call fail(error, rv_bad_input, "the times of a pressure trace must rise")
         return
      end if
      if (.not. (event >= time(1) .and. event <= time(n))) then
         call fail(error, rv_bad_input, "the closing event must start within the pressure trace")
         return
      end if
      self%time = time
      self%inlet = inlet
      self%outlet = outlet
      self%inlet_slope = monotone_slopes(time, inlet)
      self%outlet_slope = monotone_slopes(time, outlet)
      self%start = time(1)
      self%event = event
      self%cycle_end = time(n)
   end subroutine new_pressure_trace

   pure subroutine trace_factors(self, t, inlet, outlet)
      class(pressure_trace), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out) :: inlet, outlet
      real(wp) :: x
      integer :: lo, hi, middle

      x = max(self%time(1), min(self%time(size(self%time)), t))
      lo = 1
      hi = size(self%time)
      do while (hi - lo > 1)
         middle = (lo + hi)/2
         if (self%time(middle) <= x) then
            lo = middle
         else
            hi = middle
         end if
      end do
      inlet = cubic_value(self%time(lo:hi), self%inlet(lo:hi), self%inlet_slope(lo:hi), x)
      outlet = cubic_value(self%time(lo:hi), self%outlet(lo:hi), self%outlet_slope(lo:hi), x)
   end subroutine trace_factors

   pure real(wp) function trace_span(self, inlet, outlet) result(span)
      class(pressure_trace), intent(in) :: self
      real(wp), intent(in) :: inlet, outlet

      span = maxval(abs(inlet*self%inlet - outlet*self%outlet))
   end function trace_span

   !> The interpolant has no corners, but the measures start at the event.
   pure function trace_stops(self, t_end) result(t)
      class(pressure_trace), intent(in) :: self
      real(wp), intent(in) :: t_end
      real(wp), allocatable :: t(:)

      t = merge_stops([real(wp) ::], self%start, self%event, t_end)
   end function trace_stops

   !> Corners and event inside (start, t_end), rising and without repeats, then t_end.
   pure function merge_stops(corner, start, event, t_end) result(t)
      real(wp), intent(in) :: corner(:)   !! rising [s]
      real(wp), intent(in) :: start, event, t_end
      real(wp), allocatable :: t(:)
      real(wp) :: closest

      closest = 1.0e-9_wp*(t_end - start)
      t = pack(corner, corner > start + closest .and. corner < t_end - closest)
      if (event > start + closest .and. event < t_end - closest) then
         t = [pack(t, t < event - closest), event, pack(t, t > event + closest)]
      end if
      t = [t, t_end]
   end function merge_stops

end module rv_pressure
