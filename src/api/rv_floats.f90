!> The caller's floating-point environment, put aside while the library computes.
!>
!> Many a Fortran program is built to stop at its first NaN or overflow (-ffpe-trap), but here both are ordinary numbers:
!> of what is not known, and of trial steps that are refused. Flags that they raise are not the caller's either.
module rv_floats
   use, intrinsic :: iso_c_binding, only : c_int64_t
   implicit none
   private
   public :: float_guard

   !> From put_aside to the end of its scope the environment is the library's.
   type :: float_guard
      private
      integer(c_int64_t) :: kept(8) = 0   !! room for one of C
      logical :: is_aside = .false.
   contains
      procedure :: put_aside
      final :: give_back
   end type float_guard

   interface
      subroutine c_put_aside(kept) bind(C, name="rv_floats_put_aside")
         import :: c_int64_t
         integer(c_int64_t), intent(out) :: kept(*)
      end subroutine c_put_aside

      subroutine c_give_back(kept) bind(C, name="rv_floats_give_back")
         import :: c_int64_t
         integer(c_int64_t), intent(in) :: kept(*)
      end subroutine c_give_back
   end interface

contains

   subroutine put_aside(self)
      class(float_guard), intent(inout) :: self

      call c_put_aside(self%kept)
      self%is_aside = .true.
   end subroutine put_aside

   subroutine give_back(self)
      type(float_guard), intent(inout) :: self

      if (self%is_aside) call c_give_back(self%kept)
      self%is_aside = .false.
   end subroutine give_back

end module rv_floats
