!> One thread for BLAS while cases run: how it shares out its sums, and so their last bits, would depend on how many
!> processors the process may use. Cases are what our own threads share.
!>
!> A caller's own setting comes back when nobody needs one thread any more.
module rv_blas_threads
   use, intrinsic :: iso_c_binding, only : c_int
   implicit none
   private
   public :: begin_one_blas_thread, end_one_blas_thread

   integer :: users = 0            !! that have begun and not ended; touched in the critical sections only
   integer(c_int) :: before = 0    !! the caller's number of threads; 0: not known

   interface
      integer(c_int) function c_set(threads) bind(C, name="rv_blas_threads_set")
         import :: c_int
         integer(c_int), value :: threads
      end function c_set
   end interface

contains

   subroutine begin_one_blas_thread()
      !$omp critical (rv_blas_users)
      if (users == 0) before = c_set(1_c_int)
      users = users + 1
      !$omp end critical (rv_blas_users)
   end subroutine begin_one_blas_thread

   subroutine end_one_blas_thread()
      !$omp critical (rv_blas_users)
      users = users - 1
      if (users == 0 .and. before > 0) before = c_set(before)
      !$omp end critical (rv_blas_users)
   end subroutine end_one_blas_thread

end module rv_blas_threads
