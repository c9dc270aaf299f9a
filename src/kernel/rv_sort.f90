!> Sorting by several keys at once.
module rv_sort
   use rv_kinds, only : wp
   implicit none
   private
   public :: sorted_order

contains

   !> The order that sorts the columns of `key` rising, the first row first; equal columns keep their order.
   !>
   !> Bottom-up merge sort, O(n log n).
   pure function sorted_order(keys) result(order)
      real(wp), intent(in) :: keys(:, :)    !! (keys, n), no NaN
      integer :: order(size(keys, 2))
      integer :: other(size(keys, 2))
      real(wp), allocatable :: key(:, :)
      integer :: n, run, lo, i

      n = size(keys, 2)
      order = [(i, i = 1, n)]
      if (n < 2) return
      key = keys(pack([(i, i = 1, size(keys, 1))], [(any(abs(keys(i, :) - keys(i, 1)) > 0.0_wp), i = 1, size(keys, 1))]), :)
      run = 1
      do while (run < n)
         do lo = 1, n, 2*run
            call merge_runs(key, order(lo:min(lo + 2*run - 1, n)), min(run, n - lo + 1), other(lo:min(lo + 2*run - 1, n)))
         end do
         order = other
         run = 2*run
      end do
   end function sorted_order

   !> Merge the first `left` entries of `from` with the rest.
   pure subroutine merge_runs(key, from, left, to)
      real(wp), intent(in) :: key(:, :)
      integer, intent(in) :: from(:)
      integer, intent(in) :: left
      integer, intent(out) :: to(:)
      integer :: a, b, k

      a = 1
      b = left + 1
      do k = 1, size(from)
         if (a > left) then
            to(k) = from(b)
            b = b + 1
         else if (b > size(from)) then
            to(k) = from(a)
            a = a + 1
         else if (before(key(:, from(b)), key(:, from(a)))) then
            to(k) = from(b)
            b = b + 1
         else
            to(k) = from(a)
            a = a + 1
         end if
      end do
   end subroutine merge_runs

   pure logical function before(x, y)
      real(wp), intent(in) :: x(:), y(:)
      integer :: i

      before = .false.
      do i = 1, size(x)
         if (x(i) < y(i)) before = .true.
         if (abs(x(i) - y(i)) > 0.0_wp) return
      end do
   end function before

end module rv_sort
