!> The film under the reed: coefficients of the first mode, their convergence with mesh and terms, exact laws,
!> conservation of volume, symmetry, derivatives, the closed film.
program test_reed_film
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_error, only : error_type, rv_domain
   use rv_film_mesh, only : film_mesh, new_film_mesh
   use rv_film_reed, only : film_reed, new_film_reed
   use rv_plate, only : plate_type, new_plate
   use rv_reynolds, only : film_state, film_type, new_film
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_film, only : nu, oil, paper_form, paper_reed, scatter
   use paper_valve, only : kpa, mm
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: gap = 0.05_wp*mm, lift = 0.0951_wp*mm

   call coefficients()
   call mesh_order()
   call exact_laws()
   call symmetry()
   call conservation()
   call derivatives()
   call closed_film()
   call suite%finish()

contains

   function state_of(film, q) result(state)
      type(film_type), intent(in) :: film
      real(wp), intent(in) :: q(:)
      type(film_state) :: state
      type(error_type), allocatable :: error

      call film%solve(gap, oil%viscosity, q, state, error)
      if (allocated(error)) error stop "the film is refused"
   end function state_of

   !> A_land [mm2] and C_s [N s m-1] of the first mode at u = 0 and at the paper's steady displacement.
   function pairs(film) result(value)
      type(film_type), intent(in) :: film
      real(wp) :: value(4)
      type(film_state) :: shut, open

      shut = state_of(film, [0.0_wp])
      open = state_of(film, [lift])
      value = [shut%land(1)/mm**2, open%land(1)/mm**2, shut%damping(1, 1), open%damping(1, 1)]
   end function pairs

   subroutine coefficients()
      type(film_reed) :: reed
      real(wp) :: value(4)

      reed = paper_reed(1)
      value = pairs(reed%film)
      call suite%close("A_land at u = 0 [mm2]", value(1), 3.7181_wp, 2.0e-3_wp, 0.0_wp)
      call suite%close("A_land at u = 0.0951 mm [mm2]", value(2), 3.6675_wp, 2.0e-3_wp, 0.0_wp)
      call suite%close("C_s at u = 0 [N s/m]", value(3), 2.2674_wp, 5.0e-3_wp, 0.0_wp)
      call suite%close("C_s at u = 0.0951 mm [N s/m]", value(4), 0.32534_wp, 5.0e-3_wp, 0.0_wp)
      value = pairs(rich_film())
      call suite%close("18 x 8 terms, four times the mesh: A_land at u = 0 [mm2]", value(1), 3.7181_wp, 2.0e-5_wp, 0.0_wp)
      call suite%close("A_land at u = 0.0951 mm [mm2]", value(2), 3.6675_wp, 2.0e-5_wp, 0.0_wp)
      call suite%close("C_s at u = 0 [N s/m]", value(3), 2.2674_wp, 4.0e-5_wp, 0.0_wp)
      call suite%close("C_s at u = 0.0951 mm [N s/m]", value(4), 0.32534_wp, 4.0e-5_wp, 0.0_wp)
      reed = paper_reed(1, 0.65_wp)
      value = pairs(reed%film)
      call suite%close("elongation 0.65: C_s at u = 0 [N s/m]", value(3), 2.6717_wp, 1.0e-2_wp, 0.0_wp)
      call suite%close("C_s at u = 0.0951 mm [N s/m]", value(4), 0.41142_wp, 1.0e-2_wp, 0.0_wp)
   end subroutine coefficients

   !> The first mode in many terms on a fine mesh.
   function rich_film() result(film)
      type(film_type) :: film
      type(film_mesh) :: mesh
      type(plate_type) :: plate
      type(error_type), allocatable :: error

      call new_plate(plate, paper_form(), nu, 1, error, 18, 8)
      if (allocated(error)) error stop "the plate is refused"
      call new_film_mesh(mesh, paper_form(), [24, 16, 8], 12)
      call new_film(film, mesh, plate%mode_values(mesh%px, mesh%py), plate%mode_values(mesh%x, mesh%y), &
         & plate%mode_values([mesh%edge_x], [mesh%edge_y]), 0.0_wp)
   end function rich_film

   !> Order 4, with and without elongation; the default mesh is within 0.1 %.
   subroutine mesh_order()
      real(wp), parameter :: beta(2) = [0.0_wp, 0.65_wp]
      type(film_reed) :: reed
      real(wp) :: value(4, 3), order(4)
      integer :: i, n

      do i = 1, 2
         do n = 1, 3
            reed = paper_reed(1, beta(i), 2**(n - 1))
            value(:, n) = pairs(reed%film)
         end do
         order = log(abs((value(:, 1) - value(:, 2))/(value(:, 2) - value(:, 3))))/log(2.0_wp)
         call suite%close("elongation "//to_text(beta(i))//": order of A_land at u = 0", order(1), 4.0_wp, 0.0_wp, 0.4_wp)
         call suite%close("order of C_s at u = 0", order(3), 4.0_wp, 0.0_wp, 0.4_wp)
         call suite%close("order of C_s at u = 0.0951 mm", order(4), 4.0_wp, 0.0_wp, 0.4_wp)
         call suite%close("default mesh over the finest, worst coefficient less 1", &
            & maxval(abs(value(:, 1)/value(:, 3) - 1.0_wp)), 0.0_wp, 0.0_wp, 1.0e-3_wp)
      end do
   end subroutine mesh_order

   !> C_s ~ mu always and ~ g_0^-3 at q = 0 without elongation; A_land then depends on the planform alone. C ~ L^4.
   subroutine exact_laws()
      type(film_reed) :: reed, larger
      type(film_state) :: a, b
      type(error_type), allocatable :: error

      reed = paper_reed(2)
      a = state_of(reed%film, [0.0_wp, 0.0_wp])
      call reed%film%solve(3.7_wp*gap, oil%viscosity, [0.0_wp, 0.0_wp], b, error)
      call suite%close("C_s at 3.7 times the gap", b%damping(1, 1)*3.7_wp**3/a%damping(1, 1), 1.0_wp, 0.0_wp, 1.0e-10_wp)
      call suite%close("A_land", b%land(1)/a%land(1), 1.0_wp, 0.0_wp, 1.0e-10_wp)
      a = state_of(reed%film, [lift, -0.1_wp*gap])
      call reed%film%solve(gap, 0.01_wp*oil%viscosity, [lift, -0.1_wp*gap], b, error)
      call suite%close("C at a hundredth of the viscosity, lifted", maxval(abs(b%damping*100.0_wp/a%damping - 1.0_wp)), &
         & 0.0_wp, 0.0_wp, 1.0e-10_wp)
      call suite%close("A_land", maxval(abs(b%land/a%land - 1.0_wp)), 0.0_wp, 0.0_wp, 1.0e-10_wp)
      call new_film_reed(larger, 5.0_wp*mm, 8.0_wp*mm, 2.0_wp*mm, 12.0_wp*mm, nu, 2, 0.0_wp, error)
      b = state_of(larger%film, [lift, -0.1_wp*gap])
      call suite%close("C under a reed twice as large", maxval(abs(b%damping/(16.0_wp*a%damping) - 1.0_wp)), 0.0_wp, &
         & 0.0_wp, 1.0e-9_wp)
      call suite%close("A_land", maxval(abs(b%land/(4.0_wp*a%land) - 1.0_wp)), 0.0_wp, 0.0_wp, 1.0e-9_wp)
   end subroutine exact_laws

   !> The damping matrix is symmetric and dissipates; what a mode presses out through the hole is its A_land.
   subroutine symmetry()
      real(wp), parameter :: beta(2) = [0.0_wp, 0.65_wp]
      type(film_reed) :: reed
      type(film_state) :: state
      real(wp) :: in, out, rate(4), lopsided, least, reciprocal
      integer :: i, k

      do i = 1, 2
         reed = paper_reed(4, beta(i))
         lopsided = 0.0_wp
         least = huge(least)
         reciprocal = 0.0_wp
         do k = 1, 20
            state = state_of(reed%film, some_state(k))
            associate (c => state%damping)
               lopsided = max(lopsided, maxval(abs(c - transpose(c)))/maxval(abs(c)))
               rate = scatter(4, k + 100)
               least = min(least, dot_product(rate, matmul(c, rate)))
            end associate
            call reed%film%inflow(state, rate, 0.0_wp, in, out)
            reciprocal = max(reciprocal, abs(in/dot_product(state%land, rate) - 1.0_wp))
         end do
         call suite%close("elongation "//to_text(beta(i))//": C less its transpose", lopsided, 0.0_wp, 0.0_wp, 1.0e-12_wp)
         call suite%true("C takes power out of any motion", least > 0.0_wp)
         call suite%close("flow through the hole's edge per A_land q', less 1", reciprocal, 0.0_wp, 0.0_wp, 1.0e-9_wp)
      end do
   end subroutine symmetry

   !> Displacements of four modes that leave the film open: lifted by -0.9 to 4.5 gaps, higher modes by a tenth of the film.
   function some_state(k) result(q)
      integer, intent(in) :: k
      real(wp) :: q(4)

      q = scatter(4, k)
      q(1) = gap*(10.0_wp**(0.87_wp*q(1) - 0.13_wp) - 1.0_wp)
      q(2:) = 0.1_wp*(gap + q(1))*q(2:)
   end function some_state

   !> Inflow less outflow is the volume swept, to 1e-10 of the largest of the three.
   subroutine conservation()
      real(wp), parameter :: beta(3) = [0.0_wp, 0.65_wp, 1.0e-3_wp]
      type(film_reed) :: reed
      type(film_state) :: state
      real(wp) :: in, out, rate(4), drop(1), swept, worst
      integer :: i, k

      do i = 1, 3
         reed = paper_reed(4, beta(i))
         worst = 0.0_wp
         do k = 1, 200
            state = state_of(reed%film, some_state(k))
            rate = scatter(4, k + 300)*0.1_wp
            drop = scatter(1, k + 600)*50.0_wp*kpa
            call reed%film%inflow(state, rate, drop(1), in, out)
            swept = 2.0_wp*sum(matmul(reed%film%sweep, rate))
            worst = max(worst, abs(in - out - swept)/max(abs(in), abs(out), abs(swept)))
         end do
         call suite%close("elongation "//to_text(beta(i))//": volume balance of 200 states", worst, 0.0_wp, 0.0_wp, 1.0e-10_wp)
      end do
   end subroutine conservation

   !> force_slope against central differences of the forces, and pressure_of against land and damping.
   subroutine derivatives()
      real(wp), parameter :: beta(2) = [0.0_wp, 0.65_wp]
      type(film_reed) :: reed
      type(film_state) :: state
      real(wp) :: q(4), rate(4), drop(1), slope(4, 4), step, difference(4), worst, force(4), other(4)
      integer :: i, j, k

      do i = 1, 2
         reed = paper_reed(4, beta(i))
         worst = 0.0_wp
         other = 0.0_wp
         do k = 1, 20
            q = some_state(k)
            rate = scatter(4, k + 300)*0.1_wp
            drop = scatter(1, k + 600)*50.0_wp*kpa
            state = state_of(reed%film, q)
            slope = reed%film%force_slope(state, rate, drop(1))
            step = 1.0e-5_wp*(gap + q(1))
            do j = 1, 4
               difference = (force_at(reed%film, moved(q, j, step), rate, drop(1)) &
                  & - force_at(reed%film, moved(q, j, -step), rate, drop(1)))/(2.0_wp*step)
               worst = max(worst, maxval(abs(slope(:, j) - difference))/maxval(abs(slope)))
            end do
            force = force_at(reed%film, q, rate, drop(1))
            other = 2.0_wp*matmul(reed%film%pressure_of(state, rate, drop(1)), reed%film%sweep)
            if (.not. maxval(abs(force - other)) <= 1.0e-12_wp*maxval(abs(force))) worst = huge(worst)
         end do
         call suite%close("elongation "//to_text(beta(i))//": force_slope less differences", worst, 0.0_wp, 0.0_wp, 1.0e-7_wp)
      end do
   end subroutine derivatives

   pure function moved(q, j, step) result(to)
      real(wp), intent(in) :: q(:), step
      integer, intent(in) :: j
      real(wp) :: to(size(q))

      to = q
      to(j) = to(j) + step
   end function moved

   function force_at(film, q, rate, drop) result(force)
      type(film_type), intent(in) :: film
      real(wp), intent(in) :: q(:), rate(:), drop
      real(wp) :: force(size(q))
      type(film_state) :: state

      state = state_of(film, q)
      force = drop*state%land - matmul(state%damping, rate)
   end function force_at

   !> The first place to close is named; what was asked for is NaN, not a number that looks right.
   subroutine closed_film()
      type(film_reed) :: reed
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: q(4)
      integer :: k

      reed = paper_reed(4)
      q = [-1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]*gap
      call reed%film%solve(gap, oil%viscosity, 1.001_wp*q, state, error)
      call suite%fails("tip in the seat", error, "closed at x = 7.5 mm, y = 0 mm")
      if (allocated(error)) call suite%equal("code", error%code, rv_domain)
      call suite%true("land and damping are NaN", all(ieee_is_nan(state%land)) .and. all(ieee_is_nan(state%damping)))
      call reed%film%solve(gap, oil%viscosity, 0.999_wp*q, state, error)
      call suite%no_error("tip a thousandth of the gap above it", error)
      call suite%true("numbers are finite", all(abs(state%damping) < huge(1.0_wp)) .and. all(abs(state%land) < huge(1.0_wp)))
      q = [0.0_wp, -1.01_wp*gap/minval(reed%film%phi_node(:, 2)), 0.0_wp, 0.0_wp]
      k = minloc(reed%film%phi_node(:, 2), 1)
      call reed%film%solve(gap, oil%viscosity, q, state, error)
      call suite%fails("the second mode's belly in the seat", error, "x = "//to_text(reed%film%mesh%x(k)/mm, 4)//" mm, y = " &
         & //to_text(reed%film%mesh%y(k)/mm, 4)//" mm")
      call reed%film%solve(gap, oil%viscosity, ieee_value(q, ieee_quiet_nan), state, error)
      call suite%fails("displacements that are NaN", error, "closed")
      call reed%film%solve(-gap, oil%viscosity, 0.0_wp*q, state, error)
      call suite%fails("negative gap", error, "closed")
   end subroutine closed_film

end program test_reed_film
