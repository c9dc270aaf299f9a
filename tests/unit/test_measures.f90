!> The measures, from steps made by hand out of curves whose crossings and extremes are known.
program test_measures
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp, pi
   use rv_lumped, only : lumped_lanes
   use rv_measures, only : measure_lanes, n_measures
   use rv_text, only : to_text
   use check, only : suite_type
   use hand_made, only : curve_type, measures_of, feed, feed_step, lanes_of, even, u_ref
   implicit none
   type(suite_type) :: suite
   integer, parameter :: steady = 1, rise = 2, opening = 3, overshoot = 4, fall = 5, closing = 6, zero = 7, &
      & undershoot = 8, peak = 9
   real(wp), parameter :: ulp = epsilon(1.0_wp)

   !> Up as 1.2 (t/10)^2, down as 1.2 (1 - (s/8)^2), s = t - 10.
   type(curve_type), parameter :: parabola = curve_type(event=10.0_wp, &
      & before=[0.0_wp, 0.0_wp, 0.012_wp, 0.0_wp, 0.0_wp, 0.0_wp], &
      & after=[1.2_wp, 0.0_wp, -0.01875_wp, 0.0_wp, 0.0_wp, 0.0_wp])
   !> 0.65 - 0.75 cos t for two and a half turns, then 0.65 + 0.75 cos s: through all levels again and again.
   type(curve_type), parameter :: swing = curve_type(event=5.0_wp*pi, &
      & before=[0.65_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], after=[0.65_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], &
      & wave=[-0.75_wp, 0.75_wp])
   !> 10 s up, 10 s down, at even speed.
   type(curve_type), parameter :: straight = curve_type(event=10.0_wp, &
      & before=[0.0_wp, 0.1_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], after=[1.0_wp, -0.1_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
   !> Up to 1.25 at t = 1, back to 0.9375 at the event, down to -0.5 at t = 2.5, up again.
   type(curve_type), parameter :: hop = curve_type(event=1.5_wp, &
      & before=[0.0_wp, 2.5_wp, -1.25_wp, 0.0_wp, 0.0_wp, 0.0_wp], &
      & after=[0.9375_wp, -2.875_wp, 1.4375_wp, 0.0_wp, 0.0_wp, 0.0_wp])

   call parabola_levels()
   call first_crossings_only()
   call steps_end_at_levels()
   call extremes_inside_a_step()
   call no_overshoot()
   call creeping_home()
   call still_opening()
   call late_start()
   call event_at_start()
   call ended_before_event()
   call ended_in_the_fall()
   call no_way_up()
   call first_cycle_only()
   call lanes_apart()
   call lane_that_fails()
   call event_by_a_rounding()
   call film_force_peak()
   call suite%finish()

contains

   !> Crossings are square roots; polynomials up to degree five are exact on the dense output.
   subroutine parabola_levels()
      real(wp) :: m(n_measures), up(3), down(4)

      m = measures_of(parabola, [0.0_wp, even(0.0_wp, 10.0_wp, 7), even(10.0_wp, 19.0_wp, 5)])
      up = 10.0_wp*sqrt([0.1_wp, 0.9_wp, 0.98_wp]/1.2_wp)
      down = 8.0_wp*sqrt(1.0_wp - [0.9_wp, 0.1_wp, 0.02_wp, 0.0_wp]/1.2_wp)
      call suite%close("steady", m(steady), u_ref, 0.0_wp, 0.0_wp)
      call suite%close("rise from 10 to 90 %", m(rise), up(2) - up(1), 32.0_wp*ulp, 0.0_wp)
      call suite%close("opening to 98 %", m(opening), up(3), 32.0_wp*ulp, 0.0_wp)
      call suite%close("overshoot, largest at the event", m(overshoot), 0.2_wp*u_ref, 32.0_wp*ulp, 0.0_wp)
      call suite%close("fall from 90 to 10 %", m(fall), down(2) - down(1), 32.0_wp*ulp, 0.0_wp)
      call suite%close("closing to 2 %", m(closing), down(3), 32.0_wp*ulp, 0.0_wp)
      call suite%close("closing to zero", m(zero), down(4), 32.0_wp*ulp, 0.0_wp)
      call suite%close("undershoot, largest at the end", m(undershoot), 0.31875_wp*u_ref, 64.0_wp*ulp, 0.0_wp)
      call suite%close("no film, no force", m(peak), 0.0_wp, 0.0_wp, 0.0_wp)
   end subroutine parabola_levels

   !> Thrice up and twice down before the event, and again after it. The dense output's h^6/46080 limits the times.
   subroutine first_crossings_only()
      real(wp) :: m(n_measures), up(3), down(4)
      real(wp), parameter :: limit = 1.0e-8_wp   ! h = 0.08

      m = measures_of(swing, [0.0_wp, even(0.0_wp, 5.0_wp*pi, 200), even(5.0_wp*pi, 10.5_wp*pi, 220)])
      up = acos((0.65_wp - [0.1_wp, 0.9_wp, 0.98_wp])/0.75_wp)
      down = acos(([0.9_wp, 0.1_wp, 0.02_wp, 0.0_wp] - 0.65_wp)/0.75_wp)
      call suite%close("rise of the first swing", m(rise), up(2) - up(1), 0.0_wp, limit)
      call suite%close("opening of the first swing", m(opening), up(3), 0.0_wp, limit)
      call suite%close("overshoot of a swing", m(overshoot), 0.4_wp*u_ref, limit, 0.0_wp)
      call suite%close("fall of the first swing", m(fall), down(2) - down(1), 0.0_wp, limit)
      call suite%close("closing of the first swing", m(closing), down(3), 0.0_wp, limit)
      call suite%close("zero of the first swing", m(zero), down(4), 0.0_wp, limit)
      call suite%close("undershoot of a swing", m(undershoot), 0.1_wp*u_ref, 10.0_wp*limit, 0.0_wp)
   end subroutine first_crossings_only

   !> Knots at 10, 90 and 98 % up and at 90, 10, 2, 0 % down: each is found, also where the run ends there.
   subroutine steps_end_at_levels()
      real(wp) :: m(n_measures)
      real(wp), parameter :: knot(11) = [0.0_wp, 0.5_wp, 1.0_wp, 9.0_wp, 9.8_wp, 10.0_wp, 11.0_wp, 19.0_wp, 19.8_wp, 20.0_wp, &
         & 20.5_wp]
      type(curve_type), parameter :: even_rise = curve_type(event=1.0_wp, before=[0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])

      m = measures_of(straight, knot)
      call suite%close("rise, knots at the levels", m(rise), 8.0_wp, 16.0_wp*ulp, 0.0_wp)
      call suite%close("opening, knots at the levels", m(opening), 9.8_wp, 16.0_wp*ulp, 0.0_wp)
      call suite%close("fall, knots at the levels", m(fall), 8.0_wp, 16.0_wp*ulp, 0.0_wp)
      call suite%close("closing, knots at the levels", m(closing), 9.8_wp, 16.0_wp*ulp, 0.0_wp)
      call suite%close("zero, knots at the levels", m(zero), 10.0_wp, 16.0_wp*ulp, 0.0_wp)
      m = measures_of(straight, knot(:9))
      call suite%close("a run that ends at 2 % got there", m(closing), 9.8_wp, 16.0_wp*ulp, 0.0_wp)
      m = measures_of(straight, knot(:10), rtol=ulp)   ! which covers the rounding of the last displacement
      call suite%true("a run that ends at zero did not come below it", ieee_is_nan(m(zero)))
      m = measures_of(curve_type(event=1.0_wp, after=[2.0_wp, -1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]), [1.0_wp, 2.0_wp, 4.0_wp])
      call suite%close("from the steady displacement at a knot on: zero", m(zero), 2.0_wp, 16.0_wp*ulp, 0.0_wp)
      m = measures_of(even_rise, [0.0_wp, 0.1_wp, 0.9_wp, 0.98_wp])   ! u(0.9) is 90 % of u_ref to the last bit
      call suite%close("levels met to the last bit: rise", m(rise), 0.8_wp, 16.0_wp*ulp, 0.0_wp)
      call suite%close("and opening, at the end of the run", m(opening), 0.98_wp, 16.0_wp*ulp, 0.0_wp)
   end subroutine steps_end_at_levels

   !> One step over each turn: the knots alone show neither the extreme nor the crossings beside it.
   subroutine extremes_inside_a_step()
      real(wp) :: m(n_measures)

      m = measures_of(hop, [0.0_wp, 1.5_wp, 3.0_wp])
      call suite%close("overshoot inside a step", m(overshoot), 0.25_wp*u_ref, 32.0_wp*ulp, 0.0_wp)
      call suite%close("rise before the turn", m(rise), sqrt(0.92_wp) - sqrt(0.28_wp), 32.0_wp*ulp, 0.0_wp)
      call suite%close("opening before the turn", m(opening), 1.0_wp - sqrt(0.216_wp), 32.0_wp*ulp, 0.0_wp)
      call suite%close("fall before the turn", m(fall), (sqrt(1.4_wp) - sqrt(0.6_wp))/sqrt(1.4375_wp), 32.0_wp*ulp, 0.0_wp)
      call suite%close("zero before the turn", m(zero), 1.0_wp - sqrt(0.5_wp/1.4375_wp), 64.0_wp*ulp, 0.0_wp)
      call suite%close("undershoot inside a step", m(undershoot), 0.5_wp*u_ref, 32.0_wp*ulp, 0.0_wp)
      m = measures_of(curve_type(event=9.0_wp, before=hop%before), [0.0_wp, 3.2_wp])
      call suite%close("opening early in a step that ends far down", m(opening), 1.0_wp - sqrt(0.216_wp), 32.0_wp*ulp, 0.0_wp)
      m = measures_of(curve_type(event=9.0_wp, before=[1.0_wp, -0.3_wp, 0.15_wp, 0.0_wp, 0.0_wp, 0.0_wp]), [0.0_wp, 3.0_wp])
      call suite%close("down to 85 % and up to 98 % in one step: opening", m(opening), 1.0_wp + sqrt(0.13_wp/0.15_wp), &
         & 32.0_wp*ulp, 0.0_wp)
      ! 0.15 x^2 (x - 2)^2 is above 10 % about its top at x = 1, near which a step ends; its end's tangents meet below
      m = measures_of(curve_type(event=9.0_wp, before=[0.0_wp, 0.0_wp, 0.6_wp, -0.6_wp, 0.15_wp, 0.0_wp]), &
         & [0.01_wp, 1.03_wp, 2.05_wp, 3.2_wp])
      call suite%close("rise from 10 % in a step that turns at its end", m(rise), sqrt(1.0_wp + sqrt(6.0_wp)) &
         & + sqrt(1.0_wp - sqrt(2.0_wp/3.0_wp)), 64.0_wp*ulp, 0.0_wp)
   end subroutine extremes_inside_a_step

   !> Never above the steady displacement before the event, never below rest after it: zero, not missing.
   subroutine no_overshoot()
      real(wp) :: m(n_measures)

      m = measures_of(straight, [0.0_wp, 5.0_wp, 10.0_wp, 15.0_wp, 19.9_wp], steady=1.125_wp)
      call suite%close("overshoot of a rise that stays below", m(overshoot), 0.0_wp, 0.0_wp, 0.0_wp)
      call suite%close("undershoot of a fall that stays above zero", m(undershoot), 0.0_wp, 0.0_wp, 0.0_wp)
      call suite%true("which does not reach zero", ieee_is_nan(m(zero)))
      call suite%close("but 2 %", m(closing), 10.0_wp - 0.225_wp, 16.0_wp*ulp, 0.0_wp)
   end subroutine no_overshoot

   !> Beyond the steady displacement and beyond zero by a little less and a little more than ten tolerances.
   subroutine creeping_home()
      real(wp), parameter :: d(2) = [0.99e-5_wp, 1.01e-5_wp], rtol = 1.0e-6_wp
      type(curve_type) :: curve
      real(wp) :: m(n_measures)
      integer :: i

      do i = 1, 2
         curve = curve_type(event=1.0_wp, before=[0.0_wp, 2.0_wp, -1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]*(1.0_wp + d(i)))
         curve%after = [1.0_wp, -2.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]*(1.0_wp + d(i))
         curve%after(0) = 1.0_wp
         m = measures_of(curve, [0.0_wp, 1.0_wp, 1.5_wp, 3.0_wp], rtol=rtol)
         call suite%close("overshoot about ten tolerances", m(overshoot)/u_ref, merge(d(i), 0.0_wp, i == 2), 0.0_wp, 8.0_wp*ulp)
         call suite%close("undershoot about ten tolerances", m(undershoot)/u_ref, merge(d(i), 0.0_wp, i == 2), 0.0_wp, 8.0_wp*ulp)
         call suite%true("zero only with an undershoot", ieee_is_nan(m(zero)) .neqv. i == 2)
      end do
      call suite%close("when it came to zero", m(zero), 1.0_wp - sqrt(d(2)/(1.0_wp + d(2))), 0.0_wp, 1.0e-12_wp)
   end subroutine creeping_home

   !> The event finds the reed half way up and still rising; it turns 2 s later and closes in the same step.
   subroutine still_opening()
      real(wp) :: m(n_measures)

      m = measures_of(curve_type(event=10.0_wp, before=[0.0_wp, 0.05_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], &
         & after=[0.5_wp, 0.05_wp, -0.0125_wp, 0.0_wp, 0.0_wp, 0.0_wp]), [0.0_wp, 10.0_wp, 19.0_wp])
      call suite%close("overshoot of a reed that is still opening", m(overshoot), 0.0_wp, 0.0_wp, 0.0_wp)
      call suite%true("it has no rise, no opening and no fall", all(ieee_is_nan(m([rise, opening, fall]))))
      call suite%close("but closes", m(closing), 2.0_wp + sqrt(42.4_wp), 32.0_wp*ulp, 0.0_wp)
      call suite%close("to zero", m(zero), 2.0_wp + sqrt(44.0_wp), 32.0_wp*ulp, 0.0_wp)
   end subroutine still_opening

   !> A run that begins late and high: times count from its start, its first instant counts as overshoot.
   subroutine late_start()
      real(wp) :: m(n_measures)

      m = measures_of(straight, [0.5_wp, 10.0_wp])
      call suite%close("opening counts from the start of the run", m(opening), 9.3_wp, 16.0_wp*ulp, 0.0_wp)
      m = measures_of(curve_type(event=3.0_wp, before=[1.3_wp, -0.1_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]), [0.0_wp, 1.0_wp, 3.0_wp])
      call suite%close("overshoot of the first instant", m(overshoot), 0.3_wp*u_ref, 32.0_wp*ulp, 0.0_wp)
   end subroutine late_start

   !> Open from the start: nothing rises; the fall is measured from the first step on.
   subroutine event_at_start()
      real(wp) :: m(n_measures)

      m = measures_of(straight, [10.0_wp, 12.0_wp, 15.0_wp, 21.0_wp])
      call suite%true("no rise, no opening, no overshoot", all(ieee_is_nan(m([rise, opening, overshoot]))))
      call suite%close("fall from the start", m(fall), 8.0_wp, 16.0_wp*ulp, 0.0_wp)
      call suite%close("closing from the start", m(closing), 9.8_wp, 16.0_wp*ulp, 0.0_wp)
      call suite%close("undershoot", m(undershoot), 0.1_wp*u_ref, 32.0_wp*ulp, 0.0_wp)
   end subroutine event_at_start

   !> What had not come when the run ended is missing; what had is there.
   subroutine ended_before_event()
      real(wp) :: m(n_measures)

      m = measures_of(straight, [0.0_wp, 5.0_wp, 9.5_wp])
      call suite%close("rise of a run that ends before 98 %", m(rise), 8.0_wp, 16.0_wp*ulp, 0.0_wp)
      call suite%true("it has no closing, no opening, no overshoot", &
         & all(ieee_is_nan(m([opening, overshoot, fall, closing, zero, undershoot]))))
      m = measures_of(straight, [0.0_wp, 5.0_wp, 10.0_wp])
      call suite%close("opening of a run up to the event", m(opening), 9.8_wp, 16.0_wp*ulp, 0.0_wp)
      call suite%close("overshoot of it", m(overshoot), 0.0_wp, 0.0_wp, 4.0_wp*ulp*u_ref)
      call suite%true("it has no closing", all(ieee_is_nan(m([fall, closing, zero, undershoot]))))
      m = measures_of(straight, [0.0_wp])
      call suite%true("without a step only the steady displacement", all(ieee_is_nan(m(rise:undershoot))) .and. m(steady) > 0.0_wp)
   end subroutine ended_before_event

   subroutine ended_in_the_fall()
      real(wp) :: m(n_measures)

      m = measures_of(straight, [0.0_wp, 5.0_wp, 10.0_wp, 15.0_wp])
      call suite%true("90 % passed, 10 % not: no fall, no closing", all(ieee_is_nan(m([fall, closing, zero]))))
      call suite%close("no undershoot so far", m(undershoot), 0.0_wp, 0.0_wp, 0.0_wp)
   end subroutine ended_in_the_fall

   !> A pressure that shuts the valve, or leaves no equilibrium: there is nothing to open to.
   subroutine no_way_up()
      real(wp) :: m(n_measures), level(3)
      character(len=8), parameter :: name(3) = ["below 0 ", "at 0    ", "not a no"]
      integer :: i

      level = [-0.3_wp, 0.0_wp, ieee_value(1.0_wp, ieee_quiet_nan)]
      do i = 1, 3
         m = measures_of(hop, [0.0_wp, even(0.0_wp, 1.5_wp, 5), even(1.5_wp, 3.0_wp, 5)], steady=level(i))
         call suite%true("steady displacement "//trim(name(i))//": nothing relative to it", all(ieee_is_nan(m(rise:zero))))
         call suite%close("undershoot all the same", m(undershoot), 0.5_wp*u_ref, 32.0_wp*ulp, 0.0_wp)
      end do
      call suite%true("no steady displacement", ieee_is_nan(m(steady)))
      m = measures_of(curve_type(event=1.0_wp, before=[-0.5_wp, 0.5_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]), &
         & [0.0_wp, 0.5_wp, 1.0_wp], steady=-0.3_wp)
      call suite%true("nor on the way up from below", all(ieee_is_nan(m(rise:zero))))
   end subroutine no_way_up

   !> The curve goes on to zero, a new opening and a new closing after the cycle's end: nothing changes.
   subroutine first_cycle_only()
      real(wp) :: cycle(n_measures), more(n_measures), whole(n_measures)
      real(wp), parameter :: end = 5.0_wp*pi + 2.0_wp

      associate (knot => [0.0_wp, even(0.0_wp, 5.0_wp*pi, 200), even(5.0_wp*pi, end, 20)], rest => even(end, 10.5_wp*pi, 200))
         cycle = measures_of(swing, knot)
         more = measures_of(swing, [knot, rest], cycle_end=end)
         whole = measures_of(swing, [knot, rest])
      end associate
      call suite%true("what follows the first cycle changes nothing", same(cycle, more))
      call suite%true("it has no zero and no undershoot", ieee_is_nan(more(zero)) .and. .not. more(undershoot) > 0.0_wp)
      call suite%true("which a longer cycle has", whole(zero) > 2.0_wp .and. whole(undershoot) > 0.0_wp)
   end subroutine first_cycle_only

   pure logical function same(a, b)
      real(wp), intent(in) :: a(:), b(:)

      same = all(abs(a - b) <= 0.0_wp .or. (ieee_is_nan(a) .and. ieee_is_nan(b)))
   end function same

   !> Four lanes at once, one upside down, one with a film: each as it is alone.
   subroutine lanes_apart()
      real(wp), parameter :: factor(4) = [1.0_wp, -2.0_wp, 0.25_wp, 1.0_wp], film(4) = [0.0_wp, 0.0_wp, 0.0_wp, 5.0e-13_wp]
      type(measure_lanes) :: together, alone
      real(wp) :: knot(19)
      integer :: i

      knot = [0.0_wp, even(0.0_wp, 1.5_wp, 9), even(1.5_wp, 3.0_wp, 9)]
      call feed(together, hop, knot, lanes_of(film), factor, abs(factor)*u_ref)
      do i = 1, size(factor)
         call feed(alone, hop, knot, lanes_of(film(i:i)), factor(i:i), abs(factor(i:i))*u_ref)
         call suite%true("lane "//to_text(i)//" as alone", same(together%results(i), alone%results(1)))
      end do
      associate (one => together%results(1), quarter => together%results(3), upside_down => together%results(2))
         call suite%true("a quarter of the size: the same times", same(one([rise, opening, fall, closing, zero]), &
            & quarter([rise, opening, fall, closing, zero])))
         call suite%close("a quarter of the undershoot", quarter(undershoot), 0.25_wp*one(undershoot), 4.0_wp*ulp, 0.0_wp)
         call suite%close("upside down: it begins below", upside_down(undershoot), 1.875_wp*u_ref, 4.0_wp*ulp, 0.0_wp)
      end associate
   end subroutine lanes_apart

   !> A lane that fails, before the event or after it, keeps what it had; its company goes on.
   subroutine lane_that_fails()
      type(measure_lanes) :: measures
      type(lumped_lanes) :: lanes
      real(wp) :: short(n_measures), long(n_measures), last
      real(wp), parameter :: both(2) = [1.0_wp, 1.0_wp]
      integer :: i, k

      lanes = lanes_of([5.0e-13_wp, 5.0e-13_wp])
      long = measures_of(hop, [0.0_wp, even(0.0_wp, 1.5_wp, 6), even(1.5_wp, 3.0_wp, 6)], squeeze=5.0e-13_wp)
      do i = 1, 2
         last = real(i, wp)   ! before, after the event at 1.5
         associate (knot => [0.0_wp, even(0.0_wp, 1.5_wp, 6), even(1.5_wp, 3.0_wp, 6)])
            associate (seen => pack(knot, knot <= last))
               short = measures_of(hop, seen, cycle_end=3.0_wp, squeeze=5.0e-13_wp)
               call feed(measures, hop, seen, lanes, both, both*u_ref, cycle_end=3.0_wp)
               do k = size(seen) + 1, size(knot)
                  call feed_step(measures, hop, knot(k - 1), knot(k), lanes, both, [.false., .true.])
               end do
            end associate
         end associate
         call suite%true("lane that fails at "//to_text(last)//" s: as if the run had ended", same(measures%results(1), short))
         call suite%true("the other lane goes on", same(measures%results(2), long))
      end do
   end subroutine lane_that_fails

   !> An event that lies on an end of the run but for a rounding: no step ends there, and none needs to.
   subroutine event_by_a_rounding()
      real(wp) :: m(n_measures), e
      type(curve_type) :: curve
      integer :: i

      do i = -1, 1
         e = nearest(10.0_wp, real(i, wp))
         if (i == 0) e = 10.0_wp
         curve = straight
         curve%event = e
         m = measures_of(curve, [0.0_wp, 8.0_wp, 10.0_wp])
         call suite%close("event at the end, give or take an ulp: opening", m(opening), 9.8_wp, 16.0_wp*ulp, 0.0_wp)
         call suite%close("overshoot", m(overshoot), 0.0_wp, 0.0_wp, 16.0_wp*ulp*u_ref)
         call suite%true("no closing, no undershoot", all(ieee_is_nan(m([fall, closing, zero, undershoot]))))
         curve%before = [2.0_wp, -0.1_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
         m = measures_of(curve, [10.0_wp, 15.0_wp, 21.0_wp])
         call suite%true("event at the start, give or take an ulp: no overshoot", ieee_is_nan(m(overshoot)))
         call suite%close("closing", m(closing), 9.8_wp, 64.0_wp*ulp, 0.0_wp)
      end do
   end subroutine event_by_a_rounding

   !> A film of 1.5 under u = cos s: C sin s/(cos s + 1.5)^3 is largest where cos s (cos s + 1.5) + 3 sin^2 s = 0.
   subroutine film_force_peak()
      type(curve_type), parameter :: cosine = curve_type(wave=[0.0_wp, 1.0_wp])
      real(wp), parameter :: squeeze = 5.0e-13_wp
      real(wp) :: m(n_measures), cut(n_measures), c, force

      c = (1.5_wp - sqrt(1.5_wp**2 + 24.0_wp))/4.0_wp   ! 2 c^2 - 1.5 c - 3 = 0
      force = squeeze/u_ref**2*sqrt(1.0_wp - c**2)/(c + 1.5_wp)**3
      m = measures_of(cosine, [0.0_wp, even(0.0_wp, 6.3_wp, 40)], squeeze=squeeze)
      call suite%close("largest film force, inside a step", m(peak), force, 1.0e-6_wp, 0.0_wp)
      m = measures_of(cosine, [0.0_wp, even(0.0_wp, 6.3_wp, 160)], squeeze=squeeze)
      call suite%close("steps a quarter as long", m(peak), force, 1.0e-9_wp, 0.0_wp)
      m = measures_of(cosine, [0.0_wp, even(0.0_wp, 2.0_wp, 20)], squeeze=squeeze)
      call suite%close("a run that ends before the peak: at its end", m(peak), &
         & squeeze/u_ref**2*sin(2.0_wp)/(cos(2.0_wp) + 1.5_wp)**3, 64.0_wp*ulp, 0.0_wp)
      cut = measures_of(cosine, [0.0_wp, even(0.0_wp, 2.0_wp, 20), even(2.0_wp, 6.3_wp, 40)], cycle_end=2.0_wp, squeeze=squeeze)
      call suite%close("a cycle that ends before the peak: at its end too", cut(peak), m(peak), 0.0_wp, 0.0_wp)
   end subroutine film_force_peak

end program test_measures
