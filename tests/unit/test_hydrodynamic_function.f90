!> Gamma of rectangular beam and cylinder: published values, limits of the Reynolds number, the two fits compared.
program test_hydrodynamic_function
   use rv_kinds, only : wp
   use rv_hydrodynamic_function, only : maali_function, sader_function, cylinder_function, maali_range, sader_range
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   complex(wp), parameter :: i = (0.0_wp, 1.0_wp)
   integer, parameter :: n_grid = 101

   call test_sader_values()
   call test_cylinder_limits()
   call test_maali_values()
   call test_ranges()
   call test_fits_compared()
   call suite%finish()

contains

   !> Half a unit of the last digit.
   subroutine test_sader_values()
      call close_complex("Sader, Re = 1", sader_function(1.0_wp), (3.733959_wp, 4.074611_wp), 0.5e-6_wp)
      call close_complex("Sader, Re = 100", sader_function(100.0_wp), (1.326272_wp, 0.296102_wp), 0.5e-6_wp)
      call close_complex("Sader, Re = 1000", sader_function(1000.0_wp), (1.117414_wp, 0.100611_wp), 0.5e-6_wp)
      call close_complex("cylinder, Re = 1", cylinder_function(1.0_wp), (3.968015_wp, 4.566571_wp), 0.5e-6_wp)
   end subroutine test_sader_values

   !> Large Re: Gamma = 1 + 4 i/s (1 + 1/(2 z) - 1/(8 z^2) + O(z**-3)), s = sqrt(i Re), z = -i s, so that the
   !> remainder is below Re**-2; at last the inviscid value 1. Small Re: K1 = 1/z, K0 = -ln(z/2) - gamma,
   !> relative remainder of order Re ln(Re).
   subroutine test_cylinder_limits()
      real(wp), parameter :: euler_gamma = 0.5772156649015329_wp
      complex(wp) :: s, z
      real(wp) :: re
      integer :: n

      do n = 2, 6, 2
         re = 10.0_wp**n
         s = sqrt(i*re)
         z = -i*s
         call close_complex("cylinder against its large series, Re = "//to_text(re), cylinder_function(re), &
            & 1.0_wp + 4.0_wp*i/s*(1.0_wp + 0.5_wp/z - 0.125_wp/z**2), re**(-2) + 1.0e-15_wp)
      end do
      call close_complex("cylinder without viscosity", cylinder_function(1.0e30_wp), (1.0_wp, 0.0_wp), 1.0e-14_wp)
      do n = -12, -4, 4
         re = 10.0_wp**n
         z = -i*sqrt(i*re)
         call close_complex("creeping cylinder, Re = "//to_text(re), &
            & cylinder_function(re)*re*(-log(0.5_wp*z) - euler_gamma)/(4.0_wp*i), (1.0_wp, 0.0_wp), &
            & re*(1.0_wp + abs(log(re))))
      end do
   end subroutine test_cylinder_limits

   !> Eq. (23) with its constants, where the roots are whole numbers.
   subroutine test_maali_values()
      call close_complex("Maali, Re = 1", maali_function(1.0_wp), (4.8550_wp, 6.5382_wp), 1.0e-14_wp)
      call close_complex("Maali, Re = 100", maali_function(100.0_wp), (1.43527_wp, 0.407544_wp), 1.0e-15_wp)
      call close_complex("Maali, Re = 10^30", maali_function(1.0e30_wp), (1.0553_wp, 0.0_wp), 1.0e-14_wp)
   end subroutine test_maali_values

   !> Published ranges of the fits. Within them the fluid adds mass and takes energy, less of both the higher Re.
   subroutine test_ranges()
      call suite%close("Maali from", maali_range(1), 0.1_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("Maali to", maali_range(2), 1000.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("Sader from", sader_range(1), 1.0e-6_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("Sader to", sader_range(2), 1.0e4_wp, rtol=0.0_wp, atol=0.0_wp)
      call falls("Maali", maali_function(grid(maali_range)))
      call falls("Sader", sader_function(grid(sader_range)))
      call falls("cylinder", cylinder_function(grid(sader_range)))
   end subroutine test_ranges

   subroutine falls(name, gamma)
      character(len=*), intent(in) :: name
      complex(wp), intent(in) :: gamma(:)
      integer :: n

      n = size(gamma)
      call suite%true(name//": added mass falls with Re", all(gamma(2:)%re < gamma(:n - 1)%re))
      call suite%true(name//": damping falls with Re", all(gamma(2:)%im < gamma(:n - 1)%im))
      call suite%true(name//": added mass stays above the inviscid one", gamma(n)%re > 1.0_wp)
      call suite%true(name//": damping stays above zero", gamma(n)%im > 0.0_wp)
   end subroutine falls

   !> Eq. (23) fed with rho_f omega B^2/(2 mu) is closer to Sader's function over its whole range; fed with Sader's own
   !> Re = rho_f omega B^2/(4 mu) it overstates the damping by 22 to 80 %, 37.6 % at Re = 100.
   subroutine test_fits_compared()
      real(wp) :: re(n_grid), excess(n_grid)
      complex(wp) :: sader(n_grid)

      re = grid(maali_range)
      sader = sader_function(re)
      call suite%true("Maali's fit of 2 Re is the closer one", &
         & all(abs(maali_function(2.0_wp*re) - sader) < 0.6_wp*abs(maali_function(re) - sader)))
      excess = 100.0_wp*(aimag(maali_function(re))/aimag(sader) - 1.0_wp)
      call suite%close("smallest excess of damping [%]", minval(excess), 22.0_wp, rtol=0.0_wp, atol=0.5_wp)
      call suite%close("largest excess of damping [%]", maxval(excess), 80.0_wp, rtol=0.0_wp, atol=0.5_wp)
      call suite%close("excess of damping at Re = 100 [%]", &
         & 100.0_wp*(aimag(maali_function(100.0_wp))/aimag(sader_function(100.0_wp)) - 1.0_wp), 37.6_wp, &
         & rtol=0.0_wp, atol=0.05_wp)
   end subroutine test_fits_compared

   !> From end to end in steps, even in the logarithm.
   function grid(range) result(re)
      real(wp), intent(in) :: range(2)
      real(wp) :: re(n_grid)
      integer :: n

      re = range(1)*(range(2)/range(1))**([(real(n, wp), n=0, n_grid - 1)]/real(n_grid - 1, wp))
   end function grid

   subroutine close_complex(what, value, reference, limit)
      character(len=*), intent(in) :: what
      complex(wp), intent(in) :: value, reference
      real(wp), intent(in) :: limit   !! on each part

      call suite%close(what//", real part", value%re, reference%re, rtol=0.0_wp, atol=limit)
      call suite%close(what//", imaginary part", value%im, reference%im, rtol=0.0_wp, atol=limit)
   end subroutine close_complex

end program test_hydrodynamic_function
