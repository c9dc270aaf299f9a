!> The keys of a deck: one table from which reading, checking, template and reference all come.
!>
!> Numbers stand in the deck's units in this table and in SI everywhere else; a set of values is
!> one vector `real(wp) :: value(n_keys)` with integers as reals, logicals as 0 and 1, choices as
!> their place in the list of choices, a trace file as its place in the deck's list of files, and
!> NaN (choices and files: 0) for what was not given and has no default.
module rv_keys
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan, ieee_is_nan
   use rv_kinds, only : wp
   use rv_text, only : lower, to_text
   use rv_hydrodynamic_load, only : load_published, load_maali
   use rv_number, only : tidy
   implicit none
   private
   public :: key_type, keys, n_keys, n_rows, n_models
   public :: real_key, integer_key, logical_key, choice_key, text_key, mixed_key
   public :: default_load, find_key, full_name, default_value, to_si, from_si, value_text
   public :: choice_count, choice_name, choice_index
   public :: key_run_title, key_run_model, key_run_start, key_run_t_end_ms, key_run_traces, &
      & key_run_trace_dt_ms, key_run_block_size, key_run_compress, key_run_csv
   public :: key_reed_a_mm, key_reed_b_mm, key_reed_hole_diameter_mm, key_reed_width_mm, key_reed_thickness_mm, &
      & key_reed_density_kg_m3, key_reed_youngs_modulus_gpa, key_reed_poisson_ratio, key_reed_k_a, &
      & key_reed_action_area_mm2
   public :: key_fluid_density_kg_m3, key_fluid_viscosity_pa_s, key_hydro_load
   public :: key_film_gap_mm, key_film_k_s, key_film_acts, key_film_modes, key_film_mesh, key_film_edge_elongation, &
      & key_film_vapour_pressure_kpa, key_film_fields_ms
   public :: key_pressure_kind, key_pressure_inlet_kpa, key_pressure_outlet_kpa, key_pressure_period_ms, &
      & key_pressure_transition_ms, key_pressure_file, key_pressure_event_ms
   public :: key_solver_rtol, key_solver_method, key_solver_max_steps, key_solver_width
   public :: key_sweep_key, key_sweep_values, key_sweep_from, key_sweep_to, key_sweep_count, key_sweep_scale
   public :: key_design_file
   public :: model_traditional, model_squeeze, model_film, model_film_table, load_by_model
   public :: csv_auto, csv_always, csv_never
   public :: kind_square, kind_trace, start_by_kind, start_rest, start_equilibrium

   !> Places in `keys`, in the table's order.
   enum, bind(c)
      enumerator :: key_run_title = 1, key_run_model, key_run_start, key_run_t_end_ms, key_run_traces
      enumerator :: key_run_trace_dt_ms, key_run_block_size, key_run_compress, key_run_csv
      enumerator :: key_reed_a_mm, key_reed_b_mm, key_reed_hole_diameter_mm, key_reed_width_mm
      enumerator :: key_reed_thickness_mm, key_reed_density_kg_m3, key_reed_youngs_modulus_gpa
      enumerator :: key_reed_poisson_ratio, key_reed_k_a, key_reed_action_area_mm2
      enumerator :: key_fluid_density_kg_m3, key_fluid_viscosity_pa_s
      enumerator :: key_hydro_load
      enumerator :: key_film_gap_mm, key_film_k_s, key_film_acts, key_film_modes, key_film_mesh
      enumerator :: key_film_edge_elongation, key_film_vapour_pressure_kpa, key_film_fields_ms
      enumerator :: key_pressure_kind, key_pressure_inlet_kpa, key_pressure_outlet_kpa, key_pressure_period_ms
      enumerator :: key_pressure_transition_ms, key_pressure_file, key_pressure_event_ms
      enumerator :: key_solver_rtol, key_solver_method, key_solver_max_steps, key_solver_width
      enumerator :: key_sweep_key, key_sweep_values, key_sweep_from, key_sweep_to, key_sweep_count
      enumerator :: key_sweep_scale, key_design_file
   end enum
   integer, parameter :: n_keys = key_solver_width   !! keys that are part of a case
   integer, parameter :: n_rows = key_design_file    !! with those of &sweep and &design, which build cases

   !> Kinds of value.
   integer, parameter :: real_key = 1, integer_key = 2, logical_key = 3, choice_key = 4, text_key = 5
   integer, parameter :: mixed_key = 6   !! whatever the swept key is

   !> Values of run.model, hydro.load (0: published for lumped, maali for film models), pressure.kind,
   !> run.start and run.csv.
   integer, parameter :: model_traditional = 1, model_squeeze = 2, model_film = 3, model_film_table = 4, n_models = 4
   integer, parameter :: load_by_model = 0
   integer, parameter :: csv_auto = 1, csv_always = 2, csv_never = 3
   integer, parameter :: kind_square = 1, kind_trace = 2
   integer, parameter :: start_by_kind = 0, start_rest = 1, start_equilibrium = 2

   !> One key; numbers in the deck's unit.
   type :: key_type
      character(len=8) :: group
      character(len=20) :: name
      integer :: kind
      character(len=8) :: unit       !! empty: none
      real(wp) :: factor             !! SI value = factor * deck value
      character(len=12) :: default   !! as in a deck, without quotes; empty: none
      real(wp) :: lowest             !! allowed range, both ends included; of a text: its length
      real(wp) :: highest
      character(len=110) :: help
      real(wp) :: usual_low = 0.0_wp           !! outside this range (of the magnitude) a wrong unit is likely;
      real(wp) :: usual_high = huge(1.0_wp)    !! zero is never unusual
      character(len=40) :: choices = ""        !! separated by blanks
      logical :: list = .false.                !! several values may be given
      logical :: sweepable = .true.
      logical :: for_model(n_models) = .true.  !! the models it matters to
      integer :: for_kind = 0                  !! the pressure.kind it matters to; 0: any
   end type key_type

   real(wp), parameter :: milli = 1.0e-3_wp, kilo = 1.0e3_wp, giga = 1.0e9_wp, one = 1.0_wp
   real(wp), parameter :: none = 0.0_wp   !! lowest and highest where neither has a meaning
   logical, parameter :: only_squeeze(n_models) = [.false., .true., .false., .false.]
   logical, parameter :: with_film(n_models) = [.false., .true., .true., .true.]
   logical, parameter :: only_film(n_models) = [.false., .false., .true., .true.]
   logical, parameter :: only_modes(n_models) = [.false., .false., .true., .false.]
   logical, parameter :: without_modes(n_models) = [.true., .true., .false., .true.]
   logical, parameter :: only_lumped(n_models) = [.true., .true., .false., .false.]

   type(key_type), parameter :: run_keys(9) = [ &
      & key_type("run", "title", text_key, "", one, "", none, 200.0_wp, &
      & "a name for the results", sweepable=.false.), &
      & key_type("run", "model", choice_key, "", one, "squeeze", none, none, &
      & "the valve model, or a list of them: every case is run with each", &
      & choices="traditional squeeze film film_table", list=.true.), &
      & key_type("run", "start", choice_key, "", one, "", none, none, &
      & "u = 0, or the static equilibrium under the first pressure; default: rest, for traces equilibrium", &
      & choices="rest equilibrium", sweepable=.false.), &
      & key_type("run", "t_end_ms", real_key, "ms", milli, "", 1.0e-3_wp, 1.0e6_wp, &
      & "end of the run; default: 40 for square waves, the last time of a trace", 0.5_wp, 1.0e5_wp), &
      & key_type("run", "traces", logical_key, "", one, ".false.", none, none, &
      & "store the histories of displacement, velocity, pressures and squeeze force", sweepable=.false.), &
      & key_type("run", "trace_dt_ms", real_key, "ms", milli, "0.02", 1.0e-6_wp, 1.0e3_wp, &
      & "time between two stored samples", 1.0e-4_wp, 10.0_wp, sweepable=.false.), &
      & key_type("run", "block_size", integer_key, "", one, "0", 0.0_wp, 1.0e6_wp, &
      & "cases in one block: the unit of work, and what a killed run can lose; 0: set by the deck's number of cases", &
      & sweepable=.false.), &
      & key_type("run", "compress", integer_key, "", one, "0", 0.0_wp, 9.0_wp, &
      & "compression of results.nc: 0 none, 1 quick, 9 smallest", sweepable=.false.), &
      & key_type("run", "csv", choice_key, "", one, "auto", none, none, &
      & "write summary.csv; auto: up to 2 million cases", choices="auto always never", sweepable=.false.)]

   type(key_type), parameter :: reed_keys(10) = [ &
      & key_type("reed", "a_mm", real_key, "mm", milli, "2.5", 1.0e-3_wp, 1.0e3_wp, &
      & "a, from the clamp to the edge of the hole", 0.05_wp, 200.0_wp), &
      & key_type("reed", "b_mm", real_key, "mm", milli, "1.0", 1.0e-3_wp, 1.0e3_wp, &
      & "b, from the edge of the hole to the tip", 0.02_wp, 100.0_wp), &
      & key_type("reed", "hole_diameter_mm", real_key, "mm", milli, "4.0", 1.0e-3_wp, 1.0e3_wp, &
      & "D, diameter of the valve hole; not more than the width", 0.1_wp, 100.0_wp), &
      & key_type("reed", "width_mm", real_key, "mm", milli, "6.0", 1.0e-3_wp, 1.0e3_wp, &
      & "B, width of the reed", 0.1_wp, 200.0_wp), &
      & key_type("reed", "thickness_mm", real_key, "mm", milli, "0.15", 1.0e-5_wp, 1.0e2_wp, &
      & "h, thickness of the reed", 0.002_wp, 10.0_wp), &
      & key_type("reed", "density_kg_m3", real_key, "kg/m3", one, "8950.0", 1.0_wp, 1.0e5_wp, &
      & "density of the reed", 200.0_wp, 25000.0_wp), &
      & key_type("reed", "youngs_modulus_gpa", real_key, "GPa", giga, "110.0", 1.0e-3_wp, 1.0e4_wp, &
      & "E, Young's modulus of the reed", 0.1_wp, 1500.0_wp), &
      & key_type("reed", "poisson_ratio", real_key, "", one, "0.3", -0.99_wp, 0.499_wp, &
      & "Poisson's ratio of the reed", for_model=only_film), &
      & key_type("reed", "k_a", real_key, "", one, "0.91", 1.0e-3_wp, 1.0e3_wp, &
      & "k_a of Eq. (18), fitted: stiffness of the arc-shaped reed over that of the rectangle", 0.1_wp, 10.0_wp, &
      & for_model=only_lumped), &
      & key_type("reed", "action_area_mm2", real_key, "mm2", milli**2, "", 1.0e-6_wp, 1.0e6_wp, &
      & "A of Eq. (19), the area the pressures act on; default: the hole's, pi D^2/4", 0.01_wp, 1.0e4_wp, &
      & for_model=only_lumped)]

   type(key_type), parameter :: medium_keys(11) = [ &
      & key_type("fluid", "density_kg_m3", real_key, "kg/m3", one, "875.0", 1.0e-3_wp, 1.0e5_wp, &
      & "density of the fluid", 0.01_wp, 2.0e4_wp), &
      & key_type("fluid", "viscosity_pa_s", real_key, "Pa s", one, "0.0484", 1.0e-7_wp, 1.0e4_wp, &
      & "dynamic viscosity of the fluid", 1.0e-6_wp, 10.0_wp), &
      & key_type("hydro", "load", choice_key, "", one, "", none, none, &
      & "added mass and damping of the fluid, see docs/theory.md", &
      & choices="published maali sader none", sweepable=.false.), &
      & key_type("film", "gap_mm", real_key, "mm", milli, "0.05", 0.0_wp, 1.0e3_wp, &
      & "g0, thickness of the film under the reed at rest; 0: it is closed", 5.0e-4_wp, 10.0_wp, for_model=with_film), &
      & key_type("film", "k_s", real_key, "", one, "0.0075", 0.0_wp, 1.0e3_wp, &
      & "k_s of Eq. (26), fitted: factor on the squeeze force (the paper prints 0.008)", &
      & for_model=only_squeeze), &
      & key_type("film", "acts", choice_key, "", one, "closing", none, none, &
      & "the squeeze force acts while the reed closes (the paper's model) or both ways", &
      & choices="closing both", sweepable=.false., for_model=only_squeeze), &
      & key_type("film", "modes", integer_key, "", one, "4", 1.0_wp, 12.0_wp, &
      & "plate modes of the film model", sweepable=.false., for_model=only_modes), &
      & key_type("film", "mesh", integer_key, "", one, "1", 1.0_wp, 8.0_wp, &
      & "refinement of the film's mesh: 1 is 12 x 3 quadratic elements on the half land, n is 12n x 3n", &
      & sweepable=.false., for_model=only_film), &
      & key_type("film", "edge_elongation", real_key, "", one, "0.0", 0.0_wp, 10.0_wp, &
      & "beta: by how many film thicknesses the edges of the film reach out; Stokes flow says 0.65", &
      & for_model=only_film), &
      & key_type("film", "vapour_pressure_kpa", real_key, "kPa", kilo, "-101.325", -1.0e5_wp, 1.0e5_wp, &
      & "film pressure below which a case warns of cavitation, on the scale of inlet and outlet", for_model=only_film), &
      & key_type("film", "fields_ms", real_key, "ms", milli, "", -1.0e6_wp, 1.0e6_wp, &
      & "times, rising, at which the film's pressure field is stored", list=.true., sweepable=.false., &
      & for_model=only_film)]

   type(key_type), parameter :: pressure_keys(7) = [ &
      & key_type("pressure", "kind", choice_key, "", one, "square", none, none, &
      & "periodic square wave with ramps, Eqs. (19) and (20), or a measured trace from a file", &
      & choices="square trace", sweepable=.false.), &
      & key_type("pressure", "inlet_kpa", real_key, "kPa", kilo, "20.0", -1.0e5_wp, 1.0e5_wp, &
      & "inlet pressure of the open half of the square wave", 0.1_wp, 5.0e3_wp, for_kind=kind_square), &
      & key_type("pressure", "outlet_kpa", real_key, "kPa", kilo, "0.0", -1.0e5_wp, 1.0e5_wp, &
      & "outlet pressure, constant", 0.1_wp, 5.0e3_wp, for_kind=kind_square), &
      & key_type("pressure", "period_ms", real_key, "ms", milli, "40.0", 1.0e-3_wp, 1.0e6_wp, &
      & "period of the square wave; it falls at half of it", 0.1_wp, 1.0e4_wp, for_kind=kind_square), &
      & key_type("pressure", "transition_ms", real_key, "ms", milli, "1.0", 1.0e-6_wp, 1.0e6_wp, &
      & "duration of a ramp; less than half the period", 0.002_wp, 1.0e3_wp, for_kind=kind_square), &
      & key_type("pressure", "file", text_key, "", one, "", 1.0_wp, 1000.0_wp, &
      & "CSV file of the trace, relative to the deck: t_ms and p_in_kpa, p_out_kpa or p_diff_kpa", &
      & for_kind=kind_trace), &
      & key_type("pressure", "event_ms", real_key, "ms", milli, "", -1.0e6_wp, 1.0e6_wp, &
      & "when closing starts, for the measures; default: the falling ramp's start; a trace needs it")]

   type(key_type), parameter :: solver_keys(4) = [ &
      & key_type("solver", "rtol", real_key, "", one, "1.0e-6", 1.0e-12_wp, 1.0e-2_wp, &
      & "relative tolerance of the time integration"), &
      & key_type("solver", "method", choice_key, "", one, "implicit", none, none, &
      & "implicit: for any film; explicit: faster where the film is not stiff; auto: explicit where stiffness allows", &
      & choices="implicit explicit auto", sweepable=.false., for_model=without_modes), &
      & key_type("solver", "max_steps", integer_key, "", one, "1000000", 1.0_wp, 2.0e9_wp, &
      & "most steps for one case", sweepable=.false.), &
      & key_type("solver", "width", integer_key, "", one, "256", 1.0_wp, 1024.0_wp, &
      & "lanes: cases that share one integrator, a power of two", sweepable=.false.)]

   type(key_type), parameter :: case_keys(7) = [ &
      & key_type("sweep", "key", text_key, "", one, "", 1.0_wp, 64.0_wp, &
      & "the key to vary, as group.name: 'film.gap_mm'", sweepable=.false.), &
      & key_type("sweep", "values", mixed_key, "", one, "", none, none, &
      & "its values, in its own unit; or else from, to and count", list=.true., sweepable=.false.), &
      & key_type("sweep", "from", real_key, "", one, "", -huge(one), huge(one), &
      & "first value, in the key's unit", sweepable=.false.), &
      & key_type("sweep", "to", real_key, "", one, "", -huge(one), huge(one), &
      & "last value, in the key's unit", sweepable=.false.), &
      & key_type("sweep", "count", integer_key, "", one, "", 2.0_wp, 1.0e6_wp, &
      & "number of values", sweepable=.false.), &
      & key_type("sweep", "scale", choice_key, "", one, "linear", none, none, &
      & "equal differences or equal ratios from value to value", choices="linear log", sweepable=.false.), &
      & key_type("design", "file", text_key, "", one, "", 1.0_wp, 1000.0_wp, &
      & "CSV file of the cases, relative to the deck: its header names keys, each row is a case", &
      & sweepable=.false.)]

   type(key_type), parameter :: keys(n_rows) = &
      & [run_keys, reed_keys, medium_keys, pressure_keys, solver_keys, case_keys]

contains

   !> hydro.load of a model that is given none.
   pure integer function default_load(model) result(load)
      integer, intent(in) :: model

      load = load_published
      if (any(model == [model_film, model_film_table])) load = load_maali
   end function default_load

   !> The place of a key in the table, 0 if there is none; names in lower case.
   pure integer function find_key(group, name) result(key)
      character(len=*), intent(in) :: group, name

      do key = n_rows, 1, -1
         if (keys(key)%group == group .and. keys(key)%name == name) return
      end do
   end function find_key

   !> "film.gap_mm"
   pure function full_name(key) result(name)
      integer, intent(in) :: key
      character(len=:), allocatable :: name

      name = trim(keys(key)%group)//"."//trim(keys(key)%name)
   end function full_name

   !> The value a key has when the deck does not give it.
   pure real(wp) function default_value(key) result(value)
      integer, intent(in) :: key
      character(len=:), allocatable :: text

      text = trim(keys(key)%default)
      select case (keys(key)%kind)
      case (choice_key)
         value = real(choice_index(key, text), wp)
      case (logical_key)
         value = merge(1.0_wp, 0.0_wp, text == ".true.")
      case (text_key)
         value = 0.0_wp
      case default
         value = ieee_value(value, ieee_quiet_nan)
         if (text == "") return
         read(text, *) value
         value = to_si(key, value)
      end select
   end function default_value

   !> From the deck's unit to SI. Powers of ten below one divide, for one rounding instead of two.
   elemental real(wp) function to_si(key, value) result(si)
      integer, intent(in) :: key
      real(wp), intent(in) :: value   !! in the deck's unit

      if (keys(key)%factor < 1.0_wp) then
         si = value/anint(1.0_wp/keys(key)%factor)
      else
         si = value*keys(key)%factor
      end if
   end function to_si

   !> From SI to the deck's unit: the number that to_si makes `si` of, the one of 15 digits where there is one.
   elemental real(wp) function from_si(key, si) result(value)
      integer, intent(in) :: key
      real(wp), intent(in) :: si
      real(wp) :: plain, candidate(4)
      integer :: i

      if (keys(key)%factor < 1.0_wp) then
         plain = si*anint(1.0_wp/keys(key)%factor)
      else
         plain = si/keys(key)%factor
      end if
      value = tidy(plain)
      if (abs(to_si(key, value) - si) <= 0.0_wp) return
      value = plain
      if (abs(to_si(key, value) - si) <= 0.0_wp) return
      candidate(1:2) = nearest(plain, [1.0_wp, -1.0_wp])
      candidate(3:4) = nearest(candidate(1:2), [1.0_wp, -1.0_wp])
      do i = 1, size(candidate)
         if (abs(to_si(key, candidate(i)) - si) > 0.0_wp) cycle
         value = candidate(i)
         return
      end do
   end function from_si

   !> A value as a deck spells it, without quotes; empty where there is none. Texts and files stand elsewhere.
   function value_text(key, value) result(text)
      integer, intent(in) :: key
      real(wp), intent(in) :: value   !! as in a vector of values
      character(len=:), allocatable :: text

      select case (keys(key)%kind)
      case (choice_key)
         text = choice_name(key, nint(value))
      case (logical_key)
         text = trim(merge(".true. ", ".false.", value > 0.5_wp))
      case (integer_key)
         text = to_text(nint(value))
      case (real_key)
         text = ""
         if (.not. ieee_is_nan(value)) text = to_text(from_si(key, value))
      case default
         text = ""
      end select
   end function value_text

   pure integer function choice_count(key) result(n)
      integer, intent(in) :: key

      n = 0
      do while (len(choice_name(key, n + 1)) > 0)
         n = n + 1
      end do
   end function choice_count

   !> The i-th choice of a key, empty if there is none.
   pure function choice_name(key, i) result(name)
      integer, intent(in) :: key, i
      character(len=:), allocatable :: name
      character(len=len(keys%choices)) :: rest
      integer :: n

      rest = keys(key)%choices
      do n = 2, i
         rest = adjustl(rest(scan(rest//" ", " "):))
      end do
      name = rest(:scan(rest//" ", " ") - 1)
      if (i < 1) name = ""
   end function choice_name

   !> The place of a word, in any case, in the list of choices; 0 if it is none of them.
   pure integer function choice_index(key, word) result(i)
      integer, intent(in) :: key
      character(len=*), intent(in) :: word
      character(len=len(keys%choices)) :: rest
      integer :: length

      rest = keys(key)%choices
      i = 0
      do while (rest /= "")
         i = i + 1
         length = scan(rest//" ", " ") - 1
         if (rest(:length) == lower(word)) return
         rest = adjustl(rest(length + 1:))
      end do
      i = 0
   end function choice_index

end module rv_keys
