!> The model description of an FMU, and the deck its library reads.
module rv_fmu_description
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_cases, only : deck_type
   use rv_fmu_elements, only : attribute, choices_element, unknowns_elements, variable_element
   use rv_fmu_variables, only : first_input, first_output, first_parameter, inputs, is_parameter, output_count, outputs, &
      & variable_type
   use rv_keys, only : choice_key, default_load, from_si, full_name, integer_key, real_key, &
      & key_hydro_load, key_pressure_event_ms, key_pressure_file, key_pressure_kind, key_reed_action_area_mm2, &
      & key_reed_hole_diameter_mm, key_run_model, key_run_t_end_ms, keys, kind_trace, load_by_model, n_keys, text_key, value_text
   use rv_kinds, only : i8, wp
   use rv_text, only : to_text
   use rv_text_builder, only : text_builder
   use rv_version, only : code_version
   implicit none
   private
   public :: describe, valve_deck, counts_text, library_name, trace_name

   character(len=*), parameter :: library_name = "reedvalve"   !! the model identifier: what the library in an FMU is called
   character(len=*), parameter :: trace_name = "trace.csv"     !! of the pressure trace beside the deck
   real(wp), parameter :: pi = acos(-1.0_wp)
   real(wp), parameter :: default_steps = 2000.0_wp            !! communication steps to the end of the run

   !> A unit of FMI: SI value = factor times the value, of these powers of kg, m and s.
   type :: unit_type
      character(len=5) :: name
      integer :: kg, m, s
      character(len=6) :: factor
   end type unit_type

   type(unit_type), parameter :: units(14) = [ &
      & unit_type("s", 0, 0, 1, "1"), unit_type("ms", 0, 0, 1, "1e-3"), unit_type("m", 0, 1, 0, "1"), &
      & unit_type("mm", 0, 1, 0, "1e-3"), unit_type("mm2", 0, 2, 0, "1e-6"), unit_type("m/s", 0, 1, -1, "1"), &
      & unit_type("m3/s", 0, 3, -1, "1"), unit_type("N", 1, 1, -2, "1"), unit_type("Pa", 1, -1, -2, "1"), &
      & unit_type("kPa", 1, -1, -2, "1e3"), unit_type("GPa", 1, -1, -2, "1e9"), unit_type("Pa/s", 1, -1, -3, "1"), &
      & unit_type("Pa s", 1, -1, -1, "1"), unit_type("kg/m3", 1, -3, 0, "1")]

contains

   !> modelDescription.xml for the one case of a deck. FMI 2.0 does not ask for time as a variable, and FMI Library, which
   !> many importers read it with, takes that for an error.
   subroutine describe(deck, fmi, token, text)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: fmi              !! version of FMI: 2 or 3
      character(len=*), intent(in) :: token   !! that the library of this FMU wants to see
      character(len=:), allocatable, intent(out) :: text
      type(text_builder) :: build
      real(wp) :: value(n_keys)
      integer :: model, kind, i

      call values_of(deck, value)
      model = nint(value(key_run_model))
      kind = nint(value(key_pressure_kind))
      call add_head(build, deck, fmi, token, value)
      call build%line("  <ModelVariables>")
      if (fmi == 3) call add_variable(build, fmi, variable_type("time", "s", "simulation time"), 0, "independent", "")
      do i = 1, size(inputs)
         call add_variable(build, fmi, inputs(i), first_input + i - 1, "input", attribute("start", "0"))
      end do
      do i = 1, output_count(model)
         if (outputs(i)%name /= "") call add_variable(build, fmi, outputs(i), first_output + i - 1, "output", "")
      end do
      do i = 1, n_keys
         if (is_parameter(i, model, kind)) call add_parameter(build, fmi, i, value(i))
      end do
      call build%line("  </ModelVariables>")
      call add_structure(build, fmi, model)
      call build%line("</fmiModelDescription>")
      text = build%text()
   end subroutine describe

   subroutine add_head(build, deck, fmi, token, value)
      type(text_builder), intent(inout) :: build
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: fmi
      character(len=*), intent(in) :: token
      real(wp), intent(in) :: value(n_keys)
      character(len=*), parameter :: nl = new_line("a")

      call build%line('<?xml version="1.0" encoding="UTF-8"?>')
      call build%line("<fmiModelDescription"//attribute("fmiVersion", to_text(fmi)//".0")//attribute("modelName", deck%name) &
         & //nl//" "//attribute(trim(merge("guid              ", "instantiationToken", fmi == 2)), token) &
         & //nl//" "//attribute("description", description_of(deck, value)) &
         & //nl//" "//attribute("generationTool", "reedvalve "//code_version) &
         & //attribute("variableNamingConvention", "structured")//">")
      call build%line("  <CoSimulation"//attribute("modelIdentifier", library_name) &
         & //attribute("canHandleVariableCommunicationStepSize", "true")//nl//"   "//abilities(fmi)//"/>")
      call add_units(build)
      call add_choices(build, fmi, nint(value(key_run_model)), nint(value(key_pressure_kind)))
      call build%line("  <LogCategories>")
      call build%line('    <Category name="logStatusWarning" description="what is odd but can be computed with"/>')
      call build%line('    <Category name="logStatusError" description="why a call failed; told without being asked for"/>')
      call build%line("  </LogCategories>")
      call build%line('  <DefaultExperiment startTime="0" stopTime="'//to_text(value(key_run_t_end_ms))//'" stepSize="' &
         & //to_text(value(key_run_t_end_ms)/default_steps)//'"/>')
   end subroutine add_head

   !> What else the library can. FMI 3.0 has no word for derivatives of inputs, and none for memory of its own.
   function abilities(fmi) result(text)
      integer, intent(in) :: fmi
      character(len=:), allocatable :: text

      if (fmi == 2) then
         text = attribute("canInterpolateInputs", "true")//attribute("canNotUseMemoryManagementFunctions", "true") &
            & //attribute("canGetAndSetFMUstate", "true")//attribute("canSerializeFMUstate", "true")
      else
         text = attribute("canGetAndSetFMUState", "true")//attribute("canSerializeFMUState", "true")
      end if
   end function abilities

   function description_of(deck, value) result(text)
      type(deck_type), intent(in) :: deck
      real(wp), intent(in) :: value(n_keys)
      character(len=:), allocatable :: text

      text = "reed valve, model '"//value_text(key_run_model, value(key_run_model))//"'"
      if (deck%title /= "") text = deck%title//": "//text
   end function description_of

   subroutine add_units(build)
      type(text_builder), intent(inout) :: build
      type(unit_type) :: unit
      integer :: i

      call build%line("  <UnitDefinitions>")
      do i = 1, size(units)
         unit = units(i)
         call build%line('    <Unit name="'//trim(unit%name)//'"><BaseUnit'//power("kg", unit%kg)//power("m", unit%m) &
            & //power("s", unit%s)//' factor="'//trim(unit%factor)//'"/></Unit>')
      end do
      call build%line("  </UnitDefinitions>")
   end subroutine add_units

   !> ' m="-1"', or nothing for the power 0.
   function power(base, exponent) result(text)
      character(len=*), intent(in) :: base
      integer, intent(in) :: exponent
      character(len=:), allocatable :: text

      text = ""
      if (exponent /= 0) text = " "//base//'="'//to_text(exponent)//'"'
   end function power

   !> The words of every key that takes one of some words.
   subroutine add_choices(build, fmi, model, kind)
      type(text_builder), intent(inout) :: build
      integer, intent(in) :: fmi, model, kind
      integer :: key

      call build%line("  <TypeDefinitions>")
      do key = 1, n_keys
         if (.not. is_parameter(key, model, kind) .or. keys(key)%kind /= choice_key) cycle
         call build%line("    "//choices_element(fmi, key))
      end do
      call build%line("  </TypeDefinitions>")
   end subroutine add_choices

   subroutine add_variable(build, fmi, variable, reference, causality, start)
      type(text_builder), intent(inout) :: build
      type(variable_type), intent(in) :: variable
      integer, intent(in) :: fmi, reference
      character(len=*), intent(in) :: causality
      character(len=*), intent(in) :: start   !! attribute, or nothing

      call build%line("    "//variable_element(fmi, real_key, attribute("name", trim(variable%name)) &
         & //attribute("valueReference", to_text(reference))//attribute("causality", causality) &
         & //attribute("variability", "continuous")//attribute("description", trim(variable%meaning)), &
         & attribute("unit", trim(variable%unit))//start))
   end subroutine add_variable

   !> A key, in its own unit. Of the pressures of a square wave only their size matters: the caller brings pressures.
   subroutine add_parameter(build, fmi, key, value)
      type(text_builder), intent(inout) :: build
      integer, intent(in) :: fmi, key
      real(wp), intent(in) :: value   !! SI
      character(len=:), allocatable :: range, meaning

      select case (keys(key)%kind)
      case (choice_key)
         range = attribute("declaredType", full_name(key))//attribute("start", to_text(nint(value)))
      case (integer_key)
         range = attribute("min", to_text(nint(keys(key)%lowest)))//attribute("max", to_text(nint(keys(key)%highest))) &
            & //attribute("start", to_text(nint(value)))
      case default
         range = attribute("min", to_text(keys(key)%lowest))//attribute("max", to_text(keys(key)%highest)) &
            & //attribute("start", to_text(from_si(key, value)))
         if (keys(key)%unit /= "") range = attribute("unit", trim(keys(key)%unit))//range
      end select
      meaning = trim(keys(key)%help)
      if (keys(key)%group == "pressure") meaning = "pressure to be expected at most, which the tolerance is relative to"
      call build%line("    "//variable_element(fmi, keys(key)%kind, attribute("name", full_name(key)) &
         & //attribute("valueReference", to_text(first_parameter + key - 1))//attribute("causality", "parameter") &
         & //attribute("variability", "fixed")//attribute("description", meaning), range))
   end subroutine add_parameter

   !> Every output depends on everything, at the start, too. FMI 2.0 wants their places among all variables, 3.0 their
   !> references.
   subroutine add_structure(build, fmi, model)
      type(text_builder), intent(inout) :: build
      integer, intent(in) :: fmi, model
      integer, allocatable :: reference(:), place(:)
      integer :: i

      reference = pack([(first_output + i - 1, i=1, output_count(model))], outputs(:output_count(model))%name /= "")
      place = [(size(inputs) + i, i=1, size(reference))]
      call build%line("  <ModelStructure>")
      call build%line("    "//unknowns_elements(fmi, "Output", place, reference))
      call build%line("    "//unknowns_elements(fmi, "InitialUnknown", place, reference))
      call build%line("  </ModelStructure>")
   end subroutine add_structure

   !> All values of the one case, with the defaults that are made of others.
   subroutine values_of(deck, value)
      type(deck_type), intent(in) :: deck
      real(wp), intent(out) :: value(n_keys)   !! SI

      call deck%case_values(1_i8, value)
      if (nint(value(key_hydro_load)) == load_by_model) value(key_hydro_load) = &
         & real(default_load(nint(value(key_run_model))), wp)
      if (ieee_is_nan(value(key_reed_action_area_mm2))) value(key_reed_action_area_mm2) = &
         & 0.25_wp*pi*value(key_reed_hole_diameter_mm)**2
   end subroutine values_of

   !> The settings of the case as a deck without sweeps, whose trace is trace_name. The area follows the hole where the
   !> deck lets it.
   subroutine valve_deck(deck, text)
      type(deck_type), intent(in) :: deck
      character(len=:), allocatable, intent(out) :: text
      type(text_builder) :: build
      real(wp) :: value(n_keys)
      character(len=:), allocatable :: group, word
      integer :: key

      call deck%case_values(1_i8, value)
      call build%add("! What '"//deck%name//"' sets, for the library of the FMU.")
      group = ""
      do key = 1, n_keys
         if (.not. is_setting(key, nint(value(key_run_model)), nint(value(key_pressure_kind)))) cycle
         word = value_text(key, value(key))
         if (key == key_pressure_file) word = trace_name
         if (word == "") cycle
         if (any(keys(key)%kind == [choice_key, text_key])) word = "'"//word//"'"
         if (keys(key)%group /= group) then
            if (group /= "") call build%add(" /")
            group = trim(keys(key)%group)
            call build%add(new_line("a")//"&"//group)
         end if
         call build%add(" "//trim(keys(key)%name)//" = "//word)
      end do
      call build%line(" /")
      text = build%text()
   end subroutine valve_deck

   !> Whether the library needs a key: a parameter, or what says which model it is and where its trace comes from.
   pure logical function is_setting(key, model, kind)
      integer, intent(in) :: key, model, kind

      is_setting = is_parameter(key, model, kind) .or. any(key == [key_run_model, key_pressure_kind])
      if (any(key == [key_pressure_file, key_pressure_event_ms])) is_setting = kind == kind_trace
   end function is_setting

   !> "4 inputs, 3 outputs, 21 parameters"
   function counts_text(deck) result(text)
      type(deck_type), intent(in) :: deck
      character(len=:), allocatable :: text
      real(wp) :: value(n_keys)
      integer :: key, model

      call deck%case_values(1_i8, value)
      model = nint(value(key_run_model))
      text = to_text(size(inputs))//" inputs, "//to_text(count(outputs(:output_count(model))%name /= ""))//" outputs, " &
         & //to_text(count([(is_parameter(key, model, nint(value(key_pressure_kind))), key=1, n_keys)]))//" parameters"
   end function counts_text

end module rv_fmu_description
