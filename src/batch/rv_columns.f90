!> The columns of a result: what they are called, in which unit they are written, what they mean.
module rv_columns
   use rv_kinds, only : wp
   use rv_measures, only : n_measures
   implicit none
   private
   public :: column_type, measure_columns, fact_columns, trace_columns, n_facts, n_traces, n_lumped_traces
   public :: fact_lowest_pressure, fact_method

   integer, parameter :: n_facts = 8   !! numbers of the model behind a case
   integer, parameter :: fact_lowest_pressure = 7, fact_method = 8   !! those known only after the run
   integer, parameter :: n_traces = 10  !! values in a trace sample, those of the film models last
   integer, parameter :: n_lumped_traces = 5

   !> One column. Written value = value in SI times to_unit.
   type :: column_type
      character(len=24) :: name = ""
      character(len=8) :: unit = ""         !! 1: dimensionless
      real(wp) :: to_unit = 1.0_wp
      character(len=112) :: long_name = ""
      character(len=24) :: meanings = ""    !! words that the values 1, 2, ... stand for; empty: a number
   end type column_type

   real(wp), parameter :: milli = 1.0e3_wp  !! SI to mm and ms

contains

   !> The measures, in the order of the results.
   pure function measure_columns() result(column)
      type(column_type) :: column(n_measures)

      column = [ &
         & column_type("steady_mm", "mm", milli, &
         & "static tip displacement under the pressure at the start of the closing event"), &
         & column_type("rise_ms", "ms", milli, "rise from 10 to 90 % of the steady displacement"), &
         & column_type("opening_ms", "ms", milli, "from the start of the run to 98 % of the steady displacement"), &
         & column_type("overshoot_mm", "mm", milli, "largest displacement above the steady one before the closing event"), &
         & column_type("fall_ms", "ms", milli, "fall from 90 to 10 % of the steady displacement"), &
         & column_type("closing_ms", "ms", milli, "from the closing event to 2 % of the steady displacement"), &
         & column_type("zero_ms", "ms", milli, "from the closing event to zero displacement"), &
         & column_type("undershoot_mm", "mm", milli, "largest displacement below the rest position after the closing event"), &
         & column_type("peak_squeeze_n", "N", 1.0_wp, "largest force of the film against closing")]
   end function measure_columns

   !> The model's numbers behind a case.
   pure function fact_columns() result(column)
      type(column_type) :: column(n_facts)

      column = [ &
         & column_type("stiffness_n_m", "N m-1", 1.0_wp, "equivalent stiffness k"), &
         & column_type("reed_mass_kg", "kg", 1.0_wp, "equivalent mass m_e"), &
         & column_type("added_mass_kg", "kg", 1.0_wp, "added mass m_a of the fluid"), &
         & column_type("added_damping_n_s_m", "N s m-1", 1.0_wp, "added damping c_a of the fluid"), &
         & column_type("reynolds", "1", 1.0_wp, "Reynolds number at which the hydrodynamic function was taken"), &
         & column_type("wet_frequency_hz", "Hz", 1.0_wp, "undamped natural frequency in the fluid, without film"), &
         & column_type("lowest_film_kpa", "kPa", 1.0e-3_wp, &
         & "lowest pressure in the film, at the ends of the steps (film models)"), &
         & column_type("solver_method", "1", 1.0_wp, "how the case was integrated: 1 implicit, 2 explicit", &
         & "implicit explicit")]
   end function fact_columns

   !> The traces.
   pure function trace_columns() result(column)
      type(column_type) :: column(n_traces)

      column = [ &
         & column_type("displacement_mm", "mm", milli, "tip displacement"), &
         & column_type("velocity_mm_ms", "mm ms-1", 1.0_wp, "tip velocity"), &
         & column_type("inlet_kpa", "kPa", 1.0e-3_wp, "inlet pressure"), &
         & column_type("outlet_kpa", "kPa", 1.0e-3_wp, "outlet pressure"), &
         & column_type("squeeze_n", "N", 1.0_wp, &
         & "force of the film against the reed's motion, referred to the tip; positive against closing"), &
         & column_type("part_a_n", "N", 1.0_wp, &
         & "force on part A, the land at x < a, of pressure above the outlet's (film models)"), &
         & column_type("part_b_n", "N", 1.0_wp, "force on part B, the rest of the land (film models)"), &
         & column_type("part_c_n", "N", 1.0_wp, "force on part C, over the hole (film models)"), &
         & column_type("leakage_mm3_ms", "mm3 ms-1", 1.0e6_wp, "flow out of the film at the free edges (film models)"), &
         & column_type("film_low_kpa", "kPa", 1.0e-3_wp, "lowest pressure in the film (film models)")]
   end function trace_columns

end module rv_columns
