!> How long the cases of a deck take without files: block_speed DECK THREADS TABLE [SECONDS]
!>
!> All cases are run again and again until SECONDS are over (once unless given). One list of work holds the blocks of all
!> rounds, so that threads have work where a deck has few blocks. Standard output: seconds of one round. TABLE: fall and
!> closing time of each case [ms].
program block_speed
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use rv_block, only : block_bounds, block_count, block_result, run_block
   use rv_deck, only : deck_type, read_deck
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_film_case, only : planform_cache
   use omp_lib, only : omp_get_thread_num
   use rv_kinds, only : i8, wp
   use rv_posix, only : seconds
   use rv_status, only : status_ok
   implicit none
   integer, parameter :: fall = 5, closing = 6   !! places in a block's measures
   real(wp), parameter :: ms = 1.0e-3_wp
   type(planform_cache), allocatable :: cache(:)   !! one a thread
   type(deck_type) :: deck
   type(fault_list) :: faults
   type(error_type), allocatable :: error
   real(wp), allocatable :: times(:, :)   !! fall and closing of each case [s]
   character(len=4096) :: path, word, table
   real(wp) :: start, elapsed, enough
   integer :: threads, stat, i, blocks, rounds
   integer(i8) :: failed

   call get_command_argument(1, path)
   call get_command_argument(2, word)
   read(word, *, iostat=stat) threads
   call get_command_argument(3, table)
   enough = 0.0_wp
   call get_command_argument(4, word)
   if (stat == 0 .and. word /= "") read(word, *, iostat=stat) enough
   if (stat /= 0 .or. table == "") call give_up("usage: block_speed DECK THREADS TABLE [SECONDS]")
   call read_deck(trim(path), deck, faults, error)
   if (allocated(error)) call give_up(error%message)
   if (faults%errors() > 0) call give_up(faults%text(1))

   blocks = block_count(deck)
   allocate(times(2, deck%case_count()), cache(0:threads - 1))
   failed = 0
   call run_one(1)
   start = seconds()
   call run_one(1)
   rounds = rounds_in(enough*threads, (seconds() - start)*blocks)
   start = seconds()
   !$omp parallel do schedule(dynamic, 1) num_threads(threads) default(none) shared(rounds, blocks)
   do i = 0, rounds*blocks - 1
      call run_one(1 + mod(i, blocks))
   end do
   !$omp end parallel do
   elapsed = (seconds() - start)/rounds
   if (failed > 0) call give_up("a case failed")
   write(output_unit, '(es12.5)') elapsed
   call write_table()

contains

   !> Rounds that take the time `wanted` when one takes `each`.
   pure integer function rounds_in(wanted, each) result(rounds)
      real(wp), intent(in) :: wanted, each   !! [s]
      integer, parameter :: most = 100000

      rounds = 1
      if (each > 0.0_wp) rounds = max(1, ceiling(min(wanted/each, real(most, wp))))
   end function rounds_in

   subroutine run_one(block)
      integer, intent(in) :: block
      type(block_result) :: result
      integer(i8) :: first, last

      call block_bounds(deck, block, first, last)
      call run_block(deck, first, last, result, cache(omp_get_thread_num()))
      if (any(result%status /= status_ok)) then
         !$omp atomic
         failed = failed + 1
      end if
      !$omp critical (keep)
      times(:, first:last) = result%measure([fall, closing], :)
      !$omp end critical (keep)
   end subroutine run_one

   subroutine write_table()
      integer :: unit
      integer(i8) :: k

      open(newunit=unit, file=trim(table), status="replace", action="write", iostat=stat)
      if (stat /= 0) call give_up("cannot write "//trim(table))
      do k = 1, size(times, 2, kind=i8)
         write(unit, '(es23.16, ",", es23.16)', iostat=stat) times(:, k)/ms
         if (stat /= 0) exit
      end do
      if (stat == 0) close(unit, iostat=stat)
      if (stat /= 0) call give_up("cannot write "//trim(table))
   end subroutine write_table

   subroutine give_up(text)
      character(len=*), intent(in) :: text

      write(error_unit, '(a)') "block_speed: "//text
      stop 1
   end subroutine give_up

end program block_speed
