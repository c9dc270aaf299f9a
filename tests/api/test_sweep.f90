!> Sweeps through the C API: the bits of a run of the same deck; and the header's codes, equal to the library's.
program test_sweep
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int, c_loc, c_null_char, c_null_ptr, c_ptr, c_size_t
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp, i8
   use rv_api_sweep, only : rv_sweep
   use rv_api_valve, only : rv_valve_new, rv_valve_free, rv_valve_message, rv_valve_set_real, rv_valve_set_text
   use rv_block, only : block_bounds, block_count, block_result, measure_columns, n_measures, run_block, trace_columns
   use rv_deck, only : deck_type, read_deck
   use rv_error, only : error_type, rv_bad_input, rv_domain, rv_internal, rv_io, rv_not_converged
   use rv_faults, only : fault_list
   use rv_status, only : status_name, n_statuses, status_ok, status_film_closed
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none

   interface
      subroutine api_codes(code, ending, output) bind(C)
         import :: c_int
         integer(c_int), intent(out) :: code(*), ending(*), output(*)
      end subroutine api_codes
   end interface

   integer, parameter :: n = 4500   !! cases: three blocks, the last one shorter
   character(kind=c_char, len=16), target :: traces_key = "run.traces"//c_null_char, true_word = ".true."//c_null_char
   character(kind=c_char, len=18), target :: step_key = "run.trace_dt_ms"//c_null_char
   type(suite_type) :: suite
   character(kind=c_char, len=24), target :: name(2) = [character(len=24) :: "film.gap_mm"//c_null_char, &
      & "pressure.inlet_kpa"//c_null_char]
   real(c_double), target :: value(2, n), measure(n_measures, n), again(n_measures, n)
   integer(c_int), target :: status(n)
   type(c_ptr), target :: names(2), valve
   integer :: i

   do i = 1, n
      value(:, i) = [0.02_wp + real(mod(i*7, 100), wp)/1000.0_wp, 5.0_wp + real(mod(i, 30), wp)]
   end do
   names = [(c_loc(name(i)), i=1, 2)]
   call suite%equal("new", int(rv_valve_new(c_loc(valve))), 0)
   call test_codes()
   call test_same_bits(.false., 3)
   call suite%equal("traces", int(rv_valve_set_text(valve, c_loc(traces_key), c_loc(true_word))), 0)
   call suite%equal("samples", int(rv_valve_set_real(valve, c_loc(step_key), 0.02_c_double)), 0)
   call test_same_bits(.true., 6)
   call test_refused()
   call test_failures()
   call suite%equal("free", int(rv_valve_free(c_loc(valve))), 0)
   call suite%finish()

contains

   subroutine test_codes()
      integer(c_int) :: code(6), ending(7), output(4)
      character(len=24), parameter :: meant(4) = [character(len=24) :: "displacement_mm", "squeeze_n", "leakage_mm3_ms", &
         & "film_low_kpa"]
      integer :: k

      call api_codes(code, ending, output)
      call suite%true("error codes", all(code == [0, rv_bad_input, rv_io, rv_not_converged, rv_domain, rv_internal]))
      call suite%true("endings of a case", all(ending == [(k, k=0, n_statuses - 1)]))
      call suite%text("the second of them", status_name(int(ending(3))), "film_closed")
      associate (column => trace_columns())
         do k = 1, 4
            call suite%text("output "//to_text(k), trim(column(output(k) + 1)%name), trim(meant(k)))
         end do
      end associate
   end subroutine test_codes

   !> A deck with a design file of the same numbers, block by block, as every run does it.
   subroutine test_same_bits(traces, blocks)
      logical, intent(in) :: traces    !! which a sweep leaves out, but they cut the blocks
      integer, intent(in) :: blocks
      type(deck_type) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      type(block_result) :: result
      integer(i8) :: first, last
      integer :: unit, k
      logical :: same

      open(newunit=unit, file="api_sweep.csv", status="replace", action="write")
      write(unit, '(a)') "film.gap_mm,pressure.inlet_kpa"
      do k = 1, n
         write(unit, '(a)') to_text(value(1, k))//","//to_text(value(2, k))
      end do
      close(unit)
      open(newunit=unit, file="api_sweep.nml", status="replace", action="write")
      write(unit, '(a)') "&design file = 'api_sweep.csv' /"
      if (traces) write(unit, '(a)') "&run traces = .true., trace_dt_ms = 0.02 /"
      close(unit)
      call read_deck("api_sweep.nml", deck, faults, error)
      call suite%no_error("deck", error)
      call suite%equal("faults", faults%errors(), 0)
      call run_sweep(2, n, 2, measure, 0, "")
      call run_sweep(2, n, 1, again, 0, "")
      call suite%true("two threads or one", all(same_bits(measure, again)))
      call suite%true("all cases run", all(status == status_ok))
      call suite%equal("blocks", block_count(deck), blocks)
      same = .true.
      do k = 1, block_count(deck)
         call block_bounds(deck, k, first, last)
         call run_block(deck, first, last, result)
         associate (column => measure_columns())
            do i = 1, n_measures
               same = same .and. all(same_bits(measure(i, first:last), result%measure(i, :)*column(i)%to_unit))
            end do
         end associate
      end do
      call suite%true("the bits of a run of the deck", same)
   end subroutine test_same_bits

   elemental logical function same_bits(a, b)
      real(wp), intent(in) :: a, b

      same_bits = transfer(a, 0_i8) == transfer(b, 0_i8)
   end function same_bits

   subroutine test_refused()
      real(wp) :: kept

      call run_sweep(0, 1, 1, again, rv_bad_input, "1 to 64 keys")
      call run_sweep(2, 0, 1, again, rv_bad_input, "cases")
      call run_sweep(2, 1, -1, again, rv_bad_input, "threads")
      call run_sweep(2, 1, 1025, again, rv_bad_input, "threads")
      kept = value(1, 17)
      value(1, 17) = -1.0_wp
      call run_sweep(2, n, 1, again, rv_bad_input, "case 17: film.gap_mm = -1: must be >= 0 (mm)")
      value(1, 17) = ieee_value(kept, ieee_quiet_nan)
      call run_sweep(2, n, 1, again, rv_bad_input, "case 17: film.gap_mm = NaN: NaN")
      value(1, 17) = kept
      name(2) = "film.gap_mm"//c_null_char
      call run_sweep(2, 1, 1, again, rv_bad_input, "a second column")
      name(2) = "solver.max_steps"//c_null_char
      call run_sweep(2, 1, 1, again, rv_bad_input, "only real keys")
      name(2) = "pressure.inlet_kp"//c_null_char
      call run_sweep(2, 1, 1, again, rv_bad_input, "did you mean 'pressure.inlet_kpa'?")
      names(2) = c_null_ptr
      call run_sweep(2, 1, 1, again, rv_bad_input, "NULL")
      names(2) = c_loc(name(2))
      name(2) = "reed.hole_diameter_mm"//c_null_char
      value(2, 2) = 7.0_wp
      call run_sweep(2, 2, 1, again, rv_bad_input, "case 2: reed.hole_diameter_mm = 7 must not exceed")
      call suite%equal("no values", int(rv_sweep(valve, 1_c_int, c_loc(names), 1_c_size_t, c_null_ptr, c_loc(again), &
         & c_loc(status), 1_c_int)), rv_bad_input)
   end subroutine test_refused

   !> A case that fails does not stop the others.
   subroutine test_failures()
      name(2) = "pressure.inlet_kpa"//c_null_char
      value(1, 2) = 0.0_wp
      value(2, :3) = 20.0_wp
      call run_sweep(2, 3, 1, again, 0, "")
      call suite%true("the second film is closed", all(status(:3) == [status_ok, status_film_closed, status_ok]))
      call suite%true("its measures are missing", .not. again(1, 2) > 0.0_wp .and. again(1, 1) > 0.0_wp)
   end subroutine test_failures

   subroutine run_sweep(keys, cases, threads, found, code, part)
      integer, intent(in) :: keys, cases, threads
      real(wp), intent(inout), target :: found(:, :)
      integer, intent(in) :: code
      character(len=*), intent(in) :: part   !! of the message
      character(kind=c_char), target :: buffer(400)
      character(len=400) :: message
      integer :: got, k

      got = rv_sweep(valve, int(keys, c_int), c_loc(names), int(cases, c_size_t), c_loc(value), c_loc(found), &
         & c_loc(status), int(threads, c_int))
      call suite%equal("code of sweep", got, code)
      got = rv_valve_message(valve, c_loc(buffer), 400_c_size_t)
      message = ""
      do k = 1, size(buffer)
         if (buffer(k) == c_null_char) exit
         message(k:k) = buffer(k)
      end do
      call suite%true("'"//trim(message)//"' says '"//part//"'", index(message, part) > 0)
   end subroutine run_sweep

end program test_sweep
