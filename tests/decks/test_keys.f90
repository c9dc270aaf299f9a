!> The key table: places, ranges, defaults, units, choices, and the template made from it.
program test_keys
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_keys, only : choice_count, choice_index, choice_name, default_value, find_key, from_si, full_name, &
      & key_design_file, key_film_gap_mm, key_fluid_density_kg_m3, key_fluid_viscosity_pa_s, key_hydro_load, &
      & key_pressure_event_ms, key_pressure_inlet_kpa, key_pressure_kind, key_reed_action_area_mm2, &
      & key_reed_density_kg_m3, key_reed_youngs_modulus_gpa, key_run_block_size, key_run_model, key_run_start, &
      & key_run_title, key_run_traces, key_solver_width, key_sweep_scale, keys, kind_square, kind_trace, &
      & model_squeeze, model_traditional, n_keys, n_models, n_rows, real_key, start_equilibrium, start_rest, &
      & to_si, value_text
   use rv_key_text, only : write_template
   use rv_deck, only : deck_type
   use rv_suggest, only : edit_distance
   use check, only : suite_type
   use deck_trial, only : read_trial
   implicit none
   type(suite_type) :: suite

   call places()
   call table()
   call units()
   call choices()
   call templates()
   call distances()
   call suite%finish()

contains

   !> The numbers of the keys are those of their rows.
   subroutine places()
      call suite%text("first", full_name(key_run_title), "run.title")
      call suite%text("run", full_name(key_run_block_size), "run.block_size")
      call suite%text("reed", full_name(key_reed_action_area_mm2), "reed.action_area_mm2")
      call suite%text("fluid", full_name(key_fluid_viscosity_pa_s), "fluid.viscosity_pa_s")
      call suite%text("hydro", full_name(key_hydro_load), "hydro.load")
      call suite%text("film", full_name(key_film_gap_mm), "film.gap_mm")
      call suite%text("pressure", full_name(key_pressure_event_ms), "pressure.event_ms")
      call suite%text("solver", full_name(key_solver_width), "solver.width")
      call suite%text("sweep", full_name(key_sweep_scale), "sweep.scale")
      call suite%text("last", full_name(key_design_file), "design.file")
      call suite%equal("two keys of one name: reed", find_key("reed", "density_kg_m3"), key_reed_density_kg_m3)
      call suite%equal("two keys of one name: fluid", find_key("fluid", "density_kg_m3"), key_fluid_density_kg_m3)
      call suite%equal("no such key", find_key("film", "density_kg_m3"), 0)
   end subroutine places

   subroutine table()
      character(len=:), allocatable :: name
      integer :: key

      do key = 1, n_rows
         name = full_name(key)
         call suite%equal(name//": found where it is", find_key(trim(keys(key)%group), trim(keys(key)%name)), key)
         call suite%true(name//": has a line of help, not cut", len_trim(keys(key)%help) > 0 &
            & .and. len_trim(keys(key)%help) < len(keys%help))
         if (keys(key)%kind /= real_key .or. key > n_keys) cycle
         call suite%true(name//": range", keys(key)%lowest < keys(key)%highest &
            & .and. keys(key)%usual_low < keys(key)%usual_high)
         if (ieee_is_nan(default_value(key))) cycle
         call suite%true(name//": default in range", from_si(key, default_value(key)) >= keys(key)%lowest &
            & .and. from_si(key, default_value(key)) <= keys(key)%highest)
      end do
      call suite%close("default of the gap", default_value(key_film_gap_mm), 5.0e-5_wp, 0.0_wp, 0.0_wp)
      call suite%close("default of Young's modulus", default_value(key_reed_youngs_modulus_gpa), 1.1e11_wp, 0.0_wp, &
         & 0.0_wp)
      call suite%equal("default of the model", nint(default_value(key_run_model)), model_squeeze)
      call suite%equal("default of traces", nint(default_value(key_run_traces)), 0)
      call suite%true("no default of the event", ieee_is_nan(default_value(key_pressure_event_ms)))
   end subroutine table

   !> What a person writes comes back as written; what is held comes back exactly.
   subroutine units()
      real(wp) :: x
      integer :: key, i, wrong

      call suite%close("0.05 mm", to_si(key_film_gap_mm, 0.05_wp), 5.0e-5_wp, 0.0_wp, 0.0_wp)
      call suite%close("0.03 mm, rounded once", to_si(key_film_gap_mm, 0.03_wp), 0.03_wp/1000.0_wp, 0.0_wp, 0.0_wp)
      call suite%text("0.05 mm", value_text(key_film_gap_mm, 5.0e-5_wp), "0.05")
      call suite%text("12.56 mm2", value_text(key_reed_action_area_mm2, to_si(key_reed_action_area_mm2, 12.56_wp)), &
         & "12.56")
      call suite%text("0.1 + 0.2 MPa", value_text(key_pressure_inlet_kpa, 1.0e6_wp*(0.1_wp + 0.2_wp)), &
         & "300.00000000000006")
      do key = 1, n_keys
         if (keys(key)%kind /= real_key) cycle
         wrong = 0
         do i = 1, 2000
            x = to_si(key, real(i, wp)/7.0_wp)
            if (abs(to_si(key, from_si(key, x)) - x) > 0.0_wp) wrong = wrong + 1
            x = real(i, wp)/200.0_wp
            if (abs(from_si(key, to_si(key, x)) - x) > 0.0_wp) wrong = wrong + 1
         end do
         call suite%equal(full_name(key)//": values changed on their way", wrong, 0)
      end do
   end subroutine units

   subroutine choices()
      call suite%equal("loads", choice_count(key_hydro_load), 4)
      call suite%text("third load", choice_name(key_hydro_load, 3), "sader")
      call suite%text("fifth load", choice_name(key_hydro_load, 5), "")
      call suite%text("no load", choice_name(key_hydro_load, 0), "")
      call suite%equal("none", choice_index(key_hydro_load, "None"), 4)
      call suite%equal("no choice", choice_index(key_hydro_load, "non"), 0)
      call suite%equal("squeeze", choice_index(key_run_model, "squeeze"), model_squeeze)
      call suite%equal("traditional", choice_index(key_run_model, "traditional"), model_traditional)
      call suite%equal("as many models", choice_count(key_run_model), n_models)
      call suite%equal("trace", choice_index(key_pressure_kind, "trace"), kind_trace)
      call suite%equal("square", choice_index(key_pressure_kind, "square"), kind_square)
      call suite%equal("rest", choice_index(key_run_start, "rest"), start_rest)
      call suite%equal("equilibrium", choice_index(key_run_start, "equilibrium"), start_equilibrium)
   end subroutine choices

   !> The template of each model reads without a remark and says what a deck without any key says.
   subroutine templates()
      character(len=:), allocatable :: text, model
      type(deck_type) :: deck, bare
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      integer :: i

      do i = 1, n_models
         model = choice_name(key_run_model, i)
         call write_template(model, text, error)
         call suite%no_error("template of "//model, error)
         call read_trial(text, deck, faults, error)
         call suite%text("template of "//model//": no remark", faults%all_text(), "")
         call read_trial("&run model = '"//model//"' /", bare, faults, error)
         call suite%text("template of "//model//": all defaults", deck%effective_text(), bare%effective_text())
      end do
      call write_template("squeze", text, error)
      call suite%fails("template of no model", error, &
         & "must be one of 'traditional', 'squeeze', 'film', 'film_table'; did you mean 'squeeze'?")
   end subroutine templates

   subroutine distances()
      call suite%equal("same", edit_distance("gap_mm", "gap_mm"), 0)
      call suite%equal("one letter more", edit_distance("gaps_mm", "gap_mm"), 1)
      call suite%equal("neighbours swapped", edit_distance("gpa_mm", "gap_mm"), 1)
      call suite%equal("kitten", edit_distance("kitten", "sitting"), 3)
      call suite%equal("nothing", edit_distance("", "abc"), 3)
   end subroutine distances

end program test_keys
