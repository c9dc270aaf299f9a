!> From one case's values to the kernel: the valve, its pressure history, how to integrate it.
module rv_valve_case
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_columns, only : n_facts
   use rv_hydrodynamic_load, only : hydrodynamic_load, new_hydrodynamic_load, fluid_type
   use rv_keys, only : n_keys, model_squeeze, kind_trace, start_by_kind, start_equilibrium, &
      & key_run_model, key_run_start, key_run_t_end_ms, key_reed_a_mm, key_reed_b_mm, key_reed_hole_diameter_mm, &
      & key_reed_width_mm, key_reed_thickness_mm, key_reed_density_kg_m3, key_reed_youngs_modulus_gpa, key_reed_k_a, &
      & key_reed_action_area_mm2, key_fluid_density_kg_m3, key_fluid_viscosity_pa_s, key_hydro_load, key_film_gap_mm, &
      & key_film_k_s, key_film_acts, key_pressure_kind, key_pressure_inlet_kpa, key_pressure_outlet_kpa, &
      & key_pressure_period_ms, key_pressure_transition_ms, key_pressure_file, key_pressure_event_ms, &
      & key_solver_rtol, key_solver_max_steps
   use rv_lanes, only : lane_settings
   use rv_lumped, only : lumped_valve, squeeze_coefficient
   use rv_pressure, only : pressure_history, square_wave, new_square_wave, pressure_trace, new_pressure_trace
   use rv_reed, only : reed_type, new_reed
   use rv_status, only : warn_reynolds
   use rv_text, only : to_text
   use rv_trace_file, only : trace_data
   implicit none
   private
   public :: new_valve, new_history, settings_of

   real(wp), parameter :: most_periods = 1.0e5_wp  !! periods in one run; each has four stops
   integer, parameter :: acts_both = 2             !! film.acts = 'both'

contains

   !> The valve of one case, the numbers behind it, and its warnings. On failure `valve` is a default one.
   subroutine new_valve(value, valve, fact, warnings, note, error)
      real(wp), intent(in) :: value(n_keys)      !! SI
      type(lumped_valve), intent(out) :: valve
      real(wp), intent(out) :: fact(n_facts)     !! SI, in the order of fact_columns
      integer, intent(out) :: warnings           !! sum of warn_ bits
      character(len=:), allocatable, intent(out) :: note   !! a sentence for the warnings, or empty
      type(error_type), allocatable, intent(out) :: error
      type(reed_type) :: reed
      type(fluid_type) :: fluid
      type(hydrodynamic_load) :: load

      fact = 0.0_wp
      warnings = 0
      note = ""
      call new_reed(reed, value(key_reed_a_mm), value(key_reed_hole_diameter_mm), value(key_reed_b_mm), &
         & value(key_reed_width_mm), value(key_reed_thickness_mm), value(key_reed_density_kg_m3), &
         & value(key_reed_youngs_modulus_gpa), value(key_reed_k_a), error)
      if (allocated(error)) return
      fluid = fluid_type(density=value(key_fluid_density_kg_m3), viscosity=value(key_fluid_viscosity_pa_s))
      call new_hydrodynamic_load(load, nint(value(key_hydro_load)), reed, fluid, error)
      if (allocated(error)) return

      valve%mass = reed%mass + load%added_mass
      valve%damping = load%added_damping
      valve%stiffness = reed%stiffness
      valve%area = value(key_reed_action_area_mm2)
      if (ieee_is_nan(valve%area)) valve%area = 0.25_wp*pi*value(key_reed_hole_diameter_mm)**2
      valve%gap = value(key_film_gap_mm)
      if (nint(value(key_run_model)) == model_squeeze) then
         valve%squeeze = squeeze_coefficient(value(key_film_k_s), fluid%viscosity, reed%length, reed%width)
         valve%both_ways = nint(value(key_film_acts)) == acts_both
      end if
      valve%inlet = 1.0_wp
      valve%outlet = 1.0_wp
      if (nint(value(key_pressure_kind)) /= kind_trace) then
         valve%inlet = value(key_pressure_inlet_kpa)
         valve%outlet = value(key_pressure_outlet_kpa)
      end if

      fact = [reed%stiffness, reed%mass, load%added_mass, load%added_damping, load%reynolds, &
         & sqrt(reed%stiffness/valve%mass)/(2.0_wp*pi)]
      if (.not. all(ieee_is_finite(fact([1, 2, 3, 4, 6])))) then
         call fail(error, rv_bad_input, "stiffness, mass or load is not a finite number for these data")
         return
      end if
      if (.not. load%in_range) then
         warnings = ior(warnings, warn_reynolds)
         note = "warning: Re = "//to_text(load%reynolds, 5)//" is outside the range of the hydrodynamic function"
      end if
   end subroutine new_valve

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
         call fail(error, rv_bad_input, "the run ends at "//to_text(value(key_run_t_end_ms), 6) &
            & //" s, before its pressure history starts at "//to_text(history%start, 6)//" s")
      end if
   end subroutine new_history

   !> How to integrate one case.
   pure function settings_of(value) result(settings)
      real(wp), intent(in) :: value(n_keys)
      type(lane_settings) :: settings
      integer :: start

      settings%t_end = value(key_run_t_end_ms)
      settings%rtol = value(key_solver_rtol)
      settings%max_steps = nint(value(key_solver_max_steps))
      start = nint(value(key_run_start))
      settings%from_equilibrium = start == start_equilibrium &
         & .or. (start == start_by_kind .and. nint(value(key_pressure_kind)) == kind_trace)
   end function settings_of

end module rv_valve_case
