!> Dynamics of cantilever reed valves with squeeze flow: the library reedvalve for Fortran programs.
!>
!> A thin layer over the C interface, and source that is compiled with the program that uses it: nothing but this file
!> and the shared library is needed, whichever compiler it is. docs/fortran.md shows the routes, reedvalve.h has the
!> units, and says which thread may do what.
!>
!> Errors. Nothing is printed and the program is never stopped. A call that has `stat` tells its rv_ code there. A
!> failure that no `stat` took is held: the calls that follow do nothing and give NaN, until `stat` or `check` takes
!> it. A sequence of calls can thus be checked once, behind the last one; `message` has the sentence to it.
!> Copies. A valve is not copied by assignment: the copy fails as one that was never opened.
!> Numbers of keys, measures, traces and outputs count from 1.
module reedvalve
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_double, c_int, c_loc, c_null_char, c_null_ptr, c_ptr, &
      & c_size_t
   implicit none
   private
   public :: reed_valve
   public :: rv_version, rv_key_count, rv_key_name, rv_key_unit, rv_measure_count, rv_measure_name, rv_measure_unit
   public :: rv_fact_count, rv_fact_name, rv_fact_unit, rv_trace_count, rv_trace_name, rv_trace_unit

   integer, parameter, public :: rv_ok = 0
   integer, parameter, public :: rv_bad_input = 1       !! the caller's data are not allowed, or the call is out of order
   integer, parameter, public :: rv_io = 2              !! a file could not be read
   integer, parameter, public :: rv_not_converged = 3   !! the integration gave up
   integer, parameter, public :: rv_domain = 4          !! the state left the model's domain: film closed, not a number
   integer, parameter, public :: rv_internal = 5        !! no memory, or a fault of the library

   ! How a case ended
   integer, parameter, public :: rv_case_ok = 0, rv_case_step_too_small = 1, rv_case_film_closed = 2, &
      & rv_case_not_finite = 3, rv_case_too_many_steps = 4, rv_case_no_convergence = 5, rv_case_bad_case = 6

   integer, parameter, public :: rv_displacement = 1   !! of the tip, positive when open [m]
   integer, parameter, public :: rv_velocity = 2       !! of the tip [m/s]
   integer, parameter, public :: rv_inlet = 3          !! inlet pressure [Pa]
   integer, parameter, public :: rv_outlet = 4         !! outlet pressure [Pa]
   integer, parameter, public :: rv_film_force = 5     !! of the film, at the tip, positive against closing [N]
   integer, parameter, public :: rv_part_a = 6         !! pressure force on the land at x < a [N], as what follows NaN
   integer, parameter, public :: rv_part_b = 7         !! on the rest of the land [N]    without a film model
   integer, parameter, public :: rv_part_c = 8         !! over the hole [N]
   integer, parameter, public :: rv_leakage = 9        !! flow out of the film at the free edges [m3/s]
   integer, parameter, public :: rv_film_low = 10      !! lowest pressure in the film [Pa]

   integer, parameter, public :: rv_text_length = 4096   !! of messages, blanks behind the text
   integer, parameter, public :: rv_name_length = 48     !! of names and units

   !> One valve; `open` makes it, `close` or the end of its scope gives it back.
   type :: reed_valve
      private
      type(c_ptr) :: handle = c_null_ptr
      integer :: held = rv_ok                 !! code of a failure that nobody was told
      character(len=:), allocatable :: note   !! message that the library does not know of
   contains
      procedure :: open => open_valve
      procedure :: close => close_valve
      procedure :: is_open
      procedure :: check
      procedure :: message
      procedure, private :: set_real
      procedure, private :: set_integer
      procedure, private :: set_logical
      procedure, private :: set_text
      generic :: set => set_real, set_integer, set_logical, set_text
      procedure, private :: get_real
      procedure, private :: get_text
      generic :: get => get_real, get_text
      procedure :: run
      procedure :: status
      procedure :: measure
      procedure :: fact
      procedure :: trace
      procedure :: trace_times
      procedure :: sweep
      procedure :: begin
      procedure :: step
      procedure :: output
      procedure :: state
      procedure :: save => save_state
      procedure :: restore => restore_state
      procedure, private :: copy
      generic :: assignment(=) => copy
      final :: end_valve
   end type reed_valve

   interface
      integer(c_int) function c_version(buffer, size) bind(C, name="rv_version_text")
         import :: c_char, c_int, c_size_t
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_version

      integer(c_int) function c_new(out) bind(C, name="rv_valve_new")
         import :: c_int, c_ptr
         type(c_ptr), intent(out) :: out
      end function c_new

      integer(c_int) function c_new_deck(path, out, message, size) bind(C, name="rv_valve_new_deck")
         import :: c_char, c_int, c_ptr, c_size_t
         character(kind=c_char), intent(in) :: path(*)
         type(c_ptr), intent(out) :: out
         character(kind=c_char), intent(out) :: message(*)
         integer(c_size_t), value :: size
      end function c_new_deck

      integer(c_int) function c_free(self) bind(C, name="rv_valve_free")
         import :: c_int, c_ptr
         type(c_ptr), intent(inout) :: self
      end function c_free

      integer(c_int) function c_message(self, buffer, size) bind(C, name="rv_valve_message")
         import :: c_char, c_int, c_ptr, c_size_t
         type(c_ptr), value :: self
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_message

      integer(c_int) function c_set_real(self, key, value) bind(C, name="rv_valve_set_real")
         import :: c_char, c_double, c_int, c_ptr
         type(c_ptr), value :: self
         character(kind=c_char), intent(in) :: key(*)
         real(c_double), value :: value
      end function c_set_real

      integer(c_int) function c_set_text(self, key, value) bind(C, name="rv_valve_set_text")
         import :: c_char, c_int, c_ptr
         type(c_ptr), value :: self
         character(kind=c_char), intent(in) :: key(*), value(*)
      end function c_set_text

      integer(c_int) function c_get_real(self, key, value) bind(C, name="rv_valve_get_real")
         import :: c_char, c_double, c_int, c_ptr
         type(c_ptr), value :: self
         character(kind=c_char), intent(in) :: key(*)
         real(c_double), intent(inout) :: value
      end function c_get_real

      integer(c_int) function c_get_text(self, key, buffer, size) bind(C, name="rv_valve_get_text")
         import :: c_char, c_int, c_ptr, c_size_t
         type(c_ptr), value :: self
         character(kind=c_char), intent(in) :: key(*)
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_get_text

      pure integer(c_int) function c_key_count() bind(C, name="rv_key_count")
         import :: c_int
      end function c_key_count

      pure integer(c_int) function c_measure_count() bind(C, name="rv_measure_count")
         import :: c_int
      end function c_measure_count

      pure integer(c_int) function c_fact_count() bind(C, name="rv_fact_count")
         import :: c_int
      end function c_fact_count

      pure integer(c_int) function c_trace_count() bind(C, name="rv_trace_count")
         import :: c_int
      end function c_trace_count

      integer(c_int) function c_key_name(i, buffer, size) bind(C, name="rv_key_name")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: i
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_key_name

      integer(c_int) function c_key_unit(i, buffer, size) bind(C, name="rv_key_unit")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: i
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_key_unit

      integer(c_int) function c_measure_name(i, buffer, size) bind(C, name="rv_measure_name")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: i
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_measure_name

      integer(c_int) function c_measure_unit(i, buffer, size) bind(C, name="rv_measure_unit")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: i
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_measure_unit

      integer(c_int) function c_fact_name(i, buffer, size) bind(C, name="rv_fact_name")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: i
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_fact_name

      integer(c_int) function c_fact_unit(i, buffer, size) bind(C, name="rv_fact_unit")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: i
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_fact_unit

      integer(c_int) function c_trace_name(i, buffer, size) bind(C, name="rv_trace_name")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: i
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_trace_name

      integer(c_int) function c_trace_unit(i, buffer, size) bind(C, name="rv_trace_unit")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: i
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: size
      end function c_trace_unit

      integer(c_int) function c_run(self) bind(C, name="rv_valve_run")
         import :: c_int, c_ptr
         type(c_ptr), value :: self
      end function c_run

      integer(c_int) function c_status(self, status) bind(C, name="rv_valve_status")
         import :: c_int, c_ptr
         type(c_ptr), value :: self
         integer(c_int), intent(inout) :: status
      end function c_status

      integer(c_int) function c_measure(self, name, value) bind(C, name="rv_valve_measure")
         import :: c_char, c_double, c_int, c_ptr
         type(c_ptr), value :: self
         character(kind=c_char), intent(in) :: name(*)
         real(c_double), intent(inout) :: value
      end function c_measure

      integer(c_int) function c_fact(self, name, value) bind(C, name="rv_valve_fact")
         import :: c_char, c_double, c_int, c_ptr
         type(c_ptr), value :: self
         character(kind=c_char), intent(in) :: name(*)
         real(c_double), intent(inout) :: value
      end function c_fact

      integer(c_int) function c_trace_size(self, samples) bind(C, name="rv_valve_trace_size")
         import :: c_int, c_ptr, c_size_t
         type(c_ptr), value :: self
         integer(c_size_t), intent(inout) :: samples
      end function c_trace_size

      integer(c_int) function c_trace_times(self, times, samples) bind(C, name="rv_valve_trace_times")
         import :: c_double, c_int, c_ptr, c_size_t
         type(c_ptr), value :: self
         real(c_double), intent(inout) :: times(*)
         integer(c_size_t), value :: samples
      end function c_trace_times

      integer(c_int) function c_trace(self, i, values, samples) bind(C, name="rv_valve_trace")
         import :: c_double, c_int, c_ptr, c_size_t
         type(c_ptr), value :: self
         integer(c_int), value :: i
         real(c_double), intent(inout) :: values(*)
         integer(c_size_t), value :: samples
      end function c_trace

      integer(c_int) function c_sweep(self, n_keys, keys, n_cases, values, measures, status, threads) &
         & bind(C, name="rv_sweep")
         import :: c_double, c_int, c_ptr, c_size_t
         type(c_ptr), value :: self
         integer(c_int), value :: n_keys, threads
         type(c_ptr), intent(in) :: keys(*)
         integer(c_size_t), value :: n_cases
         real(c_double), intent(in) :: values(*)
         real(c_double), intent(inout) :: measures(*)
         integer(c_int), intent(inout) :: status(*)
      end function c_sweep

      integer(c_int) function c_begin(self, t0) bind(C, name="rv_valve_begin")
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: self
         real(c_double), value :: t0
      end function c_begin

      integer(c_int) function c_step(self, t_end, p_in0, p_in1, p_out0, p_out1) bind(C, name="rv_valve_step")
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: self
         real(c_double), value :: t_end, p_in0, p_in1, p_out0, p_out1
      end function c_step

      integer(c_int) function c_output(self, which, value) bind(C, name="rv_valve_output")
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: self
         integer(c_int), value :: which
         real(c_double), intent(inout) :: value
      end function c_output

      integer(c_int) function c_dofs(self, dofs) bind(C, name="rv_valve_dofs")
         import :: c_int, c_ptr
         type(c_ptr), value :: self
         integer(c_int), intent(inout) :: dofs
      end function c_dofs

      integer(c_int) function c_state(self, t, q, v, next_step) bind(C, name="rv_valve_state")
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: self
         real(c_double), intent(inout) :: t, q(*), v(*), next_step
      end function c_state

      integer(c_int) function c_state_size(self, bytes) bind(C, name="rv_valve_state_size")
         import :: c_int, c_ptr, c_size_t
         type(c_ptr), value :: self
         integer(c_size_t), intent(inout) :: bytes
      end function c_state_size

      integer(c_int) function c_state_save(self, bytes, size) bind(C, name="rv_valve_state_save")
         import :: c_double, c_int, c_ptr, c_size_t
         type(c_ptr), value :: self
         real(c_double), intent(inout) :: bytes(*)
         integer(c_size_t), value :: size
      end function c_state_save

      integer(c_int) function c_state_restore(self, bytes, size) bind(C, name="rv_valve_state_restore")
         import :: c_double, c_int, c_ptr, c_size_t
         type(c_ptr), value :: self
         real(c_double), intent(in) :: bytes(*)
         integer(c_size_t), value :: size
      end function c_state_restore
   end interface

contains

   !> Make the valve: with the defaults of a deck, or with the settings of a deck of one case. One that is open is
   !> closed first, and what it held is over.
   subroutine open_valve(self, deck, stat)
      class(reed_valve), intent(inout) :: self
      character(len=*), intent(in), optional :: deck   !! path; its warnings come to `message`
      integer, intent(out), optional :: stat
      character(kind=c_char) :: buffer(rv_text_length + 1)
      integer :: code

      call close_valve(self)
      if (present(deck)) then
         code = c_new_deck(trim(deck)//c_null_char, self%handle, buffer, size(buffer, kind=c_size_t))
         self%note = trim(plain(buffer))
      else
         code = c_new(self%handle)
      end if
      call tell(self, code, stat)
   end subroutine open_valve

   !> Give the valve back; one that is not open may be closed, too.
   subroutine close_valve(self)
      class(reed_valve), intent(inout) :: self
      integer :: code

      code = c_free(self%handle)
      self%handle = c_null_ptr
      self%held = rv_ok
      if (allocated(self%note)) deallocate(self%note)
   end subroutine close_valve

   impure elemental subroutine end_valve(self)
      type(reed_valve), intent(inout) :: self

      call close_valve(self)
   end subroutine end_valve

   logical function is_open(self)
      class(reed_valve), intent(in) :: self

      is_open = c_associated(self%handle)
   end function is_open

   !> Two valves with one handle would close it twice, so the copy has none and says so.
   impure elemental subroutine copy(self, other)
      class(reed_valve), intent(inout) :: self
      class(reed_valve), intent(in) :: other

      if (c_associated(self%handle) .and. c_associated(self%handle, other%handle)) return
      call close_valve(self)
      self%held = rv_bad_input
      self%note = "a valve is not copied by assignment: open another one"
   end subroutine copy

   !> Take the failure that is held: rv_ok if there is none.
   subroutine check(self, stat)
      class(reed_valve), intent(inout) :: self
      integer, intent(out) :: stat

      stat = self%held
      self%held = rv_ok
   end subroutine check

   !> What the failure that is held or was taken last has to say, or the last call: blank if nothing.
   function message(self) result(text)
      class(reed_valve), intent(in) :: self
      character(len=rv_text_length) :: text
      character(kind=c_char) :: buffer(rv_text_length + 1)
      integer :: code

      if (allocated(self%note)) then
         text = self%note
      else
         code = c_message(self%handle, buffer, size(buffer, kind=c_size_t))
         text = plain(buffer)
      end if
   end function message

   !> Whether a call may go on: no failure is held. One that is held goes to `stat`.
   logical function may_go(self, stat)
      class(reed_valve), intent(inout) :: self
      integer, intent(out), optional :: stat

      may_go = self%held == rv_ok
      if (may_go .and. allocated(self%note)) deallocate(self%note)
      if (present(stat)) call self%check(stat)
   end function may_go

   !> Tell how a call ended, or hold it.
   subroutine tell(self, code, stat)
      class(reed_valve), intent(inout) :: self
      integer, intent(in) :: code
      integer, intent(out), optional :: stat

      if (present(stat)) then
         stat = code
      else
         self%held = code
      end if
   end subroutine tell

   !> A failure that the library does not know of.
   subroutine refuse(self, code, note, stat)
      class(reed_valve), intent(inout) :: self
      integer, intent(in) :: code
      character(len=*), intent(in) :: note
      integer, intent(out), optional :: stat

      self%note = note
      call tell(self, code, stat)
   end subroutine refuse

   !> Set a key, "film.gap_mm", to a value in its unit.
   subroutine set_real(self, key, value, stat)
      class(reed_valve), intent(inout) :: self
      character(len=*), intent(in) :: key
      real(c_double), intent(in) :: value
      integer, intent(out), optional :: stat

      if (may_go(self, stat)) call tell(self, c_set_real(self%handle, trim(key)//c_null_char, value), stat)
   end subroutine set_real

   subroutine set_integer(self, key, value, stat)
      class(reed_valve), intent(inout) :: self
      character(len=*), intent(in) :: key
      integer, intent(in) :: value
      integer, intent(out), optional :: stat

      call set_real(self, key, real(value, c_double), stat)
   end subroutine set_integer

   subroutine set_logical(self, key, value, stat)
      class(reed_valve), intent(inout) :: self
      character(len=*), intent(in) :: key
      logical, intent(in) :: value
      integer, intent(out), optional :: stat

      call set_text(self, key, merge(".true. ", ".false.", value), stat)
   end subroutine set_logical

   !> A choice, a file, or a number as a deck has it. Blanks behind it do not count.
   subroutine set_text(self, key, value, stat)
      class(reed_valve), intent(inout) :: self
      character(len=*), intent(in) :: key, value
      integer, intent(out), optional :: stat

      if (.not. may_go(self, stat)) return
      call tell(self, c_set_text(self%handle, trim(key)//c_null_char, trim(value)//c_null_char), stat)
   end subroutine set_text

   !> The value of a key in its unit; NaN where it has none.
   subroutine get_real(self, key, value, stat)
      class(reed_valve), intent(inout) :: self
      character(len=*), intent(in) :: key
      real(c_double), intent(out) :: value
      integer, intent(out), optional :: stat

      value = nan()
      if (may_go(self, stat)) call tell(self, c_get_real(self%handle, trim(key)//c_null_char, value), stat)
   end subroutine get_real

   !> The value of any key as a deck spells it.
   subroutine get_text(self, key, value, stat)
      class(reed_valve), intent(inout) :: self
      character(len=*), intent(in) :: key
      character(len=:), allocatable, intent(out) :: value
      integer, intent(out), optional :: stat
      character(kind=c_char) :: buffer(rv_text_length + 1)

      buffer(1) = c_null_char
      if (may_go(self, stat)) then
         call tell(self, c_get_text(self%handle, trim(key)//c_null_char, buffer, size(buffer, kind=c_size_t)), stat)
      end if
      value = trim(plain(buffer))
   end subroutine get_text

   !> Run the case under its own pressure history.
   subroutine run(self, stat)
      class(reed_valve), intent(inout) :: self
      integer, intent(out), optional :: stat

      if (may_go(self, stat)) call tell(self, c_run(self%handle), stat)
   end subroutine run

   !> How the case ended; rv_case_bad_case if none was run.
   integer function status(self)
      class(reed_valve), intent(inout) :: self

      status = rv_case_bad_case
      if (may_go(self)) call tell(self, c_status(self%handle, status))
   end function status

   !> A measure of the case that was run, "closing_ms"; NaN if it did not happen.
   real(c_double) function measure(self, name)
      class(reed_valve), intent(inout) :: self
      character(len=*), intent(in) :: name

      measure = nan()
      if (may_go(self)) call tell(self, c_measure(self%handle, trim(name)//c_null_char, measure))
   end function measure

   !> A number of the model behind that case, "wet_frequency_hz".
   real(c_double) function fact(self, name)
      class(reed_valve), intent(inout) :: self
      character(len=*), intent(in) :: name

      fact = nan()
      if (may_go(self)) call tell(self, c_fact(self%handle, trim(name)//c_null_char, fact))
   end function fact

   !> A history of the case, if run.traces was set: rv_displacement and so on, in the unit rv_trace_unit tells.
   subroutine trace(self, which, values, stat)
      class(reed_valve), intent(inout) :: self
      integer, intent(in) :: which
      real(c_double), allocatable, intent(out) :: values(:)
      integer, intent(out), optional :: stat

      call take_samples(self, values, stat)
      if (size(values) == 0) return
      call tell(self, c_trace(self%handle, from_zero(which), values, size(values, kind=c_size_t)), stat)
   end subroutine trace

   !> The times of the samples [s].
   subroutine trace_times(self, times, stat)
      class(reed_valve), intent(inout) :: self
      real(c_double), allocatable, intent(out) :: times(:)
      integer, intent(out), optional :: stat

      call take_samples(self, times, stat)
      if (size(times) == 0) return
      call tell(self, c_trace_times(self%handle, times, size(times, kind=c_size_t)), stat)
   end subroutine trace_times

   !> NaN for each sample of a trace; empty if there are none, or on failure.
   subroutine take_samples(self, values, stat)
      class(reed_valve), intent(inout) :: self
      real(c_double), allocatable, intent(out) :: values(:)
      integer, intent(out), optional :: stat
      integer(c_size_t) :: samples
      integer :: fault

      samples = 0
      if (may_go(self, stat)) call tell(self, c_trace_size(self%handle, samples), stat)
      allocate(values(samples), source=nan(), stat=fault)
      if (fault == 0) return
      allocate(values(0))
      call refuse(self, rv_internal, "no memory for a trace", stat)
   end subroutine take_samples

   !> Run cases that differ from the valve's settings in some keys, side by side on all threads. Cases that fail do not
   !> make the call fail.
   subroutine sweep(self, keys, values, measures, status, threads, stat)
      class(reed_valve), intent(inout) :: self
      character(len=*), intent(in) :: keys(:)
      real(c_double), intent(in) :: values(:, :)                    !! in the keys' units, (size(keys), cases)
      real(c_double), allocatable, intent(out) :: measures(:, :)   !! (rv_measure_count(), cases)
      integer, allocatable, intent(out) :: status(:)                !! rv_case_, (cases)
      integer, intent(in), optional :: threads                      !! default: as many as OpenMP offers
      integer, intent(out), optional :: stat
      character(kind=c_char), target :: text(len(keys) + 1, size(keys))
      type(c_ptr), allocatable :: names(:)
      integer :: cases, fault, k, wanted
      logical :: goes

      goes = may_go(self, stat)
      cases = merge(size(values, 2), 0, goes)
      allocate(measures(c_measure_count(), cases), source=nan(), stat=fault)
      if (fault == 0) allocate(status(cases), source=rv_case_bad_case, stat=fault)
      if (fault == 0) allocate(names(size(keys)), stat=fault)
      if (fault /= 0) call refuse(self, rv_internal, "no memory for the results of a sweep", stat)
      if (fault /= 0 .or. .not. goes) return
      if (size(values, 1) /= size(keys)) then
         call refuse(self, rv_bad_input, "a sweep needs a row of values for each key", stat)
         return
      end if
      do k = 1, size(keys)
         text(:, k) = transfer(keys(k)//c_null_char, text(:, k))
         text(len_trim(keys(k)) + 1, k) = c_null_char
         names(k) = c_loc(text(1, k))
      end do
      wanted = 0
      if (present(threads)) wanted = threads
      call tell(self, c_sweep(self%handle, size(keys), names, size(values, 2, c_size_t), values, measures, status, &
         & wanted), stat)
   end subroutine sweep

   !> Begin to step, at time t0 [s].
   subroutine begin(self, t0, stat)
      class(reed_valve), intent(inout) :: self
      real(c_double), intent(in) :: t0
      integer, intent(out), optional :: stat

      if (may_go(self, stat)) call tell(self, c_begin(self%handle, t0), stat)
   end subroutine begin

   !> Go on to t_end [s] while the inlet pressure goes straight from inlet(1) to inlet(2), the outlet's likewise [Pa].
   subroutine step(self, t_end, inlet, outlet, stat)
      class(reed_valve), intent(inout) :: self
      real(c_double), intent(in) :: t_end, inlet(:), outlet(:)   ! of two
      integer, intent(out), optional :: stat

      if (.not. may_go(self, stat)) return
      if (size(inlet) /= 2 .or. size(outlet) /= 2) then
         call refuse(self, rv_bad_input, "a step needs two pressures of the inlet and two of the outlet", stat)
         return
      end if
      call tell(self, c_step(self%handle, t_end, inlet(1), inlet(2), outlet(1), outlet(2)), stat)
   end subroutine step

   !> rv_displacement and so on at the time reached, in SI.
   real(c_double) function output(self, which)
      class(reed_valve), intent(inout) :: self
      integer, intent(in) :: which

      output = nan()
      if (may_go(self)) call tell(self, c_output(self%handle, from_zero(which), output))
   end function output

   !> Time [s]; displacement [m] and velocity [m/s] of each degree of freedom; the step tried first next [s], 0: not known.
   subroutine state(self, t, q, v, next_step, stat)
      class(reed_valve), intent(inout) :: self
      real(c_double), intent(out) :: t
      real(c_double), allocatable, intent(out) :: q(:), v(:)
      real(c_double), intent(out) :: next_step
      integer, intent(out), optional :: stat
      integer :: dofs

      t = nan()
      next_step = nan()
      dofs = 0
      if (may_go(self, stat)) call tell(self, c_dofs(self%handle, dofs), stat)
      allocate(q(dofs), v(dofs), source=nan())
      if (dofs > 0) call tell(self, c_state(self%handle, t, q, v, next_step), stat)
   end subroutine state

   !> Keep the state, to go back to it; empty on failure.
   subroutine save_state(self, kept, stat)
      class(reed_valve), intent(inout) :: self
      real(c_double), allocatable, intent(out) :: kept(:)
      integer, intent(out), optional :: stat
      integer(c_size_t) :: bytes

      bytes = 0
      if (may_go(self, stat)) call tell(self, c_state_size(self%handle, bytes), stat)
      allocate(kept(bytes/8), source=nan())
      if (bytes > 0) call tell(self, c_state_save(self%handle, kept, bytes), stat)
   end subroutine save_state

   !> Go back to a state that a valve of the same model and size kept: steps from there have the same bits.
   subroutine restore_state(self, kept, stat)
      class(reed_valve), intent(inout) :: self
      real(c_double), intent(in) :: kept(:)
      integer, intent(out), optional :: stat

      if (may_go(self, stat)) call tell(self, c_state_restore(self%handle, kept, 8*size(kept, kind=c_size_t)), stat)
   end subroutine restore_state

   !> The version of the library, "0.1.0".
   function rv_version() result(text)
      character(len=rv_name_length) :: text
      character(kind=c_char) :: buffer(rv_name_length + 1)
      integer :: code

      code = c_version(buffer, size(buffer, kind=c_size_t))
      text = plain(buffer)
   end function rv_version

   pure integer function rv_key_count() result(n)
      n = c_key_count()
   end function rv_key_count

   pure integer function rv_measure_count() result(n)
      n = c_measure_count()
   end function rv_measure_count

   pure integer function rv_fact_count() result(n)
      n = c_fact_count()
   end function rv_fact_count

   pure integer function rv_trace_count() result(n)
      n = c_trace_count()
   end function rv_trace_count

   !> Names and units; blank where there is no i-th one.
   function rv_key_name(i) result(text)
      integer, intent(in) :: i
      character(len=rv_name_length) :: text

      text = named(c_key_name, i)
   end function rv_key_name

   function rv_key_unit(i) result(text)
      integer, intent(in) :: i
      character(len=rv_name_length) :: text

      text = named(c_key_unit, i)
   end function rv_key_unit

   function rv_measure_name(i) result(text)
      integer, intent(in) :: i
      character(len=rv_name_length) :: text

      text = named(c_measure_name, i)
   end function rv_measure_name

   function rv_measure_unit(i) result(text)
      integer, intent(in) :: i
      character(len=rv_name_length) :: text

      text = named(c_measure_unit, i)
   end function rv_measure_unit

   function rv_fact_name(i) result(text)
      integer, intent(in) :: i
      character(len=rv_name_length) :: text

      text = named(c_fact_name, i)
   end function rv_fact_name

   function rv_fact_unit(i) result(text)
      integer, intent(in) :: i
      character(len=rv_name_length) :: text

      text = named(c_fact_unit, i)
   end function rv_fact_unit

   function rv_trace_name(i) result(text)
      integer, intent(in) :: i
      character(len=rv_name_length) :: text

      text = named(c_trace_name, i)
   end function rv_trace_name

   function rv_trace_unit(i) result(text)
      integer, intent(in) :: i
      character(len=rv_name_length) :: text

      text = named(c_trace_unit, i)
   end function rv_trace_unit

   function named(list, i) result(text)
      procedure(c_key_name) :: list
      integer, intent(in) :: i   !! from 1
      character(len=rv_name_length) :: text
      character(kind=c_char) :: buffer(rv_name_length + 1)
      integer :: code

      code = list(from_zero(i), buffer, size(buffer, kind=c_size_t))
      text = plain(buffer)
   end function named

   !> What C calls the i-th; of what is below 1, none.
   pure integer(c_int) function from_zero(i)
      integer, intent(in) :: i

      from_zero = max(i, 0) - 1
   end function from_zero

   !> A NUL-terminated text, with blanks behind it.
   pure function plain(buffer) result(text)
      character(kind=c_char), intent(in) :: buffer(:)
      character(len=size(buffer) - 1) :: text
      integer :: i

      text = ""
      do i = 1, size(buffer) - 1
         if (buffer(i) == c_null_char) exit
         text(i:i) = buffer(i)
      end do
   end function plain

   real(c_double) function nan()
      nan = ieee_value(1.0_c_double, ieee_quiet_nan)
   end function nan

end module reedvalve
