!> The one real kind of the code and the constants that need no source.
module rv_kinds
   use, intrinsic :: iso_fortran_env, only : real64, int64
   implicit none
   private
   public :: wp, i8, pi

   integer, parameter :: wp = real64  !! working precision
   integer, parameter :: i8 = int64   !! counts that may pass 2^31
   real(wp), parameter :: pi = 3.141592653589793238462643383279502884_wp
end module rv_kinds
