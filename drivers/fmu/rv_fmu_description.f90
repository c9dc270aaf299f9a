!> The model description of an FMU, and the deck its library reads.
module rv_fmu_description
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_cases, only : deck_type
   use rv_fmu_variables, only : first_input, first_output, first_parameter, inputs, is_parameter, output_count, outputs, &
      & variable_type
   use rv_keys, only : choice_count, choice_key, choice_name, default_load, from_si, full_name, integer_key, &
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

   !> modelDescription.xml of FMI 3.0 for the one case of a deck.
   subroutine describe(deck, token, text)
      type(deck_type), intent(in) :: deck
      character(len=*), intent(in) :: token   !! that the library of this FMU wants to see
      character(len=:), allocatable, intent(out) :: text
      type(text_builder) :: build
      real(wp) :: value(n_keys)
      integer :: model, kind, i

      call values_of(deck, value)
      model = nint(value(key_run_model))
      kind = nint(value(key_pressure_kind))
      call add_head(build, deck, token, value)
      call build%line("  <ModelVariables>")
      call build%line('    <Float64 name="time" valueReference="0" causality="independent" variability="continuous"' &
         & //' unit="s" description="simulation time"/>')
      do i = 1, size(inputs)
         call add_variable(build, inputs(i), first_input + i - 1, 'input" start="0')
      end do
      do i = 1, output_count(model)
         if (outputs(i)%name /= "") call add_variable(build, outputs(i), first_output + i - 1, "output")
      end do
      do i = 1, n_keys
         if (is_parameter(i, model, kind)) call add_parameter(build, i, value(i))
      end do
      call build%line("  </ModelVariables>")
      call build%line("  <ModelStructure>")
      call add_outputs(build, "Output", model)
      call add_outputs(build, "InitialUnknown", model)
      call build%line("  </ModelStructure>")
      call build%line("</fmiModelDescription>")
      text = build%text()
   end subroutine describe

   subroutine add_head(build, deck, token, value)
      type(text_builder), intent(inout) :: build
      type(deck_type), intent(in) :: deck
      character(len=*), intent(in) :: token
      real(wp), intent(in) :: value(n_keys)
      character(len=*), parameter :: nl = new_line("a")

      call build%line('<?xml version="1.0" encoding="UTF-8"?>')
      call build%line('<fmiModelDescription fmiVersion="3.0" modelName="'//escaped(deck%name)//'"' &
         & //nl//'  instantiationToken="'//token//'"' &
         & //nl//'  description="'//escaped(description_of(deck, value))//'"' &
         & //nl//'  generationTool="reedvalve '//code_version//'" variableNamingConvention="structured">')
      call build%line('  <CoSimulation modelIdentifier="'//library_name//'" canHandleVariableCommunicationStepSize="true"' &
         & //nl//'    canGetAndSetFMUState="true" canSerializeFMUState="true"/>')
      call add_units(build)
      call add_choices(build, nint(value(key_run_model)), nint(value(key_pressure_kind)))
      call build%line("  <LogCategories>")
      call build%line('    <Category name="logStatusWarning" description="what is odd but can be computed with"/>')
      call build%line('    <Category name="logStatusError" description="why a call failed; told without being asked for"/>')
      call build%line("  </LogCategories>")
      call build%line('  <DefaultExperiment startTime="0" stopTime="'//to_text(value(key_run_t_end_ms))//'" stepSize="' &
         & //to_text(value(key_run_t_end_ms)/default_steps)//'"/>')
   end subroutine add_head

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
   subroutine add_choices(build, model, kind)
      type(text_builder), intent(inout) :: build
      integer, intent(in) :: model, kind
      integer :: key, i

      call build%line("  <TypeDefinitions>")
      do key = 1, n_keys
         if (.not. is_parameter(key, model, kind) .or. keys(key)%kind /= choice_key) cycle
         call build%line('    <EnumerationType name="'//full_name(key)//'">')
         do i = 1, choice_count(key)
            call build%line('      <Item name="'//choice_name(key, i)//'" value="'//to_text(i)//'"/>')
         end do
         call build%line("    </EnumerationType>")
      end do
      call build%line("  </TypeDefinitions>")
   end subroutine add_choices

   subroutine add_variable(build, variable, reference, causality)
      type(text_builder), intent(inout) :: build
      type(variable_type), intent(in) :: variable
      integer, intent(in) :: reference
      character(len=*), intent(in) :: causality   !! and further attributes behind it, but for the last quote

      call build%line('    <Float64 name="'//trim(variable%name)//'" valueReference="'//to_text(reference)//'" causality="' &
         & //causality//'" variability="continuous" unit="'//trim(variable%unit)//'" description="' &
         & //escaped(trim(variable%meaning))//'"/>')
   end subroutine add_variable

   !> A key, in its own unit. Of the pressures of a square wave only their size matters: the caller brings pressures.
   subroutine add_parameter(build, key, value)
      type(text_builder), intent(inout) :: build
      integer, intent(in) :: key
      real(wp), intent(in) :: value   !! SI
      character(len=:), allocatable :: line, kind, meaning

      kind = "Float64"
      if (keys(key)%kind == integer_key) kind = "Int32"
      if (keys(key)%kind == choice_key) kind = "Enumeration"
      line = "    <"//kind//' name="'//full_name(key)//'" valueReference="'//to_text(first_parameter + key - 1) &
         & //'" causality="parameter" variability="fixed"'
      select case (keys(key)%kind)
      case (choice_key)
         line = line//' declaredType="'//full_name(key)//'" start="'//to_text(nint(value))//'"'
      case (integer_key)
         line = line//' min="'//to_text(nint(keys(key)%lowest))//'" max="'//to_text(nint(keys(key)%highest))//'" start="' &
            & //to_text(nint(value))//'"'
      case default
         if (keys(key)%unit /= "") line = line//' unit="'//trim(keys(key)%unit)//'"'
         line = line//' min="'//to_text(keys(key)%lowest)//'" max="'//to_text(keys(key)%highest)//'" start="' &
            & //to_text(from_si(key, value))//'"'
      end select
      meaning = trim(keys(key)%help)
      if (keys(key)%group == "pressure") meaning = "pressure to be expected at most, which the tolerance is relative to"
      call build%line(line//' description="'//escaped(meaning)//'"/>')
   end subroutine add_parameter

   subroutine add_outputs(build, element, model)
      type(text_builder), intent(inout) :: build
      character(len=*), intent(in) :: element
      integer, intent(in) :: model
      integer :: i

      do i = 1, output_count(model)
         if (outputs(i)%name /= "") call build%line("    <"//element//' valueReference="'//to_text(first_output + i - 1)//'"/>')
      end do
   end subroutine add_outputs

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

   !> As XML wants it in an attribute.
   function escaped(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: escaped
      type(text_builder) :: build
      integer :: i

      do i = 1, len(text)
         select case (text(i:i))
         case ("&")
            call build%add("&amp;")
         case ("<")
            call build%add("&lt;")
         case (">")
            call build%add("&gt;")
         case ('"')
            call build%add("&quot;")
         case (achar(0):achar(31))
            call build%add(" ")   ! most are not allowed there at all
         case default
            call build%add(text(i:i))
         end select
      end do
      escaped = build%text()
   end function escaped

end module rv_fmu_description
