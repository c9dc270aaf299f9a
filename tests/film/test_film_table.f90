!> The table of A_land and C_s: against direct solutions over its whole range, at its nodes, its slopes, its ends.
program test_film_table
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_film_reed, only : film_reed
   use rv_film_table, only : film_table, new_film_table
   use rv_reynolds, only : film_state
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_film, only : build_paper_table, paper_reed
   use paper_valve, only : mm
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: gap = 0.05_wp*mm
   integer, parameter :: lowest = -10, highest = 16   !! powers of two of x

   call whole_range(0.0_wp)
   call whole_range(0.65_wp)
   call nodes()
   call slopes()
   call any_gap()
   call ends()
   call refusals()
   call suite%finish()

contains

   !> C_s [N s m-1] and A_land [m2] by the table for a liquid of 1 Pa s.
   function tabled(table, x, at_gap) result(pair)
      type(film_table), intent(in) :: table
      real(wp), intent(in) :: x, at_gap
      real(wp) :: pair(2), y, y_slope, area_slope

      call table%look_up(x, y, y_slope, pair(2), area_slope)
      pair(1) = 1.0_wp/(y*at_gap)**3
   end function tabled

   function solved(reed, x, at_gap) result(pair)
      type(film_reed), intent(in) :: reed
      real(wp), intent(in) :: x, at_gap
      real(wp) :: pair(2)
      type(film_state) :: state
      type(error_type), allocatable :: error

      call reed%static_film%solve(at_gap, 1.0_wp, [at_gap*(x - 1.0_wp)], state, error)
      if (allocated(error)) error stop "the film is refused"
      pair = [state%damping(1, 1), state%land(1)]
   end function solved

   !> Twenty places an octave. The interpolation costs a thirtieth of the mesh's own error and less.
   subroutine whole_range(elongation)
      real(wp), intent(in) :: elongation
      type(film_reed) :: reed
      type(film_table) :: table
      real(wp) :: x, off(2), worst(2), worst_x(2)
      integer :: k

      call build_paper_table(reed, table, gap, elongation)
      worst = -1.0_wp
      worst_x = 0.0_wp
      do k = 0, 20*(highest - lowest)
         x = 2.0_wp**lowest*2.0_wp**(real(k, wp)/20.0_wp)
         off = abs(tabled(table, x, gap)/solved(reed, x, gap) - 1.0_wp)
         where (.not. off <= worst) worst_x = x
         where (.not. off <= worst) worst = off
      end do
      call suite%close("elongation "//to_text(elongation)//": C_s, worst at h_tip/g0 = "//to_text(worst_x(1), 3), worst(1), &
         & 0.0_wp, 0.0_wp, 4.0e-5_wp)
      call suite%close("A_land, worst at h_tip/g0 = "//to_text(worst_x(2), 3), worst(2), 0.0_wp, 0.0_wp, 1.0e-5_wp)
   end subroutine whole_range

   !> Four nodes an octave hold solutions.
   subroutine nodes()
      type(film_reed) :: reed
      type(film_table) :: table
      real(wp) :: worst
      integer :: octave, part

      call build_paper_table(reed, table, gap, 0.0_wp)
      worst = 0.0_wp
      do octave = lowest, highest - 1
         do part = 0, 3
            associate (x => 2.0_wp**octave*(1.0_wp + 0.25_wp*real(part, wp)))
               worst = max(worst, maxval(abs(tabled(table, x, gap)/solved(reed, x, gap) - 1.0_wp)))
            end associate
         end do
      end do
      call suite%close("nodes of the table", worst, 0.0_wp, 0.0_wp, 1.0e-12_wp)
   end subroutine nodes

   !> The slopes are those of the values, across the nodes too: Newton's method and the integrator rely on it.
   subroutine slopes()
      type(film_reed) :: reed
      type(film_table) :: table
      real(wp) :: x, dx, y(4), y_slope(4), area(4), area_slope(4), off(2), jump
      integer :: k

      call build_paper_table(reed, table, gap, 0.0_wp)
      off = 0.0_wp
      jump = 0.0_wp
      do k = 1, 15*(highest - lowest)
         x = 2.0_wp**lowest*2.0_wp**((real(k, wp) - 0.4_wp)/15.0_wp)
         dx = 1.0e-4_wp*x
         call table%look_up(x + dx*[-1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp], y, y_slope, area, area_slope)
         off = max(off, [abs((y(2) - y(1))/(2.0_wp*dx)/y_slope(3) - 1.0_wp), &
            & abs((area(2) - area(1))/(2.0_wp*dx) - area_slope(3))*x/area(3)])
         x = 2.0_wp**(lowest + real(k, wp)/30.0_wp)
         x = 2.0_wp**floor(log(x)/log(2.0_wp))*1.25_wp   ! a node inside an octave, approached from both sides
         call table%look_up(x*(1.0_wp + 1.0e-9_wp*[-1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp]), y, y_slope, area, area_slope)
         jump = max(jump, abs(y_slope(2)/y_slope(1) - 1.0_wp), abs(area_slope(2) - area_slope(1))*x/area(1))
      end do
      call suite%close("slope of Y against differences", off(1), 0.0_wp, 0.0_wp, 1.0e-5_wp)
      call suite%close("slope of A_land against differences", off(2), 0.0_wp, 0.0_wp, 1.0e-5_wp)
      call suite%close("slopes across nodes, worst jump", jump, 0.0_wp, 0.0_wp, 1.0e-6_wp)
   end subroutine slopes

   !> Without elongation one table serves every gap.
   subroutine any_gap()
      type(film_reed) :: reed
      type(film_table) :: table
      real(wp) :: off(2)
      integer :: k

      call build_paper_table(reed, table, gap, 0.0_wp)
      off = 0.0_wp
      do k = 1, 9
         off = max(off, abs(tabled(table, 0.37_wp*real(k, wp), 0.2_wp*gap) &
            & /solved(reed, 0.37_wp*real(k, wp), 0.2_wp*gap) - 1.0_wp))
      end do
      call suite%close("a fifth of the table's gap: C_s", off(1), 0.0_wp, 0.0_wp, 4.0e-5_wp)
      call suite%close("A_land", off(2), 0.0_wp, 0.0_wp, 1.0e-5_wp)
      call build_paper_table(reed, table, gap, 0.65_wp)
      off = abs(tabled(table, 2.0_wp, 0.2_wp*gap)/solved(reed, 2.0_wp, 0.2_wp*gap) - 1.0_wp)
      call suite%true("with elongation it does not: C_s off by "//to_text(off(1), 2), off(1) > 0.01_wp)
   end subroutine any_gap

   !> Beyond its ends the table gives its ends; nothing makes it read outside.
   subroutine ends()
      real(wp), parameter :: beyond(5) = [2.0_wp**lowest, 1.0e-9_wp, 0.0_wp, -3.0_wp, -huge(1.0_wp)]
      type(film_reed) :: reed
      type(film_table) :: table
      real(wp) :: off(2)
      integer :: k

      call build_paper_table(reed, table, gap, 0.0_wp)
      call suite%close("lowest x", table%lowest, 2.0_wp**lowest, 0.0_wp, 0.0_wp)
      off = 0.0_wp
      do k = 1, 5
         off = max(off, abs(tabled(table, beyond(k), gap)/solved(reed, 2.0_wp**lowest, gap) - 1.0_wp))
      end do
      call suite%close("below the table, worst difference to its end", maxval(off), 0.0_wp, 0.0_wp, 1.0e-12_wp)
      off = max(abs(tabled(table, 1.0e9_wp, gap)/solved(reed, 2.0_wp**highest, gap) - 1.0_wp), &
         & abs(tabled(table, huge(1.0_wp), gap)/solved(reed, 2.0_wp**highest, gap) - 1.0_wp))
      call suite%close("above it", maxval(off), 0.0_wp, 0.0_wp, 1.0e-12_wp)
      off = abs(tabled(table, ieee_value(1.0_wp, ieee_quiet_nan), gap)/solved(reed, 2.0_wp**lowest, gap) - 1.0_wp)
      call suite%close("NaN reads the lower end", maxval(off), 0.0_wp, 0.0_wp, 1.0e-12_wp)
   end subroutine ends

   subroutine refusals()
      type(film_reed) :: reed
      type(film_table) :: table
      type(error_type), allocatable :: error

      reed = paper_reed(1)
      call new_film_table(table, reed, 0.0_wp, error)
      call suite%fails("gap 0", error, "closed")
      call new_film_table(table, reed, -gap, error)
      call suite%fails("negative gap", error, "closed")
      call new_film_table(table, reed, ieee_value(1.0_wp, ieee_quiet_nan), error)
      call suite%fails("gap NaN", error, "closed")
   end subroutine refusals

end program test_film_table
