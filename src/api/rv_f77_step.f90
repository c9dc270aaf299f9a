!> Fortran 77 interface: stepping. See docs/fortran.md, and rv_f77_valve for how it is made.
module rv_f77_step
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_loc, c_size_t
   use rv_api_call, only : refuse, rv_ok
   use rv_api_step, only : rv_valve_begin, rv_valve_step, rv_valve_output, rv_valve_dofs, rv_valve_state, &
      & rv_valve_state_size, rv_valve_state_save, rv_valve_state_restore
   use rv_handles, only : handle_of, valve_of, valve_type
   use rv_text, only : to_text
   implicit none
   private
   public :: f77_begin, f77_step, f77_out, f77_ndof, f77_state, f77_size, f77_save, f77_rest

contains

   !> CALL RV_BEGIN(IV, T0, IERR)
   subroutine f77_begin(iv, t0, ierr) bind(C, name="rv_begin_")
      integer(c_int), intent(in) :: iv
      real(c_double), intent(in) :: t0
      integer(c_int), intent(out) :: ierr

      ierr = rv_valve_begin(handle_of(iv), t0)
   end subroutine f77_begin

   !> CALL RV_STEP(IV, T1, PIN0, PIN1, POUT0, POUT1, IERR)
   subroutine f77_step(iv, t1, pin0, pin1, pout0, pout1, ierr) bind(C, name="rv_step_")
      integer(c_int), intent(in) :: iv
      real(c_double), intent(in) :: t1, pin0, pin1, pout0, pout1
      integer(c_int), intent(out) :: ierr

      ierr = rv_valve_step(handle_of(iv), t1, pin0, pin1, pout0, pout1)
   end subroutine f77_step

   !> CALL RV_OUT(IV, I, X, IERR)
   subroutine f77_out(iv, i, x, ierr) bind(C, name="rv_out_")
      integer(c_int), intent(in) :: iv, i
      real(c_double), intent(inout), target :: x
      integer(c_int), intent(out) :: ierr

      ierr = rv_valve_output(handle_of(iv), max(i, 0_c_int) - 1, c_loc(x))
   end subroutine f77_out

   !> CALL RV_NDOF(IV, N, IERR)
   subroutine f77_ndof(iv, n, ierr) bind(C, name="rv_ndof_")
      integer(c_int), intent(in) :: iv
      integer(c_int), intent(inout), target :: n
      integer(c_int), intent(out) :: ierr

      ierr = rv_valve_dofs(handle_of(iv), c_loc(n))
   end subroutine f77_ndof

   !> CALL RV_STATE(IV, T, Q, V, N, H, IERR)
   subroutine f77_state(iv, t, q, v, n, h, ierr) bind(C, name="rv_state_")
      integer(c_int), intent(in) :: iv, n
      real(c_double), intent(inout), target :: t, q(*), v(*), h
      integer(c_int), intent(out) :: ierr
      type(valve_type), pointer :: valve
      integer(c_int), target :: dofs

      ierr = rv_valve_dofs(handle_of(iv), c_loc(dofs))
      if (ierr /= rv_ok) return
      if (n == dofs) then
         ierr = rv_valve_state(handle_of(iv), c_loc(t), c_loc(q), c_loc(v), c_loc(h))
      else
         call valve_of(handle_of(iv), valve)
         call refuse(valve, "this valve has "//to_text(int(dofs))//" degrees of freedom, not "//to_text(int(n)), ierr)
      end if
   end subroutine f77_state

   !> CALL RV_SIZE(IV, N, IERR)
   subroutine f77_size(iv, n, ierr) bind(C, name="rv_size_")
      integer(c_int), intent(in) :: iv
      integer(c_int), intent(inout) :: n
      integer(c_int), intent(out) :: ierr
      integer(c_size_t), target :: bytes

      bytes = 0
      ierr = rv_valve_state_size(handle_of(iv), c_loc(bytes))
      n = int(bytes/8, c_int)
   end subroutine f77_size

   !> CALL RV_SAVE(IV, W, N, IERR)
   subroutine f77_save(iv, w, n, ierr) bind(C, name="rv_save_")
      integer(c_int), intent(in) :: iv, n
      real(c_double), intent(inout), target :: w(*)
      integer(c_int), intent(out) :: ierr

      ierr = rv_valve_state_save(handle_of(iv), c_loc(w), 8*int(n, c_size_t))
   end subroutine f77_save

   !> CALL RV_REST(IV, W, N, IERR)
   subroutine f77_rest(iv, w, n, ierr) bind(C, name="rv_rest_")
      integer(c_int), intent(in) :: iv, n
      real(c_double), intent(in), target :: w(*)
      integer(c_int), intent(out) :: ierr

      ierr = rv_valve_state_restore(handle_of(iv), c_loc(w), 8*int(n, c_size_t))
   end subroutine f77_rest

end module rv_f77_step
