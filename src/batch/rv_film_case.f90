!> From cases' values to lanes of the film models.
module rv_film_case
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type
   use rv_case_facts, only : case_facts, tell, add_note, film_is_closed, fluid_of, load_of, amplitudes_of
   use rv_film_lanes, only : film_lanes, new_film_lanes
   use rv_film_reed, only : film_reed, new_film_reed
   use rv_film_table, only : film_table, new_film_table
   use rv_film_valve, only : film_valve, new_film_valve
   use rv_hydrodynamic_load, only : load_published
   use rv_keys, only : n_keys, model_film, model_film_table, load_by_model, key_run_model, key_reed_a_mm, &
      & key_reed_b_mm, key_reed_hole_diameter_mm, key_reed_width_mm, key_reed_thickness_mm, key_reed_density_kg_m3, &
      & key_reed_youngs_modulus_gpa, key_reed_poisson_ratio, key_hydro_load, key_film_gap_mm, key_film_modes, &
      & key_film_mesh, key_film_edge_elongation, key_fluid_density_kg_m3, key_fluid_viscosity_pa_s
   use rv_status, only : warn_wide_gap
   use rv_table_lanes, only : table_lanes, new_table_lanes
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: planform_cache, new_film_cases, film_of_case, planform_key, n_planform
   public :: mesh_nodes, elements_around, elements_across

   real(wp), parameter :: wide_gap = 0.15e-3_wp    !! Navier-Stokes over lubrication: 0.95 at this film thickness [m]
   integer, parameter :: elements_around(3) = [6, 4, 2]  !! film mesh of film.mesh = 1: on arc, side and clamp
   integer, parameter :: elements_across = 3
   integer, parameter :: n_planform = 9            !! values in planform_key
   real(wp), parameter :: table_gap = 0.1e-3_wp    !! of tables that hold for any gap, lest the first case choose [m]

   !> What a valve depends on besides planform, gap and pressure.
   integer, parameter :: valve_keys(8) = [key_run_model, key_reed_thickness_mm, key_reed_density_kg_m3, &
      & key_reed_youngs_modulus_gpa, key_reed_poisson_ratio, key_hydro_load, key_fluid_density_kg_m3, &
      & key_fluid_viscosity_pa_s]

   !> The planform solved last, for the film models: cases that share it need it once.
   type :: planform_cache
      private
      real(wp) :: key(n_planform) = -1.0_wp
      type(film_reed) :: reed
      type(film_table), allocatable :: table
   end type planform_cache

contains

   !> Lanes of cases that share model and planform; see new_case_lanes.
   subroutine new_film_cases(value, cache, lanes, facts)
      real(wp), intent(in) :: value(:, :)
      type(planform_cache), intent(inout) :: cache
      class(valve_lanes), allocatable, intent(out) :: lanes
      type(case_facts), intent(inout) :: facts(:)
      type(film_valve), allocatable :: valve(:)
      type(film_lanes), allocatable :: film
      type(table_lanes), allocatable :: table
      type(error_type), allocatable :: error
      logical :: fine(size(facts))
      integer :: like, i   ! like: the last case whose valve was computed and is that of the next, but for gap and pressure

      call keep_planform(value(:, 1), cache, error)
      if (allocated(error)) then
         do i = 1, size(facts)
            facts(i)%error = error
         end do
         return
      end if
      allocate(valve(size(facts)))
      like = 0
      do i = 1, size(facts)
         if (like > 0) then
            if (any(abs(value(valve_keys, i) - value(valve_keys, like)) > 0.0_wp)) like = 0
         end if
         if (like > 0) then
            valve(i) = valve(like)
         else
            call new_film_valve_of(value(:, i), cache%reed, valve(i), facts(i)%error)
            if (.not. allocated(facts(i)%error)) like = i
         end if
         if (.not. allocated(facts(i)%error)) call finish_film_case(value(:, i), valve(i), facts(i))
         fine(i) = .not. (allocated(facts(i)%error) .or. facts(i)%is_closed)
      end do
      valve = pack(valve, fine)
      if (size(valve) == 0) return
      if (nint(value(key_run_model, 1)) == model_film) then
         allocate(film)
         call new_film_lanes(film, cache%reed, valve(1))
         call move_alloc(film, lanes)
      else
         allocate(table)
         call new_table_lanes(table, cache%reed, cache%table, valve)
         call move_alloc(table, lanes)
      end if
   end subroutine new_film_cases

   !> Everything of a case's valve but gap and pressure.
   subroutine new_film_valve_of(value, reed, valve, error)
      real(wp), intent(in) :: value(n_keys)
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(out) :: valve
      type(error_type), allocatable, intent(out) :: error

      call new_film_valve(valve, reed, value(key_reed_thickness_mm), value(key_reed_density_kg_m3), &
         & value(key_reed_youngs_modulus_gpa), value(key_reed_poisson_ratio), load_of(value), &
         & fluid_of(value), value(key_film_gap_mm), error)
   end subroutine new_film_valve_of

   subroutine finish_film_case(value, valve, facts)
      real(wp), intent(in) :: value(n_keys)
      type(film_valve), intent(inout) :: valve
      type(case_facts), intent(inout) :: facts

      valve%gap = value(key_film_gap_mm)
      call amplitudes_of(value, valve%inlet, valve%outlet)
      call tell(facts, valve%hole_stiffness, valve%modal_mass, valve%added_mass, valve%added_damping, &
         & valve%reynolds, valve%in_range)
      facts%fact(6) = valve%omega/(2.0_wp*pi)
      facts%is_closed = film_is_closed(value)
      if (valve%gap < wide_gap*(1.0_wp - epsilon(wide_gap))) return
      facts%warnings = ior(facts%warnings, warn_wide_gap)
      call add_note(facts, "from a gap of 0.15 mm on lubrication theory overstates the steady load on the land")
   end subroutine finish_film_case

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
      call new_film_valve_of(as_film, reed, valve, error)
      if (.not. allocated(error)) call finish_film_case(as_film, valve, facts)
   end subroutine film_of_case

   !> Solve a planform unless it is the one at hand.
   subroutine keep_planform(value, cache, error)
      real(wp), intent(in) :: value(n_keys)
      type(planform_cache), intent(inout) :: cache
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: gap
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
      if (nint(value(key_run_model)) == model_film_table .and. .not. film_is_closed(value)) then
         allocate(cache%table)
         gap = merge(value(key_film_gap_mm), table_gap, holds_for_one_gap(value))
         call new_film_table(cache%table, cache%reed, gap, error)
         if (allocated(error)) return
      end if
      cache%key = planform_key(value)
   end subroutine keep_planform

   !> What cases must share to share a planform and its table: zeros for the lumped models. Cases whose film is closed
   !> from the start are kept apart from others, whatever their model: they never reach lanes.
   pure function planform_key(value) result(key)
      real(wp), intent(in) :: value(n_keys)
      real(wp) :: key(n_planform)
      integer :: model

      key = 0.0_wp
      if (film_is_closed(value)) key(9) = 1.0_wp
      model = nint(value(key_run_model))
      if (all(model /= [model_film, model_film_table])) return
      key(:7) = [value(key_run_model), value(key_reed_a_mm), value(key_reed_hole_diameter_mm), value(key_reed_b_mm), &
         & value(key_reed_width_mm), value(key_reed_poisson_ratio), value(key_film_edge_elongation)]
      if (model == model_film_table .and. holds_for_one_gap(value)) key(8) = value(key_film_gap_mm)
   end function planform_key

   pure logical function holds_for_one_gap(value)
      real(wp), intent(in) :: value(n_keys)

      holds_for_one_gap = value(key_film_edge_elongation) > 0.0_wp
   end function holds_for_one_gap

   !> Nodes of the film mesh of a refinement.
   pure integer function mesh_nodes(mesh)
      integer, intent(in) :: mesh   !! film.mesh

      mesh_nodes = (2*mesh*sum(elements_around) + 1)*(2*mesh*elements_across + 1)
   end function mesh_nodes

end module rv_film_case
