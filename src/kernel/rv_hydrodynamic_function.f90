!> The hydrodynamic function Gamma of a beam that vibrates in a viscous fluid.
!>
!> Force per length on a beam of width B moving as u exp(-i omega t):
!> F = (pi/4) rho_f omega^2 B^2 Gamma u, Sader (1998), doi:10.1063/1.368002.
!> Gamma = Gamma_r + i Gamma_i; the real part is added mass, the imaginary part damping.
module rv_hydrodynamic_function
   use rv_kinds, only : wp
   use rv_bessel, only : bessel_k01
   implicit none
   private
   public :: maali_function, sader_function, cylinder_function
   public :: maali_range, sader_range

   real(wp), parameter :: maali_range(2) = [0.1_wp, 1000.0_wp]   !! Reynolds numbers where Eq. (23) holds [-]
   real(wp), parameter :: sader_range(2) = [1.0e-6_wp, 1.0e4_wp] !! Reynolds numbers of Sader's fit [-]

contains

   !> Eq. (23), Maali et al. (2005), doi:10.1063/1.1873060: a fit to Gamma in powers of Re**(-1/2).
   !>
   !> The fit's variable, held against Sader's function, is rho_f omega B^2/(2 mu).
   elemental function maali_function(reynolds) result(gamma)
      real(wp), intent(in) :: reynolds   !! [-], > 0; fitted over maali_range
      complex(wp) :: gamma               !! [-]
      real(wp), parameter :: a1 = 1.0553_wp, a2 = 3.7997_wp, b1 = 3.8018_wp, b2 = 2.7364_wp

      gamma = cmplx(a1 + a2/sqrt(reynolds), b1/sqrt(reynolds) + b2/reynolds, wp)
   end function maali_function

   !> Gamma of a thin rectangular beam: the circular cylinder's times Sader's rational correction.
   elemental function sader_function(reynolds) result(gamma)
      real(wp), intent(in) :: reynolds   !! rho_f omega B^2/(4 mu) [-], > 0; fitted over sader_range
      complex(wp) :: gamma               !! [-]

      gamma = rectangle_correction(log10(reynolds))*cylinder_function(reynolds)
   end function sader_function

   !> Gamma of a circular cylinder, exact (Stokes): 1 + 4 i K1(z)/(s K0(z)), s = sqrt(i Re), z = -i s.
   elemental function cylinder_function(reynolds) result(gamma)
      real(wp), intent(in) :: reynolds   !! rho_f omega B^2/(4 mu) with B the diameter [-], > 0
      complex(wp) :: gamma               !! [-]
      complex(wp), parameter :: i = (0.0_wp, 1.0_wp)
      complex(wp) :: s, k0, k1

      s = sqrt(i*reynolds)
      call bessel_k01(-i*s, k0, k1)
      gamma = 1.0_wp + 4.0_wp*i*k1/(s*k0)
   end function cylinder_function

   !> Omega(tau), tau = log10 Re: Sader (1998), Eqs. (21).
   elemental function rectangle_correction(tau) result(omega)
      real(wp), intent(in) :: tau
      complex(wp) :: omega
      real(wp), parameter :: real_top(0:6) = [0.91324_wp, -0.48274_wp, 0.46842_wp, -0.12886_wp, &
         & 0.044055_wp, -0.0035117_wp, 0.00069085_wp]
      real(wp), parameter :: real_bottom(0:6) = [1.0_wp, -0.56964_wp, 0.48690_wp, -0.13444_wp, &
         & 0.045155_wp, -0.0035862_wp, 0.00069085_wp]
      real(wp), parameter :: imag_top(0:6) = [-0.024134_wp, -0.029256_wp, 0.016294_wp, -0.00010961_wp, &
         & 0.000064577_wp, -0.000044510_wp, 0.0_wp]
      real(wp), parameter :: imag_bottom(0:6) = [1.0_wp, -0.59702_wp, 0.55182_wp, -0.18357_wp, &
         & 0.079156_wp, -0.014369_wp, 0.0028361_wp]

      omega = cmplx(horner(real_top, tau)/horner(real_bottom, tau), &
         & horner(imag_top, tau)/horner(imag_bottom, tau), wp)
   end function rectangle_correction

   pure real(wp) function horner(c, x) result(value)
      real(wp), intent(in) :: c(0:)
      real(wp), intent(in) :: x
      integer :: k

      value = 0.0_wp
      do k = ubound(c, 1), 0, -1
         value = value*x + c(k)
      end do
   end function horner

end module rv_hydrodynamic_function
