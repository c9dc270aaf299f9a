!> Sorting by several keys: against counting who comes before whom, ties in their order, all small sizes.
program test_sort
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_positive_inf
   use rv_kinds, only : wp
   use rv_sort, only : sorted_order
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite

   call small_sizes()
   call one_key()
   call first_key_first()
   call no_keys()
   call odd_numbers()
   call many()
   call suite%finish()

contains

   !> Three keys of three values each, so that ties of every kind abound, at every size about the powers of two to 64.
   subroutine small_sizes()
      integer, parameter :: largest = 70
      real(wp) :: key(3, largest)
      logical :: is_right(0:largest)
      integer :: n, i

      do i = 1, largest
         key(:, i) = aint(3.0_wp*scattered(i, [0.6180339887498949_wp, 0.4142135623730951_wp, 0.7320508075688772_wp]))
      end do
      do n = 0, largest
         is_right(n) = agrees(sorted_order(key(:, :n)), counted_order(key(:, :n)))
      end do
      do n = 0, 5
         call suite%true("three keys, "//to_text(n)//" columns", is_right(n))
      end do
      call suite%true("three keys, every size up to "//to_text(largest), all(is_right))
   end subroutine small_sizes

   !> Rising, falling, equal, and scattered columns of a single key.
   subroutine one_key()
      integer, parameter :: n = 37
      real(wp) :: rising(1, n), mixed(1, n)
      integer :: i, same(n)

      same = [(i, i=1, n)]
      rising(1, :) = real(same, wp)
      call suite%true("a rising key stays", agrees(sorted_order(rising), same))
      call suite%true("a falling key is turned round", agrees(sorted_order(-rising), same(n:1:-1)))
      call suite%true("equal columns keep their order", agrees(sorted_order(0.0_wp*rising), same))
      mixed(1, :) = scattered(same, 0.6180339887498949_wp)
      call suite%true("one key, scattered", agrees(sorted_order(mixed), counted_order(mixed)))
   end subroutine one_key

   !> A lower row counts only where all rows above are equal, however large its differences.
   subroutine first_key_first()
      real(wp) :: key(3, 4)

      key = reshape([2.0_wp, -9.0_wp, -9.0_wp, 1.0_wp, 5.0_wp, 9.0_wp, 1.0_wp, 5.0_wp, -9.0_wp, 1.0_wp, 4.0_wp, 1.0e9_wp], [3, 4])
      call suite%true("the first key decides, then the second, then the third", agrees(sorted_order(key), [4, 3, 2, 1]))
   end subroutine first_key_first

   subroutine no_keys()
      real(wp) :: key(0, 3)

      call suite%true("without keys nothing moves", agrees(sorted_order(key), [1, 2, 3]))
   end subroutine no_keys

   !> Signed zeros are equal; infinities and the largest numbers have their place.
   subroutine odd_numbers()
      real(wp) :: infinite, key(1, 6)

      infinite = ieee_value(1.0_wp, ieee_positive_inf)
      key(1, :) = [0.0_wp, infinite, -0.0_wp, -infinite, huge(1.0_wp), -huge(1.0_wp)]
      call suite%true("zeros, infinities, largest numbers", agrees(sorted_order(key), [4, 6, 1, 3, 5, 2]))
      key(1, :2) = [-0.0_wp, 0.0_wp]
      call suite%true("0 is not above -0", agrees(sorted_order(key(:, :2)), [1, 2]))
      call suite%true("nor below it", agrees(sorted_order(-key(:, :2)), [1, 2]))
   end subroutine odd_numbers

   !> As many as a large block holds: a method of n^2 would take minutes.
   subroutine many()
      integer, parameter :: n = 100000
      real(wp), allocatable :: key(:, :)
      integer, allocatable :: order(:)
      logical :: found(n), rising
      integer :: i

      allocate(key(2, n))
      do i = 1, n
         key(:, i) = [aint(real(n/20, wp)*scattered(i, 0.6180339887498949_wp)), real(mod(i, 2), wp)]
      end do
      order = sorted_order(key)
      found = .false.
      found(order) = .true.
      call suite%true("100000 columns: each is there once", all(found))
      rising = .true.
      do i = 2, n
         rising = rising .and. comes_before(key(:, order(i - 1)), key(:, order(i)), order(i - 1) < order(i))
      end do
      call suite%true("100000 columns: rising, ties in their order", rising)
   end subroutine many

   !> The place of a column is the number of columns before it.
   function counted_order(key) result(order)
      real(wp), intent(in) :: key(:, :)
      integer :: order(size(key, 2))
      integer :: i, j, place

      do i = 1, size(key, 2)
         place = 0
         do j = 1, size(key, 2)
            if (comes_before(key(:, j), key(:, i), j <= i)) place = place + 1
         end do
         order(place) = i
      end do
   end function counted_order

   !> Is x before y? `ties` answers where they are equal.
   pure logical function comes_before(x, y, ties) result(before)
      real(wp), intent(in) :: x(:), y(:)
      logical, intent(in) :: ties
      integer :: first

      do first = 1, size(x)
         if (abs(x(first) - y(first)) > 0.0_wp) exit
      end do
      before = ties
      if (first <= size(x)) before = x(first) < y(first)
   end function comes_before

   logical function agrees(order, expected)
      integer, intent(in) :: order(:), expected(:)

      agrees = size(order) == size(expected)
      if (agrees) agrees = all(order == expected)
   end function agrees

   !> Multiples of an irrational number modulo one: scattered, and the same on every machine.
   elemental real(wp) function scattered(i, step)
      integer, intent(in) :: i
      real(wp), intent(in) :: step

      scattered = modulo(real(i, wp)*step, 1.0_wp)
   end function scattered

end program test_sort
