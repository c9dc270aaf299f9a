!> Blocks of cases, from deck to results: order, grouping, cutting and threads change nothing; each case fails alone.
program test_block
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_deck, only : deck_type
   use rv_block, only : block_result, run_block, block_count, block_bounds
   use rv_status, only : status_ok, status_bad_case, status_film_closed, status_too_many_steps, warn_reynolds
   use rv_text, only : to_text
   use check, only : suite_type
   use deck_trial, only : read_trial
   implicit none
   type(suite_type) :: suite
   integer, parameter :: steady = 1, overshoot = 4, fall = 5, closing = 6, undershoot = 8, peak = 9
   real(wp), parameter :: agreement = 1.0e-4_wp   !! of cases run in different company at rtol 1e-6
   character(len=*), parameter :: sweeps = "&sweep key = 'film.gap_mm', values = 0.1, 0.04, 0.05 /~" &
      & //"&sweep key = 'pressure.inlet_kpa', values = 40, 5, 20, 10 /"

   call paper_tables()
   call results_in_deck_order()
   call widths_agree()
   call blocks_agree()
   call threads_agree()
   call tolerances_apart()
   call ends_apart()
   call bad_cases()
   call case_on_its_seat()
   call step_limit()
   call reynolds_warning()
   call first_cycle()
   call later_event()
   call suite%finish()

contains

   !> The traditional pair and PAPER's reading of Tables III and IV at 5, 20 and 40 kPa, to the digits given there.
   subroutine paper_tables()
      type(block_result) :: r
      integer :: i
      real(wp), parameter :: falls(3) = [2.843_wp, 1.503_wp, 0.931_wp], closings(3) = [6.039_wp, 4.117_wp, 3.049_wp]

      call run("&run model = 'traditional', 'squeeze' /~&reed action_area_mm2 = 12.56 /~" &
         & //"&sweep key = 'pressure.inlet_kpa', values = 5, 20, 40 /", r)
      do i = 1, 3
         call suite%close("traditional fall [ms]", 1.0e3_wp*r%measure(fall, i), 0.623_wp, 0.0_wp, 2.0e-3_wp)
         call suite%close("traditional closing [ms]", 1.0e3_wp*r%measure(closing, i), 1.021_wp, 0.0_wp, 2.0e-3_wp)
         call suite%close("fall with film [ms]", 1.0e3_wp*r%measure(fall, 3 + i), falls(i), 0.0_wp, 0.6e-3_wp)
         call suite%close("closing with film [ms]", 1.0e3_wp*r%measure(closing, 3 + i), closings(i), 0.0_wp, 0.6e-3_wp)
      end do
      call suite%close("steady displacement at 20 kPa [mm]", 1.0e3_wp*r%measure(steady, 2), 0.093316_wp, 1.0e-5_wp, 0.0_wp)
   end subroutine paper_tables

   !> Models, then gaps, then pressures, the last fastest, though lanes were sorted by other things.
   subroutine results_in_deck_order()
      type(block_result) :: r
      real(wp), parameter :: kpa(4) = [40.0_wp, 5.0_wp, 20.0_wp, 10.0_wp]
      real(wp) :: per_kpa
      integer :: model, gap, i, n
      logical :: right_film

      call run("&run model = 'squeeze', 'traditional' /~&solver width = 4 /~"//sweeps, r)
      call suite%equal("first case", int(r%first), 1)
      call suite%equal("cases", size(r%status), 24)
      call suite%true("all end well, without a word", all(r%status == status_ok) .and. all(r%warnings == 0) .and. &
         & all([(r%message(n)%s == "", n=1, 24)]))
      per_kpa = r%measure(steady, 3)/20.0_wp
      right_film = .true.
      n = 0
      do model = 1, 2
         do gap = 1, 3
            do i = 1, 4
               n = n + 1
               call suite%close("steady displacement of case "//to_text(n)//" tells its pressure", &
                  & r%measure(steady, n)/per_kpa, kpa(i), 1.0e-12_wp, 0.0_wp)
               right_film = right_film .and. (r%measure(peak, n) > 0.0_wp .eqv. model == 1)
            end do
         end do
      end do
      call suite%true("half the cases have a film", right_film)
      call suite%true("the thinner the film the longer it closes: 0.04, 0.05, 0.1 mm", &
         & all(r%measure(closing, 5:8) > r%measure(closing, 9:12)) .and. all(r%measure(closing, 9:12) > r%measure(closing, 1:4)))
      call suite%true("without film the gap does not matter", agree(r%measure(:, 13:16), r%measure(:, 17:20)))
   end subroutine results_in_deck_order

   subroutine widths_agree()
      type(block_result) :: r, alone
      character(len=*), parameter :: width(3) = ["2  ", "8  ", "64 "]
      integer :: i

      call run("&run model = 'squeeze', 'traditional' /~&solver width = 1 /~"//sweeps, alone)
      do i = 1, 3
         call run("&run model = 'squeeze', 'traditional' /~&solver width = "//width(i)//"/~"//sweeps, r)
         call suite%true("groups of "//width(i)//"lanes as one by one", agree(r%measure, alone%measure))
         call suite%true("with the same facts, to the last bit", .not. any(abs(r%fact - alone%fact) > 0.0_wp))
      end do
   end subroutine widths_agree

   !> Cut into blocks of 1, 5 and 24 cases.
   subroutine blocks_agree()
      type(block_result) :: whole, part
      type(deck_type) :: deck
      integer(i8) :: first, last
      integer :: i, k
      character(len=*), parameter :: size_of(2) = ["1", "5"]
      logical :: as_whole

      call run("&run model = 'squeeze', 'traditional' /~"//sweeps, whole)
      do k = 1, 2
         call read_good("&run model = 'squeeze', 'traditional', block_size = "//size_of(k)//" /~"//sweeps, deck)
         as_whole = .true.
         do i = 1, block_count(deck)
            call block_bounds(deck, i, first, last)
            call run_block(deck, first, last, part)
            as_whole = as_whole .and. part%first == first .and. agree(part%measure, whole%measure(:, int(first):int(last)))
         end do
         call suite%true("blocks of "//size_of(k)//" as one block", as_whole)
      end do
   end subroutine blocks_agree

   !> Two threads that take blocks as they come: not one bit differs from one thread.
   subroutine threads_agree()
      type(block_result), allocatable :: one(:), two(:)
      type(deck_type) :: deck
      integer :: i, n
      logical :: same

      call read_good("&run model = 'squeeze', 'traditional', block_size = 5, traces = .true., trace_dt_ms = 0.5 /~"//sweeps, deck)
      n = block_count(deck)
      allocate(one(n), two(n))
      do i = 1, n
         call run_nth(deck, i, one(i))
      end do
      !$omp parallel do schedule(dynamic, 1) num_threads(2) default(none) shared(deck, two, n) private(i)
      do i = n, 1, -1
         call run_nth(deck, i, two(i))
      end do
      !$omp end parallel do
      same = .true.
      do i = 1, n
         same = same .and. same_bits(one(i)%measure, two(i)%measure) .and. same_bits(one(i)%fact, two(i)%fact)
         same = same .and. all(transfer(one(i)%trace, [1_i8], size(one(i)%trace)) &
            & == transfer(two(i)%trace, [1_i8], size(two(i)%trace)))
      end do
      call suite%true("two threads, the same bits", same)

   end subroutine threads_agree

   subroutine run_nth(deck, i, result)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: i
      type(block_result), intent(out) :: result
      integer(i8) :: first, last

      call block_bounds(deck, i, first, last)
      call run_block(deck, first, last, result)
   end subroutine run_nth

   !> Cases of different tolerance do not share an integrator: the rough ones are as rough as alone.
   subroutine tolerances_apart()
      type(block_result) :: both, rough, fine
      real(wp) :: distance

      call run("&sweep key = 'solver.rtol', values = 1e-3, 1e-9 /", both)
      call run("&solver rtol = 1e-3 /", rough)
      call run("&solver rtol = 1e-9 /", fine)
      call suite%true("the rough one as alone, to the last bit", same_bits(both%measure(:, 1:1), rough%measure))
      call suite%true("the fine one as alone, to the last bit", same_bits(both%measure(:, 2:2), fine%measure))
      distance = abs(both%measure(closing, 1)/both%measure(closing, 2) - 1.0_wp)
      call suite%true("they differ as their tolerances do: by "//to_text(distance, 3), distance > 1.0e-8_wp &
         & .and. distance < 1.0e-2_wp)
   end subroutine tolerances_apart

   !> Ends before, in and after the closing event at 19.5 ms: what was not reached is missing, the rest agrees.
   subroutine ends_apart()
      type(block_result) :: r

      call run("&sweep key = 'run.t_end_ms', values = 40, 10, 21.5, 19.5 /", r)
      call suite%true("all end well", all(r%status == status_ok))
      call suite%true("nothing closes by 10 ms", all(ieee_is_nan(r%measure(overshoot:undershoot, 2))))
      call suite%true("by 19.5 ms the overshoot is known", r%measure(overshoot, 4) > 0.0_wp .and. &
         & all(ieee_is_nan(r%measure(fall:undershoot, 4))))
      call suite%true("by 21.5 ms it falls, but is not closed", r%measure(fall, 3) > 0.0_wp &
         & .and. ieee_is_nan(r%measure(closing, 3)))
      call suite%true("they open alike", agree(r%measure(:3, 2:2), r%measure(:3, 1:1)) &
         & .and. agree(r%measure(:4, 4:4), r%measure(:4, 1:1)) .and. agree(r%measure(:fall, 3:3), r%measure(:fall, 1:1)))
   end subroutine ends_apart

   !> Beyond the first 10000 cases, which are checked with the deck, each case checks itself.
   subroutine bad_cases()
      type(deck_type) :: deck
      type(block_result) :: r

      call read_good("&sweep key = 'reed.hole_diameter_mm', from = 4, to = 6.0002, count = 10002 /", deck)
      call run_block(deck, 10000_i8, 10002_i8, r)
      call suite%true("holes up to the reed's width are fine", all(r%status(1:2) == status_ok))
      call expect_bad("a hole wider than the reed", r, 3, "wider than the reed")

      call read_good("&run t_end_ms = 30 /~&sweep key = 'pressure.transition_ms', from = 1, to = 20, count = 10001 /", deck)
      call run_block(deck, 9999_i8, 10001_i8, r)
      call suite%true("ramps up to half the period are fine", all(r%status(1:2) == status_ok))
      call expect_bad("a ramp of half the period", r, 3, "transition < period/2")

      call read_good("&run t_end_ms = 1000 /~&pressure transition_ms = 0.002 /~" &
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
      call suite%true("it has no measures", all(ieee_is_nan(r%measure(:, i))))
   end subroutine expect_bad

   !> A film too weak to stop its reed, in one group with others: it fails late, with its reason, and they do not notice.
   subroutine case_on_its_seat()
      type(block_result) :: r, others
      character(len=*), parameter :: tiny = "&run traces = .true., trace_dt_ms = 0.5 /~&film gap_mm = 0.001 /~"
      integer :: i

      call run(tiny//"&sweep key = 'film.k_s', values = 0.0075, 1e-70, 0.02 /", r)
      call run(tiny//"&sweep key = 'film.k_s', values = 0.0075, 0.02 /", others)
      call suite%equal("case on its seat: status", r%status(2), status_film_closed)
      call suite%true("its message: "//r%message(2)%s, index(r%message(2)%s, "at t = 0.02") == 1)
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

      call run("&solver max_steps = 20 /~&sweep key = 'film.gap_mm', values = 0.05, 0.1 /", r)
      call suite%true("both cases stop at the limit", all(r%status == status_too_many_steps))
      call suite%true("and say so: "//r%message(2)%s, index(r%message(2)%s, "after 20 steps") == 1 &
         & .and. index(r%message(2)%s, "max_steps") > 0)
   end subroutine step_limit

   !> Thin oil: Re = rho omega h B/mu leaves 0.1 to 1000. Flagged and worded, but run; a failure's reason goes first.
   subroutine reynolds_warning()
      type(block_result) :: r
      integer, parameter :: reynolds = 5

      call run("&sweep key = 'fluid.viscosity_pa_s', values = 0.0484, 0.005 /", r)
      call suite%true("both run", all(r%status == status_ok))
      call suite%true("the second is flagged", all(r%warnings == [0, warn_reynolds]))
      call suite%text("nothing is said of the first", r%message(1)%s, "")
      call suite%close("Re of the first", r%fact(reynolds, 1), 212.0_wp, 2.0e-3_wp, 0.0_wp)
      call suite%close("Re of the second", r%fact(reynolds, 2), r%fact(reynolds, 1)*0.0484_wp/0.005_wp, 1.0e-12_wp, 0.0_wp)
      call suite%text("what is said of the second", r%message(2)%s, "warning: Re = "//to_text(r%fact(reynolds, 2), 5) &
         & //" is outside the range of the hydrodynamic function")
      call run("&fluid viscosity_pa_s = 0.005 /~&solver max_steps = 20 /", r)
      call suite%true("a failure's reason goes before the warning", index(r%message(1)%s, "after 20 steps") == 1)
      call suite%equal("whose flag stays", r%warnings(1), warn_reynolds)
   end subroutine reynolds_warning

   !> Two periods and a bit: the measures are those of one.
   subroutine first_cycle()
      type(block_result) :: one, many

      call run(sweeps, one)
      call run("&run t_end_ms = 95 /~"//sweeps, many)
      call suite%true("measures are of the first cycle", agree(many%measure, one%measure))
   end subroutine first_cycle

   !> An event in the second period: its closing, which is like the first one's.
   subroutine later_event()
      type(block_result) :: one, later

      call run("&run t_end_ms = 80 /~"//sweeps, one)
      call run("&run t_end_ms = 80 /~&pressure event_ms = 59.5 /~"//sweeps, later)
      call suite%close("fall of the second closing over the first", &
         & maxval(abs(later%measure(fall, :)/one%measure(fall, :) - 1.0_wp)), 0.0_wp, 0.0_wp, 10.0_wp*agreement)
      call suite%close("closing time of the second closing over the first", &
         & maxval(abs(later%measure(closing, :)/one%measure(closing, :) - 1.0_wp)), 0.0_wp, 0.0_wp, 10.0_wp*agreement)
   end subroutine later_event

   !> The same measures, relative to the steady displacement, to themselves, to the force; missing in both or in none.
   logical function agree(a, b)
      real(wp), intent(in) :: a(:, :), b(:, :)
      real(wp) :: size_of
      integer :: k, i

      agree = all(ieee_is_nan(a) .eqv. ieee_is_nan(b))
      do i = 1, size(a, 2)
         do k = 1, size(a, 1)
            if (ieee_is_nan(a(k, i))) cycle
            size_of = abs(b(k, i))
            if (k == overshoot .or. k == undershoot) size_of = b(steady, i)
            agree = agree .and. abs(a(k, i) - b(k, i)) <= agreement*size_of
         end do
      end do
   end function agree

   pure logical function same_bits(a, b)
      real(wp), intent(in) :: a(:, :), b(:, :)

      same_bits = all(transfer(a, [1_i8], size(a)) == transfer(b, [1_i8], size(b)))
   end function same_bits

   !> All cases of a deck as one block.
   subroutine run(text, result)
      character(len=*), intent(in) :: text
      type(block_result), intent(out) :: result
      type(deck_type) :: deck

      call read_good(text, deck)
      call run_block(deck, 1_i8, deck%case_count(), result)
   end subroutine run

   subroutine read_good(text, deck)
      character(len=*), intent(in) :: text
      type(deck_type), intent(out) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error

      call read_trial(text//"~", deck, faults, error)
      call suite%no_error("deck", error)
      if (faults%errors() > 0) call suite%text("a deck without faults", faults%all_text(), "")
   end subroutine read_good

end program test_block
