!> Fortran 77 interface: whole cases and many cases. See docs/fortran.md, and rv_f77_valve for how it is made.
module rv_f77_run
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int, c_loc, c_ptr, c_size_t
   use rv_api_call, only : begin_call, refuse
   use rv_api_run, only : rv_valve_run, rv_valve_status, rv_valve_measure, rv_valve_fact, rv_valve_trace_size, &
      & rv_valve_trace_times, rv_valve_trace, rv_measure_count
   use rv_api_sweep, only : rv_sweep
   use rv_f77_text, only : to_c
   use rv_handles, only : handle_of, valve_type
   use rv_text, only : to_text
   implicit none
   private
   public :: f77_run, f77_stat, f77_meas, f77_fact, f77_ntrc, f77_time, f77_trc, f77_cases

   integer, parameter :: most_keys = 64   !! that a sweep takes

contains

   !> CALL RV_RUN(IV, IERR)
   subroutine f77_run(iv, ierr) bind(C, name="rv_run_")
      integer(c_int), intent(in) :: iv
      integer(c_int), intent(out) :: ierr

      ierr = rv_valve_run(handle_of(iv))
   end subroutine f77_run

   !> CALL RV_STAT(IV, ISTAT, IERR)
   subroutine f77_stat(iv, istat, ierr) bind(C, name="rv_stat_")
      integer(c_int), intent(in) :: iv
      integer(c_int), intent(inout), target :: istat
      integer(c_int), intent(out) :: ierr

      ierr = rv_valve_status(handle_of(iv), c_loc(istat))
   end subroutine f77_stat

   !> CALL RV_MEAS(IV, NAME, X, IERR)
   subroutine f77_meas(iv, name, x, ierr, name_length) bind(C, name="rv_meas_")
      integer(c_size_t), value :: name_length
      integer(c_int), intent(in) :: iv
      character(kind=c_char), intent(in) :: name(name_length)
      real(c_double), intent(inout), target :: x
      integer(c_int), intent(out) :: ierr
      character(kind=c_char), allocatable, target :: text(:)

      call to_c(name, text)
      ierr = rv_valve_measure(handle_of(iv), c_loc(text), c_loc(x))
   end subroutine f77_meas

   !> CALL RV_FACT(IV, NAME, X, IERR)
   subroutine f77_fact(iv, name, x, ierr, name_length) bind(C, name="rv_fact_")
      integer(c_size_t), value :: name_length
      integer(c_int), intent(in) :: iv
      character(kind=c_char), intent(in) :: name(name_length)
      real(c_double), intent(inout), target :: x
      integer(c_int), intent(out) :: ierr
      character(kind=c_char), allocatable, target :: text(:)

      call to_c(name, text)
      ierr = rv_valve_fact(handle_of(iv), c_loc(text), c_loc(x))
   end subroutine f77_fact

   !> CALL RV_NTRC(IV, N, IERR)
   subroutine f77_ntrc(iv, n, ierr) bind(C, name="rv_ntrc_")
      integer(c_int), intent(in) :: iv
      integer(c_int), intent(inout) :: n
      integer(c_int), intent(out) :: ierr
      integer(c_size_t), target :: samples

      samples = 0
      ierr = rv_valve_trace_size(handle_of(iv), c_loc(samples))
      n = int(samples, c_int)
   end subroutine f77_ntrc

   !> CALL RV_TIME(IV, T, N, IERR)
   subroutine f77_time(iv, t, n, ierr) bind(C, name="rv_time_")
      integer(c_int), intent(in) :: iv, n
      real(c_double), intent(inout), target :: t(*)
      integer(c_int), intent(out) :: ierr

      ierr = rv_valve_trace_times(handle_of(iv), c_loc(t), int(n, c_size_t))
   end subroutine f77_time

   !> CALL RV_TRC(IV, I, X, N, IERR)
   subroutine f77_trc(iv, i, x, n, ierr) bind(C, name="rv_trc_")
      integer(c_int), intent(in) :: iv, i, n
      real(c_double), intent(inout), target :: x(*)
      integer(c_int), intent(out) :: ierr

      ierr = rv_valve_trace(handle_of(iv), max(i, 0_c_int) - 1, c_loc(x), int(n, c_size_t))
   end subroutine f77_trc

   !> CALL RV_CASES(IV, NK, KEY, NC, X, NM, Y, ISTAT, NTHR, IERR)
   subroutine f77_cases(iv, nk, key, nc, x, nm, y, istat, nthr, ierr, key_length) bind(C, name="rv_cases_")
      integer(c_size_t), value :: key_length
      integer(c_int), intent(in) :: iv, nk, nc, nm, nthr
      character(kind=c_char), intent(in) :: key(*)
      real(c_double), intent(in), target :: x(*)
      real(c_double), intent(inout), target :: y(*)
      integer(c_int), intent(inout), target :: istat(*)
      integer(c_int), intent(out) :: ierr
      type(valve_type), pointer :: valve
      character(kind=c_char), allocatable, target :: text(:, :)
      character(kind=c_char), allocatable :: name(:)
      type(c_ptr), target :: names(most_keys)
      integer :: k

      call begin_call(handle_of(iv), valve, ierr)
      if (.not. associated(valve)) return
      if (nm /= rv_measure_count()) then
         call refuse(valve, "the measures of a case are "//to_text(int(rv_measure_count()))//", not "//to_text(int(nm)), ierr)
         return
      end if
      allocate(text(key_length + 1, most_keys))
      do k = 1, merge(nk, 0, nk <= most_keys)   ! more are refused unseen
         call to_c(key((k - 1)*key_length + 1:k*key_length), name)
         text(:size(name), k) = name
         names(k) = c_loc(text(1, k))
      end do
      ierr = rv_sweep(handle_of(iv), nk, c_loc(names), int(nc, c_size_t), c_loc(x), c_loc(y), c_loc(istat), nthr)
   end subroutine f77_cases

end module rv_f77_run
