!> Histories stored by a deck: their grid of times, where they begin and end, what they hold, how they cut blocks.
program test_traces
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8, pi
   use rv_deck, only : deck_type
   use rv_block, only : block_result, run_block, block_count, block_bounds, trace_times
   use rv_status, only : status_ok, status_bad_case, status_film_closed
   use rv_text, only : to_text
   use check, only : suite_type
   use deck_trial, only : lines, write_file
   use block_trial, only : read_good
   implicit none
   type(suite_type) :: suite
   integer, parameter :: displacement = 1, velocity = 2, inlet = 3, outlet = 4, force = 5
   real(wp), parameter :: ms = 1.0e-3_wp
   character(len=*), parameter :: traces = "traces = .true., "

   call write_file("early.csv", lines("t_ms,p_in_kpa,p_out_kpa~1,30,10~2,30,10~3,20,10~4,10,10~5,5,10~6,5,10~"))
   call write_file("late.csv", lines("t_ms,p_diff_kpa~2.5,20~3.5,20~4.5,10~5.5,0~6.5,0~7.5,0~8.5,0~"))
   call grids()
   call grid_of_files()
   call ends_on_the_grid()
   call what_they_hold()
   call without_traces()
   call of_files()
   call starts()
   call bounds()
   call default_size()
   call memory()
   call suite%finish()

contains

   !> No traces, a step that divides the run, one that does not, one as long as the run, one longer.
   subroutine grids()
      call grid("no traces", "&run t_end_ms = 40 /", 0)
      call grid("0.02 ms in 40 ms by default", "&run "//traces//" /", 2001, last=40.0_wp)
      call grid("0.3 ms in 1 ms", "&run "//traces//"t_end_ms = 1, trace_dt_ms = 0.3 /", 4, last=0.9_wp)
      call grid("0.1 ms in 0.3 ms", "&run "//traces//"t_end_ms = 0.3, trace_dt_ms = 0.1 /", 4, last=0.3_wp)
      call grid("one step", "&run "//traces//"t_end_ms = 7, trace_dt_ms = 7 /", 2, last=7.0_wp)
      call grid("a step longer than the run", "&run "//traces//"t_end_ms = 7, trace_dt_ms = 7.01 /", 1, last=0.0_wp)
      call grid("the longest of swept ends", "&run "//traces//"trace_dt_ms = 1 /" &
         & //"&sweep key = 'run.t_end_ms', values = 5, 13, 9 /", 14, last=13.0_wp)
      call write_file("plan.csv", lines("film.gap_mm,run.t_end_ms~0.05,5~0.1,8~0.05,6~"))
      call grid("the longest end of a plan", "&run "//traces//"trace_dt_ms = 1 /~&design file = 'plan.csv' /", 9, last=8.0_wp)
   end subroutine grids

   subroutine grid(what, text, n, last)
      character(len=*), intent(in) :: what, text
      integer, intent(in) :: n
      real(wp), intent(in), optional :: last   !! [ms]
      type(deck_type) :: deck

      call read_good(suite, text, deck)
      associate (time => trace_times(deck))
         call suite%equal(what//": samples", size(time), n)
         if (size(time) /= n .or. n == 0) return
         call suite%close(what//": first", time(1), 0.0_wp, 0.0_wp, 0.0_wp)
         if (present(last)) call suite%close(what//": last, to the last bit", time(n), last/1.0e3_wp, 0.0_wp, 0.0_wp)
         call suite%true(what//": rising", all(time(2:) > time(:n - 1)))
      end associate
   end subroutine grid

   !> With trace files: from the first start to the last end.
   subroutine grid_of_files()
      type(deck_type) :: deck

      call read_good(suite, "&run "//traces//"trace_dt_ms = 0.25 /~&pressure kind = 'trace', event_ms = 3 /~" &
         & //"&sweep key = 'pressure.file', values = 'early.csv', 'late.csv' /", deck)
      associate (time => trace_times(deck))
         call suite%equal("samples from 1 to 8.5 ms", size(time), 31)
         call suite%close("first [ms]", time(1)/ms, 1.0_wp, 1.0e-15_wp, 0.0_wp)
         call suite%close("last [ms]", time(size(time))/ms, 8.5_wp, 1.0e-15_wp, 0.0_wp)
      end associate
   end subroutine grid_of_files

   !> Cases that end on the grid, at times that 0.05 ms times an integer misses by a rounding: the last sample is there.
   subroutine ends_on_the_grid()
      type(deck_type) :: deck
      type(block_result) :: r
      integer :: i, k
      integer, parameter :: t_end(6) = [1, 3, 9, 11, 13, 15]   !! [ms]
      logical :: exact

      call read_good(suite, "&run "//traces//"trace_dt_ms = 0.05 /~&solver rtol = 1e-3 /~" &
         & //"&sweep key = 'run.t_end_ms', values = 1, 3, 9, 11, 13, 15 /", deck)
      call run_block(deck, 1_i8, 6_i8, r)
      do i = 1, 6
         exact = .true.
         do k = 1, size(r%trace, 1)
            exact = exact .and. (ieee_is_nan(r%trace(k, displacement, i)) .eqv. k > 20*t_end(i) + 1)
         end do
         call suite%true("a run to "//to_text(t_end(i))//" ms has samples up to there and none after", exact)
      end do
      call suite%true("the common part agrees", &
         & all(abs(r%trace(:21, displacement, 1) - r%trace(:21, displacement, 6)) < 1.0e-2_wp*r%measure(1, 6)))
   end subroutine ends_on_the_grid

   !> Displacement and velocity fit together; pressures are the square wave's; the film acts while closing.
   subroutine what_they_hold()
      type(deck_type) :: deck
      type(block_result) :: r
      real(wp) :: p, worst
      integer :: k

      call read_good(suite, "&run model = 'squeeze', 'traditional', "//traces//" /~&pressure outlet_kpa = 3 /", deck)
      call run_block(deck, 1_i8, 2_i8, r)
      associate (x => r%trace(:, :, 1), time => trace_times(deck))
         worst = maxval(abs(x(3:, displacement) - x(:1999, displacement) - 0.02_wp*ms/3.0_wp*(x(:1999, velocity) &
            & + 4.0_wp*x(2:2000, velocity) + x(3:, velocity))))
         call suite%close("displacement less integral of the velocity [m]", worst, 0.0_wp, 0.0_wp, 1.0e-9_wp)
         worst = 0.0_wp
         do k = 1, size(time)
            p = 20.0e3_wp*max(0.0_wp, min(1.0_wp, 0.5_wp + time(k)/ms, 20.5_wp - time(k)/ms))
            if (time(k) > 39.5_wp*ms) p = 20.0e3_wp*(time(k)/ms - 39.5_wp)
            worst = max(worst, abs(x(k, inlet) - p), abs(x(k, outlet) - 3.0e3_wp))
         end do
         call suite%close("pressures less the square wave [Pa]", worst, 0.0_wp, 0.0_wp, 1.0e-6_wp)
         call suite%true("the film acts while closing only", all(x(:, force) > 0.0_wp .eqv. x(:, velocity) < 0.0_wp))
         call suite%close("its largest force is the measure [N]", maxval(x(:, force)), r%measure(9, 1), 1.0e-3_wp, 0.0_wp)
         call suite%close("its largest displacement is steady + overshoot [m]", maxval(x(:, displacement)), &
            & r%measure(1, 1) + r%measure(4, 1), 1.0e-4_wp, 0.0_wp)
      end associate
      call suite%close("no film, no force [N]", maxval(abs(r%trace(:, force, 2))), 0.0_wp, 0.0_wp, 0.0_wp)
   end subroutine what_they_hold

   subroutine without_traces()
      type(deck_type) :: deck
      type(block_result) :: r

      call read_good(suite, "&run t_end_ms = 1 /", deck)
      call run_block(deck, 1_i8, 1_i8, r)
      call suite%equal("samples without traces", size(r%trace, 1), 0)
      call suite%equal("cases all the same", size(r%trace, 3), 1)
   end subroutine without_traces

   !> Two files of other starts and ends in one block: each case has its own stretch of the grid, from equilibrium on.
   subroutine of_files()
      type(deck_type) :: deck
      type(block_result) :: r
      real(wp) :: open
      integer :: i

      call read_good(suite, "&run "//traces//"trace_dt_ms = 0.25 /~&pressure kind = 'trace', event_ms = 3.5 /~" &
         & //"&sweep key = 'pressure.file', values = 'late.csv', 'early.csv' /", deck)
      call run_block(deck, 1_i8, 2_i8, r)
      call suite%true("both end well", all(r%status == status_ok))
      call suite%true("the late one from 2.5 ms on", all([(ieee_is_nan(r%trace(i, displacement, 1)) .eqv. i < 7, i=1, 31)]))
      call suite%true("the early one up to 6 ms", all([(ieee_is_nan(r%trace(i, displacement, 2)) .eqv. i > 21, i=1, 31)]))
      open = 20.0e3_wp*pi*0.25_wp*(4.0_wp*ms)**2/r%fact(1, 1)
      call suite%close("the late one begins open by 20 kPa [mm]", r%trace(7, displacement, 1)/ms, open/ms, 1.0e-12_wp, 0.0_wp)
      call suite%close("the early one too", r%trace(1, displacement, 2)/ms, open/ms, 1.0e-12_wp, 0.0_wp)
      call suite%close("outlet of the early one [kPa]", maxval(abs(r%trace(:21, outlet, 2)/1.0e3_wp - 10.0_wp)), 0.0_wp, &
         & 0.0_wp, 1.0e-12_wp)
      call suite%close("inlet of the late one at 4.5 ms [kPa]", r%trace(15, inlet, 1)/1.0e3_wp, 10.0_wp, 1.0e-12_wp, 0.0_wp)
   end subroutine of_files

   !> Files of the same times and other pressures, in one block; a start at rest, and starts where the film is closed.
   subroutine starts()
      type(deck_type) :: deck
      type(block_result) :: r
      character(len=*), parameter :: head = "trace_dt_ms = 1 /~&pressure kind = 'trace', event_ms = 3 /~"

      call write_file("shut.csv", lines("t_ms,p_diff_kpa~1,-20~2,-20~3,-20~4,-20~5,-20~6,-20~"))
      call read_good(suite, "&run "//traces//head//"&sweep key = 'film.gap_mm', values = 0.05, 0.2 /" &
         & //"&sweep key = 'pressure.file', values = 'early.csv', 'shut.csv' /", deck)
      call run_block(deck, 1_i8, 4_i8, r)
      call suite%true("the gap decides whether a reed can start shut", all(r%status == [status_ok, status_film_closed, status_ok, &
         & status_ok]))
      call suite%true("why not: "//r%message(2)%s, index(r%message(2)%s, "no static equilibrium to start from") > 0)
      call suite%true("nothing is known of it", all(ieee_is_nan(r%trace(:, :, 2))) .and. all(ieee_is_nan(r%measure(:8, 2))))
      call suite%close("the other stays where it is", maxval(abs(r%trace(:, displacement, 4) + 20.0e3_wp*pi*0.25_wp &
         & *(4.0_wp*ms)**2/r%fact(1, 4))), 0.0_wp, 0.0_wp, 1.0e-9_wp)
      call suite%true("and has its own file's pressure", all(r%trace(:, inlet, 4) < 0.0_wp))

      call read_good(suite, "&run start = 'rest', "//traces//head//"&sweep key = 'pressure.file', values = 'early.csv' /", deck)
      call run_block(deck, 1_i8, 1_i8, r)
      call suite%close("at rest if wanted [m]", r%trace(1, displacement, 1), 0.0_wp, 0.0_wp, 0.0_wp)

      call read_good(suite, "&pressure kind = 'trace', event_ms = 3, file = 'late.csv' /~" &
         & //"&sweep key = 'run.t_end_ms', from = 8.5, to = 2.5, count = 10001 /", deck)
      call run_block(deck, 10000_i8, 10001_i8, r)
      call suite%true("a run that ends where its file begins is a bad case", all(r%status == [status_ok, status_bad_case]))
      call suite%true("its reason: "//r%message(2)%s, index(r%message(2)%s, "before its pressure history starts") > 0)
   end subroutine starts

   !> Blocks cover all cases once, in order, whatever their size: 1, a divisor, not a divisor, all, more than all.
   subroutine bounds()
      integer, parameter :: block_size(6) = [1, 5, 7, 34, 35, 1000]
      integer :: i

      do i = 1, size(block_size)
         call covers("blocks of "//to_text(block_size(i)), "&run block_size = "//to_text(block_size(i))//" /", &
            & (35 + block_size(i) - 1)/block_size(i), min(35, block_size(i)))
      end do
   end subroutine bounds

   !> Left to themselves, blocks follow the number of cases: 2048 cases at least, 64 blocks, then 8192 cases; with
   !> the model film 16 to 256.
   subroutine default_size()
      integer, parameter :: side(7) = [5, 32, 64, 181, 256, 512, 1000]
      integer, parameter :: largest(7) = [25, 1024, 2048, 2048, 2048, 4096, 8192]
      integer, parameter :: of_film(7) = [16, 16, 64, 256, 256, 256, 256]
      integer :: i

      do i = 1, size(side)
         call first_block("squeeze", side(i), largest(i))
         call first_block("film", side(i), of_film(i))
      end do
   end subroutine default_size

   subroutine first_block(model, side, cases)
      character(len=*), intent(in) :: model
      integer, intent(in) :: side, cases
      type(deck_type) :: deck
      integer(i8) :: first, last

      call read_good(suite, "&run model = '"//model//"' /~&sweep key = 'film.gap_mm', from = 0.05, to = 0.09, count = " &
         & //to_text(side)//" /~&sweep key = 'pressure.inlet_kpa', from = 5, to = 35, count = "//to_text(side)//" /", deck)
      call block_bounds(deck, 1, first, last)
      call suite%equal("a block of "//to_text(side)//" times "//to_text(side)//" cases with "//model, int(last), cases)
   end subroutine first_block

   !> Blocks whose traces would take more than 64 MiB are smaller: 200001 samples of 5 values are 7.6 MiB. A case that
   !> alone takes more is a block.
   subroutine memory()
      type(deck_type) :: deck
      integer(i8) :: first, last

      call covers("traces of 7.6 MiB a case", "&run "//traces//"trace_dt_ms = 2e-4 /", 5, 8)
      call covers("of which fewer are wanted", "&run "//traces//"trace_dt_ms = 2e-4, block_size = 6 /", 6, 6)
      call read_good(suite, "&run "//traces//"trace_dt_ms = 2e-5 /~&sweep key = 'film.gap_mm', values = 0.05, 0.1, 0.2 /", deck)
      call suite%equal("traces of 76 MiB a case: blocks", block_count(deck), 3)
      call block_bounds(deck, 2, first, last)
      call suite%true("a case is a block", first == 2 .and. last == 2)
   end subroutine memory

   subroutine covers(what, text, blocks, largest)
      character(len=*), intent(in) :: what, text
      integer, intent(in) :: blocks, largest
      type(deck_type) :: deck
      integer(i8) :: first, last, next
      integer :: i
      logical :: joined

      call read_good(suite, text//"~&sweep key = 'film.gap_mm', from = 0.05, to = 0.09, count = 5 /~" &
         & //"&sweep key = 'pressure.inlet_kpa', from = 5, to = 35, count = 7 /", deck)
      call suite%equal(what//": their number", block_count(deck), blocks)
      joined = .true.
      next = 1
      do i = 1, block_count(deck)
         call block_bounds(deck, i, first, last)
         joined = joined .and. first == next .and. last >= first .and. last - first < largest
         if (i == 1) joined = joined .and. last - first + 1 == largest
         next = last + 1
      end do
      call suite%true(what//": every case is in one of them", joined .and. next == 36)
   end subroutine covers

end program test_traces
