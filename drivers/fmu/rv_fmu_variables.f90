!> The variables of an FMU and the numbers that FMI calls them by. Model description and library both ask here.
!>
!> Value references: 0 is time; from 1 come the inputs, from 10 the outputs in the order of rv_out in reedvalve.h, and
!> 100 + i is the key i of rv_key_name.
module rv_fmu_variables
   use, intrinsic :: iso_c_binding, only : c_int, c_ptr, c_size_t
   use rv_columns, only : n_lumped_traces, n_traces
   use rv_c_text, only : give_text
   use rv_keys, only : choice_key, choice_name, integer_key, keys, kind_square, key_film_fields_ms, &
      & key_film_vapour_pressure_kpa, key_pressure_event_ms, key_pressure_inlet_kpa, key_pressure_kind, &
      & key_pressure_outlet_kpa, key_pressure_period_ms, key_pressure_transition_ms, key_run_block_size, key_run_compress, &
      & key_run_csv, key_run_model, key_run_t_end_ms, key_run_trace_dt_ms, key_solver_width, model_film, n_keys, real_key
   implicit none
   private
   public :: variable_type, inputs, outputs, output_count, is_parameter
   public :: first_input, first_output, first_parameter

   integer, parameter :: first_input = 1, first_output = 10, first_parameter = 100

   !> An input or output; those without a name are none.
   type :: variable_type
      character(len=20) :: name = ""
      character(len=4) :: unit = ""
      character(len=100) :: meaning = ""
   end type variable_type

   type(variable_type), parameter :: inputs(4) = [ &
      & variable_type("p_in", "Pa", "inlet pressure at the start of a step"), &
      & variable_type("p_out", "Pa", "outlet pressure at the start of a step"), &
      & variable_type("p_in_rate", "Pa/s", "slope of the inlet pressure over a step; 0: the pressure is constant"), &
      & variable_type("p_out_rate", "Pa/s", "slope of the outlet pressure over a step; 0: the pressure is constant")]

   type(variable_type), parameter :: outputs(n_traces) = [ &
      & variable_type("displacement", "m", "of the tip, positive when open"), &
      & variable_type("velocity", "m/s", "of the tip"), &
      & variable_type(), &
      & variable_type(), &
      & variable_type("film_force", "N", "of the film against the motion, referred to the tip, positive against closing"), &
      & variable_type("part_a_force", "N", "of pressure above the outlet's on part A, the land at x < a"), &
      & variable_type("part_b_force", "N", "of pressure above the outlet's on part B, the rest of the land"), &
      & variable_type("part_c_force", "N", "of pressure above the outlet's on part C, over the hole"), &
      & variable_type("leakage", "m3/s", "flow out of the film at the free edges"), &
      & variable_type("film_low", "Pa", "lowest pressure in the film")]

   !> Keys that do not matter to stepping, and those that an FMU is packed for.
   integer, parameter :: fixed_keys(13) = [key_run_model, key_run_t_end_ms, key_run_trace_dt_ms, key_run_block_size, &
      & key_run_compress, key_run_csv, key_film_fields_ms, key_pressure_kind, key_pressure_period_ms, &
      & key_pressure_transition_ms, key_pressure_event_ms, key_film_vapour_pressure_kpa, key_solver_width]

contains

   !> Outputs of a model, those without a name among them.
   pure integer function output_count(model) result(n)
      integer, intent(in) :: model

      n = merge(n_traces, n_lumped_traces, model >= model_film)
   end function output_count

   !> Whether a key is a parameter of the FMU of a model and a kind of pressure. The pressures of a square wave are: they
   !> say what is to be expected, which the tolerance is relative to.
   pure logical function is_parameter(key, model, kind)
      integer, intent(in) :: key, model, kind

      is_parameter = keys(key)%for_model(model) .and. .not. any(fixed_keys == key) &
         & .and. any(keys(key)%kind == [real_key, integer_key, choice_key])
      if (any(key == [key_pressure_inlet_kpa, key_pressure_outlet_kpa])) is_parameter = kind == kind_square
   end function is_parameter

   !> For the library in C, as the following ones: keys and outputs count from 0, models and kinds from 1.
   integer(c_int) function rv_fmu_is_output(model, which) result(yes) bind(C)
      integer(c_int), value :: model, which

      yes = 0
      if (which >= 0 .and. which < output_count(model)) yes = merge(1, 0, outputs(which + 1)%name /= "")
   end function rv_fmu_is_output

   integer(c_int) function rv_fmu_is_parameter(key, model, kind) result(yes) bind(C)
      integer(c_int), value :: key, model, kind

      yes = 0
      if (key >= 0 .and. key < n_keys) yes = merge(1, 0, is_parameter(key + 1, model, kind))
   end function rv_fmu_is_parameter

   !> The word of a choice; empty if there is none of that number.
   subroutine rv_fmu_choice(key, number, buffer, size) bind(C)
      integer(c_int), value :: key, number
      type(c_ptr), value :: buffer
      integer(c_size_t), value :: size

      !$omp critical (rv_api_text)
      call give_text(choice_name(key + 1, number), buffer, size)
      !$omp end critical (rv_api_text)
   end subroutine rv_fmu_choice

end module rv_fmu_variables
