!> C API: a valve stepped under the caller's pressures. See reedvalve.h.
module rv_api_step
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_value, ieee_quiet_nan
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only : int8
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_domain
   use rv_api_call, only : begin_call, refuse, settle, code_of_status, put_number, put_nan, rv_ok, no_pointer
   use rv_blas_threads, only : begin_one_blas_thread, end_one_blas_thread
   use rv_block, only : n_traces
   use rv_case_facts, only : amplitudes_of, case_facts
   use rv_film_case, only : planform_cache
   use rv_floats, only : float_guard
   use rv_handles, only : valve_type
   use rv_keys, only : n_keys, kind_trace, key_pressure_kind, key_run_model
   use rv_pressure, only : pressure_history
   use rv_state_bytes, only : state_count, save_state, restore_state
   use rv_stepper, only : new_stepper
   use rv_text, only : to_text
   use rv_valve_case, only : new_case_lanes, new_history, settings_of
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: rv_valve_begin, rv_valve_step, rv_valve_output, rv_valve_dofs, rv_valve_state
   public :: rv_valve_state_size, rv_valve_state_save, rv_valve_state_restore

   real(wp), parameter :: least_scale = 1.0_wp   !! of a pressure difference; else no tolerance would be met [Pa]
   real(wp), parameter :: shortest = 1.0e-20_wp   !! step; squares of it are still numbers [s]
   real(wp), parameter :: least_part = 16.0_wp*epsilon(1.0_wp)   !! of the time that a step may be
   character(len=*), parameter :: not_begun = "there is no state: begin first, after all settings"

contains

   integer(c_int) function rv_valve_begin(self, t0) result(code) bind(C)
      type(c_ptr), value :: self
      real(c_double), value :: t0
      type(valve_type), pointer :: valve
      type(error_type), allocatable :: error
      character(len=:), allocatable :: warnings
      type(float_guard) :: guard

      call guard%put_aside()
      call begin_call(self, valve, code)
      if (.not. associated(valve)) return
      if (.not. ieee_is_finite(t0)) then
         call refuse(valve, "the time to begin at must be a finite number", code)
         return
      end if
      valve%is_stepping = .false.
      !$omp critical (rv_api_text)
      call valve%setup%check(warnings, error)
      !$omp end critical (rv_api_text)
      if (.not. allocated(error)) then
         valve%message = warnings
         call make_stepper(valve, t0, error)
      end if
      call settle(valve, error, code)
      valve%is_stepping = .not. allocated(error)
   end function rv_valve_begin

   !> Lanes of the one case, whose pressures come in Pa; the largest difference of its own pressure history, which is
   !> not run, is the scale of its tolerance.
   subroutine make_stepper(valve, t0, error)
      type(valve_type), intent(inout) :: valve
      real(wp), intent(in) :: t0   !! [s]
      type(error_type), allocatable, intent(out) :: error
      class(pressure_history), allocatable :: history
      class(valve_lanes), allocatable :: lanes
      type(planform_cache) :: cache
      type(case_facts) :: facts(1)
      real(wp) :: value(n_keys), inlet, outlet, scale

      call valve%setup%ready%case_values(1_i8, value)
      call new_history(value, valve%setup%ready%trace, history, error)
      if (allocated(error)) return
      call amplitudes_of(value, inlet, outlet)
      scale = max(least_scale, history%span(inlet, outlet))
      value(key_pressure_kind) = real(kind_trace, wp)
      call begin_one_blas_thread()
      call new_case_lanes(reshape(value, [n_keys, 1]), cache, lanes, facts)
      call end_one_blas_thread()
      if (allocated(facts(1)%error)) then
         error = facts(1)%error
      else if (facts(1)%is_closed) then
         call fail(error, rv_domain, "the film under the reed is closed over the whole land: the gap is 0")
      end if
      if (allocated(error)) return
      if (allocated(facts(1)%note)) valve%message = valve%message//facts(1)%note
      call new_stepper(valve%stepper, lanes, settings_of(value), scale, t0)
   end subroutine make_stepper

   integer(c_int) function rv_valve_step(self, t_end, p_in0, p_in1, p_out0, p_out1) result(code) bind(C)
      type(c_ptr), value :: self
      real(c_double), value :: t_end, p_in0, p_in1, p_out0, p_out1
      type(valve_type), pointer :: valve
      integer :: status
      type(float_guard) :: guard

      call guard%put_aside()
      call begin_stepping(self, valve, code)
      if (code /= rv_ok) return
      if (valve%stepper%has_failed) then
         call refuse(valve, "the last step failed: go back to a saved state, or begin again", code)
      else if (.not. all(ieee_is_finite([t_end - valve%stepper%t, p_in0, p_in1, p_out0, p_out1]))) then
         call refuse(valve, "times and pressures must be finite numbers", code)
      else if (.not. t_end - valve%stepper%t > max(shortest, least_part*max(abs(t_end), abs(valve%stepper%t)))) then
         call refuse(valve, "time must go on: t_end = "//to_text(t_end)//" s is not beyond t = " &
            & //to_text(valve%stepper%t)//" s by more than rounding", code)
      end if
      if (code /= rv_ok) return
      call valve%stepper%step(t_end, [p_in0, p_in1], [p_out0, p_out1], status, valve%message)
      code = code_of_status(status)
   end function rv_valve_step

   !> A call that needs a state.
   subroutine begin_stepping(self, valve, code)
      type(c_ptr), intent(in) :: self
      type(valve_type), pointer, intent(out) :: valve
      integer(c_int), intent(out) :: code

      call begin_call(self, valve, code)
      if (.not. associated(valve)) return
      if (.not. valve%is_stepping) call refuse(valve, not_begun, code)
   end subroutine begin_stepping

   integer(c_int) function rv_valve_output(self, which, value) result(code) bind(C)
      type(c_ptr), value :: self, value
      integer(c_int), value :: which
      type(valve_type), pointer :: valve
      real(wp) :: number

      call put_nan(value)
      call begin_stepping(self, valve, code)
      if (code /= rv_ok) return
      if (.not. c_associated(value)) then
         call refuse(valve, no_pointer, code)
      else if (which < 0 .or. which >= n_traces) then
         call refuse(valve, "there is no such output", code)
      end if
      if (code /= rv_ok) return
      number = ieee_value(1.0_wp, ieee_quiet_nan)
      if (which < size(valve%stepper%sample)) number = valve%stepper%sample(which + 1)
      call put_number(number, value)
   end function rv_valve_output

   integer(c_int) function rv_valve_dofs(self, dofs) result(code) bind(C)
      type(c_ptr), value :: self, dofs
      type(valve_type), pointer :: valve
      integer(c_int), pointer :: place

      call begin_stepping(self, valve, code)
      if (code /= rv_ok) return
      if (c_associated(dofs)) then
         call c_f_pointer(dofs, place)
         place = size(valve%stepper%state)/2
      else
         call refuse(valve, no_pointer, code)
      end if
   end function rv_valve_dofs

   integer(c_int) function rv_valve_state(self, t, q, v, next_step) result(code) bind(C)
      type(c_ptr), value :: self, t, q, v, next_step
      type(valve_type), pointer :: valve
      real(c_double), pointer :: place(:)
      integer :: n

      call put_nan(t)
      call put_nan(next_step)
      call begin_stepping(self, valve, code)
      if (code /= rv_ok) return
      associate (stepper => valve%stepper)
         n = size(stepper%state)/2
         if (c_associated(t)) call put_number(stepper%t, t)
         if (c_associated(next_step)) call put_number(stepper%next_step, next_step)
         if (c_associated(q)) then
            call c_f_pointer(q, place, [n])
            place = stepper%state(:n)
         end if
         if (c_associated(v)) then
            call c_f_pointer(v, place, [n])
            place = stepper%state(n + 1:)
         end if
      end associate
   end function rv_valve_state

   integer(c_int) function rv_valve_state_size(self, bytes) result(code) bind(C)
      type(c_ptr), value :: self, bytes
      type(valve_type), pointer :: valve
      integer(c_size_t), pointer :: place

      call begin_stepping(self, valve, code)
      if (code /= rv_ok) return
      if (c_associated(bytes)) then
         call c_f_pointer(bytes, place)
         place = 8_c_size_t*state_count(valve%stepper)
      else
         call refuse(valve, no_pointer, code)
      end if
   end function rv_valve_state_size

   integer(c_int) function rv_valve_state_save(self, bytes, size) result(code) bind(C)
      type(c_ptr), value :: self, bytes
      integer(c_size_t), value :: size
      type(valve_type), pointer :: valve
      real(wp), allocatable :: number(:)

      call begin_state(self, bytes, size, valve, code)
      if (code /= rv_ok) return
      allocate(number(state_count(valve%stepper)))
      call save_state(valve%stepper, model_of(valve), number)
      call copy_to(number, bytes)
   end function rv_valve_state_save

   integer(c_int) function rv_valve_state_restore(self, bytes, size) result(code) bind(C)
      type(c_ptr), value :: self, bytes
      integer(c_size_t), value :: size
      type(valve_type), pointer :: valve
      type(error_type), allocatable :: error
      real(wp), allocatable :: number(:)
      type(float_guard) :: guard

      call guard%put_aside()
      call begin_state(self, bytes, size, valve, code)
      if (code /= rv_ok) return
      allocate(number(state_count(valve%stepper)))
      call copy_from(bytes, number)
      call restore_state(valve%stepper, model_of(valve), number, error)
      call settle(valve, error, code)
   end function rv_valve_state_restore

   !> A call with the bytes of a state.
   subroutine begin_state(self, bytes, size, valve, code)
      type(c_ptr), intent(in) :: self, bytes
      integer(c_size_t), intent(in) :: size
      type(valve_type), pointer, intent(out) :: valve
      integer(c_int), intent(out) :: code

      call begin_stepping(self, valve, code)
      if (code /= rv_ok) return
      if (.not. c_associated(bytes)) then
         call refuse(valve, no_pointer, code)
      else if (size /= 8_c_size_t*state_count(valve%stepper)) then
         call refuse(valve, "a state of this valve has "//to_text(8_i8*state_count(valve%stepper)) &
            & //" bytes: "//to_text(state_count(valve%stepper))//" numbers of 8", code)
      end if
   end subroutine begin_state

   pure integer function model_of(valve) result(model)
      type(valve_type), intent(in) :: valve

      model = nint(valve%setup%ready%value(key_run_model))
   end function model_of

   !> The caller's bytes may lie at any address: not as numbers, then.
   subroutine copy_to(number, bytes)
      real(wp), intent(in) :: number(:)
      type(c_ptr), intent(in) :: bytes
      integer(int8), pointer :: place(:)

      call c_f_pointer(bytes, place, [8*size(number)])
      place = transfer(number, place)
   end subroutine copy_to

   subroutine copy_from(bytes, number)
      type(c_ptr), intent(in) :: bytes
      real(wp), intent(out) :: number(:)
      integer(int8), pointer :: place(:)

      call c_f_pointer(bytes, place, [8*size(number)])
      number = transfer(place, number)
   end subroutine copy_from

end module rv_api_step
