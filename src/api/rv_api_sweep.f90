!> C API: sweeps of many cases. See reedvalve.h.
module rv_api_sweep
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_ptr, c_size_t
   use omp_lib, only : omp_get_max_threads, omp_get_num_procs, omp_get_thread_num
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_api_call, only : begin_call, refuse, settle, need_memory, rv_ok, no_pointer, no_text
   use rv_block, only : block_bounds, block_count, block_result, run_block, n_measures, column_type, measure_columns
   use rv_c_text, only : take_text
   use rv_deck, only : deck_type
   use rv_film_case, only : planform_cache
   use rv_floats, only : float_guard
   use rv_handles, only : valve_type
   use rv_keys, only : key_run_block_size, key_run_traces
   use rv_posix, only : process_number
   use rv_text, only : text_type
   implicit none
   private
   public :: rv_sweep

   integer, parameter :: most_threads = 1024
   integer(c_size_t), parameter :: most_cases = 2000000000_c_size_t
   integer(i8), parameter :: stack_bytes = 16*1024**2   !! of a thread, generously
   integer(i8), parameter :: case_bytes = 2048          !! of a case in a block, likewise

   integer :: team_process = 0   !! the process that OpenMP's threads belong to; 0: none has been asked for

contains

   integer(c_int) function rv_sweep(self, n_keys, keys, n_cases, values, measures, status, threads) result(code) bind(C)
      type(c_ptr), value :: self, keys, values, measures, status
      integer(c_int), value :: n_keys, threads
      integer(c_size_t), value :: n_cases
      type(valve_type), pointer :: valve
      type(text_type), allocatable :: names(:)
      type(error_type), allocatable :: error
      type(deck_type) :: deck
      real(c_double), pointer :: number(:, :), measure(:, :)
      integer(c_int), pointer :: ends(:)
      type(float_guard) :: guard

      call guard%put_aside()
      call begin_call(self, valve, code)
      if (.not. associated(valve)) return
      call take_names(valve, n_keys, keys, names, code)
      if (code /= rv_ok) return
      if (.not. (c_associated(values) .and. c_associated(measures) .and. c_associated(status))) then
         call refuse(valve, no_pointer, code)
      else if (n_cases < 1 .or. n_cases > most_cases) then
         call refuse(valve, "a sweep has from 1 to 2000000000 cases", code)
      else if (threads < 0 .or. threads > most_threads) then
         call refuse(valve, "a sweep takes from 1 to 1024 threads; 0: as many as OpenMP offers", code)
      end if
      if (code /= rv_ok) return
      call c_f_pointer(values, number, [int(n_keys, c_size_t), n_cases])
      call c_f_pointer(measures, measure, [int(n_measures, c_size_t), n_cases])
      call c_f_pointer(status, ends, [n_cases])
      call need_memory(8*n_cases*(3*n_keys + 2), error)   ! the design is copied as it is checked
      if (.not. allocated(error)) then
         !$omp critical (rv_api_text)
         call valve%setup%sweep(names, number, deck, valve%message, error)
         !$omp end critical (rv_api_text)
      end if
      if (.not. allocated(error)) call run_all(deck, int(threads), measure, ends, error)
      call settle(valve, error, code)
   end function rv_sweep

   subroutine take_names(valve, n, keys, names, code)
      type(valve_type), intent(inout) :: valve
      integer(c_int), intent(in) :: n
      type(c_ptr), intent(in) :: keys
      type(text_type), allocatable, intent(out) :: names(:)
      integer(c_int), intent(out) :: code
      type(c_ptr), pointer :: name(:)
      logical :: taken
      integer :: i

      code = rv_ok
      if (n < 1 .or. n > 64) then
         call refuse(valve, "a sweep varies from 1 to 64 keys", code)
      else if (.not. c_associated(keys)) then
         call refuse(valve, no_pointer, code)
      end if
      if (code /= rv_ok) return
      call c_f_pointer(keys, name, [n])
      allocate(names(n))
      do i = 1, n
         call take_text(name(i), names(i)%s, taken)
         if (.not. taken) call refuse(valve, no_text, code)
      end do
   end subroutine take_names

   !> All cases, cut into the blocks of a run of the same deck: the same bits.
   subroutine run_all(deck, threads, measure, status, error)
      type(deck_type), intent(inout) :: deck
      integer, intent(in) :: threads                   !! 0: as many as OpenMP offers
      real(c_double), intent(inout) :: measure(:, :)   !! in the measures' units
      integer(c_int), intent(inout) :: status(:)
      type(error_type), allocatable, intent(out) :: error
      type(planform_cache), allocatable :: cache(:)   ! one a thread
      integer(i8) :: first, last
      integer :: block, blocks, team

      call block_bounds(deck, 1, first, last)
      deck%value(key_run_block_size) = real(last, wp)   ! traces, which nobody sees, are cut off; not the blocks otherwise
      deck%value(key_run_traces) = 0.0_wp
      blocks = block_count(deck)
      team = team_size(threads, blocks)
      call need_memory((team - 1)*stack_bytes + team*last*case_bytes, error)
      if (allocated(error)) return
      allocate(cache(0:team - 1))
      !$omp parallel do schedule(dynamic, 1) num_threads(size(cache)) default(none) &
      !$omp& shared(deck, blocks, cache, measure, status)
      do block = 1, blocks
         call run_one(deck, block, cache(omp_get_thread_num()), measure, status)
      end do
      !$omp end parallel do
   end subroutine run_all

   !> Threads to run on: no more than can work at once. OpenMP's threads do not follow a fork, and a team that counts on
   !> them waits for ever: the child of a process that has run on several gets one.
   integer function team_size(threads, blocks) result(size)
      integer, intent(in) :: threads   !! 0: as many as OpenMP offers
      integer, intent(in) :: blocks

      size = omp_get_max_threads()
      if (threads > 0) size = min(threads, max(size, omp_get_num_procs()))
      size = min(size, blocks)
      if (size == 1) return
      !$omp critical (rv_team_process)
      if (team_process == 0) team_process = process_number()
      if (team_process /= process_number()) size = 1
      !$omp end critical (rv_team_process)
   end function team_size

   subroutine run_one(deck, block, cache, measure, status)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: block
      type(planform_cache), intent(inout) :: cache
      real(c_double), intent(inout) :: measure(:, :)
      integer(c_int), intent(inout) :: status(:)
      type(block_result) :: result
      type(column_type) :: column(n_measures)
      integer(i8) :: first, last
      integer :: i
      type(float_guard) :: guard

      call guard%put_aside()
      call block_bounds(deck, block, first, last)
      call run_block(deck, first, last, result, cache)
      column = measure_columns()
      do i = 1, n_measures
         measure(i, first:last) = result%measure(i, :)*column(i)%to_unit
      end do
      status(first:last) = result%status
   end subroutine run_one

end module rv_api_sweep
