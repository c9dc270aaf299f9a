!> Added mass and damping: the published reading, the wet fixed point, no load, range flag, refused data.
program test_hydrodynamic_load
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan, ieee_is_nan
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type, rv_bad_input, rv_not_converged
   use rv_hydrodynamic_function, only : maali_function, sader_function
   use rv_hydrodynamic_load, only : hydrodynamic_load, new_hydrodynamic_load, fluid_type, &
      & load_published, load_maali, load_sader, load_none
   use rv_reed, only : reed_type, new_reed
   use rv_text, only : to_text
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   type(fluid_type), parameter :: oil = fluid_type(875.0_wp, 0.0484_wp)
   real(wp), parameter :: some_ulp = 16.0_wp*epsilon(1.0_wp)
   real(wp), parameter :: fixed_point = 1.1e-14_wp   !! the iteration's tolerance and its rounding
   type(reed_type) :: reed

   reed = paper_reed()
   call test_published()
   call test_maali()
   call test_fixed_point("maali", load_maali)
   call test_fixed_point("sader", load_sader)
   call test_every_viscosity()
   call test_sader()
   call test_none()
   call test_range()
   call test_thin_fluid()
   call test_refused_data()
   call suite%finish()

contains

   !> The reading that reproduces the paper's tables; limits: half a unit of the last digit given.
   subroutine test_published()
      type(hydrodynamic_load) :: load

      load = loaded(load_published, oil)
      call suite%close("published: omega [rad/s]", load%angular_frequency, 13028.0_wp, rtol=0.0_wp, atol=0.5_wp)
      call suite%close("published: omega is the dry one", load%angular_frequency, sqrt(reed%stiffness/reed%mass), &
         & rtol=some_ulp, atol=0.0_wp)
      call suite%close("published: Re", load%reynolds, 212.0_wp, rtol=0.0_wp, atol=0.5_wp)
      call suite%close("published: added mass [kg]", load%added_mass, 9.916e-5_wp, rtol=0.0_wp, atol=0.5e-8_wp)
      call suite%close("published: added damping [N s/m]", load%added_damping, 0.26896_wp, rtol=0.0_wp, atol=0.5e-5_wp)
      call suite%true("published: in range", load%in_range)
      call suite%close("published: loaded frequency [Hz]", &
         & sqrt(reed%stiffness/(reed%mass + load%added_mass))/(2.0_wp*pi), 770.0_wp, rtol=0.0_wp, atol=0.5_wp)
      call suite%close("published: damping ratio", &
         & 0.5_wp*load%added_damping/sqrt(reed%stiffness*(reed%mass + load%added_mass)), 0.242_wp, &
         & rtol=0.0_wp, atol=0.5e-3_wp)
   end subroutine test_published

   subroutine test_maali()
      type(hydrodynamic_load) :: load

      load = loaded(load_maali, oil)
      call suite%close("maali: omega [rad/s]", load%angular_frequency, 6065.95_wp, rtol=0.0_wp, atol=0.5e-2_wp)
      call suite%close("maali: Re", load%reynolds, 986.97_wp, rtol=0.0_wp, atol=0.5e-2_wp)
      call suite%close("maali: added mass [kg]", load%added_mass, 5.72985e-5_wp, rtol=0.0_wp, atol=0.5e-10_wp)
      call suite%close("maali: added damping [N s/m]", load%added_damping, 0.036578_wp, rtol=0.0_wp, atol=0.5e-6_wp)
      call suite%true("maali: in range", load%in_range)
   end subroutine test_maali

   !> omega = sqrt(k/(m_e + m_a)) with m_a taken at that omega, Eqs. (21) and (22), over nine decades of viscosity.
   subroutine test_fixed_point(name, choice)
      character(len=*), intent(in) :: name
      integer, intent(in) :: choice
      type(hydrodynamic_load) :: load
      type(fluid_type) :: fluid
      complex(wp) :: gamma
      real(wp) :: omega, reynolds, displaced
      character(len=:), allocatable :: at
      integer :: n

      do n = -6, 3
         fluid = fluid_type(875.0_wp, 10.0_wp**n)
         load = loaded(choice, fluid)
         omega = load%angular_frequency
         reynolds = fluid%density*omega*reed%width**2/(4.0_wp*fluid%viscosity)
         gamma = merge(maali_function(reynolds), sader_function(reynolds), choice == load_maali)
         displaced = 0.25_wp*pi*fluid%density*reed%width**2*reed%shape2_integral
         at = name//", viscosity 1e"//to_text(n)//" Pa s: "
         call suite%close(at//"omega [rad/s]", omega, sqrt(reed%stiffness/(reed%mass + load%added_mass)), &
            & rtol=fixed_point, atol=0.0_wp)
         call suite%close(at//"Re", load%reynolds, reynolds, rtol=some_ulp, atol=0.0_wp)
         call suite%close(at//"added mass [kg]", load%added_mass, displaced*gamma%re, rtol=some_ulp, atol=0.0_wp)
         call suite%close(at//"added damping [N s/m]", load%added_damping, displaced*omega*gamma%im, rtol=some_ulp, &
            & atol=0.0_wp)
      end do
   end subroutine test_fixed_point

   !> Where the last digits of Gamma do not settle, those of omega do not either, at one viscosity in two thousand or
   !> so;
   !> the load is found all the same.
   subroutine test_every_viscosity()
      type(hydrodynamic_load) :: load
      type(error_type), allocatable :: error
      real(wp) :: viscosity
      integer :: n, failed

      failed = 0
      do n = 0, 6000
         viscosity = 10.0_wp**(real(n, wp)/1000.0_wp - 4.0_wp)
         call new_hydrodynamic_load(load, load_sader, reed, fluid_type(875.0_wp, viscosity), error)
         if (allocated(error)) failed = failed + 1
      end do
      call suite%equal("viscosities of 1e-4 to 100 Pa s without a wet frequency", failed, 0)
   end subroutine test_every_viscosity

   !> Solved independently with mpmath's Bessel functions, 40 digits.
   subroutine test_sader()
      type(hydrodynamic_load) :: load

      load = loaded(load_sader, oil)
      call suite%close("sader: omega [rad/s]", load%angular_frequency, 6189.155329350690_wp, rtol=1.0e-12_wp, &
         & atol=0.0_wp)
      call suite%close("sader: Re", load%reynolds, 1007.016492120593_wp, rtol=1.0e-12_wp, atol=0.0_wp)
      call suite%close("sader: added mass [kg]", load%added_mass, 5.441483444891233e-5_wp, rtol=1.0e-12_wp, atol=0.0_wp)
      call suite%close("sader: added damping [N s/m]", load%added_damping, 0.03023710511279040_wp, &
         & rtol=1.0e-12_wp, atol=0.0_wp)
   end subroutine test_sader

   subroutine test_none()
      type(hydrodynamic_load) :: load

      load = loaded(load_none, oil)
      call suite%close("none: added mass [kg]", load%added_mass, 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("none: added damping [N s/m]", load%added_damping, 0.0_wp, rtol=0.0_wp, atol=0.0_wp)
      call suite%close("none: omega is the dry one", load%angular_frequency, sqrt(reed%stiffness/reed%mass), &
         & rtol=some_ulp, atol=0.0_wp)
      call suite%true("none: no Reynolds number", ieee_is_nan(load%reynolds))
      call suite%true("none: nothing out of range", load%in_range)
   end subroutine test_none

   !> The flag follows Re against 0.1..1000 of Eq. (23) and 1e-6..1e4 of Sader's fit. The published Re is
   !> inverse to the viscosity, so its edges are known; for the wet ones the viscosity is a decade on either side.
   subroutine test_range()
      type(hydrodynamic_load) :: load
      real(wp) :: edge

      load = loaded(load_published, oil)
      edge = oil%viscosity*load%reynolds/1000.0_wp
      call flag("published, Re just below 1000", load_published, edge*(1.0_wp + 1.0e-9_wp), .true.)
      call flag("published, Re just above 1000", load_published, edge*(1.0_wp - 1.0e-9_wp), .false.)
      edge = oil%viscosity*load%reynolds/0.1_wp
      call flag("published, Re just above 0.1", load_published, edge*(1.0_wp - 1.0e-9_wp), .true.)
      call flag("published, Re just below 0.1", load_published, edge*(1.0_wp + 1.0e-9_wp), .false.)
      call flag("maali, Re of some 100", load_maali, 0.4_wp, .true.)
      call flag("maali, Re of some 5000", load_maali, 0.01_wp, .false.)
      call flag("sader, Re of some 5000", load_sader, 0.01_wp, .true.)
      call flag("sader, Re of some 50 000", load_sader, 0.001_wp, .false.)
      call flag("sader, Re of some 1e-4", load_sader, 1.0e4_wp, .true.)
      call flag("sader, Re of some 1e-8", load_sader, 1.0e6_wp, .false.)
   end subroutine test_range

   subroutine flag(what, choice, viscosity, in_range)
      character(len=*), intent(in) :: what
      integer, intent(in) :: choice
      real(wp), intent(in) :: viscosity
      logical, intent(in) :: in_range
      type(hydrodynamic_load) :: load

      load = loaded(choice, fluid_type(oil%density, viscosity))
      call suite%true(what//": Re = "//to_text(load%reynolds, 12)//", in range "//trim(merge("yes", "no ", in_range)), &
         & load%in_range .eqv. in_range)
   end subroutine flag

   !> Next to no density: the wet reed vibrates as the dry one. Next to no viscosity: Gamma is a1 of Eq. (23)
   !> (the limit is its next term, 4/sqrt(Re)).
   subroutine test_thin_fluid()
      type(hydrodynamic_load) :: load

      load = loaded(load_maali, fluid_type(1.0e-12_wp, 1.0e-17_wp))
      call suite%close("vacuum: omega [rad/s]", load%angular_frequency, sqrt(reed%stiffness/reed%mass), &
         & rtol=1.0e-12_wp, atol=0.0_wp)
      load = loaded(load_maali, fluid_type(875.0_wp, 1.0e-17_wp))
      call suite%close("inviscid: added mass [kg]", load%added_mass, &
         & 1.0553_wp*0.25_wp*pi*875.0_wp*reed%width**2*reed%shape2_integral, rtol=4.0_wp/sqrt(load%reynolds), &
         & atol=0.0_wp)
      call suite%true("inviscid: the damping is that of the boundary layer", &
         & load%added_damping < 1.0e-5_wp*load%added_mass*load%angular_frequency .and. load%added_damping > 0.0_wp)
   end subroutine test_thin_fluid

   subroutine test_refused_data()
      real(wp) :: bad(3)
      type(reed_type) :: no_reed, odd_reed
      integer :: n

      bad = [0.0_wp, -1.0_wp, ieee_value(1.0_wp, ieee_quiet_nan)]
      do n = 1, 3
         call refused("density "//to_text(bad(n)), load_published, reed, fluid_type(bad(n), 0.0484_wp), "density")
         call refused("viscosity "//to_text(bad(n)), load_sader, reed, fluid_type(875.0_wp, bad(n)), "viscosity")
      end do
      call refused("a reed that was not built", load_maali, no_reed, oil, "the reed's mass > 0")
      odd_reed = reed
      odd_reed%stiffness = bad(3)
      call refused("a reed whose stiffness is not a number", load_sader, odd_reed, oil, "no wet frequency", &
         & rv_not_converged)
      call refused("choice 0", 0, reed, oil, "unknown hydrodynamic load")
      call refused("choice 5", 5, reed, oil, "unknown hydrodynamic load")
   end subroutine test_refused_data

   subroutine refused(what, choice, a_reed, fluid, part, code)
      character(len=*), intent(in) :: what
      integer, intent(in) :: choice
      type(reed_type), intent(in) :: a_reed
      type(fluid_type), intent(in) :: fluid
      character(len=*), intent(in) :: part
      integer, intent(in), optional :: code   !! rv_bad_input unless given
      type(hydrodynamic_load) :: load
      type(error_type), allocatable :: error
      integer :: expected

      expected = rv_bad_input
      if (present(code)) expected = code
      call new_hydrodynamic_load(load, choice, a_reed, fluid, error)
      call suite%fails(what, error, part)
      if (allocated(error)) call suite%equal(what//": code", error%code, expected)
      call suite%true(what//": a default load is left", &
         & abs(load%added_mass) + abs(load%added_damping) + abs(load%angular_frequency) + abs(load%reynolds) <= 0.0_wp)
   end subroutine refused

   function loaded(choice, fluid) result(load)
      integer, intent(in) :: choice
      type(fluid_type), intent(in) :: fluid
      type(hydrodynamic_load) :: load
      type(error_type), allocatable :: error

      call new_hydrodynamic_load(load, choice, reed, fluid, error)
      if (allocated(error)) call suite%no_error("a valid load", error)
   end function loaded

   function paper_reed() result(built)
      type(reed_type) :: built
      type(error_type), allocatable :: error

      call new_reed(built, 2.5e-3_wp, 4.0e-3_wp, 1.0e-3_wp, 6.0e-3_wp, 0.15e-3_wp, 8950.0_wp, 110.0e9_wp, 0.91_wp, &
         & error)
      call suite%no_error("the paper's reed", error)
   end function paper_reed

end program test_hydrodynamic_load
