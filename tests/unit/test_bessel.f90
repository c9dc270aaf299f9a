!> K0 and K1 of complex argument: mpmath's values, their differential relations, both ends of the range.
program test_bessel
   use rv_kinds, only : wp, pi
   use rv_bessel, only : bessel_k01
   use rv_text, only : to_text
   use check, only : suite_type
   use ref_table, only : read_table
   implicit none
   type(suite_type) :: suite
   complex(wp), parameter :: sader_ray = sqrt(0.5_wp)*(1.0_wp, -1.0_wp)   !! arg z = -pi/4

   call test_reference()
   call test_switch()
   call test_derivatives()
   call test_conjugation()
   call test_limits()
   call suite%finish()

contains

   !> mpmath, 50 digits. On Sader's ray as good as the module promises; 1e-12 towards the imaginary axis,
   !> where the series cancels and the continued fraction is slow.
   subroutine test_reference()
      real(wp), allocatable :: ref(:, :)
      complex(wp) :: z, k0, k1
      real(wp) :: limit
      integer :: n

      call read_table("bessel_k01.txt", 6, ref)
      call suite%equal("rows of bessel_k01.txt", size(ref, 2), 130)
      do n = 1, size(ref, 2)
         z = cmplx(ref(1, n), ref(2, n), wp)
         limit = 1.0e-12_wp
         if (abs(abs(z%im) - z%re) <= 1.0e-12_wp*z%re) limit = 1.0e-13_wp
         call bessel_k01(z, k0, k1)
         call close_complex("exp(z) K0 at "//place(z), k0, cmplx(ref(3, n), ref(4, n), wp), limit)
         call close_complex("exp(z) K1 at "//place(z), k1, cmplx(ref(5, n), ref(6, n), wp), limit)
      end do
   end subroutine test_reference

   !> Series and continued fraction meet at |z| = 2: two points 2e-12 apart differ by as much, not more.
   subroutine test_switch()
      complex(wp) :: below0, below1, above0, above1
      complex(wp) :: z
      integer :: n
      real(wp) :: angle

      do n = -4, 4
         angle = 0.1_wp*pi*real(n, wp)
         z = 2.0_wp*cmplx(cos(angle), sin(angle), wp)
         call bessel_k01(z*(1.0_wp - 1.0e-12_wp), below0, below1)
         call bessel_k01(z*(1.0_wp + 1.0e-12_wp), above0, above1)
         call close_complex("K0 across the switch at "//place(z), above0, below0, 1.0e-11_wp)
         call close_complex("K1 across the switch at "//place(z), above1, below1, 1.0e-11_wp)
      end do
   end subroutine test_switch

   !> K0' = -K1 and K1' = -K0 - K1/z, times exp(z), by central differences along both axes (which makes the
   !> functions analytic too). With a step of epsilon**(1/3) |z| both errors of the difference
   !> are some epsilon**(2/3) = 4e-11; the limit is sqrt(epsilon).
   subroutine test_derivatives()
      complex(wp) :: z, k0, k1, d0, d1, direction
      real(wp), parameter :: limit = sqrt(epsilon(1.0_wp))
      integer :: n, axis

      do n = -3, 2
         z = 10.0_wp**(0.7_wp*real(n, wp))*sader_ray
         if (n == 2) z = 2.0_wp*sader_ray
         call bessel_k01(z, k0, k1)
         do axis = 1, 2
            direction = merge((1.0_wp, 0.0_wp), (0.0_wp, 1.0_wp), axis == 1)
            call differences(z, direction, d0, d1)
            call close_complex("K0' = -K1 at "//place(z)//" along "//place(direction), d0, k0 - k1, limit)
            call close_complex("K1' = -K0 - K1/z at "//place(z)//" along "//place(direction), d1, &
               & k1 - k0 - k1/z, limit)
         end do
      end do
   end subroutine test_derivatives

   subroutine differences(z, direction, d0, d1)
      complex(wp), intent(in) :: z, direction
      complex(wp), intent(out) :: d0, d1
      complex(wp) :: step, ahead0, ahead1, behind0, behind1

      step = epsilon(1.0_wp)**(1.0_wp/3.0_wp)*abs(z)*direction
      call bessel_k01(z + step, ahead0, ahead1)
      call bessel_k01(z - step, behind0, behind1)
      d0 = (ahead0 - behind0)/(2.0_wp*step)
      d1 = (ahead1 - behind1)/(2.0_wp*step)
   end subroutine differences

   !> The functions are real on the real axis: conjugate arguments give conjugate values, in every bit but the last.
   subroutine test_conjugation()
      complex(wp) :: z, upper0, upper1, lower0, lower1
      integer :: n

      do n = 1, 2
         z = cmplx(0.8_wp*real(n, wp)**2, 0.9_wp*real(n, wp), wp)
         call bessel_k01(z, upper0, upper1)
         call bessel_k01(conjg(z), lower0, lower1)
         call close_complex("K0 of the conjugate of "//place(z), lower0, conjg(upper0), 4.0_wp*epsilon(1.0_wp))
         call close_complex("K1 of the conjugate of "//place(z), lower1, conjg(upper1), 4.0_wp*epsilon(1.0_wp))
      end do
   end subroutine test_conjugation

   !> Far out sqrt(2 z/pi) exp(z) K_n(z) = 1 + (4 n^2 - 1)/(8 z) + O(z**-2); near 0, z K1 = 1 and K0 = -ln(z/2) - gamma.
   subroutine test_limits()
      real(wp), parameter :: euler_gamma = 0.5772156649015329_wp
      complex(wp) :: z, k0, k1

      z = 1.0e8_wp*sader_ray
      call bessel_k01(z, k0, k1)
      call close_complex("K0, large argument", k0*sqrt(2.0_wp*z/pi), 1.0_wp - 0.125_wp/z, 1.0e-14_wp)
      call close_complex("K1, large argument", k1*sqrt(2.0_wp*z/pi), 1.0_wp + 0.375_wp/z, 1.0e-14_wp)
      z = 1.0e-100_wp*sader_ray
      call bessel_k01(z, k0, k1)
      call close_complex("K0, tiny argument", k0, -log(0.5_wp*z) - euler_gamma, 1.0e-14_wp)
      call close_complex("K1, tiny argument", z*k1, (1.0_wp, 0.0_wp), 1.0e-14_wp)
   end subroutine test_limits

   subroutine close_complex(what, value, reference, limit)
      character(len=*), intent(in) :: what
      complex(wp), intent(in) :: value, reference
      real(wp), intent(in) :: limit   !! on |value - reference|/|reference|

      call suite%close(what//", relative error", abs(value - reference)/abs(reference), 0.0_wp, &
         & rtol=0.0_wp, atol=limit)
   end subroutine close_complex

   function place(z) result(text)
      complex(wp), intent(in) :: z
      character(len=:), allocatable :: text

      text = "("//to_text(z%re, 6)//", "//to_text(z%im, 6)//")"
   end function place

end program test_bessel
