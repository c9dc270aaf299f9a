!> A silicon cantilever in water after Sader (1998), doi:10.1063/1.368002: frequency and quality factor of three modes.
!>
!> 800 x 50 x 5 um, 169 GPa, 2330 kg/m3; water of 997 kg/m3 and 0.89 mPa s. Only Gamma is the
!> code's own; the references were computed with mpmath's Bessel functions and 40 digits.
program test_immersed_beam
   use rv_kinds, only : wp, pi
   use rv_hydrodynamic_function, only : sader_function
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: length = 800.0e-6_wp, width = 50.0e-6_wp, thickness = 5.0e-6_wp
   real(wp), parameter :: modulus = 169.0e9_wp, density = 2330.0_wp
   real(wp), parameter :: water_density = 997.0_wp, water_viscosity = 0.89e-3_wp
   real(wp), parameter :: mass_ratio = pi*water_density*width/(4.0_wp*density*thickness)
   !> roots of 1 + cos(c) cosh(c) = 0
   real(wp), parameter :: root(3) = [1.875104068711961_wp, 4.694091132974175_wp, 7.854757438237613_wp]
   !> half a unit of the last digit given bounds each
   real(wp), parameter :: frequency(3) = [4149.70_wp, 29141.48_wp, 84577.36_wp]   !! [Hz]
   real(wp), parameter :: quality(3) = [2.8303_wp, 6.0563_wp, 9.3329_wp]          !! [-]
   complex(wp) :: gamma
   real(wp) :: dry, wet
   integer :: mode, iteration

   do mode = 1, 3
      dry = (root(mode)/length)**2*thickness*sqrt(modulus/(12.0_wp*density))
      wet = dry
      do iteration = 1, 100   ! contracts by two or better
         gamma = sader_function(water_density*wet*width**2/(4.0_wp*water_viscosity))
         wet = dry/sqrt(1.0_wp + mass_ratio*gamma%re)
      end do
      call suite%close("loaded frequency of mode "//to_text(mode)//" [Hz]", wet/(2.0_wp*pi), frequency(mode), &
         & rtol=0.0_wp, atol=0.5e-2_wp)
      call suite%close("quality factor of mode "//to_text(mode), (1.0_wp/mass_ratio + gamma%re)/gamma%im, &
         & quality(mode), &
         & rtol=0.0_wp, atol=0.5e-4_wp)
   end do
   call suite%finish()
end program test_immersed_beam
