!> How thick may a reed be that closes within 3 ms, and how far does it open then under a pressure of the caller's?
program design
   use, intrinsic :: iso_fortran_env, only : error_unit, real64
   use reedvalve, only : reed_valve, rv_displacement, rv_ok
   implicit none

   real(real64), parameter :: wanted = 3.0_real64   !! closing time [ms]
   type(reed_valve) :: valve
   real(real64) :: thickness, opening(3)
   integer :: stat

   call valve%open()
   call valve%set("run.model", "squeeze")
   call find_thickness(valve, thickness)
   call follow(valve, opening)
   call valve%check(stat)   ! of all calls so far
   if (stat /= rv_ok) then
      write(error_unit, '(a)') trim(valve%message())
      stop 1
   end if
   print '(a, f6.4, a, f4.2, a)', "A reed of ", thickness, " mm closes in ", wanted, " ms."
   print '(a, 3f8.4, a)', "Open after 1, 2 and 3 ms by", opening, " mm."

contains

   !> Bisection: thicker reeds close faster.
   subroutine find_thickness(valve, thickness)
      type(reed_valve), intent(inout) :: valve
      real(real64), intent(out) :: thickness   !! [mm]
      real(real64) :: low, high
      integer :: i

      low = 0.1_real64
      high = 0.3_real64
      do i = 1, 30
         thickness = 0.5_real64*(low + high)
         call valve%set("reed.thickness_mm", thickness)
         call valve%run()
         if (valve%measure("closing_ms") > wanted) then
            low = thickness
         else
            high = thickness
         end if
      end do
   end subroutine find_thickness

   !> The inlet rises from 0 to 15 kPa and back within 3 ms, in steps of 0.05 ms.
   subroutine follow(valve, opening)
      type(reed_valve), intent(inout) :: valve
      real(real64), intent(out) :: opening(3)   !! [mm]
      integer :: k, ms

      call valve%begin(0.0_real64)
      do ms = 1, 3
         do k = 20*ms - 19, 20*ms
            call valve%step(5.0e-5_real64*k, [inlet(k - 1), inlet(k)], [0.0_real64, 0.0_real64])
         end do
         opening(ms) = 1.0e3_real64*valve%output(rv_displacement)
      end do
   end subroutine follow

   !> [Pa]
   pure real(real64) function inlet(k)
      integer, intent(in) :: k

      inlet = 1.5e4_real64*sin(acos(-1.0_real64)*k/60)
   end function inlet

end program design
