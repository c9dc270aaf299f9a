!> From cases' values to the kernel: lanes of their model, their pressure history, how to integrate them.
module rv_valve_case
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_case_facts, only : case_facts, tell, film_is_closed, fluid_of, load_of, amplitudes_of
   use rv_film_case, only : planform_cache, new_film_cases
   use rv_hydrodynamic_load, only : hydrodynamic_load, new_hydrodynamic_load
   use rv_keys, only : n_keys, model_squeeze, model_film, model_film_table, kind_trace, start_equilibrium, &
      & key_run_model, key_run_start, key_run_t_end_ms, key_reed_a_mm, key_reed_b_mm, key_reed_hole_diameter_mm, &
      & key_reed_width_mm, key_reed_thickness_mm, key_reed_density_kg_m3, key_reed_youngs_modulus_gpa, key_reed_k_a, &
      & key_reed_action_area_mm2, key_film_gap_mm, key_film_k_s, key_film_acts, key_pressure_kind, &
      & key_pressure_period_ms, key_pressure_transition_ms, key_pressure_file, key_pressure_event_ms, &
      & key_fluid_density_kg_m3, key_fluid_viscosity_pa_s, key_solver_rtol, key_solver_method, key_solver_max_steps
   use rv_lanes, only : lane_settings
   use rv_lumped, only : lumped_lanes, lumped_valve, new_lumped_lanes, squeeze_coefficient
   use rv_pressure, only : pressure_history, square_wave, new_square_wave, pressure_trace, new_pressure_trace
   use rv_reed, only : reed_type, new_reed
   use rv_text, only : time_text, to_text
   use rv_trace_file, only : trace_data
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: new_case_lanes, new_history, settings_of

   real(wp), parameter :: most_periods = 1.0e5_wp  !! periods in one run; each has four stops
   integer, parameter :: acts_both = 2             !! film.acts = 'both'

   !> What the reed's stiffness, mass and load depend on, besides the choice of the load.
   integer, parameter :: reed_keys(10) = [key_reed_a_mm, key_reed_hole_diameter_mm, key_reed_b_mm, key_reed_width_mm, &
      & key_reed_thickness_mm, key_reed_density_kg_m3, key_reed_youngs_modulus_gpa, key_reed_k_a, &
      & key_fluid_density_kg_m3, key_fluid_viscosity_pa_s]

   !> A reed in its liquid, or why there is none.
   type :: immersed_reed
      real(wp) :: value(size(reed_keys)) = 0.0_wp
      integer :: load_choice = 0
      type(reed_type) :: reed
      type(hydrodynamic_load) :: load
      type(error_type), allocatable :: error
   end type immersed_reed

contains

   !> Lanes of cases that share model and planform. `lanes` holds those without an error, in order; none: unallocated.
   subroutine new_case_lanes(value, cache, lanes, facts)
      real(wp), intent(in) :: value(:, :)                      !! SI, (n_keys, cases)
      type(planform_cache), intent(inout) :: cache
      class(valve_lanes), allocatable, intent(out) :: lanes
      type(case_facts), intent(out) :: facts(:)                !! (cases)

      select case (nint(value(key_run_model, 1)))
      case (model_film, model_film_table)
         call new_film_cases(value, cache, lanes, facts)
      case default
         call new_lumped_cases(value, lanes, facts)
      end select
   end subroutine new_case_lanes

   subroutine new_lumped_cases(value, lanes, facts)
      real(wp), intent(in) :: value(:, :)
      class(valve_lanes), allocatable, intent(out) :: lanes
      type(case_facts), intent(inout) :: facts(:)
      type(lumped_valve) :: valve(size(facts))
      type(lumped_lanes), allocatable :: lumped
      type(immersed_reed) :: reed
      logical :: fine(size(facts))
      integer :: i

      do i = 1, size(facts)
         if (.not. is_immersed(reed, value(:, i))) call immerse(reed, value(:, i))
         call new_lumped_case(value(:, i), reed, valve(i), facts(i))
         fine(i) = .not. (allocated(facts(i)%error) .or. facts(i)%is_closed)
      end do
      if (.not. any(fine)) return
      allocate(lumped)
      call new_lumped_lanes(lumped, pack(valve, fine))
      call move_alloc(lumped, lanes)
   end subroutine new_lumped_cases

   !> Whether this is the reed of the case, in its liquid. Cases of a sweep mostly share it.
   pure logical function is_immersed(self, value)
      type(immersed_reed), intent(in) :: self
      real(wp), intent(in) :: value(n_keys)

      is_immersed = self%load_choice == load_of(value)
      if (is_immersed) is_immersed = all(abs(value(reed_keys) - self%value) <= 0.0_wp)
   end function is_immersed

   subroutine immerse(self, value)
      type(immersed_reed), intent(out) :: self
      real(wp), intent(in) :: value(n_keys)

      self%value = value(reed_keys)
      self%load_choice = load_of(value)
      call new_reed(self%reed, value(key_reed_a_mm), value(key_reed_hole_diameter_mm), value(key_reed_b_mm), &
         & value(key_reed_width_mm), value(key_reed_thickness_mm), value(key_reed_density_kg_m3), &
         & value(key_reed_youngs_modulus_gpa), value(key_reed_k_a), self%error)
      if (.not. allocated(self%error)) call new_hydrodynamic_load(self%load, self%load_choice, self%reed, &
         & fluid_of(value), self%error)
   end subroutine immerse

   subroutine new_lumped_case(value, immersed, valve, facts)
      real(wp), intent(in) :: value(n_keys)
      type(immersed_reed), intent(in) :: immersed
      type(lumped_valve), intent(out) :: valve
      type(case_facts), intent(inout) :: facts

      if (allocated(immersed%error)) then
         facts%error = immersed%error
         return
      end if
      associate (reed => immersed%reed, load => immersed%load)
         valve%mass = reed%mass + load%added_mass
         valve%damping = load%added_damping
         valve%stiffness = reed%stiffness
         valve%area = value(key_reed_action_area_mm2)
         if (ieee_is_nan(valve%area)) valve%area = 0.25_wp*pi*value(key_reed_hole_diameter_mm)**2
         valve%gap = value(key_film_gap_mm)
         facts%is_closed = film_is_closed(value)
         if (nint(value(key_run_model)) == model_squeeze) then
            valve%squeeze = squeeze_coefficient(value(key_film_k_s), value(key_fluid_viscosity_pa_s), reed%length, reed%width)
            valve%both_ways = nint(value(key_film_acts)) == acts_both
         end if
         call amplitudes_of(value, valve%inlet, valve%outlet)
         call tell(facts, reed%stiffness, reed%mass, load%added_mass, load%added_damping, load%reynolds, load%in_range)
      end associate
   end subroutine new_lumped_case

   !> The pressure history of one case.
   subroutine new_history(value, trace, history, error)
      real(wp), intent(in) :: value(n_keys)      !! SI
      type(trace_data), intent(in) :: trace(:)   !! the deck's trace files
      class(pressure_history), allocatable, intent(out) :: history
      type(error_type), allocatable, intent(out) :: error
      type(square_wave) :: wave
      type(pressure_trace) :: measured
      integer :: file

      if (nint(value(key_pressure_kind)) == kind_trace) then
         file = nint(value(key_pressure_file))
         call new_pressure_trace(measured, trace(file)%time, trace(file)%inlet, trace(file)%outlet, &
            & value(key_pressure_event_ms), error)
         allocate(history, source=measured)
      else
         if (value(key_run_t_end_ms) > most_periods*value(key_pressure_period_ms)) then
            call fail(error, rv_bad_input, "more than "//to_text(nint(most_periods))//" periods in one run")
            return
         end if
         if (ieee_is_nan(value(key_pressure_event_ms))) then
            call new_square_wave(wave, value(key_pressure_period_ms), value(key_pressure_transition_ms), error)
         else
            call new_square_wave(wave, value(key_pressure_period_ms), value(key_pressure_transition_ms), error, &
               & value(key_pressure_event_ms))
         end if
         allocate(history, source=wave)
      end if
      if (allocated(error)) return
      if (.not. value(key_run_t_end_ms) > history%start) then
         call fail(error, rv_bad_input, "the run ends at "//time_text(value(key_run_t_end_ms)) &
            & //", before its pressure history starts at "//time_text(history%start))
      end if
   end subroutine new_history

   !> How to integrate one case.
   pure function settings_of(value) result(settings)
      real(wp), intent(in) :: value(n_keys)
      type(lane_settings) :: settings

      settings%t_end = value(key_run_t_end_ms)
      settings%rtol = value(key_solver_rtol)
      settings%method = nint(value(key_solver_method))
      settings%max_steps = nint(value(key_solver_max_steps))
      settings%from_equilibrium = nint(value(key_run_start)) == start_equilibrium
   end function settings_of

end module rv_valve_case
