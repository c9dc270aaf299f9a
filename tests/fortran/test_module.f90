!> The module for Fortran programs: bits of the C interface, failures that are told or held, valves that end by themselves.
program test_module
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use reedvalve, only : reed_valve, rv_ok, rv_bad_input, rv_io, rv_not_converged, rv_domain, rv_case_ok, &
      & rv_case_film_closed, rv_case_bad_case, rv_displacement, rv_inlet, rv_leakage, rv_film_low, rv_version, &
      & rv_key_count, rv_key_name, rv_key_unit, rv_measure_count, rv_measure_name, rv_measure_unit, rv_fact_count, &
      & rv_fact_name, rv_fact_unit, rv_trace_count, rv_trace_name, rv_trace_unit
   implicit none

   integer, parameter :: wp = c_double
   integer :: passed = 0, failed = 0

   interface
      subroutine peer_run(gap_mm, closing_ms, frequency_hz, code) bind(C, name="peer_run_")
         import :: c_double, c_int
         real(c_double), intent(in) :: gap_mm
         real(c_double), intent(out) :: closing_ms, frequency_hz
         integer(c_int), intent(out) :: code
      end subroutine peer_run

      subroutine peer_step(gap_mm, steps, output, code) bind(C, name="peer_step_")
         import :: c_double, c_int
         real(c_double), intent(in) :: gap_mm
         integer(c_int), intent(in) :: steps
         real(c_double), intent(out) :: output(5)
         integer(c_int), intent(out) :: code
      end subroutine peer_step

      subroutine peer_sweep(cases, values, measures, status, code) bind(C, name="peer_sweep_")
         import :: c_double, c_int
         integer(c_int), intent(in) :: cases
         real(c_double), intent(in) :: values(2, *)
         real(c_double), intent(out) :: measures(9, *)
         integer(c_int), intent(out) :: status(*), code
      end subroutine peer_sweep

      subroutine rv_new(number, code) bind(C, name="rv_new_")
         import :: c_int
         integer(c_int), intent(out) :: number, code
      end subroutine rv_new

      subroutine rv_free(number, code) bind(C, name="rv_free_")
         import :: c_int
         integer(c_int), intent(inout) :: number
         integer(c_int), intent(out) :: code
      end subroutine rv_free
   end interface

   call test_run()
   call test_settings()
   call test_decks()
   call test_traces()
   call test_sweep()
   call test_stepping()
   call test_held()
   call test_not_open()
   call test_copies()
   call test_ends()
   call test_names()
   print '(i0, a, i0, a)', passed, " passed, ", failed, " failed"
   if (failed > 0 .or. passed < 200) stop 1

contains

   subroutine ok(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) then
         passed = passed + 1
      else
         failed = failed + 1
         print '(2a)', "WRONG: ", what
      end if
   end subroutine ok

   !> Nothing is held.
   subroutine good(valve, what)
      type(reed_valve), intent(inout) :: valve
      character(len=*), intent(in) :: what
      integer :: stat

      call valve%check(stat)
      call ok(stat == rv_ok, what//": "//trim(valve%message()))
   end subroutine good

   !> A failure is held, or `stat` tells it, with this part in its message.
   subroutine fails(valve, code, part, stat)
      type(reed_valve), intent(inout) :: valve
      integer, intent(in) :: code
      character(len=*), intent(in) :: part
      integer, intent(in), optional :: stat
      integer :: told

      if (present(stat)) then
         told = stat
      else
         call valve%check(told)
      end if
      call ok(told == code, part)
      call ok(index(valve%message(), part) > 0, part//" in '"//trim(valve%message())//"'")
   end subroutine fails

   elemental logical function same_bits(a, b)
      real(wp), intent(in) :: a, b

      same_bits = a >= b .and. a <= b .or. is_nan(a) .and. is_nan(b)
   end function same_bits

   elemental logical function is_nan(a)
      real(wp), intent(in) :: a

      is_nan = .not. a <= 0.0_wp .and. .not. a > 0.0_wp
   end function is_nan

   subroutine test_run()
      type(reed_valve) :: valve
      real(wp) :: closing, frequency
      integer(c_int) :: code

      call valve%open()
      call ok(valve%is_open(), "open")
      call valve%set("film.gap_mm", 0.04_wp)
      call valve%run()
      call peer_run(0.04_wp, closing, frequency, code)
      call ok(code == 0, "run of C")
      call ok(same_bits(valve%measure("closing_ms"), closing), "the closing time of C")
      call ok(same_bits(valve%fact("wet_frequency_hz  "), frequency), "the frequency of C")
      call ok(valve%status() == rv_case_ok, "status")
      call good(valve, "run")
      call valve%close()
      call ok(.not. valve%is_open(), "closed")
   end subroutine test_run

   subroutine test_settings()
      type(reed_valve) :: valve
      character(len=:), allocatable :: word
      real(wp) :: value
      integer :: stat

      call valve%open()
      call valve%set("solver.max_steps", 1000)
      call valve%get("solver.max_steps", value)
      call ok(nint(value) == 1000, "integer")
      call valve%set("run.traces", .true.)
      call valve%get("run.traces", word)
      call ok(word == ".true.", "logical")
      call valve%set("run.model", "film_table   ")
      call valve%get("run.model", word)
      call ok(word == "film_table" .and. len(word) == 10, "text")
      call valve%get("pressure.event_ms", value)
      call ok(is_nan(value), "no value")
      call valve%set("reed.width_mm", 600.0_wp)
      call ok(index(valve%message(), "unusually large") > 0, "warning")
      call good(valve, "settings")
      call ok(valve%message() /= "", "a warning stays when nothing is held")
      call valve%set("film.gap_m", 1.0_wp)
      call fails(valve, rv_bad_input, "did you mean 'film.gap_mm'?")
      call valve%set("film.gap_mm", -0.05_wp, stat)
      call fails(valve, rv_bad_input, "must be >= 0 (mm)", stat)
      call valve%set("pressure.file", 1.0_wp)
      call fails(valve, rv_bad_input, "as text")
      call valve%get("run.model", value)
      call fails(valve, rv_bad_input, "as text")
      call ok(is_nan(value), "NaN after a failure")
      call valve%set("run.title", repeat("x", 5000))
      call fails(valve, rv_bad_input, "too long")
      call valve%get("run.titel", word, stat)
      call fails(valve, rv_bad_input, "run.title", stat)
      call ok(word == "", "nothing after a failure")
   end subroutine test_settings

   subroutine test_decks()
      type(reed_valve) :: valve
      real(wp) :: gap
      integer :: unit, stat

      open(newunit=unit, file="module.nml", status="replace", action="write")
      write(unit, '(a)') "&film gap_mm = 0.04 /", "&reed thickness_mm = 0.00015 /"
      close(unit)
      call valve%open(deck="module.nml  ")
      call ok(index(valve%message(), "was it given in m?") > 0, "a deck's warning")
      call valve%get("film.gap_mm", gap)
      call ok(same_bits(gap, 0.04_wp), "a deck's gap")
      call good(valve, "deck")
      call valve%open(deck="there is none.nml")
      call ok(.not. valve%is_open(), "the valve before is closed")
      call fails(valve, rv_io, "there is none.nml")
      call valve%open("there is none.nml", stat)
      call fails(valve, rv_io, "there is none.nml", stat)
   end subroutine test_decks

   subroutine test_traces()
      type(reed_valve) :: valve
      real(wp), allocatable :: t(:), p(:)
      integer :: stat

      call valve%open()
      call valve%set("run.t_end_ms", 2.0_wp)
      call valve%set("run.trace_dt_ms", 0.05_wp)
      call valve%run()
      call valve%trace_times(t)
      call good(valve, "no traces were asked for")
      call ok(size(t) == 0, "none are there")
      call valve%set("run.traces", .true.)
      call valve%run()
      call valve%trace_times(t)
      call valve%trace(rv_inlet, p)
      call good(valve, "traces")
      call ok(size(t) == 41 .and. size(p) == 41, "samples")
      call ok(abs(t(41) - 2.0e-3_wp) < 1.0e-15_wp .and. abs(p(41) - 20.0_wp) < 1.0e-12_wp, "the last one")
      call valve%trace(0, p)
      call fails(valve, rv_bad_input, "no such trace")
      call ok(size(p) == 41 .and. all(is_nan(p)), "NaN after a failure")
      call valve%trace(rv_leakage, p, stat)
      call fails(valve, rv_bad_input, "no such trace", stat)
      call valve%set("film.gap_mm", 0.04_wp)
      call valve%trace(rv_displacement, p, stat)
      call fails(valve, rv_bad_input, "run the valve first", stat)
      call ok(size(p) == 0, "no samples")
   end subroutine test_traces

   subroutine test_sweep()
      integer, parameter :: n = 600
      type(reed_valve) :: valve
      character(len=24) :: keys(2)
      real(wp) :: values(2, n), wide(4, n), measure_of_c(9, n)
      real(wp), allocatable :: measures(:, :)
      integer, allocatable :: status(:)
      integer(c_int) :: status_of_c(n), code
      integer :: i, stat

      do i = 1, n
         values(:, i) = [0.03_wp + 1.0e-4_wp*real(i, wp), 10.0_wp + real(mod(i, 7), wp)]
      end do
      values(1, 2) = 0.0_wp
      keys = [character(len=24) :: "film.gap_mm", "pressure.inlet_kpa"]
      call valve%open()
      call valve%sweep(keys, values, measures, status)
      call good(valve, "sweep")
      call peer_sweep(n, values, measure_of_c, status_of_c, code)
      call ok(code == 0 .and. all(same_bits(measures, measure_of_c)), "the bits of C")
      call ok(all(status == status_of_c) .and. status(2) == rv_case_film_closed .and. status(3) == rv_case_ok, "endings")
      wide(::2, :) = values
      call valve%sweep(keys, wide(::2, :), measures, status, threads=1)
      call ok(all(same_bits(measures, measure_of_c)), "an array with gaps")
      call valve%sweep(keys(:1), values, measures, status, stat=stat)
      call fails(valve, rv_bad_input, "a row of values for each key", stat)
      call valve%sweep(keys, values(:, :0), measures, status)
      call fails(valve, rv_bad_input, "cases")
      call valve%sweep(keys, values, measures, status, threads=-1)
      call fails(valve, rv_bad_input, "threads")
      call ok(all(is_nan(measures)) .and. all(status == rv_case_bad_case), "nothing after a failure")
      keys(2) = "pressure.inlet"
      call valve%sweep(keys, values, measures, status)
      call fails(valve, rv_bad_input, "did you mean 'pressure.inlet_kpa'?")
   end subroutine test_sweep

   subroutine test_stepping()
      type(reed_valve) :: valve
      real(wp), allocatable :: q(:), v(:), kept(:), other(:)
      real(wp) :: of_c(5), t, next
      integer(c_int) :: code
      integer :: i, k, stat

      call valve%open()
      call valve%set("film.gap_mm", 0.04_wp)
      call valve%step(1.0e-3_wp, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], stat)
      call fails(valve, rv_bad_input, "begin first", stat)
      call valve%begin(0.0_wp)
      call valve%step(1.0e-3_wp, [0.0_wp, 0.0_wp, 1.0_wp], [0.0_wp, 0.0_wp], stat)
      call fails(valve, rv_bad_input, "two pressures", stat)
      call valve%step(1.0e-3_wp, [0.0_wp, 0.0_wp], [0.0_wp], stat)
      call fails(valve, rv_bad_input, "two pressures", stat)
      do k = 0, 39
         if (k == 20) call valve%save(kept)
         call step(valve, k)
      end do
      call good(valve, "steps")
      call peer_step(0.04_wp, 40, of_c, code)
      call ok(code == 0, "steps of C")
      call ok(all([(same_bits(valve%output(i), of_c(i)), i=1, 5)]), "the bits of C")
      call ok(is_nan(valve%output(rv_film_low)), "no film")
      call valve%restore(kept)
      call valve%state(t, q, v, next)
      call ok(same_bits(t, 1.0e-3_wp) .and. size(q) == 1 .and. size(v) == 1, "state")
      call ok(q(1) > 0.0_wp .and. next > 0.0_wp, "its numbers")
      do k = 20, 39
         call step(valve, k)
      end do
      call ok(same_bits(valve%output(rv_displacement), of_c(1)), "the same bits again")
      call good(valve, "the state before")
      call ok(is_nan(valve%output(11)), "no such output")
      call fails(valve, rv_bad_input, "no such output")
      other = kept(2:)
      call valve%restore(other)
      call fails(valve, rv_bad_input, "numbers of 8")
      other = kept
      other(5) = 7.0_wp
      call valve%restore(other)
      call fails(valve, rv_bad_input, "damaged")
      call valve%step(1.0_wp, [0.0_wp, 1.0e300_wp], [0.0_wp, 0.0_wp], stat)
      call ok(stat == rv_not_converged .or. stat == rv_domain, "no solver follows that")
      call valve%step(2.0_wp, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp])
      call fails(valve, rv_bad_input, "the last step failed")
   end subroutine test_stepping

   !> Step k of 50 us, in which the inlet rises by 500 Pa.
   subroutine step(valve, k)
      type(reed_valve), intent(inout) :: valve
      integer, intent(in) :: k

      call valve%step(50.0e-6_wp*real(k + 1, wp), 500.0_wp*real([k, k + 1], wp), [0.0_wp, 0.0_wp])
   end subroutine step

   !> The first failure that nobody was told holds all that follows.
   subroutine test_held()
      type(reed_valve) :: valve
      real(wp) :: gap
      integer :: stat

      call valve%open()
      call valve%set("film.gap", 0.03_wp)
      call valve%set("film.gap_mm", 0.03_wp)
      call valve%run()
      call ok(is_nan(valve%measure("closing_ms")), "nothing was run")
      call fails(valve, rv_bad_input, "did you mean 'film.gap_mm'?")
      call good(valve, "it is told once")
      call valve%get("film.gap_mm", gap)
      call ok(same_bits(gap, 0.05_wp), "what followed did nothing")
      call valve%set("film.gap", 0.03_wp)
      call valve%run(stat)
      call fails(valve, rv_bad_input, "did you mean 'film.gap_mm'?", stat)
      call valve%run(stat)
      call ok(stat == rv_ok, "run after it was told")
      call ok(valve%measure("closing_ms") > 0.0_wp, "its closing time")
      call valve%set("film.gap_mm", 0.0_wp)
      call valve%run(stat)
      call fails(valve, rv_domain, "the gap is 0", stat)
      call ok(valve%status() == rv_case_film_closed, "what stat took is not held")
      call valve%set("film.gap", 0.03_wp)
      call valve%open()
      call good(valve, "open begins anew")
   end subroutine test_held

   subroutine test_not_open()
      type(reed_valve) :: valve
      real(wp), allocatable :: a(:), b(:), table(:, :)
      integer, allocatable :: status(:)
      character(len=:), allocatable :: word
      real(wp) :: x, y
      integer :: stat, which

      call valve%close()
      call good(valve, "closing a closed valve")
      call ok(valve%status() == rv_case_bad_case, "status")
      call fails(valve, rv_bad_input, "was closed")
      do which = 1, 13
         select case (which)
         case (1)
            call valve%set("film.gap_mm", 1.0_wp, stat)
         case (2)
            call valve%set("run.model", "film", stat)
         case (3)
            call valve%get("film.gap_mm", x, stat)
         case (4)
            call valve%get("run.model", word, stat)
         case (5)
            call valve%run(stat)
         case (6)
            call valve%trace(1, a, stat)
         case (7)
            call valve%trace_times(a, stat)
         case (8)
            call valve%sweep(["film.gap_mm"], reshape([1.0_wp], [1, 1]), table, status, stat=stat)
         case (9)
            call valve%begin(0.0_wp, stat)
         case (10)
            call valve%step(1.0_wp, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], stat)
         case (11)
            call valve%state(x, a, b, y, stat)
         case (12)
            call valve%save(a, stat)
         case default
            call valve%restore([1.0_wp], stat)
         end select
         call fails(valve, rv_bad_input, "was closed", stat)
      end do
      call ok(is_nan(x) .and. is_nan(y) .and. size(a) == 0 .and. size(b) == 0, "nothing is known")
      call ok(all(is_nan([valve%measure("fall_ms"), valve%fact("reynolds"), valve%output(1)])), "NaN")
      call fails(valve, rv_bad_input, "was closed")
   end subroutine test_not_open

   subroutine test_copies()
      type(reed_valve) :: one, two, many(2)

      call one%open()
      call two%open()
      two = one
      call ok(one%is_open() .and. .not. two%is_open(), "the copy is closed")
      call two%run()
      call fails(two, rv_bad_input, "not copied")
      many = one
      call fails(many(2), rv_bad_input, "not copied")
      call one%run()
      call good(one, "the first goes on")
   end subroutine test_copies

   !> Valves in variables that end leave their places to others.
   subroutine test_ends()
      integer(c_int) :: first, last, code
      integer :: i

      call rv_new(first, code)
      call rv_free(first, code)
      call rv_new(first, code)
      last = first
      call rv_free(last, code)
      do i = 1, 40
         call forget()
      end do
      call rv_new(last, code)
      call ok(iand(first, 65535) == iand(last, 65535), "no valve is left behind")
      call rv_free(last, code)
   end subroutine test_ends

   subroutine forget()
      type(reed_valve) :: one, several(2)
      type(reed_valve), allocatable :: some(:)

      allocate(some(2))
      call one%open()
      call one%open()
      call several(2)%open()
      call some(1)%open()
      call ok(one%is_open() .and. several(2)%is_open() .and. some(1)%is_open(), "open")
   end subroutine forget

   subroutine test_names()
      integer :: i, longest

      call ok(index(rv_version(), ".") == 2, "version")
      call ok(all([rv_measure_count(), rv_fact_count(), rv_trace_count()] == [9, 8, 10]), "counts")
      call ok(all([rv_key_name(4), rv_key_unit(4)] == [character(len=12) :: "run.t_end_ms", "ms"]), "key")
      call ok(all([rv_measure_name(6), rv_measure_unit(6)] == [character(len=10) :: "closing_ms", "ms"]), "measure")
      call ok(all([rv_fact_name(8), rv_fact_unit(1)] == [character(len=13) :: "solver_method", "N m-1"]), "fact")
      call ok(all([rv_trace_name(rv_leakage), rv_trace_unit(rv_film_low)] == [character(len=14) :: "leakage_mm3_ms", "kPa"]), &
         & "trace")
      call ok(all([rv_key_name(0), rv_key_name(-huge(1)), rv_measure_name(10)] == ""), "none")
      call ok(rv_key_count() > 30, "keys")
      do i = 1, rv_key_count()
         longest = len_trim(rv_key_name(i))
         call ok(longest > 0 .and. longest < len(rv_key_name(i)), "fits")
      end do
   end subroutine test_names

end program test_module
