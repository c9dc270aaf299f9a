!> The shape-preserving cubic: SciPy's PCHIP, monotony, straight lines, order of accuracy.
program test_monotone_cubic
   use rv_kinds, only : wp
   use rv_monotone_cubic, only : monotone_slopes, cubic_value
   use rv_text, only : to_text
   use check, only : suite_type
   use ref_table, only : read_table
   implicit none
   type(suite_type) :: suite

   call test_scipy()
   call test_monotone()
   call test_line()
   call test_order()
   call suite%finish()

contains

   !> Same formula as SciPy's: agreement to rounding, measured by each set's own size of values and slopes.
   subroutine test_scipy()
      real(wp), allocatable :: ref(:, :)
      integer :: number

      call read_table("pchip.txt", 5, ref)
      call suite%equal("rows of pchip.txt", size(ref, 2), 106)
      do number = 1, 6
         call compare_set("set "//to_text(number), pick(ref, number, sample=1), pick(ref, number, sample=0))
      end do
   end subroutine test_scipy

   subroutine compare_set(name, sample, between)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: sample(:, :), between(:, :)   !! columns of pchip.txt
      real(wp) :: slope(size(sample, 2))
      real(wp) :: value_limit, slope_limit, x, d
      integer :: n

      slope = monotone_slopes(sample(3, :), sample(4, :))
      value_limit = 1.0e-14_wp*maxval(abs(sample(4, :)))
      slope_limit = 1.0e-14_wp*maxval(abs(sample(5, :)))
      do n = 1, size(sample, 2)
         call suite%close(name//": slope at "//to_text(sample(3, n)), slope(n), sample(5, n), &
            & rtol=1.0e-14_wp, atol=slope_limit)
      end do
      do n = 1, size(between, 2)
         x = between(3, n)
         call suite%close(name//": value at "//to_text(x), interpolate(sample(3, :), sample(4, :), slope, x), &
            & between(4, n), rtol=1.0e-14_wp, atol=value_limit)
         ! the five-point difference is exact for a cubic: only the rounding of values and places remains
         d = 0.05_wp*minval(sample(3, 2:) - sample(3, :size(sample, 2) - 1))
         call suite%close(name//": slope at "//to_text(x), &
            & (8.0_wp*(interpolate(sample(3, :), sample(4, :), slope, x + d) &
            & - interpolate(sample(3, :), sample(4, :), slope, x - d)) &
            & - interpolate(sample(3, :), sample(4, :), slope, x + 2.0_wp*d) &
            & + interpolate(sample(3, :), sample(4, :), slope, x - 2.0_wp*d))/(12.0_wp*d), &
            & between(5, n), rtol=1.0e-14_wp, &
            & atol=2.0_wp*(value_limit + maxval(abs(sample(5, :)))*epsilon(x)*abs(x))/d)
      end do
   end subroutine compare_set

   !> Rising, uneven data with a cliff: a fine march over the curve never goes down and never leaves the data's range.
   subroutine test_monotone()
      real(wp), parameter :: x(7) = [0.0_wp, 1.0_wp, 1.01_wp, 1.02_wp, 4.0_wp, 4.5_wp, 9.0_wp]
      real(wp), parameter :: y(7) = [0.0_wp, 0.1_wp, 5.0_wp, 9.9_wp, 10.0_wp, 10.0_wp, 11.0_wp]
      integer, parameter :: steps = 9000
      real(wp) :: slope(7), last, value, lowest_step
      integer :: n

      slope = monotone_slopes(x, y)
      last = y(1)
      lowest_step = huge(1.0_wp)
      do n = 1, steps
         value = interpolate(x, y, slope, x(7)*real(n, wp)/real(steps, wp))
         lowest_step = min(lowest_step, value - last)
         last = value
      end do
      call suite%true("rising data, rising curve", lowest_step >= -1.0e-14_wp*y(7))
      call suite%close("last value", last, y(7), rtol=1.0e-15_wp, atol=0.0_wp)
      call suite%close("flat between equal samples", interpolate(x, y, slope, 4.3_wp), 10.0_wp, &
         & rtol=1.0e-15_wp, atol=0.0_wp)
   end subroutine test_monotone

   !> A straight line comes back as it is, on uneven samples too.
   subroutine test_line()
      real(wp), parameter :: x(5) = [-1.0_wp, 0.0_wp, 0.125_wp, 3.0_wp, 3.5_wp]
      real(wp) :: y(5), slope(5), at
      integer :: n

      y = 7.0_wp - 3.0_wp*x
      slope = monotone_slopes(x, y)
      do n = 0, 9
         at = -1.0_wp + 0.5_wp*real(n, wp)
         call suite%close("line at "//to_text(at), interpolate(x, y, slope, at), 7.0_wp - 3.0_wp*at, &
            & rtol=0.0_wp, atol=2.0e-15_wp*10.0_wp)
      end do
   end subroutine test_line

   !> Smooth monotone data: third order on even samples. Where the spacing alternates, the slopes are first
   !> order only, the values second.
   subroutine test_order()
      real(wp) :: order

      order = log(largest_error(80, 0.5_wp)/largest_error(160, 0.5_wp))/log(2.0_wp)
      call suite%close("order on even samples", order, 3.0_wp, rtol=0.0_wp, atol=0.1_wp)
      order = log(largest_error(80, 0.3_wp)/largest_error(160, 0.3_wp))/log(2.0_wp)
      call suite%close("order on alternating samples", order, 2.0_wp, rtol=0.0_wp, atol=0.1_wp)
   end subroutine test_order

   !> Largest error for exp on 0..1, inner part, with pairs of intervals cut at `cut` of their length.
   function largest_error(intervals, cut) result(error)
      integer, intent(in) :: intervals   !! even
      real(wp), intent(in) :: cut        !! 0.5: evenly
      real(wp) :: error
      real(wp) :: x(0:intervals), slope(0:intervals), at
      integer :: n

      do n = 0, intervals
         x(n) = real(n, wp)/real(intervals, wp)
         if (mod(n, 2) == 1) x(n) = (real(n - 1, wp) + 2.0_wp*cut)/real(intervals, wp)
      end do
      slope = monotone_slopes(x, exp(x))
      error = 0.0_wp
      do n = 0, 50*intervals
         at = 0.1_wp + 0.8_wp*real(n, wp)/real(50*intervals, wp)
         error = max(error, abs(interpolate(x, exp(x), slope, at) - exp(at)))
      end do
   end function largest_error

   function interpolate(x, y, slope, at) result(value)
      real(wp), intent(in) :: x(:), y(:), slope(:)
      real(wp), intent(in) :: at
      real(wp) :: value
      integer :: n

      n = max(1, min(size(x) - 1, count(x <= at)))
      value = cubic_value(x(n:n + 1), y(n:n + 1), slope(n:n + 1), at)
   end function interpolate

   !> The rows of one set, samples or places between them.
   function pick(table, set, sample) result(part)
      real(wp), intent(in) :: table(:, :)
      integer, intent(in) :: set, sample
      real(wp), allocatable :: part(:, :)
      integer :: n

      part = table(:, pack([(n, n=1, size(table, 2))], nint(table(1, :)) == set .and. nint(table(2, :)) == sample))
   end function pick

end program test_monotone_cubic
