!> What the plate and the film say of one case: stiffness, frequencies, masses, and the k_a and k_s that a lumped
!> model would need to match them. The paper fitted both; here they follow from the planform.
module rv_modes
   use rv_kinds, only : wp, i8, pi
   use rv_error, only : error_type
   use rv_cases, only : deck_type
   use rv_film_reed, only : film_reed
   use rv_film_valve, only : film_valve
   use rv_keys, only : n_keys, key_fluid_viscosity_pa_s, key_pressure_inlet_kpa, key_pressure_outlet_kpa, &
      & key_reed_a_mm, key_reed_b_mm, key_reed_hole_diameter_mm, key_reed_width_mm, key_reed_thickness_mm, &
      & key_reed_density_kg_m3, key_reed_youngs_modulus_gpa
   use rv_lumped, only : squeeze_coefficient
   use rv_reed, only : reed_type, new_reed
   use rv_reynolds, only : film_state
   use rv_text, only : to_text
   use rv_text_builder, only : text_builder
   use rv_film_case, only : film_of_case
   implicit none
   private
   public :: modes_text

   interface
      subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
         import :: wp
         integer, intent(in) :: itype, n, lda, ldb, lwork
         character, intent(in) :: jobz, uplo
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         real(wp), intent(out) :: w(*), work(*)
         integer, intent(out) :: info
      end subroutine dsygv
   end interface

contains

   !> A readable account of the first case of a deck, whatever its model.
   subroutine modes_text(deck, text, error)
      type(deck_type), intent(in) :: deck
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: value(n_keys)
      type(text_builder) :: build
      type(film_reed) :: reed
      type(film_valve) :: valve

      text = ""
      call deck%case_values(1_i8, value)
      call film_of_case(value, reed, valve, error)
      if (allocated(error)) return
      call build%line("Plate of "//deck%name//", case 1 of "//to_text(deck%case_count()))
      call build%line("")
      call tell_modes(build, reed, valve)
      call tell_fluid(build, valve)
      call tell_equivalents(build, value, reed, valve, error)
      text = build%text()
   end subroutine modes_text

   subroutine tell_modes(build, reed, valve)
      type(text_builder), intent(inout) :: build
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(in) :: valve
      real(wp) :: wet(valve%modes), areal_mass
      integer :: j

      wet = wet_frequencies(valve)
      areal_mass = valve%modal_mass/reed%plate%mass(1)
      call build%line("mode   in vacuum [Hz]   in oil [Hz]   modal mass [kg]   modal stiffness [N/m]   hole [mm2]")
      do j = 1, valve%modes
         call build%line(right(to_text(j), 4) &
            & //right(to_text(sqrt(valve%stiffness(j)/(areal_mass*reed%plate%mass(j)))/(2.0_wp*pi), 6), 17) &
            & //right(to_text(wet(j), 6), 14)//right(to_text(areal_mass*reed%plate%mass(j), 5), 18) &
            & //right(to_text(valve%stiffness(j), 6), 24)//right(to_text(1.0e6_wp*reed%hole(j), 5), 13))
      end do
      call build%line("(each shape is 1 at the tip; hole: integral of the shape over the hole)")
      call build%line("")
   end subroutine tell_modes

   subroutine tell_fluid(build, valve)
      type(text_builder), intent(inout) :: build
      type(film_valve), intent(in) :: valve

      call build%line("pressed hole: force over tip displacement   "//to_text(valve%hole_stiffness, 6)//" N/m")
      call build%line("first mode in oil, far from the seat:       "//to_text(valve%omega/(2.0_wp*pi), 5)//" Hz, Re " &
         & //to_text(valve%reynolds, 4)//", added mass "//to_text(valve%added_mass, 4)//" kg, added damping " &
         & //to_text(valve%added_damping, 4)//" N s/m, damping ratio " &
         & //to_text(0.5_wp*valve%added_damping/(valve%omega*(valve%modal_mass + valve%added_mass)), 3))
      call build%line("")
   end subroutine tell_fluid

   !> The film's damping at some displacements, and what k_a and k_s would give a lumped model the same.
   subroutine tell_equivalents(build, value, reed, valve, error)
      type(text_builder), intent(inout) :: build
      real(wp), intent(in) :: value(n_keys)
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(in) :: valve
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: part(5) = [0.0_wp, 0.02_wp, 0.1_wp, 0.5_wp, 1.0_wp]
      type(reed_type) :: beam
      type(film_state) :: state
      real(wp) :: steady, drop, per_k_s, u
      integer :: i

      call new_reed(beam, value(key_reed_a_mm), value(key_reed_hole_diameter_mm), value(key_reed_b_mm), &
         & value(key_reed_width_mm), value(key_reed_thickness_mm), value(key_reed_density_kg_m3), &
         & value(key_reed_youngs_modulus_gpa), 1.0_wp, error)
      if (allocated(error)) return
      call build%line("k_a of Eq. (18), for the stiffness alone:   "//to_text(valve%hole_stiffness/beam%stiffness, 4))
      if (.not. valve%gap > 0.0_wp) then
         call build%line("The film is closed at film.gap_mm = 0: it has no damping, and no pressure on the land, to tell of.")
         return
      end if
      drop = value(key_pressure_inlet_kpa) - value(key_pressure_outlet_kpa)
      call static_displacement(reed, valve, drop, steady, error)
      if (allocated(error)) return
      call build%line("k_a with the pressure on the land, at "//to_text(1.0e-3_wp*drop, 4)//" kPa: " &
         & //to_text(drop*reed%hole_area/(beam%stiffness*steady), 4)//" (steady tip displacement " &
         & //to_text(1.0e3_wp*steady, 5)//" mm)")
      call build%line("")
      per_k_s = squeeze_coefficient(1.0_wp, value(key_fluid_viscosity_pa_s), beam%length, beam%width)
      call build%line("tip [mm]   land area [mm2]   film damping [N s/m]   k_s of Eq. (26)")
      do i = 1, size(part)
         u = part(i)*steady
         call reed%static_film%solve(valve%gap, valve%viscosity, [u], state, error)
         if (allocated(error)) return
         call build%line(right(to_text(1.0e3_wp*u, 4), 8)//right(to_text(1.0e6_wp*state%land(1), 5), 18) &
            & //right(to_text(state%damping(1, 1), 5), 23) &
            & //right(to_text(state%damping(1, 1)*(u + valve%gap)**3/per_k_s, 4), 18))
      end do
      call build%line("(static shape; one k_s cannot fit the film at every opening)")
   end subroutine tell_equivalents

   !> Tip displacement of the static shape under a pressure difference: k u = drop (hole + A_land(u)), by secants.
   subroutine static_displacement(reed, valve, drop, u, error)
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(in) :: valve
      real(wp), intent(in) :: drop   !! [Pa]
      real(wp), intent(out) :: u     !! [m]
      type(error_type), allocatable, intent(out) :: error
      type(film_state) :: state
      integer :: iteration
      real(wp) :: next

      u = max(0.0_wp, drop*reed%static_hole/valve%static_stiffness)
      do iteration = 1, 200   ! A_land hardly depends on u: the fixed point contracts fast
         call reed%static_film%solve(valve%gap, valve%viscosity, [u], state, error)
         if (allocated(error)) return
         next = drop*(reed%static_hole + state%land(1))/valve%static_stiffness
         if (abs(next - u) <= 1.0e-12_wp*abs(next)) exit
         u = next
      end do
   end subroutine static_displacement

   !> Undamped frequencies of K and M + M_a, the load taken at the first one [Hz].
   function wet_frequencies(valve) result(frequency)
      type(film_valve), intent(in) :: valve
      real(wp) :: frequency(valve%modes)
      real(wp) :: k(valve%modes, valve%modes), m(valve%modes, valve%modes), work(64*valve%modes)
      integer :: j, info

      k = 0.0_wp
      do j = 1, valve%modes
         k(j, j) = valve%stiffness(j)
      end do
      m = valve%mass
      call dsygv(1, "N", "L", valve%modes, k, valve%modes, m, valve%modes, frequency, work, size(work), info)
      frequency = sqrt(frequency)/(2.0_wp*pi)
   end function wet_frequencies

   pure function right(text, width)
      character(len=*), intent(in) :: text
      integer, intent(in) :: width
      character(len=width) :: right

      right = text
      right = adjustr(right)
   end function right

end module rv_modes
