!> How long the cases of a deck take without files: block_speed DECK THREADS TABLE
!>
!> Every block is run once, after a first one to warm up. Standard output: seconds. TABLE: fall and closing time of
!> each case [ms].
program block_speed
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use rv_block, only : block_bounds, block_count, block_result, run_block
   use rv_deck, only : deck_type, read_deck
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_kinds, only : i8, wp
   use rv_posix, only : seconds
   use rv_status, only : status_ok
   implicit none
   integer, parameter :: fall = 5, closing = 6   !! places in a block's measures
   real(wp), parameter :: ms = 1.0e-3_wp
   type(deck_type) :: deck
   type(fault_list) :: faults
   type(error_type), allocatable :: error
   type(block_result), allocatable :: result(:)
   character(len=4096) :: path, threads_word, table
   real(wp) :: start, elapsed
   integer :: threads, stat, i

   call get_command_argument(1, path)
   call get_command_argument(2, threads_word)
   call get_command_argument(3, table)
   read(threads_word, *, iostat=stat) threads
   if (stat /= 0 .or. table == "") call give_up("usage: block_speed DECK THREADS TABLE")
   call read_deck(trim(path), deck, faults, error)
   if (allocated(error)) call give_up(error%message)
   if (faults%errors() > 0) call give_up(faults%text(1))

   allocate(result(block_count(deck)))
   call run_one(1)
   start = seconds()
   !$omp parallel do schedule(dynamic, 1) num_threads(threads) default(none) shared(result)
   do i = 1, size(result)
      call run_one(i)
   end do
   !$omp end parallel do
   elapsed = seconds() - start
   write(output_unit, '(es12.5)') elapsed
   call write_table()

contains

   subroutine run_one(block)
      integer, intent(in) :: block
      integer(i8) :: first, last

      call block_bounds(deck, block, first, last)
      call run_block(deck, first, last, result(block))
   end subroutine run_one

   subroutine write_table()
      integer :: unit, k

      do k = 1, size(result)
         if (any(result(k)%status /= status_ok)) call give_up("a case failed")
      end do
      open(newunit=unit, file=trim(table), status="replace", action="write", iostat=stat)
      if (stat /= 0) call give_up("cannot write "//trim(table))
      do k = 1, size(result)
         write(unit, '(es23.16, ",", es23.16)') result(k)%measure([fall, closing], :)/ms
      end do
      close(unit)
   end subroutine write_table

   subroutine give_up(text)
      character(len=*), intent(in) :: text

      write(error_unit, '(a)') "block_speed: "//text
      stop 1
   end subroutine give_up

end program block_speed
