!> The largest of many numbers that are not negative, in a loop that vectors can do.
module rv_largest
   use rv_kinds, only : wp, i8
   implicit none
   private
   public :: largest

contains

   !> NaN if one of them is; 0 if there are none. As integers their bits have the same order, with NaN on top.
   pure real(wp) function largest(x)
      real(wp), intent(in) :: x(:)   !! none negative
      integer(i8) :: top
      integer :: i

      top = 0_i8
      do i = 1, size(x)
         top = max(top, iand(transfer(x(i), top), huge(top)))   ! processors make NaN with a sign
      end do
      largest = transfer(top, largest)
   end function largest

end module rv_largest
