!> Responses made by hand: curves with known crossings, cut into steps and handed to the measures.
module hand_made
   use rv_kinds, only : wp
   use rv_dense, only : derivative, value_at
   use rv_error, only : error_type
   use rv_lumped, only : lumped_lanes, lumped_valve, new_lumped_lanes
   use rv_measures, only : measure_lanes, new_measure_lanes, n_measures
   use rv_pressure, only : square_wave, new_square_wave
   use rv_step, only : step_type, new_step
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: curve_type, measures_of, feed, feed_step, lanes_of, even

   real(wp), parameter, public :: u_ref = 1.0e-4_wp   !! size of the curves [m]

   !> u/u_ref as a polynomial and a wave, one before the closing event and one after it.
   type :: curve_type
      real(wp) :: event = 0.0_wp          !! [s]
      real(wp) :: before(0:5) = 0.0_wp    !! coefficients in powers of t
      real(wp) :: after(0:5) = 0.0_wp     !! in powers of t - event
      real(wp) :: wave(2) = 0.0_wp        !! factors of cos t before, cos(t - event) after
   end type curve_type

contains

   !> Measures of one lane whose steady displacement is u_ref (or `steady`, over u_ref).
   function measures_of(curve, knot, cycle_end, steady, squeeze, rtol) result(measure)
      type(curve_type), intent(in) :: curve
      real(wp), intent(in) :: knot(:)                !! the steps' ends [s]
      real(wp), intent(in), optional :: cycle_end    !! [s]; the last knot unless given
      real(wp), intent(in), optional :: steady
      real(wp), intent(in), optional :: squeeze      !! C of a film of 1.5 u_ref [N s m2]
      real(wp), intent(in), optional :: rtol         !! tolerance that made the curve [-]; 0 unless given
      real(wp) :: measure(n_measures)
      real(wp) :: level, film
      type(measure_lanes) :: measures

      level = 1.0_wp
      if (present(steady)) level = steady
      film = 0.0_wp
      if (present(squeeze)) film = squeeze
      call feed(measures, curve, knot, lanes_of([film]), [1.0_wp], [level*u_ref], cycle_end, rtol)
      measure = measures%results(1)
   end function measures_of

   !> Hand the curve, times a factor for each lane, to measures, step by step.
   subroutine feed(measures, curve, knot, lanes, factor, steady, cycle_end, rtol)
      type(measure_lanes), intent(out) :: measures
      type(curve_type), intent(in) :: curve
      real(wp), intent(in) :: knot(:)                !! [s]
      class(valve_lanes), intent(in) :: lanes        !! one degree of freedom
      real(wp), intent(in) :: factor(:), steady(:)   !! [-], [m]; (width)
      real(wp), intent(in), optional :: cycle_end, rtol
      class(valve_lanes), allocatable :: own
      type(step_type) :: step
      real(wp) :: last
      integer :: k

      allocate(own, source=lanes)
      last = knot(size(knot))
      if (present(cycle_end)) last = cycle_end
      call new_step(step, knot(1), rows(curve, factor, 0, knot(1), knot(1)), rows(curve, factor, 1, knot(1), knot(1)), &
         & rows(curve, factor, 2, knot(1), knot(1)), own%tip, spread(.true., 1, size(factor)))
      call new_measure_lanes(measures, knot(1), curve%event, last, steady, step%u1, rtol)
      do k = 2, size(knot)
         call feed_step(measures, curve, knot(k - 1), knot(k), own, factor, spread(.true., 1, size(factor)))
      end do
   end subroutine feed

   subroutine feed_step(measures, curve, t0, t1, lanes, factor, live)
      type(measure_lanes), intent(inout) :: measures
      type(curve_type), intent(in) :: curve
      real(wp), intent(in) :: t0, t1   !! [s]
      class(valve_lanes), intent(inout) :: lanes
      real(wp), intent(in) :: factor(:)
      logical, intent(in) :: live(:)   !! lanes that have not failed
      type(step_type) :: step
      real(wp), allocatable :: q(:, :), v(:, :), a(:, :)

      call new_step(step, t0, rows(curve, factor, 0, t0, t0), rows(curve, factor, 1, t0, t0), rows(curve, factor, 2, t0, t0), &
         & lanes%tip, live)
      q = rows(curve, factor, 0, t0, t1)
      v = rows(curve, factor, 1, t0, t1)
      a = rows(curve, factor, 2, t0, t1)
      call step%go_on(t1, q, v, a)
      call measures%observe(step, lanes, some_wave())
   end subroutine feed_step

   !> A derivative of the curve at t, on the piece that holds where the step begins; (width, 1).
   pure function rows(curve, factor, order, begin, t) result(row)
      type(curve_type), intent(in) :: curve
      real(wp), intent(in) :: factor(:)
      integer, intent(in) :: order      !! 0, 1 or 2
      real(wp), intent(in) :: begin, t  !! [s]
      real(wp) :: row(size(factor), 1)
      real(wp) :: c(0:5), x, wave, u

      if (begin < curve%event) then
         c = curve%before
         wave = curve%wave(1)
         x = t
      else
         c = curve%after
         wave = curve%wave(2)
         x = t - curve%event
      end if
      select case (order)
      case (0)
         u = value_at(c, x) + wave*cos(x)
      case (1)
         u = value_at(derivative(c), x) - wave*sin(x)
      case default
         u = value_at(derivative(derivative(c)), x) - wave*cos(x)
      end select
      row(:, 1) = factor*u*u_ref
   end function rows

   !> Lumped lanes for their films alone, of 1.5 u_ref.
   function lanes_of(squeeze) result(lanes)
      real(wp), intent(in) :: squeeze(:)   !! C [N s m2]
      type(lumped_lanes) :: lanes
      type(lumped_valve) :: valve(size(squeeze))

      valve%squeeze = squeeze
      valve%gap = 1.5_wp*u_ref
      call new_lumped_lanes(lanes, valve)
   end function lanes_of

   !> The measures ask the history for pressures only to hand them on to the film.
   function some_wave() result(wave)
      type(square_wave) :: wave
      type(error_type), allocatable :: error

      call new_square_wave(wave, 40.0_wp, 1.0_wp, error)
      if (allocated(error)) error stop "the wave is refused"
   end function some_wave

   !> The ends of n even steps from a to b.
   pure function even(a, b, n) result(knot)
      real(wp), intent(in) :: a, b
      integer, intent(in) :: n
      real(wp) :: knot(n)
      integer :: k

      knot = [(a + (b - a)*(real(k, wp)/real(n, wp)), k = 1, n)]
      knot(n) = b
   end function even

end module hand_made
