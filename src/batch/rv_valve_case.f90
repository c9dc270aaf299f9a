!> From cases' values to the kernel: lanes of their model, their pressure history, how to integrate them.
module rv_valve_case
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_is_nan, ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_columns, only : n_facts
   use rv_film_lanes, only : film_lanes, new_film_lanes
   use rv_film_reed, only : film_reed, new_film_reed
   use rv_film_table, only : film_table, new_film_table
   use rv_film_valve, only : film_valve, new_film_valve
   use rv_hydrodynamic_load, only : hydrodynamic_load, new_hydrodynamic_load, fluid_type, load_published
   use rv_keys, only : n_keys, model_squeeze, model_film, model_film_table, load_by_model, default_load, &
      & kind_trace, start_equilibrium, &
      & key_run_model, key_run_start, key_run_t_end_ms, key_reed_a_mm, key_reed_b_mm, key_reed_hole_diameter_mm, &
      & key_reed_width_mm, key_reed_thickness_mm, key_reed_density_kg_m3, key_reed_youngs_modulus_gpa, key_reed_k_a, &
      & key_reed_poisson_ratio, key_reed_action_area_mm2, key_fluid_density_kg_m3, key_fluid_viscosity_pa_s, &
      & key_hydro_load, key_film_gap_mm, key_film_k_s, key_film_acts, key_film_modes, key_film_mesh, &
      & key_film_edge_elongation, key_pressure_kind, key_pressure_inlet_kpa, key_pressure_outlet_kpa, &
      & key_pressure_period_ms, key_pressure_transition_ms, key_pressure_file, key_pressure_event_ms, &
      & key_solver_rtol, key_solver_max_steps
   use rv_lanes, only : lane_settings
   use rv_lumped, only : lumped_lanes, lumped_valve, new_lumped_lanes, squeeze_coefficient
   use rv_pressure, only : pressure_history, square_wave, new_square_wave, pressure_trace, new_pressure_trace
   use rv_reed, only : reed_type, new_reed
   use rv_status, only : warn_reynolds, warn_wide_gap
   use rv_table_lanes, only : table_lanes, new_table_lanes
   use rv_text, only : to_text
   use rv_trace_file, only : trace_data
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: planform_cache, case_facts, new_case_lanes, film_of_case, new_history, settings_of, planform_key, &
      & n_planform, mesh_nodes
   public :: elements_around, elements_across

   real(wp), parameter :: most_periods = 1.0e5_wp  !! periods in one run; each has four stops
   real(wp), parameter :: wide_gap = 0.15e-3_wp    !! Navier-Stokes over lubrication: 0.95 at this film thickness [m]
   integer, parameter :: elements_around(3) = [6, 4, 2]  !! film mesh of film.mesh = 1: on arc, side and clamp
   integer, parameter :: elements_across = 3
   integer, parameter :: acts_both = 2             !! film.acts = 'both'
   integer, parameter :: n_planform = 8            !! values in planform_key

   !> The planform solved last, for the film models: cases that share it need it once.
   type :: planform_cache
      private
      real(wp) :: key(n_planform) = -1.0_wp
      type(film_reed) :: reed
      type(film_table), allocatable :: table
   end type planform_cache

   !> What is known of a case before it runs.
   type :: case_facts
      real(wp) :: fact(n_facts) = 0.0_wp            !! SI, in the order of fact_columns
      integer :: warnings = 0                       !! sum of warn_ bits
      character(len=:), allocatable :: note         !! a sentence for the warnings; unallocated: none
      type(error_type), allocatable :: error        !! the case cannot be run
   end type case_facts

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
      type(lumped_lanes) :: lumped
      logical :: fine(size(facts))
      integer :: i

      do i = 1, size(facts)
         call new_lumped_case(value(:, i), valve(i), facts(i))
         fine(i) = .not. allocated(facts(i)%error)
      end do
      if (.not. any(fine)) return
      call new_lumped_lanes(lumped, pack(valve, fine))
      allocate(lanes, source=lumped)
   end subroutine new_lumped_cases

   subroutine new_lumped_case(value, valve, facts)
      real(wp), intent(in) :: value(n_keys)
      type(lumped_valve), intent(out) :: valve
      type(case_facts), intent(inout) :: facts
      type(reed_type) :: reed
      type(fluid_type) :: fluid
      type(hydrodynamic_load) :: load

      call new_reed(reed, value(key_reed_a_mm), value(key_reed_hole_diameter_mm), value(key_reed_b_mm), &
         & value(key_reed_width_mm), value(key_reed_thickness_mm), value(key_reed_density_kg_m3), &
         & value(key_reed_youngs_modulus_gpa), value(key_reed_k_a), facts%error)
      if (allocated(facts%error)) return
      fluid = fluid_of(value)
      call new_hydrodynamic_load(load, load_of(value), reed, fluid, facts%error)
      if (allocated(facts%error)) return

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
      call amplitudes_of(value, valve%inlet, valve%outlet)
      call tell(facts, reed%stiffness, reed%mass, load%added_mass, load%added_damping, load%reynolds, load%in_range)
   end subroutine new_lumped_case

   subroutine new_film_cases(value, cache, lanes, facts)
      real(wp), intent(in) :: value(:, :)
      type(planform_cache), intent(inout) :: cache
      class(valve_lanes), allocatable, intent(out) :: lanes
      type(case_facts), intent(inout) :: facts(:)
      type(film_valve), allocatable :: valve(:)
      type(film_lanes) :: film
      type(table_lanes) :: table
      type(error_type), allocatable :: error
      logical :: fine(size(facts))
      integer :: i

      call keep_planform(value(:, 1), cache, error)
      if (allocated(error)) then
         do i = 1, size(facts)
            facts(i)%error = error
         end do
         return
      end if
      allocate(valve(size(facts)))
      do i = 1, size(facts)
         call new_film_case(value(:, i), cache%reed, valve(i), facts(i))
         fine(i) = .not. allocated(facts(i)%error)
      end do
      valve = pack(valve, fine)
      if (size(valve) == 0) return
      if (nint(value(key_run_model, 1)) == model_film) then
         call new_film_lanes(film, cache%reed, valve(1))
         allocate(lanes, source=film)
      else
         call new_table_lanes(table, cache%reed, cache%table, valve)
         allocate(lanes, source=table)
      end if
   end subroutine new_film_cases

   subroutine new_film_case(value, reed, valve, facts)
      real(wp), intent(in) :: value(n_keys)
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(out) :: valve
      type(case_facts), intent(inout) :: facts

      call new_film_valve(valve, reed, value(key_reed_thickness_mm), value(key_reed_density_kg_m3), &
         & value(key_reed_youngs_modulus_gpa), value(key_reed_poisson_ratio), load_of(value), &
         & fluid_of(value), value(key_film_gap_mm), facts%error)
      if (allocated(facts%error)) return
      call amplitudes_of(value, valve%inlet, valve%outlet)
      call tell(facts, valve%hole_stiffness, valve%modal_mass, valve%added_mass, valve%added_damping, &
         & valve%reynolds, valve%in_range)
      facts%fact(6) = valve%omega/(2.0_wp*pi)
      if (valve%gap < wide_gap*(1.0_wp - epsilon(wide_gap))) return
      facts%warnings = ior(facts%warnings, warn_wide_gap)
      call add_note(facts, "at a gap of "//to_text(1.0e3_wp*valve%gap, 4) &
         & //" mm lubrication theory overstates the steady load on the land")
   end subroutine new_film_case

   !> Planform and film valve of one case, whatever its model: what a film model would make of it.
   subroutine film_of_case(value, reed, valve, error)
      real(wp), intent(in) :: value(n_keys)
      type(film_reed), intent(out) :: reed
      type(film_valve), intent(out) :: valve
      type(error_type), allocatable, intent(out) :: error
      type(planform_cache) :: cache
      type(case_facts) :: facts
      real(wp) :: as_film(n_keys)

      as_film = value
      as_film(key_run_model) = real(model_film, wp)
      if (nint(value(key_hydro_load)) == load_published) as_film(key_hydro_load) = real(load_by_model, wp)
      call keep_planform(as_film, cache, error)
      if (allocated(error)) return
      reed = cache%reed
      call new_film_case(as_film, reed, valve, facts)
      if (allocated(facts%error)) call move_alloc(facts%error, error)
   end subroutine film_of_case

   !> Solve a planform unless it is the one at hand.
   subroutine keep_planform(value, cache, error)
      real(wp), intent(in) :: value(n_keys)
      type(planform_cache), intent(inout) :: cache
      type(error_type), allocatable, intent(out) :: error
      integer :: mesh, modes

      if (all(abs(planform_key(value) - cache%key) <= 0.0_wp)) return
      cache%key = -1.0_wp
      if (allocated(cache%table)) deallocate(cache%table)
      mesh = nint(value(key_film_mesh))
      modes = 1
      if (nint(value(key_run_model)) == model_film) modes = nint(value(key_film_modes))
      call new_film_reed(cache%reed, value(key_reed_a_mm), value(key_reed_hole_diameter_mm), value(key_reed_b_mm), &
         & value(key_reed_width_mm), value(key_reed_poisson_ratio), modes, value(key_film_edge_elongation), error, &
         & around=mesh*elements_around, across=mesh*elements_across)
      if (allocated(error)) return
      if (nint(value(key_run_model)) == model_film_table) then
         allocate(cache%table)
         call new_film_table(cache%table, cache%reed, value(key_film_gap_mm), error)
         if (allocated(error)) return
      end if
      cache%key = planform_key(value)
   end subroutine keep_planform

   !> What cases must share to share a planform (and its table): zeros for the lumped models.
   pure function planform_key(value) result(key)
      real(wp), intent(in) :: value(n_keys)
      real(wp) :: key(n_planform)
      integer :: model

      key = 0.0_wp
      model = nint(value(key_run_model))
      if (all(model /= [model_film, model_film_table])) return
      key = [value(key_run_model), value(key_reed_a_mm), value(key_reed_hole_diameter_mm), value(key_reed_b_mm), &
         & value(key_reed_width_mm), value(key_reed_poisson_ratio), value(key_film_edge_elongation), 0.0_wp]
      if (model == model_film_table .and. value(key_film_edge_elongation) > 0.0_wp) key(8) = value(key_film_gap_mm)
   end function planform_key

   !> Nodes of the film mesh of a refinement.
   pure integer function mesh_nodes(mesh)
      integer, intent(in) :: mesh   !! film.mesh

      mesh_nodes = (2*mesh*sum(elements_around) + 1)*(2*mesh*elements_across + 1)
   end function mesh_nodes

   pure function fluid_of(value) result(fluid)
      real(wp), intent(in) :: value(n_keys)
      type(fluid_type) :: fluid

      fluid = fluid_type(density=value(key_fluid_density_kg_m3), viscosity=value(key_fluid_viscosity_pa_s))
   end function fluid_of

   pure integer function load_of(value) result(load)
      real(wp), intent(in) :: value(n_keys)

      load = nint(value(key_hydro_load))
      if (load == load_by_model) load = default_load(nint(value(key_run_model)))
   end function load_of

   !> What the factors of the pressure history are multiplied with: a trace's are pressures already.
   pure subroutine amplitudes_of(value, inlet, outlet)
      real(wp), intent(in) :: value(n_keys)
      real(wp), intent(out) :: inlet, outlet   !! [Pa] or [-]

      inlet = 1.0_wp
      outlet = 1.0_wp
      if (nint(value(key_pressure_kind)) == kind_trace) return
      inlet = value(key_pressure_inlet_kpa)
      outlet = value(key_pressure_outlet_kpa)
   end subroutine amplitudes_of

   subroutine tell(facts, stiffness, mass, added_mass, added_damping, reynolds, in_range)
      type(case_facts), intent(inout) :: facts
      real(wp), intent(in) :: stiffness, mass, added_mass, added_damping, reynolds
      logical, intent(in) :: in_range

      facts%fact = [stiffness, mass, added_mass, added_damping, reynolds, &
         & sqrt(stiffness/(mass + added_mass))/(2.0_wp*pi), ieee_value(1.0_wp, ieee_quiet_nan)]
      if (.not. all(ieee_is_finite(facts%fact([1, 2, 3, 4, 6])))) then
         call fail(facts%error, rv_bad_input, "stiffness, mass or load is not a finite number for these data")
         return
      end if
      if (in_range) return
      facts%warnings = ior(facts%warnings, warn_reynolds)
      call add_note(facts, "Re = "//to_text(reynolds, 5)//" is outside the range of the hydrodynamic function")
   end subroutine tell

   subroutine add_note(facts, sentence)
      type(case_facts), intent(inout) :: facts
      character(len=*), intent(in) :: sentence

      if (allocated(facts%note)) then
         facts%note = facts%note//"; "//sentence
      else
         facts%note = "warning: "//sentence
      end if
   end subroutine add_note

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
         call new_square_wave(wave, value(key_pressure_period_ms), value(key_pressure_transition_ms), error)
         if (allocated(error)) return
         if (.not. ieee_is_nan(value(key_pressure_event_ms))) wave%event = value(key_pressure_event_ms)
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

      settings%t_end = value(key_run_t_end_ms)
      settings%rtol = value(key_solver_rtol)
      settings%max_steps = nint(value(key_solver_max_steps))
      settings%from_equilibrium = nint(value(key_run_start)) == start_equilibrium
   end function settings_of

end module rv_valve_case
