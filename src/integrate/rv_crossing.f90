!> Where many lanes cross their levels within one step: roots of quintics side by side, in loops that vectors can do.
module rv_crossing
   use rv_kinds, only : wp, i8
   implicit none
   private
   public :: crossings

contains

   !> Place s on 0..1 at which the quintic through both ends' u, u' and u'' meets the level between u0 and u1.
   !>
   !> Newton from the inverse cubic, held in by bisection, until Newton moves no lane by more than 1e-9: to rounding.
   pure subroutine crossings(n, h, level, u0, v0, a0, u1, v1, a1, s)
      integer, intent(in) :: n
      real(wp), intent(in) :: h                              !! the step [s]
      real(wp), dimension(n), intent(in) :: level            !! [m]
      real(wp), dimension(n), intent(in) :: u0, v0, a0       !! [m], [m s-1], [m s-2] at s = 0
      real(wp), dimension(n), intent(in) :: u1, v1, a1       !! the same at s = 1
      real(wp), intent(out) :: s(n)
      real(wp), parameter :: near = 1.0e-9_wp
      real(wp), dimension(n) :: c0, c1, c2, c3, c4, c5, left, right
      real(wp), parameter :: rounding = 2.0_wp*epsilon(1.0_wp)
      real(wp) :: f, slope, newton, x, d0, d1, middle, inside, moved
      integer(i8) :: some
      integer :: i, iteration

      do i = 1, n
         c0(i) = u0(i) - level(i)
         c1(i) = h*v0(i)
         c2(i) = 0.5_wp*h*h*a0(i)
         f = u1(i) - u0(i) - c1(i) - c2(i)
         d0 = h*v1(i) - c1(i) - 2.0_wp*c2(i)
         d1 = h*h*a1(i) - 2.0_wp*c2(i)
         c3(i) = 10.0_wp*f - 4.0_wp*d0 + 0.5_wp*d1
         c4(i) = -15.0_wp*f + 7.0_wp*d0 - d1
         c5(i) = 6.0_wp*f - 3.0_wp*d0 + 0.5_wp*d1
         x = (level(i) - u0(i))/(u1(i) - u0(i))
         d0 = (u1(i) - u0(i))/c1(i)
         d1 = (u1(i) - u0(i))/(h*v1(i))
         f = x*(d0 + x*(3.0_wp - 2.0_wp*d0 - d1 + x*(d0 + d1 - 2.0_wp)))
         s(i) = merge(f, x, f > 0.0_wp .and. f < 1.0_wp)
         left(i) = 0.0_wp
         right(i) = 1.0_wp
      end do
      do iteration = 1, 100
         some = 0_i8
         do i = 1, n
            f = c0(i) + s(i)*(c1(i) + s(i)*(c2(i) + s(i)*(c3(i) + s(i)*(c4(i) + s(i)*c5(i)))))
            slope = c1(i) + s(i)*(2.0_wp*c2(i) + s(i)*(3.0_wp*c3(i) + s(i)*(4.0_wp*c4(i) + s(i)*5.0_wp*c5(i))))
            x = f*(u0(i) - level(i))   ! positive: still on the side of s = 0
            left(i) = merge(s(i), left(i), x > 0.0_wp)
            right(i) = merge(right(i), s(i), x > 0.0_wp)
            middle = 0.5_wp*(left(i) + right(i))
            newton = s(i) - f/slope
            newton = merge(s(i), newton, abs(f) <= 0.0_wp)
            inside = merge(1.0_wp, 0.0_wp, newton >= left(i))
            inside = merge(inside, 0.0_wp, newton <= right(i))
            newton = merge(newton, middle, inside > 0.0_wp)
            moved = merge(abs(newton - s(i)), near*(right(i) - left(i))/rounding, inside > 0.0_wp)
            some = ior(some, merge(0_i8, 1_i8, moved <= near))
            s(i) = newton
         end do
         if (some == 0_i8) exit
      end do
   end subroutine crossings

end module rv_crossing
