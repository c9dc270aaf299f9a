!> What is known of a case before it runs, and what every model reads off its values.
module rv_case_facts
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite, ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_columns, only : n_facts
   use rv_hydrodynamic_load, only : fluid_type
   use rv_keys, only : n_keys, load_by_model, default_load, kind_trace, model_traditional, model_squeeze, &
      & key_run_model, key_fluid_density_kg_m3, key_fluid_viscosity_pa_s, key_hydro_load, key_film_gap_mm, &
      & key_film_k_s, key_pressure_kind, key_pressure_inlet_kpa, key_pressure_outlet_kpa
   use rv_status, only : warn_reynolds
   use rv_text, only : to_text
   implicit none
   private
   public :: case_facts, tell, add_note, film_is_closed, fluid_of, load_of, amplitudes_of

   !> What is known of a case before it runs.
   type :: case_facts
      real(wp) :: fact(n_facts) = 0.0_wp            !! SI, in the order of fact_columns
      integer :: warnings = 0                       !! sum of warn_ bits
      character(len=:), allocatable :: note         !! a sentence for the warnings; unallocated: none
      logical :: is_closed = .false.                !! the film is closed before anything moves
      type(error_type), allocatable :: error        !! the case cannot be run
   end type case_facts

contains

   !> Note the numbers behind a case; data that make no finite model are an error.
   subroutine tell(facts, stiffness, mass, added_mass, added_damping, reynolds, in_range)
      type(case_facts), intent(inout) :: facts
      real(wp), intent(in) :: stiffness, mass, added_mass, added_damping, reynolds
      logical, intent(in) :: in_range

      facts%fact = ieee_value(1.0_wp, ieee_quiet_nan)
      facts%fact(:6) = [stiffness, mass, added_mass, added_damping, reynolds, sqrt(stiffness/(mass + added_mass))/(2.0_wp*pi)]
      if (.not. all(ieee_is_finite(facts%fact([1, 2, 3, 4, 6])))) then
         call fail(facts%error, rv_bad_input, "stiffness, mass or load is not a finite number for these data")
         return
      end if
      if (in_range) return
      facts%warnings = ior(facts%warnings, warn_reynolds)
      call add_note(facts, "Re = "//to_text(reynolds, 5)//" is outside the range of the hydrodynamic function")
   end subroutine tell

   !> One more sentence to beware of.
   subroutine add_note(facts, sentence)
      type(case_facts), intent(inout) :: facts
      character(len=*), intent(in) :: sentence

      if (allocated(facts%note)) then
         facts%note = facts%note//"; "//sentence
      else
         facts%note = "warning: "//sentence
      end if
   end subroutine add_note

   !> A film of no thickness; the squeeze model without a squeeze force has no film.
   pure logical function film_is_closed(value) result(closed)
      real(wp), intent(in) :: value(n_keys)
      integer :: model

      model = nint(value(key_run_model))
      closed = model /= model_traditional .and. .not. value(key_film_gap_mm) > 0.0_wp
      if (model == model_squeeze) closed = closed .and. value(key_film_k_s) > 0.0_wp
   end function film_is_closed

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

end module rv_case_facts
