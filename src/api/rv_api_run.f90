!> C API: whole cases, their measures, facts and traces. See reedvalve.h.
module rv_api_run
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, rv_bad_input
   use rv_api_call, only : begin_call, refuse, settle, need_memory, code_of_status, put_number, put_nan, rv_ok, &
      & no_pointer, no_text
   use rv_block, only : block_result, run_block, trace_times, trace_count, n_facts, n_measures, &
      & n_traces, column_type, fact_columns, measure_columns, trace_columns
   use rv_c_text, only : give_text, take_text
   use rv_deck, only : deck_type
   use rv_floats, only : float_guard
   use rv_handles, only : valve_type
   use rv_keys, only : key_run_trace_dt_ms, key_run_traces
   use rv_text, only : to_text
   implicit none
   private
   public :: rv_valve_run, rv_valve_status, rv_valve_measure, rv_measure_count, rv_measure_name, rv_measure_unit
   public :: rv_valve_fact, rv_fact_count, rv_fact_name, rv_fact_unit
   public :: rv_valve_trace_size, rv_valve_trace_times, rv_valve_trace, rv_trace_count, rv_trace_name, rv_trace_unit

   character(len=*), parameter :: not_run = "there are no results: run the valve first, after all settings"

contains

   integer(c_int) function rv_valve_run(self) result(code) bind(C)
      type(c_ptr), value :: self
      type(valve_type), pointer :: valve
      type(error_type), allocatable :: error
      character(len=:), allocatable :: warnings
      type(float_guard) :: guard

      call guard%put_aside()
      call begin_call(self, valve, code)
      if (.not. associated(valve)) return
      valve%has_run = .false.
      !$omp critical (rv_api_text)
      call valve%setup%check(warnings, error)
      !$omp end critical (rv_api_text)
      if (.not. allocated(error)) call need_memory(trace_bytes(valve%setup%ready), error)
      call settle(valve, error, code)
      if (allocated(error)) return
      valve%time = trace_times(valve%setup%ready)
      call run_block(valve%setup%ready, 1_i8, 1_i8, valve%result)
      valve%has_run = .true.
      valve%message = warnings//valve%result%message(1)%s
      code = code_of_status(valve%result%status(1))
   end function rv_valve_run

   !> Memory for the traces of a run: samples of the integration and of the result, and times, with copies on their way.
   integer(i8) function trace_bytes(deck) result(bytes)
      type(deck_type), intent(in) :: deck
      real(wp) :: start, finish

      bytes = 0
      if (nint(deck%value(key_run_traces)) == 0) return
      call deck%time_span(start, finish)
      bytes = 8_i8*(4*trace_count(deck) + 4)*nint((finish - start)/deck%value(key_run_trace_dt_ms) + 1.0_wp, i8)
   end function trace_bytes

   integer(c_int) function rv_valve_status(self, status) result(code) bind(C)
      type(c_ptr), value :: self, status
      type(valve_type), pointer :: valve
      integer(c_int), pointer :: place

      call begin_results(self, status, valve, code)
      if (code /= rv_ok) return
      call c_f_pointer(status, place)
      place = valve%result%status(1)
   end function rv_valve_status

   integer(c_int) function rv_valve_measure(self, name, value) result(code) bind(C)
      type(c_ptr), value :: self, name, value
      type(valve_type), pointer :: valve

      call put_nan(value)
      call begin_results(self, value, valve, code)
      if (code == rv_ok) call give_number(valve, measure_columns(), valve%result%measure(:, 1), name, value, code)
   end function rv_valve_measure

   integer(c_int) function rv_valve_fact(self, name, value) result(code) bind(C)
      type(c_ptr), value :: self, name, value
      type(valve_type), pointer :: valve

      call put_nan(value)
      call begin_results(self, value, valve, code)
      if (code == rv_ok) call give_number(valve, fact_columns(), valve%result%fact(:, 1), name, value, code)
   end function rv_valve_fact

   !> One of these numbers, by the name of its column and in its unit.
   subroutine give_number(valve, column, number, name, value, code)
      type(valve_type), intent(inout) :: valve
      type(column_type), intent(in) :: column(:)
      real(wp), intent(in) :: number(:)    !! SI
      type(c_ptr), intent(in) :: name, value
      integer(c_int), intent(out) :: code
      character(len=:), allocatable :: word
      logical :: taken
      integer :: i

      call take_text(name, word, taken)
      if (.not. taken) then
         call refuse(valve, no_text, code)
         return
      end if
      do i = 1, size(column)
         if (column(i)%name /= word) cycle
         call put_number(number(i)*column(i)%to_unit, value)
         code = rv_ok
         return
      end do
      call refuse(valve, "'"//word(:min(len(word), 60))//"': there is no such name", code)
   end subroutine give_number

   !> A call that asks for results and tells them through a pointer.
   subroutine begin_results(self, pointer, valve, code)
      type(c_ptr), intent(in) :: self, pointer
      type(valve_type), pointer, intent(out) :: valve
      integer(c_int), intent(out) :: code

      call begin_call(self, valve, code)
      if (.not. associated(valve)) return
      if (.not. valve%has_run) call refuse(valve, not_run, code)
      if (.not. c_associated(pointer)) call refuse(valve, no_pointer, code)
   end subroutine begin_results

   integer(c_int) function rv_measure_count() result(n) bind(C)
      n = n_measures
   end function rv_measure_count

   integer(c_int) function rv_measure_name(i, buffer, size) result(code) bind(C)
      integer(c_int), value :: i
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      call give_column(measure_columns(), i, .true., buffer, size, code)
   end function rv_measure_name

   integer(c_int) function rv_measure_unit(i, buffer, size) result(code) bind(C)
      integer(c_int), value :: i
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      call give_column(measure_columns(), i, .false., buffer, size, code)
   end function rv_measure_unit

   integer(c_int) function rv_fact_count() result(n) bind(C)
      n = n_facts
   end function rv_fact_count

   integer(c_int) function rv_fact_name(i, buffer, size) result(code) bind(C)
      integer(c_int), value :: i
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      call give_column(fact_columns(), i, .true., buffer, size, code)
   end function rv_fact_name

   integer(c_int) function rv_fact_unit(i, buffer, size) result(code) bind(C)
      integer(c_int), value :: i
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      call give_column(fact_columns(), i, .false., buffer, size, code)
   end function rv_fact_unit

   integer(c_int) function rv_trace_count() result(n) bind(C)
      n = n_traces
   end function rv_trace_count

   integer(c_int) function rv_trace_name(i, buffer, size) result(code) bind(C)
      integer(c_int), value :: i
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      call give_column(trace_columns(), i, .true., buffer, size, code)
   end function rv_trace_name

   integer(c_int) function rv_trace_unit(i, buffer, size) result(code) bind(C)
      integer(c_int), value :: i
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      call give_column(trace_columns(), i, .false., buffer, size, code)
   end function rv_trace_unit

   !> Name or unit of the i-th column, from 0.
   subroutine give_column(column, i, is_name, buffer, size, code)
      type(column_type), intent(in) :: column(0:)
      integer(c_int), intent(in) :: i
      logical, intent(in) :: is_name
      type(c_ptr), intent(in) :: buffer
      integer(c_size_t), intent(in) :: size
      integer(c_int), intent(out) :: code

      code = rv_bad_input
      call give_text("", buffer, size)
      if (i < 0 .or. i > ubound(column, 1) .or. .not. c_associated(buffer)) return
      if (is_name) call give_text(trim(column(i)%name), buffer, size)
      if (.not. is_name) call give_text(trim(column(i)%unit), buffer, size)
      code = rv_ok
   end subroutine give_column

   integer(c_int) function rv_valve_trace_size(self, samples) result(code) bind(C)
      type(c_ptr), value :: self, samples
      type(valve_type), pointer :: valve
      integer(c_size_t), pointer :: place

      call begin_results(self, samples, valve, code)
      if (code /= rv_ok) return
      call c_f_pointer(samples, place)
      place = size(valve%time, kind=c_size_t)
   end function rv_valve_trace_size

   integer(c_int) function rv_valve_trace_times(self, times, samples) result(code) bind(C)
      type(c_ptr), value :: self, times
      integer(c_size_t), value :: samples
      type(valve_type), pointer :: valve
      real(c_double), pointer :: place(:)

      call begin_results(self, times, valve, code)
      if (code == rv_ok) call check_samples(valve, samples, code)
      if (code /= rv_ok) return
      call c_f_pointer(times, place, [samples])
      place = valve%time
   end function rv_valve_trace_times

   integer(c_int) function rv_valve_trace(self, i, values, samples) result(code) bind(C)
      type(c_ptr), value :: self, values
      integer(c_int), value :: i
      integer(c_size_t), value :: samples
      type(valve_type), pointer :: valve
      real(c_double), pointer :: place(:)

      call begin_results(self, values, valve, code)
      if (code == rv_ok) call check_samples(valve, samples, code)
      if (code /= rv_ok) return
      if (i < 0 .or. i >= size(valve%result%trace, 2)) then
         call refuse(valve, "this model has no such trace", code)
         return
      end if
      call c_f_pointer(values, place, [samples])
      associate (column => trace_columns())
         place = valve%result%trace(:, i + 1, 1)*column(i + 1)%to_unit
      end associate
   end function rv_valve_trace

   subroutine check_samples(valve, samples, code)
      type(valve_type), intent(inout) :: valve
      integer(c_size_t), intent(in) :: samples
      integer(c_int), intent(inout) :: code

      if (samples == size(valve%time, kind=c_size_t)) return
      if (size(valve%time) == 0) then
         call refuse(valve, "there are no traces: set run.traces to .true. before the run", code)
         return
      end if
      call refuse(valve, "the array must have "//to_text(size(valve%time))//" elements, one for each sample", code)
   end subroutine check_samples

end module rv_api_run
