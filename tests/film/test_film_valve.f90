!> The valve in liquid: wet frequency, added mass and damping; limits, exact laws, refusals.
program test_film_valve
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type
   use rv_film_reed, only : film_reed, fluid_matrices, new_film_reed
   use rv_film_valve, only : film_valve, new_film_valve
   use rv_hydrodynamic_function, only : maali_function, sader_function
   use rv_hydrodynamic_load, only : fluid_type, load_maali, load_none, load_published, load_sader
   use rv_planform, only : point_set, reed_points
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_film, only : areal_mass, nu, oil, paper_case, paper_form, paper_reed, rigidity
   use paper_valve, only : kpa, mm
   implicit none
   type(suite_type) :: suite
   type(film_reed) :: reed
   real(wp), parameter :: gap = 0.05_wp*mm

   reed = paper_reed(4)
   call table_two()
   call sader()
   call strips()
   call wet_frequency()
   call limits()
   call ranges()
   call planform_data()
   call refusals()
   call suite%finish()

contains

   subroutine table_two()
      type(film_valve) :: valve

      valve = paper_case(reed, gap, 20.0_wp*kpa)
      call suite%close("hole-load stiffness [N/m]", valve%hole_stiffness, 3118.5_wp, 2.0e-3_wp, 0.0_wp)
      call suite%close("first mode, dry mass [kg]", valve%modal_mass, 1.1020e-5_wp, 2.0e-3_wp, 0.0_wp)
      call suite%close("first mode, stiffness [N/m]", valve%stiffness(1), 1437.7_wp, 2.0e-3_wp, 0.0_wp)
      call suite%close("wet frequency [Hz]", valve%omega/(2.0_wp*pi), 905.9_wp, 5.0e-3_wp, 0.0_wp)
      call suite%close("added mass [kg]", valve%added_mass, 3.336e-5_wp, 5.0e-3_wp, 0.0_wp)
      call suite%close("added damping [N s/m]", valve%added_damping, 0.02485_wp, 5.0e-3_wp, 0.0_wp)
      call suite%close("Re = rho omega B^2/(4 mu)", valve%reynolds, &
         & oil%density*valve%omega*(6.0_wp*mm)**2/(4.0_wp*oil%viscosity), 1.0e-12_wp, 0.0_wp)
      call suite%true("it is in Eq. (23)'s range", valve%in_range)
   end subroutine table_two

   !> Sader's exact function instead of the fit: lighter by 5 %, less damped by a fifth.
   subroutine sader()
      type(film_valve) :: fit, exact

      fit = paper_case(reed, gap, 20.0_wp*kpa)
      exact = paper_case(reed, gap, 20.0_wp*kpa, load_sader)
      call suite%close("Sader over Eq. (23): wet frequency "//to_text(exact%omega/(2.0_wp*pi), 5)//" Hz", &
         & exact%omega/fit%omega, 1.021_wp, 0.0_wp, 1.0e-3_wp)
      call suite%close("added mass "//to_text(exact%added_mass, 5)//" kg", exact%added_mass/fit%added_mass, 0.946_wp, &
         & 0.0_wp, 1.0e-3_wp)
      call suite%close("added damping "//to_text(exact%added_damping, 5)//" N s/m", exact%added_damping/fit%added_damping, &
         & 0.803_wp, 0.0_wp, 1.0e-3_wp)
   end subroutine sader

   !> The matrices by other quadrature points, straight from the definition; the static shape is last.
   subroutine strips()
      integer, parameter :: choice(2) = [load_maali, load_sader]
      type(film_valve) :: valve
      type(point_set) :: p
      real(wp), allocatable :: phi(:, :)
      real(wp), dimension(5, 5) :: mass, damping, own_mass, own_damping
      complex(wp) :: gamma
      real(wp) :: re
      integer :: i, k, j

      p = reed_points(paper_form(), 19)
      allocate(phi(size(p%x), 5))
      phi(:, :4) = reed%plate%mode_values(p%x, p%y)
      phi(:, 5:) = reed%plate%static_values(p%x, p%y)
      do i = 1, 2
         valve = paper_case(reed, gap, 20.0_wp*kpa, choice(i))
         own_mass = 0.0_wp
         own_damping = 0.0_wp
         do k = 1, size(p%x)
            re = oil%density*valve%omega*p%chord(k)**2/(4.0_wp*oil%viscosity)
            gamma = maali_function(re)
            if (choice(i) == load_sader) gamma = sader_function(re)
            gamma = 0.5_wp*pi*oil%density*p%chord(k)*p%weight(k)*gamma
            do j = 1, 5
               own_mass(:, j) = own_mass(:, j) + real(gamma)*phi(k, :)*phi(k, j)
               own_damping(:, j) = own_damping(:, j) + valve%omega*aimag(gamma)*phi(k, :)*phi(k, j)
            end do
         end do
         call fluid_matrices(reed, choice(i), oil, valve%omega, mass, damping)
         call suite%close("choice "//to_text(i)//": added masses", maxval(abs(mass - own_mass))/maxval(own_mass), 0.0_wp, &
            & 0.0_wp, 1.0e-6_wp)
         call suite%close("added dampings", maxval(abs(damping - own_damping))/maxval(own_damping), 0.0_wp, 0.0_wp, 1.0e-6_wp)
         do j = 1, 4
            mass(j, j) = mass(j, j) + areal_mass*reed%plate%mass(j)
         end do
         call suite%close("mass matrix of the valve", maxval(abs(valve%mass/mass(:4, :4) - 1.0_wp)), 0.0_wp, 0.0_wp, 1.0e-12_wp)
         call suite%close("its damping matrix", maxval(abs(valve%damping/damping(:4, :4) - 1.0_wp)), 0.0_wp, 0.0_wp, 1.0e-12_wp)
         call suite%close("static shape: added mass", valve%static_added_mass, mass(5, 5), 1.0e-12_wp, 0.0_wp)
         call suite%close("added damping", valve%static_damping, damping(5, 5), 1.0e-12_wp, 0.0_wp)
      end do
   end subroutine strips

   !> omega^2 (m + m_a(omega)) = k, found for any liquid and plate, for either function.
   subroutine wet_frequency()
      integer, parameter :: choice(2) = [load_maali, load_sader]
      type(film_valve) :: valve
      type(error_type), allocatable :: error
      type(fluid_type) :: fluid
      real(wp) :: worst, thickness
      integer :: i, k, failures

      do i = 1, 2
         worst = 0.0_wp
         failures = 0
         do k = 1, 300
            fluid%viscosity = 1.0e-5_wp*10.0_wp**(0.02_wp*real(mod(37*k, 300), wp))
            fluid%density = 1.0_wp*10.0_wp**(0.015_wp*real(mod(101*k, 300), wp))
            thickness = 0.01_wp*mm*10.0_wp**(0.007_wp*real(k, wp))
            call new_film_valve(valve, reed, thickness, 8950.0_wp, 110.0e9_wp, nu, choice(i), fluid, gap, error)
            if (allocated(error)) failures = failures + 1
            if (allocated(error)) cycle
            worst = max(worst, abs(valve%omega**2*(valve%modal_mass + valve%added_mass)/valve%stiffness(1) - 1.0_wp))
         end do
         call suite%equal("function "//to_text(i)//": liquids and plates without a wet frequency", failures, 0)
         call suite%close("the equation it solves, worst of them", worst, 0.0_wp, 0.0_wp, 1.0e-13_wp)
      end do
   end subroutine wet_frequency

   subroutine limits()
      type(film_valve) :: dry, thin
      type(error_type), allocatable :: error

      dry = paper_case(reed, gap, 20.0_wp*kpa, load_none)
      call suite%close("without load, the dry frequency [Hz]", dry%omega/(2.0_wp*pi), 1817.9_wp, 1.0e-3_wp, 0.0_wp)
      call suite%close("and no added mass or damping", dry%added_mass + maxval(abs(dry%damping)), 0.0_wp, 0.0_wp, 0.0_wp)
      call suite%true("and nothing out of range", dry%in_range)
      call new_film_valve(thin, reed, 0.15_wp*mm, 8950.0_wp, 110.0e9_wp, nu, load_sader, &
         & fluid_type(density=1.0e-6_wp, viscosity=1.0e-9_wp), gap, error)
      call suite%close("in next to nothing", thin%omega/dry%omega, 1.0_wp, 0.0_wp, 1.0e-6_wp)
   end subroutine limits

   !> Told from Re = 0.1 to 1000 for Eq. (23), from 1e-6 to 1e4 for Sader's function.
   subroutine ranges()
      integer, parameter :: choice(2) = [load_maali, load_sader]
      real(wp), parameter :: lowest(2) = [0.1_wp, 1.0e-6_wp], highest(2) = [1.0e3_wp, 1.0e4_wp]
      type(film_valve) :: valve
      type(error_type), allocatable :: error
      real(wp) :: reynolds(-6:6)
      logical :: right
      integer :: i, k

      do i = 1, 2
         right = .true.
         do k = -6, 6
            call new_film_valve(valve, reed, 0.15_wp*mm, 8950.0_wp, 110.0e9_wp, nu, choice(i), &
               & fluid_type(density=875.0_wp, viscosity=10.0_wp**k), gap, error)
            if (allocated(error)) error stop "the liquid is refused"
            reynolds(k) = valve%reynolds
            right = right .and. (valve%in_range .eqv. (valve%reynolds >= lowest(i) .and. valve%reynolds <= highest(i)))
         end do
         call suite%true("function "//to_text(i)//": in its range where it says so, Re "//to_text(reynolds(6), 2)//" to " &
            & //to_text(reynolds(-6), 2), right .and. reynolds(6) < lowest(i) .and. reynolds(-6) > highest(i))
      end do
   end subroutine ranges

   !> The planform and its data are those of the plate: D_p and rho h scale stiffness and mass.
   subroutine planform_data()
      type(film_valve) :: valve

      valve = paper_case(reed, gap, 20.0_wp*kpa)
      call suite%close("stiffnesses", maxval(abs(valve%stiffness/(rigidity*reed%plate%stiffness) - 1.0_wp)), 0.0_wp, 0.0_wp, &
         & 1.0e-14_wp)
      call suite%close("static stiffness [N/m]", valve%static_stiffness, valve%hole_stiffness*reed%static_hole/reed%hole_area, &
         & 1.0e-9_wp, 0.0_wp)
      call suite%close("static mass [kg]", valve%static_mass, areal_mass*reed%plate%static_mass, 1.0e-14_wp, 0.0_wp)
      call suite%close("hole area [mm2]", reed%hole_area/mm**2, 4.0_wp*pi, 1.0e-14_wp, 0.0_wp)
      call suite%close("int_hole phi_1 [mm2]", reed%hole(1)/mm**2, 5.9277_wp, 2.0e-3_wp, 0.0_wp)
      call suite%close("land [mm2]", sum(reed%land_weight)/mm**2, 27.0_wp + 4.5_wp*pi - 4.0_wp*pi, 1.0e-12_wp, 0.0_wp)
      call suite%close("part A [mm2]", sum(reed%root_weight)/mm**2, 15.0_wp, 1.0e-12_wp, 0.0_wp)
   end subroutine planform_data

   subroutine refusals()
      type(film_reed) :: other
      type(film_valve) :: valve
      type(error_type), allocatable :: error
      real(wp) :: value(6), nan
      integer :: i, k

      nan = ieee_value(1.0_wp, ieee_quiet_nan)
      do k = 1, 6
         do i = 1, 2
            value = [0.15_wp*mm, 8950.0_wp, 110.0e9_wp, gap, 875.0_wp, 0.0484_wp]
            value(k) = merge(merge(-gap, 0.0_wp, k == 4), nan, i == 1)
            call new_film_valve(valve, reed, value(1), value(2), value(3), nu, load_maali, fluid_type(value(5), value(6)), &
               & value(4), error)
            call suite%fails("datum "//to_text(k)//" = "//to_text(value(k)), error, "viscosity > 0, gap >= 0")
         end do
      end do
      call suite%equal("and the valve is a default one", valve%modes, 0)
      call new_film_valve(valve, reed, 0.15_wp*mm, 8950.0_wp, 110.0e9_wp, nu, load_published, oil, gap, error)
      call suite%fails("the paper's load", error, "hydro.load = 'maali', 'sader' or 'none'")
      call new_film_reed(other, 2.5_wp*mm, 4.0_wp*mm, 1.5_wp*mm, 6.0_wp*mm, nu, 4, 0.0_wp, error)
      call suite%fails("b = 1.5 mm", error, "concentric")
      call suite%equal("and the reed is a default one", other%plate%modes, 0)
      call new_film_reed(other, 2.5_wp*mm, 4.0_wp*mm, 1.0_wp*mm, 6.0_wp*mm, 0.5_wp, 4, 0.0_wp, error)
      call suite%fails("nu = 0.5", error, "Poisson")
   end subroutine refusals

end program test_film_valve
