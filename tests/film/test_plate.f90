!> The plate: converged values, beam limits, convergence from above, orthogonality, completeness, scaling, refusals.
program test_plate
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type
   use rv_planform, only : planform_type, new_planform, point_set, reed_points, hole_points
   use rv_plate, only : plate_type, new_plate
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_film, only : areal_mass, nu, paper_form, rigidity
   use paper_valve, only : mm
   implicit none
   type(suite_type) :: suite

   call table_two()
   call from_above()
   call beam_limit()
   call orthogonality()
   call completeness()
   call scaling()
   call refusals()
   call suite%finish()

contains

   function plate_with(form, poisson, modes, along, across) result(plate)
      type(planform_type), intent(in) :: form
      real(wp), intent(in) :: poisson
      integer, intent(in) :: modes
      integer, intent(in), optional :: along, across
      type(plate_type) :: plate
      type(error_type), allocatable :: error

      call new_plate(plate, form, poisson, modes, error, along, across)
      if (allocated(error)) error stop "the plate is refused"
   end function plate_with

   !> Values of four independent plate solutions, and the limit of this one with terms.
   subroutine table_two()
      type(plate_type) :: plate, rich
      type(point_set) :: hole
      real(wp) :: hertz(2)

      plate = plate_with(paper_form(), nu, 2)
      hertz = sqrt(rigidity*plate%stiffness/(areal_mass*plate%mass))/(2.0_wp*pi)
      call suite%close("hole-load stiffness [N/m]", rigidity*plate%hole_stiffness, 3118.5_wp, 2.0e-3_wp, 0.0_wp)
      call suite%close("first frequency [Hz]", hertz(1), 1817.9_wp, 1.0e-3_wp, 0.0_wp)
      call suite%close("second frequency [Hz]", hertz(2), 10477.0_wp, 3.0e-3_wp, 0.0_wp)
      call suite%close("first mode, modal mass [kg]", areal_mass*plate%mass(1), 1.1020e-5_wp, 2.0e-3_wp, 0.0_wp)
      call suite%close("first mode, modal stiffness [N/m]", rigidity*plate%stiffness(1), 1437.7_wp, 2.0e-3_wp, 0.0_wp)
      hole = hole_points(paper_form(), 12)
      call suite%close("first mode, integral over the hole [mm2]", &
         & 2.0_wp*sum(hole%weight*first(plate%mode_values(hole%x, hole%y)))/mm**2, 5.9277_wp, 2.0e-3_wp, 0.0_wp)
      rich = plate_with(paper_form(), nu, 2, 16, 8)
      call suite%close("stiffness with 16 x 8 terms [N/m]", rigidity*rich%hole_stiffness, 3118.5_wp, 5.0e-5_wp, 0.0_wp)
      call suite%close("8 x 4 terms over them", plate%hole_stiffness/rich%hole_stiffness, 1.0_wp, 0.0_wp, 5.0e-4_wp)
      plate = plate_with(paper_form(), 0.0_wp, 1)
      call suite%close("hole-load stiffness at nu = 0 [N/m]", rigidity*(1.0_wp - nu**2)*plate%hole_stiffness, 2967.4_wp, &
         & 2.0e-3_wp, 0.0_wp)
   end subroutine table_two

   pure function first(phi) result(column)
      real(wp), intent(in) :: phi(:, :)
      real(wp) :: column(size(phi, 1))

      column = phi(:, 1)
   end function first

   !> Each space of terms holds the one before: stiffness and frequencies fall, by less and less.
   subroutine from_above()
      integer, parameter :: along(5) = [4, 6, 8, 12, 16], across(5) = [2, 3, 4, 6, 8]
      type(plate_type) :: plate
      real(wp) :: value(3, 5), step(3, 4)
      integer :: n

      do n = 1, 5
         plate = plate_with(paper_form(), nu, 2, along(n), across(n))
         value(:, n) = [plate%hole_stiffness, plate%stiffness/plate%mass]
      end do
      step = (value(:, :4) - value(:, 2:))/value(:, 2:)
      do n = 1, 4
         call suite%true(to_text(along(n))//" x "//to_text(across(n))//" terms lie above the next by " &
            & //to_text(step(1, n), 2)//", "//to_text(step(2, n), 2)//", "//to_text(step(3, n), 2), all(step(:, n) > 0.0_wp))
      end do
      call suite%true("and ever closer", all(step(:, 2:) < step(:, :3)))
   end subroutine from_above

   !> A long narrow reed is a beam. nu = 0: no plate effect but that of the load's spread, of order (B/L)^2 and
   !> better. Static: the load at x = c bends the beam up to there. First mode: the round tip lacks the mass
   !> (1 - pi/4) B^2/2 of a square one, next to a quarter of the beam's as the modal mass.
   subroutine beam_limit()
      real(wp), parameter :: root = 1.8751040687119611_wp   ! of cos x cosh x = -1
      type(planform_type) :: form
      type(plate_type) :: plate
      type(error_type), allocatable :: error
      real(wp) :: width, stiffness(2), frequency(2), round
      integer :: n

      do n = 1, 2
         width = 0.04_wp/real(n, wp)
         call new_planform(form, 1.0_wp, 0.5_wp*width, 0.25_wp*width, width, error)
         plate = plate_with(form, 0.0_wp, 1)
         associate (c => form%centre, l => form%length)
            stiffness(n) = plate%hole_stiffness*(c**3/3.0_wp + 0.5_wp*c**2*(l - c))/width - 1.0_wp
            round = (1.0_wp - 0.25_wp*pi)*0.5_wp*width/(0.25_wp*l)
            frequency(n) = sqrt(plate%stiffness(1)/plate%mass(1)*(1.0_wp - round))*(l/root)**2 - 1.0_wp
         end associate
      end do
      call suite%close("static stiffness over a beam's, less 1, at B/L = 0.02", stiffness(2), 0.0_wp, 0.0_wp, 1.0e-6_wp)
      call suite%close("first frequency over a beam's, less 1, at B/L = 0.02", frequency(2), 0.0_wp, 0.0_wp, 1.0e-4_wp)
      call suite%close("static, halved B/L: the deviation falls", stiffness(2)/stiffness(1), 0.0_wp, 0.0_wp, 0.3_wp)
      call suite%close("first frequency, halved B/L: the deviation falls", frequency(2)/frequency(1), 0.0_wp, 0.0_wp, 0.3_wp)
   end subroutine beam_limit

   !> int phi_i phi_j over the reed with other quadrature points: the modal masses, and zero between modes.
   subroutine orthogonality()
      type(plate_type) :: plate
      type(point_set) :: p
      real(wp), allocatable :: phi(:, :)
      real(wp) :: product(8, 8), worst, tip(1, 8)
      integer :: i, j

      plate = plate_with(paper_form(), nu, 8)
      p = reed_points(paper_form(), 31)
      phi = plate%mode_values(p%x, p%y)
      worst = 0.0_wp
      do j = 1, 8
         do i = 1, 8
            product(i, j) = 2.0_wp*sum(p%weight*phi(:, i)*phi(:, j))/sqrt(plate%mass(i)*plate%mass(j))
            worst = max(worst, abs(product(i, j) - merge(1.0_wp, 0.0_wp, i == j)))
         end do
      end do
      call suite%close("modes orthogonal, with their masses", worst, 0.0_wp, 0.0_wp, 1.0e-10_wp)
      call suite%true("frequencies rise", all(plate%stiffness(2:)/plate%mass(2:) > plate%stiffness(:7)/plate%mass(:7)))
      tip = plate%mode_values([7.5_wp*mm], [0.0_wp])
      call suite%close("modes are 1 at the tip", maxval(abs(tip - 1.0_wp)), 0.0_wp, 0.0_wp, 1.0e-10_wp)
      phi = plate%mode_values([0.0_wp, 1.0e-6_wp*mm], [2.0_wp*mm, 2.0_wp*mm])
      call suite%close("modes are clamped: zero", maxval(abs(phi(1, :))), 0.0_wp, 0.0_wp, 0.0_wp)
      call suite%true("and without slope", maxval(abs(phi(2, :))) < 1.0e-9_wp)
   end subroutine orthogonality

   !> All modes together are the static solution: the same space of terms, so to rounding.
   subroutine completeness()
      type(plate_type) :: plate
      type(point_set) :: hole
      real(wp), allocatable :: shape(:, :)
      real(wp) :: tip(2), load(32), together(2), x(2), y(2)
      integer :: i

      plate = plate_with(paper_form(), nu, 32)
      hole = hole_points(paper_form(), 16)
      load = 2.0_wp*matmul(hole%weight, plate%mode_values(hole%x, hole%y))
      call suite%close("tip displacement, sum over all modes", sum(load/plate%stiffness)*plate%hole_stiffness, &
         & pi*(2.0_wp*mm)**2, 1.0e-9_wp, 0.0_wp)
      x = [2.0_wp, 6.0_wp]*mm
      y = [2.5_wp, 1.0_wp]*mm
      together = matmul(plate%mode_values(x, y), load/plate%stiffness)/sum(load/plate%stiffness)
      shape = plate%static_values(x, y)
      do i = 1, 2
         call suite%close("static shape, sum over all modes, place "//to_text(i), together(i), shape(i, 1), 1.0e-8_wp, 0.0_wp)
      end do
      tip = reshape(plate%static_values([7.5_wp*mm, 0.0_wp], [0.0_wp, 1.0_wp*mm]), [2])
      call suite%close("static shape at the tip", tip(1), 1.0_wp, 1.0e-12_wp, 0.0_wp)
      call suite%close("static shape at the clamp", tip(2), 0.0_wp, 0.0_wp, 0.0_wp)
      call suite%close("static stiffness: int_hole of the shape over that of the load's own displacement", &
         & plate%static_stiffness, 2.0_wp*sum(hole%weight*first(plate%static_values(hole%x, hole%y))) &
         & /(pi*(2.0_wp*mm)**2)*plate%hole_stiffness, 1.0e-10_wp, 0.0_wp)
   end subroutine completeness

   !> k/D_p ~ L^-2 and m/(rho h) ~ L^2.
   subroutine scaling()
      type(planform_type) :: form
      type(plate_type) :: plate, larger
      type(error_type), allocatable :: error

      plate = plate_with(paper_form(), nu, 4)
      call new_planform(form, 7.5_wp*mm, 12.0_wp*mm, 3.0_wp*mm, 18.0_wp*mm, error)
      larger = plate_with(form, nu, 4)
      call suite%close("stiffness of a reed three times as large", larger%hole_stiffness*9.0_wp, plate%hole_stiffness, &
         & 1.0e-10_wp, 0.0_wp)
      call suite%close("its modal stiffness, worst mode", maxval(abs(9.0_wp*larger%stiffness/plate%stiffness - 1.0_wp)), &
         & 0.0_wp, 0.0_wp, 1.0e-8_wp)
      call suite%close("its modal mass, worst mode", maxval(abs(larger%mass/(9.0_wp*plate%mass) - 1.0_wp)), &
         & 0.0_wp, 0.0_wp, 1.0e-8_wp)
   end subroutine scaling

   subroutine refusals()
      real(wp), parameter :: bad(4) = [0.5_wp, -1.0_wp, 0.7_wp, -2.0_wp]
      type(plate_type) :: plate
      type(error_type), allocatable :: error
      integer :: i

      do i = 1, size(bad)
         call new_plate(plate, paper_form(), bad(i), 1, error)
         call suite%fails("nu = "//to_text(bad(i)), error, "-1 < Poisson's ratio < 0.5, not "//to_text(bad(i)))
      end do
      call new_plate(plate, paper_form(), ieee_value(1.0_wp, ieee_quiet_nan), 1, error)
      call suite%fails("nu = NaN", error, "not NaN")
      call suite%equal("and the plate has no modes", plate%modes, 0)
      call new_plate(plate, paper_form(), nu, 0, error)
      call suite%fails("no modes", error, "1 to 32 modes, not 0")
      call new_plate(plate, paper_form(), nu, 33, error)
      call suite%fails("33 modes", error, "1 to 32 modes, not 33")
      call new_plate(plate, paper_form(), 0.499_wp, 1, error)
      call suite%no_error("nu = 0.499", error)
      call new_plate(plate, paper_form(), -0.99_wp, 1, error)
      call suite%no_error("nu = -0.99", error)
   end subroutine refusals

end program test_plate
