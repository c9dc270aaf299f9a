!> Single cases from deck to results: the paper's numbers, starts and ends, and each way to fail alone.
program test_cases
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8
   use rv_deck, only : deck_type
   use rv_block, only : block_result, run_block
   use rv_status, only : status_ok, status_bad_case, status_film_closed, status_too_many_steps, warn_reynolds, &
      & warn_large_slope, warn_not_open
   use rv_text, only : to_text
   use check, only : suite_type
   use block_trial, only : run_all, read_good, agree, agreement, same_bits, steady, rise, overshoot, fall, closing, &
      & undershoot, peak, twelve
   implicit none
   type(suite_type) :: suite

   call paper_tables()
   call ends_apart()
   call bad_cases()
   call closed_from_the_start()
   call case_on_its_seat()
   call step_limit()
   call reynolds_warning()
   call slope_warning()
   call shut_warning()
   call start_and_film()
   call first_cycle()
   call later_event()
   call suite%finish()

contains

   !> The traditional pair and PAPER's reading of Tables III and IV at 5, 20 and 40 kPa, to the digits given there.
   subroutine paper_tables()
      type(block_result) :: r
      integer :: i
      real(wp), parameter :: falls(3) = [2.843_wp, 1.503_wp, 0.931_wp], closings(3) = [6.039_wp, 4.117_wp, 3.049_wp]
      real(wp), parameter :: facts(6) = [2691.932_wp, 1.586025e-5_wp, 9.916e-5_wp, 0.26896_wp, 212.0_wp, 770.0_wp]

      call run_all(suite, "&run model = 'traditional', 'squeeze' /~&reed action_area_mm2 = 12.56 /~" &
         & //"&sweep key = 'pressure.inlet_kpa', values = 5, 20, 40 /", r)
      do i = 1, 3
         call suite%close("traditional fall [ms]", 1.0e3_wp*r%measure(fall, i), 0.623_wp, 0.0_wp, 2.0e-3_wp)
         call suite%close("traditional closing [ms]", 1.0e3_wp*r%measure(closing, i), 1.021_wp, 0.0_wp, 2.0e-3_wp)
         call suite%close("fall with film [ms]", 1.0e3_wp*r%measure(fall, 3 + i), falls(i), 0.0_wp, 0.6e-3_wp)
         call suite%close("closing with film [ms]", 1.0e3_wp*r%measure(closing, 3 + i), closings(i), 0.0_wp, 0.6e-3_wp)
      end do
      call suite%close("steady displacement at 20 kPa [mm]", 1.0e3_wp*r%measure(steady, 2), 0.093316_wp, 1.0e-5_wp, 0.0_wp)
      do i = 1, 6
         call suite%close("stiffness, masses, damping, Re, frequency: "//to_text(i), r%fact(i, 4), facts(i), 1.0e-3_wp, 0.0_wp)
      end do
   end subroutine paper_tables

   !> Ends before, in and after the closing event at 19.5 ms: what was not reached is missing, the rest agrees.
   subroutine ends_apart()
      type(block_result) :: r, one

      call run_all(suite, "&sweep key = 'run.t_end_ms', values = 40, 10, 21.5, 19.5 /", r)
      call suite%true("all end well", all(r%status == status_ok))
      call suite%true("nothing closes by 10 ms", all(ieee_is_nan(r%measure(overshoot:undershoot, 2))))
      call suite%true("by 19.5 ms the overshoot is known", r%measure(overshoot, 4) > 0.0_wp .and. &
         & all(ieee_is_nan(r%measure(fall:undershoot, 4))))
      call suite%true("by 21.5 ms it falls, but is not closed", r%measure(fall, 3) > 0.0_wp &
         & .and. ieee_is_nan(r%measure(closing, 3)))
      call run_all(suite, "&run t_end_ms = 4.9 /~&pressure period_ms = 10, transition_ms = 0.2 /", one)
      call suite%true("a run up to the event, but for a rounding, shows no closing", one%measure(overshoot, 1) > 0.0_wp .and. &
         & all(ieee_is_nan(one%measure(fall:undershoot, 1))))
      call suite%true("they open alike", agree(r%measure(:3, 2:2), r%measure(:3, 1:1)) &
         & .and. agree(r%measure(:4, 4:4), r%measure(:4, 1:1)) .and. agree(r%measure(:fall, 3:3), r%measure(:fall, 1:1)))
   end subroutine ends_apart

   !> Beyond the first 10000 cases, which are checked with the deck, each case checks itself.
   subroutine bad_cases()
      type(deck_type) :: deck
      type(block_result) :: r, alone

      call read_good(suite, "&sweep key = 'pressure.inlet_kpa', values = 5, 40 /~" &
         & //"&sweep key = 'reed.hole_diameter_mm', from = 4, to = 6.0002, count = 10002 /", deck)
      call run_block(deck, 10001_i8, 10004_i8, r)
      call suite%true("holes up to the reed's width are fine", all(r%status([1, 3, 4]) == status_ok))
      call expect_bad("a hole wider than the reed", r, 2, "wider than the reed")
      call run_block(deck, 10004_i8, 10004_i8, alone)
      call suite%true("the cases after it are their own", agree(r%measure(:, 4:4), alone%measure))

      call read_good(suite, "&run t_end_ms = 30 /~&sweep key = 'pressure.transition_ms', from = 1, to = 20, count = 10001 /", deck)
      call run_block(deck, 9999_i8, 10001_i8, r)
      call suite%true("ramps up to half the period are fine", all(r%status(1:2) == status_ok))
      call expect_bad("a ramp of half the period", r, 3, "transition < period/2")

      call read_good(suite, "&run t_end_ms = 1000 /~&pressure transition_ms = 0.002 /~" &
         & //"&sweep key = 'pressure.period_ms', from = 20.01, to = 0.009, count = 10001 /", deck)
      call run_block(deck, 10001_i8, 10001_i8, r)
      call expect_bad("more periods than can be counted", r, 1, "100000 periods")
   end subroutine bad_cases

   subroutine expect_bad(what, r, i, reason)
      character(len=*), intent(in) :: what, reason
      type(block_result), intent(in) :: r
      integer, intent(in) :: i

      call suite%equal(what//" is a bad case", r%status(i), status_bad_case)
      call suite%true("its reason: "//r%message(i)%s, index(r%message(i)%s, reason) > 0)
      call suite%true("it has no measures and no facts", all(ieee_is_nan(r%measure(:, i))) .and. all(ieee_is_nan(r%fact(:, i))))
   end subroutine expect_bad

   !> Gap 0: every model with a film ends at once and says where, whatever its start and edges; facts are known.
   subroutine closed_from_the_start()
      type(block_result) :: r, others
      integer, parameter :: open_gap(12) = [1, 3, 4, 5, 7, 8, 9, 11, 12, 13, 15, 16]   !! of 16, whose second of four is shut
      character(len=*), parameter :: models = "&run model = 'squeeze', 'film', 'film_table', 'traditional'", &
         & gaps = "~&solver width = 2 /~&sweep key = 'film.gap_mm', values = 0.05, ", &
         & where = "at t = 0 ms: the film under the reed is closed over the whole land: the gap is 0"
      character(len=*), parameter :: more(3) = [character(len=96) :: " /~&film modes = 1 /", &
         & ", start = 'equilibrium' /~&film modes = 1 /", &
         & ", traces = .true., trace_dt_ms = 10 /~&film modes = 1, edge_elongation = 0.65, fields_ms = 20 /"]
      integer :: k, i

      do k = 1, 3
         call run_all(suite, models//trim(more(k))//gaps//"0, 0.1, 0.2 /", r)
         call suite%true("closed: "//r%message(2)%s, all(r%status([2, 6, 10]) == status_film_closed) &
            & .and. all([(r%message(i)%s == where, i=2, 10, 4)]))
         call suite%true("nothing happened there", all(ieee_is_nan(r%measure(:, [2, 6, 10]))) &
            & .and. all(ieee_is_nan(r%trace(:, :, [2, 6, 10]))) .and. all(ieee_is_nan(r%field(:, :, [2, 6, 10]))))
         call suite%true("its facts are those of its neighbour", same_bits(r%fact(:6, [2, 6, 10]), r%fact(:6, [1, 5, 9])))
         call suite%true("all others end well", all(r%status(open_gap) == status_ok) .and. r%status(14) == status_ok)
         call run_all(suite, models//trim(more(k))//gaps//"0.1, 0.2 /", others)
         call suite%true("to the last bit as without it", same_bits(r%measure(:, open_gap), others%measure) &
            & .and. same_bits(r%fact(:, open_gap), others%fact))
         call suite%true("without a film the gap does not matter", same_bits(r%measure(:, 14:14), r%measure(:, 13:13)))
      end do
   end subroutine closed_from_the_start

   !> A film too weak to stop its reed, in one group with others: it fails late, with its reason, and they do not notice.
   subroutine case_on_its_seat()
      type(block_result) :: r, others
      character(len=*), parameter :: tiny = "&run traces = .true., trace_dt_ms = 0.5 /~&film gap_mm = 0.001 /~"
      integer :: i

      call run_all(suite, tiny//"&sweep key = 'film.k_s', values = 0.0075, 1e-70, 0.02 /", r)
      call run_all(suite, tiny//"&sweep key = 'film.k_s', values = 0.0075, 0.02 /", others)
      call suite%equal("case on its seat: status", r%status(2), status_film_closed)
      call suite%true("its message: "//r%message(2)%s, index(r%message(2)%s, "at t = 20.") == 1)
      call suite%close("it goes as far below rest as the gap lets it [mm]", 1.0e3_wp*r%measure(undershoot, 2), 0.001_wp, &
         & 1.0e-3_wp, 0.0_wp)
      call suite%true("its history ends there", all([(ieee_is_nan(r%trace(i, 1, 2)) .eqv. i > 42, i=1, 81)]))
      call suite%true("the others end well", all(r%status([1, 3]) == status_ok))
      call suite%true("where they are without it", agree(r%measure(:, [1, 3]), others%measure))
      call suite%close("at all times", maxval(abs(r%trace(:, 1, [1, 3]) - others%trace(:, 1, :)))/r%measure(steady, 1), &
         & 0.0_wp, 0.0_wp, agreement)
   end subroutine case_on_its_seat

   subroutine step_limit()
      type(block_result) :: r

      call run_all(suite, "&solver max_steps = 20 /~&sweep key = 'film.gap_mm', values = 0.05, 0.1 /", r)
      call suite%true("both cases stop at the limit", all(r%status == status_too_many_steps))
      call suite%true("and say so: "//r%message(2)%s, index(r%message(2)%s, "after 20 steps") == 1 &
         & .and. index(r%message(2)%s, "max_steps") > 0)
      call run_all(suite, "&solver max_steps = 1 /", r)
      call suite%true("no film force yet is 0, not -0", sign(1.0_wp, r%measure(peak, 1)) > 0.0_wp)
   end subroutine step_limit

   !> Thin oil: Re = rho omega h B/mu leaves 0.1 to 1000. Flagged and worded, but run; a failure's reason goes first.
   subroutine reynolds_warning()
      type(block_result) :: r
      integer, parameter :: reynolds = 5

      call run_all(suite, "&sweep key = 'fluid.viscosity_pa_s', values = 0.0484, 0.005 /", r)
      call suite%true("both run", all(r%status == status_ok))
      call suite%true("the second is flagged", all(r%warnings == [0, warn_reynolds]))
      call suite%text("nothing is said of the first", r%message(1)%s, "")
      call suite%close("Re of the first", r%fact(reynolds, 1), 212.0_wp, 2.0e-3_wp, 0.0_wp)
      call suite%close("Re of the second", r%fact(reynolds, 2), r%fact(reynolds, 1)*0.0484_wp/0.005_wp, 1.0e-12_wp, 0.0_wp)
      call suite%text("what is said of the second", r%message(2)%s, "warning: Re = "//to_text(r%fact(reynolds, 2), 5) &
         & //" is outside the range of the hydrodynamic function")
      call run_all(suite, "&fluid viscosity_pa_s = 0.005 /~&solver max_steps = 20 /", r)
      call suite%true("a failure's reason goes before the warning", index(r%message(1)%s, "after 20 steps") == 1)
      call suite%equal("whose flag stays", r%warnings(1), warn_reynolds)
   end subroutine reynolds_warning

   !> A thin reed bends beyond small slopes; the limit is at 0.2 of the length, 1.5 mm, whatever the model.
   subroutine slope_warning()
      type(block_result) :: r
      real(wp) :: largest(2)

      call run_all(suite, "&run start = 'equilibrium' /~&pressure transition_ms = 19.8 /~" &
         & //"&sweep key = 'pressure.inlet_kpa', values = 319, 323 /", r)
      largest = 1.0e3_wp*(r%measure(steady, :) + r%measure(overshoot, :))
      call suite%true("either side of the limit", largest(1) > 1.48_wp .and. largest(1) < 1.5_wp .and. largest(2) > 1.5_wp &
         & .and. largest(2) < 1.52_wp)
      call suite%true("the second is flagged, both are fine", all(r%warnings == [0, warn_large_slope]) &
         & .and. all(r%status == status_ok))
      call suite%text("what is said of it", r%message(2)%s, "warning: the tip moves by "//to_text(largest(2), 4) &
         & //" mm, 0.2 of the reed's length: too steep for the theory of small slopes")
      call run_all(suite, "&run model = 'traditional' /~&pressure inlet_kpa = 250 /~&hydro load = 'none' /", r)
      call suite%true("an overshoot counts", r%measure(steady, 1) < 1.4e-3_wp .and. r%warnings(1) == warn_large_slope)
      call run_all(suite, "&run model = 'film_table', 'film' /~&film modes = 1 /~&reed thickness_mm = 0.02 /", r)
      call suite%true("film models too: "//r%message(1)%s, all(iand(r%warnings, warn_large_slope) > 0))
   end subroutine slope_warning

   !> A pressure that presses a lumped reed onto its seat, or does not open it: the empty measures have a reason.
   subroutine shut_warning()
      type(block_result) :: r

      call run_all(suite, "&run model = 'squeeze', 'traditional' /~" &
         & //"&sweep key = 'pressure.inlet_kpa', values = -20, 0, 20 /", r)
      call suite%true("all are fine", all(r%status == status_ok))
      call suite%true("all but the last are flagged", all(r%warnings == warn_not_open*[1, 1, 0, 1, 1, 0]))
      call suite%text("on its seat", r%message(1)%s, &
         & "warning: at the closing event the pressure presses the reed onto its seat: no times are measured")
      call suite%text("at rest", r%message(2)%s, &
         & "warning: at the closing event the pressure does not hold the reed open: no times are measured")
      call suite%text("without a film there is no seat", r%message(4)%s, r%message(2)%s)
      call suite%true("a steady displacement is missing on the seat alone", all(ieee_is_nan(r%measure(steady, :)) &
         & .eqv. [.true., .false., .false., .false., .false., .false.]))
   end subroutine shut_warning

   !> Where a run starts, and which way its film acts.
   subroutine start_and_film()
      type(block_result) :: r, both, half_open
      character(len=*), parameter :: traces = "&run traces = .true., trace_dt_ms = 20"

      call run_all(suite, traces//" /", r)
      call suite%close("a square wave finds the reed at rest [m]", r%trace(1, 1, 1), 0.0_wp, 0.0_wp, 0.0_wp)
      call run_all(suite, traces//", start = 'equilibrium' /", half_open)
      call suite%close("or half open, if wanted: over the steady displacement", half_open%trace(1, 1, 1) &
         & /half_open%measure(steady, 1), 0.5_wp, 1.0e-12_wp, 0.0_wp)
      call run_all(suite, "&film acts = 'both' /", both)
      call suite%true("a film that acts both ways slows the rise", both%measure(rise, 1) > 1.1_wp*r%measure(rise, 1))
   end subroutine start_and_film

   !> Two periods and a bit: the measures are those of one.
   subroutine first_cycle()
      type(block_result) :: one, many

      call run_all(suite, twelve, one)
      call run_all(suite, "&run t_end_ms = 95 /~"//twelve, many)
      call suite%true("measures are of the first cycle", agree(many%measure, one%measure))
   end subroutine first_cycle

   !> An event in the second period, half a millisecond before the ramp: its closing, which is like the first one's.
   subroutine later_event()
      type(block_result) :: one, later

      call run_all(suite, "&run t_end_ms = 80 /~"//twelve, one)
      call run_all(suite, "&run t_end_ms = 80 /~&pressure event_ms = 59.0 /~"//twelve, later)
      call suite%close("fall of the second closing over the first", &
         & maxval(abs(later%measure(fall, :)/one%measure(fall, :) - 1.0_wp)), 0.0_wp, 0.0_wp, 10.0_wp*agreement)
      call suite%close("closing time of the second closing over the first", &
         & maxval(abs((later%measure(closing, :) - 0.5e-3_wp)/one%measure(closing, :) - 1.0_wp)), 0.0_wp, 0.0_wp, &
         & 10.0_wp*agreement)
   end subroutine later_event

end program test_cases
