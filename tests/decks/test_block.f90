!> Blocks of cases: order, grouping, cutting and threads change nothing.
program test_block
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8
   use rv_deck, only : deck_type
   use rv_columns, only : fact_method
   use rv_block, only : block_result, run_block, block_count, block_bounds
   use rv_status, only : status_ok
   use rv_text, only : to_text
   use check, only : suite_type
   use block_trial, only : run_all, read_good, agree, same_bits, steady, closing, peak, twelve
   implicit none
   type(suite_type) :: suite

   call results_in_deck_order()
   call widths_agree()
   call method_is_told()
   call blocks_agree()
   call threads_agree()
   call models_apart()
   call histories_apart()
   call tolerances_apart()
   call suite%finish()

contains

   !> Models, then gaps, then pressures, the last fastest, though lanes were sorted by other things.
   subroutine results_in_deck_order()
      type(block_result) :: r
      real(wp), parameter :: kpa(4) = [40.0_wp, 5.0_wp, 20.0_wp, 10.0_wp]
      real(wp) :: per_kpa
      integer :: model, gap, i, n
      logical :: right_film

      call run_all(suite, "&run model = 'squeeze', 'traditional' /~&solver width = 4 /~"//twelve, r)
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

   !> Each group of lanes chooses for itself under `auto`, and the results say what.
   subroutine method_is_told()
      type(block_result) :: r

      call run_all(suite, "&solver method = 'auto', width = 1 /~&sweep key = 'film.gap_mm', values = 0.2, 0.03 /", r)
      call suite%true("explicit at 0.2 mm, implicit at 0.03 mm", all(nint(r%fact(fact_method, :)) == [2, 1]))
      call run_all(suite, "&solver method = 'auto' /~&sweep key = 'film.gap_mm', values = 0.2, 0.03 /", r)
      call suite%true("together both implicit", all(nint(r%fact(fact_method, :)) == 1))
      call run_all(suite, "&run model = 'squeeze', 'film_table' /~&solver method = 'auto' /~&film gap_mm = 0.055 /", r)
      call suite%true("the table's stages are dear: implicit from wider gaps on", all(nint(r%fact(fact_method, :)) == [2, 1]))
      call run_all(suite, "&solver method = 'explicit' /~&film gap_mm = 0.2 /", r)
      call suite%true("explicit as asked for", all(nint(r%fact(fact_method, :)) == 2))
   end subroutine method_is_told

   !> One lane an integrator, two, some, all of them.
   subroutine widths_agree()
      type(block_result) :: r, alone
      type(deck_type) :: deck
      character(len=*), parameter :: width(3) = ["2  ", "8  ", "64 "]
      integer :: i

      call read_good(suite, "&run model = 'squeeze', 'traditional' /~&solver width = 1 /~"//twelve, deck)
      call run_block(deck, 1_i8, 24_i8, alone)
      call run_block(deck, 7_i8, 7_i8, r)
      call suite%true("one lane an integrator: as in a block of its own, to the last bit", &
         & same_bits(r%measure, alone%measure(:, 7:7)))
      do i = 1, 3
         call run_all(suite, "&run model = 'squeeze', 'traditional' /~&solver width = "//width(i)//"/~"//twelve, r)
         call suite%true("groups of "//width(i)//"lanes as one by one", agree(r%measure, alone%measure))
         call suite%true("with the same facts, to the last bit", same_bits(r%fact, alone%fact))
         call suite%true("but steps in common", .not. same_bits(r%measure, alone%measure))
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

      call run_all(suite, "&run model = 'squeeze', 'traditional' /~"//twelve, whole)
      do k = 1, 2
         call read_good(suite, "&run model = 'squeeze', 'traditional', block_size = "//size_of(k)//" /~"//twelve, deck)
         as_whole = .true.
         do i = 1, block_count(deck)
            call block_bounds(deck, i, first, last)
            call run_block(deck, first, last, part)
            as_whole = as_whole .and. part%first == first .and. agree(part%measure, whole%measure(:, int(first):int(last)))
         end do
         call suite%true("blocks of "//size_of(k)//" as one block", as_whole)
      end do
   end subroutine blocks_agree

   !> Two threads that take blocks as they come: not one bit differs from one thread, nor a letter.
   subroutine threads_agree()
      call on_two_threads("cases that end well", "&run model = 'squeeze', 'traditional', block_size = 5, traces = .true., " &
         & //"trace_dt_ms = 0.5 /~"//twelve)
      call on_two_threads("cases with warnings", "&run t_end_ms = 1, block_size = 1 /~&fluid viscosity_pa_s = 0.005 /~"//twelve)
      call on_two_threads("cases that fail", "&run model = 'squeeze', 'traditional', block_size = 1 /~&solver max_steps = 60 /~" &
         & //twelve)
   end subroutine threads_agree

   subroutine on_two_threads(what, text)
      character(len=*), intent(in) :: what, text
      type(block_result), allocatable :: one(:), two(:)
      type(deck_type) :: deck
      integer :: i, k, n
      logical :: same

      call read_good(suite, text, deck)
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
         do k = 1, size(one(i)%message)
            same = same .and. one(i)%message(k)%s == two(i)%message(k)%s
         end do
      end do
      call suite%true(what//" on two threads", same)
   end subroutine on_two_threads

   subroutine run_nth(deck, i, result)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: i
      type(block_result), intent(out) :: result
      integer(i8) :: first, last

      call block_bounds(deck, i, first, last)
      call run_block(deck, first, last, result)
   end subroutine run_nth

   !> Models do not share an integrator, whatever their order: each case is as in a deck of its model, to the last bit.
   subroutine models_apart()
      type(block_result) :: all_four, one
      character(len=*), parameter :: rest = " t_end_ms = 1.5, traces = .true., trace_dt_ms = 0.5 /~&film modes = 2 /~" &
         & //"&sweep key = 'film.gap_mm', values = 0.1, 0.05, 0.2 /"
      character(len=11), parameter :: model(4) = [character(len=11) :: "film_table", "squeeze", "film", "traditional"]
      integer :: i
      logical :: same

      call run_all(suite, "&run model = 'film_table', 'squeeze', 'film', 'traditional',"//rest, all_four)
      call suite%true("four models: all end well", all(all_four%status == status_ok))
      same = .true.
      do i = 1, 4
         call run_all(suite, "&run model = '"//trim(model(i))//"',"//rest, one)
         same = same .and. same_bits(all_four%measure(:, 3*i - 2:3*i), one%measure) &
            & .and. same_bits(all_four%fact(:, 3*i - 2:3*i), one%fact)
      end do
      call suite%true("each as in a deck of its model", same)
      call suite%true("film models have values in all traces, lumped ones in the first five", &
         & .not. any(ieee_is_nan(all_four%trace(:, :, [1, 2, 3, 7, 8, 9]))) .and. &
         & all(ieee_is_nan(all_four%trace(:, 6:, [4, 5, 6, 10, 11, 12]))) .and. &
         & .not. any(ieee_is_nan(all_four%trace(:, :5, [4, 5, 6, 10, 11, 12]))))
   end subroutine models_apart

   !> Cases whose pressures run in other times do not share an integrator: each is as alone, to the last bit.
   subroutine histories_apart()
      call suite%true("periods", each_as_alone("pressure.period_ms", ["40", "30", "36"]))
      call suite%true("ramps", each_as_alone("pressure.transition_ms", ["1 ", "3 ", "2 "]))
      call suite%true("events", each_as_alone("pressure.event_ms", ["20", "21", "19"]))
      call suite%true("ends", each_as_alone("run.t_end_ms", ["21", "40", "19"]))
   end subroutine histories_apart

   logical function each_as_alone(key, value) result(same)
      character(len=*), intent(in) :: key
      character(len=2), intent(in) :: value(3)
      type(block_result) :: all_three, alone
      integer :: i

      call run_all(suite, "&sweep key = '"//key//"', values = "//value(1)//","//value(2)//","//value(3)//" /", all_three)
      same = .not. (same_bits(all_three%measure(:, 1:1), all_three%measure(:, 2:2)) &
         & .or. same_bits(all_three%measure(:, 2:2), all_three%measure(:, 3:3)))
      do i = 1, 3
         call run_all(suite, "&sweep key = '"//key//"', values = "//value(i)//" /", alone)
         same = same .and. same_bits(all_three%measure(:, i:i), alone%measure)
      end do
   end function each_as_alone

   !> Cases of different tolerance do not share an integrator: the rough ones are as rough as alone.
   subroutine tolerances_apart()
      type(block_result) :: both, rough, fine
      real(wp) :: distance

      call run_all(suite, "&sweep key = 'solver.rtol', values = 1e-3, 1e-9 /", both)
      call run_all(suite, "&solver rtol = 1e-3 /", rough)
      call run_all(suite, "&solver rtol = 1e-9 /", fine)
      call suite%true("the rough one as alone, to the last bit", same_bits(both%measure(:, 1:1), rough%measure))
      call suite%true("the fine one as alone, to the last bit", same_bits(both%measure(:, 2:2), fine%measure))
      distance = abs(both%measure(closing, 1)/both%measure(closing, 2) - 1.0_wp)
      call suite%true("they differ as their tolerances do: by "//to_text(distance, 3), distance > 1.0e-8_wp &
         & .and. distance < 1.0e-2_wp)
   end subroutine tolerances_apart

end program test_block
