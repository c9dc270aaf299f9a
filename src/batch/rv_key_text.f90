!> The key table as text: a deck to start from, and the reference of all keys.
module rv_key_text
   use rv_kinds, only : wp
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_text, only : to_text
   use rv_text_builder, only : text_builder
   use rv_keys, only : keys, n_keys, n_rows, n_models, real_key, integer_key, logical_key, choice_key, text_key, &
      & choice_count, choice_name, choice_index, kind_square, key_run_model, key_run_trace_dt_ms, &
      & key_pressure_kind, key_hydro_load, default_load
   use rv_key_value, only : range_text, unknown_choice
   implicit none
   private
   public :: write_template, key_reference

contains

   !> A commented deck of one model with every key that matters to it, at its default.
   subroutine write_template(model, text, error)
      character(len=*), intent(in) :: model   !! one of the choices of run.model
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      type(text_builder) :: build
      character(len=:), allocatable :: group
      integer :: key, number

      text = ""
      number = choice_index(key_run_model, model)
      if (number == 0) then
         call fail(error, rv_bad_input, "model '"//model//"' "//unknown_choice(key_run_model, model))
         return
      end if
      call build%line("! A valve of the model '"//choice_name(key_run_model, number)//"'.")
      call build%line("! Every other value is the default; what follows a ! is not read.")
      group = ""
      do key = 1, n_keys
         if (.not. keys(key)%for_model(number)) cycle
         if (keys(key)%group /= group) then
            if (group /= "") call build%line("/")
            group = trim(keys(key)%group)
            call build%line("")
            call build%line("&"//group)
         end if
         call build%line(template_line(key, number))
      end do
      call build%line("/")
      call build%line("")
      call build%line("! Cases are all combinations of the sweeps, the last one fastest:")
      call build%line("! &sweep key = 'pressure.inlet_kpa', from = 5.0, to = 40.0, count = 8 /")
      call build%line("! &sweep key = 'reed.thickness_mm', values = 0.10, 0.15, 0.20 /")
      call build%line("! or the rows of a CSV file whose header names keys:")
      call build%line("! &design file = 'plan.csv' /")
      text = build%text()
   end subroutine write_template

   !> One key; commented out where it has no default or no effect as the deck stands.
   function template_line(key, model) result(line)
      integer, intent(in) :: key, model
      character(len=:), allocatable :: line
      character(len=*), parameter :: margin = "   "
      integer, parameter :: help_column = 40
      logical :: is_live

      is_live = keys(key)%default /= "" .and. keys(key)%for_kind <= kind_square .and. key /= key_run_trace_dt_ms
      line = trim(keys(key)%name)//" = "//default_text(key)
      if (key == key_run_model) line = trim(keys(key)%name)//" = '"//choice_name(key, model)//"'"
      if (key == key_hydro_load) then
         is_live = .true.
         line = trim(keys(key)%name)//" = '"//choice_name(key, default_load(model))//"'"
      end if
      if (line(len(line):) == " ") line = line//"..."
      if (.not. is_live) line = "! "//line
      line = margin//line//repeat(" ", max(1, help_column - len(margin) - len(line)))//"! "
      if (keys(key)%kind == choice_key) line = line//allowed_text(key)//"; "
      line = line//trim(keys(key)%help)
   end function template_line

   !> The default as a deck spells it, or nothing.
   function default_text(key) result(text)
      integer, intent(in) :: key
      character(len=:), allocatable :: text

      text = trim(keys(key)%default)
      if (text /= "" .and. any(keys(key)%kind == [choice_key, text_key])) text = "'"//text//"'"
   end function default_text

   !> What a key takes.
   function allowed_text(key) result(text)
      integer, intent(in) :: key
      character(len=:), allocatable :: text
      integer :: i

      text = ""
      select case (keys(key)%kind)
      case (real_key, integer_key)
         if (keys(key)%highest >= huge(1.0_wp)) return
         text = trim(range_text(key)//" "//keys(key)%unit)
      case (logical_key)
         text = ".true. or .false."
      case (choice_key)
         text = "'"//choice_name(key, 1)//"'"
         do i = 2, choice_count(key)
            text = text//" or '"//choice_name(key, i)//"'"
         end do
      case (text_key)
         text = "a text of at most "//to_text(nint(keys(key)%highest))//" bytes"
      case default
         text = "one value or several of the key's kind"
      end select
   end function allowed_text

   !> The reference of all keys in Markdown.
   subroutine key_reference(text)
      character(len=:), allocatable, intent(out) :: text
      type(text_builder) :: build
      character(len=:), allocatable :: group
      integer :: key

      call add_introduction(build)
      group = ""
      do key = 1, n_rows
         if (keys(key)%group /= group) then
            group = trim(keys(key)%group)
            call build%line("")
            call build%line("## &"//group)
            call build%line("")
            call build%line(about_group(group))
            call build%line("")
            call build%line("| key | takes | default | meaning | matters to | may vary |")
            call build%line("|---|---|---|---|---|---|")
         end if
         call build%line("| `"//trim(keys(key)%name)//"` | "//allowed_text(key)//" | " &
            & //code(default_text(key))//" | "//trim(keys(key)%help)//" | "//matters_text(key)//" | " &
            & //merge("yes", "no ", keys(key)%sweepable)//" |")
      end do
      text = build%text()
   end subroutine key_reference

   function code(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: code

      code = ""
      if (text /= "") code = "`"//text//"`"
   end function code

   !> The models and kinds of pressure a key has an effect on.
   function matters_text(key) result(text)
      integer, intent(in) :: key
      character(len=:), allocatable :: text
      integer :: i

      text = ""
      if (key > n_keys) return
      do i = 1, n_models
         if (keys(key)%for_model(i) .and. .not. all(keys(key)%for_model)) text = text//", model '" &
            & //choice_name(key_run_model, i)//"'"
      end do
      if (keys(key)%for_kind > 0) text = text//", kind '"//choice_name(key_pressure_kind, keys(key)%for_kind)//"'"
      if (text == "") text = ", all"
      text = text(3:)
   end function matters_text

   subroutine add_introduction(build)
      type(text_builder), intent(inout) :: build
      character(len=*), parameter :: text(29) = [character(len=108) :: &
         & "# Keys of a deck", &
         & "", &
         & "This page is generated from the key table in `src/batch/rv_keys.f90`. `reedvalve template` prints a deck", &
         & "to start from; `reedvalve check DECK` tells all that is wrong with one.", &
         & "", &
         & "A deck is a Fortran namelist file of groups `&name key = value, ... /`. Names are written in any case,", &
         & "texts in quotes, comments after `!`; `3*0.1` is 0.1 three times. Array indices, values left out between", &
         & "commas, `$name` and `&end` are refused. Every key ends in its unit. The file is UTF-8, at most 8 MiB.", &
         & "", &
         & "Cases are the product of the models in `run.model` and of all `&sweep` groups, the last one fastest; or", &
         & "the rows of a `&design` file, for each model. `film.gap_mm` is the full name of the key `gap_mm` of", &
         & "`&film`; sweeps and designs use full names. A key that may vary can be swept or be a column of a design;", &
         & "models are swept by a list in `run.model`.", &
         & "", &
         & "File names are relative to the folder of the deck. The files are CSV: columns separated by commas,", &
         & "decimals with a point, lines that start with `#` are comments. A file has at most 268435456 bytes", &
         & "(256 MiB).", &
         & "", &
         & "* A pressure trace has a header with `t_ms` (or `t_s`, `t_us`) and either `p_in_kpa` and `p_out_kpa` or", &
         & "  `p_diff_kpa` (or `_pa`, `_bar`, `_mpa`). Time must rise from row to row, and no step may be more than", &
         & "  20 times the median step. Other columns are ignored with a warning.", &
         & "* A design has a header of full names of keys; each row is a case. `run.model` and `pressure.file` may", &
         & "  be columns, too.", &
         & "", &
         & "A value outside the range that a key takes is a fault. A value far from the usual draws a warning, for", &
         & "another unit is likely: `thickness_mm = 0.00015` was probably meant in m. So does a key that has no", &
         & "effect on the chosen models or kind of pressure.", &
         & "", &
         & "Faults read `deck.nml:12:8: film.gap_mm = -0.05: must be >= 0 (mm)`: file, line, column, key, value, cure."]
      integer :: i

      do i = 1, size(text)
         call build%line(trim(text(i)))
      end do
   end subroutine add_introduction

   pure function about_group(group) result(text)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: text

      select case (group)
      case ("run")
         text = "What is run and what is stored."
      case ("reed")
         text = "The reed, Fig. 2 and Table II of the paper."
      case ("fluid")
         text = "The fluid around it."
      case ("hydro")
         text = "Added mass and damping of the fluid; docs/theory.md has the equations and the choices."
      case ("film")
         text = "The squeeze film between reed and seat."
      case ("pressure")
         text = "The pressures that drive the reed."
      case ("solver")
         text = "The time integration."
      case ("sweep")
         text = "One axis of the cases; the group may come several times."
      case ("design")
         text = "Cases from a file, instead of sweeps."
      case default
         text = ""
      end select
   end function about_group

end module rv_key_text
