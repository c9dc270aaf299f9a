!> A deck that has been read: base values, axes of the case product, and every case by its number.
module rv_cases
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8
   use rv_text, only : text_type
   use rv_text_builder, only : text_builder
   use rv_keys, only : keys, n_keys, n_models, full_name, value_text, choice_name, text_key, &
      & choice_key, key_run_title, key_run_model, key_run_t_end_ms, key_run_traces, key_run_trace_dt_ms, &
      & key_fluid_density_kg_m3, key_fluid_viscosity_pa_s, key_hydro_load, key_pressure_kind, key_pressure_file, &
      & model_squeeze, model_film, model_film_table, key_film_fields_ms
   use rv_trace_file, only : trace_data
   implicit none
   private
   public :: deck_type, axis_type, mention_type

   !> One axis of the product of cases.
   type :: axis_type
      integer :: key = 0
      real(wp), allocatable :: value(:)   !! as in a vector of values
      character(len=:), allocatable :: range   !! "from = 5, to = 40, count = 8" if so given; unallocated: a list
   end type axis_type

   !> Where a file is named.
   type :: mention_type
      character(len=:), allocatable :: file
      integer :: line = 0, column = 0
   end type mention_type

   !> One deck; made by read_deck.
   type :: deck_type
      character(len=:), allocatable :: path     !! as given
      character(len=:), allocatable :: name     !! file name without folder and .nml
      character(len=:), allocatable :: folder   !! of the deck, with a / at its end, or empty: file names start there
      character(len=:), allocatable :: text     !! the deck's bytes
      real(wp) :: value(n_keys) = 0.0_wp        !! base values, see rv_keys
      logical :: given(n_keys) = .false.        !! the deck names the key, as a value or in a sweep or design
      integer :: line(n_keys) = 0               !! where it does; 0: nowhere
      integer :: column(n_keys) = 0
      character(len=:), allocatable :: title
      type(text_type), allocatable :: trace_name(:)   !! names of trace files as the deck gives them
      type(mention_type), allocatable :: trace_mention(:)
      type(text_type), allocatable :: trace_file(:)   !! the same as names that open; place = value(key_pressure_file)
      type(trace_data), allocatable :: trace(:)       !! what they hold
      type(axis_type), allocatable :: axis(:)         !! the last one runs fastest
      type(axis_type) :: fields                       !! film.fields_ms [s]; values unallocated if not given
      logical :: has_design = .false.
      character(len=:), allocatable :: design_name    !! file name as the deck gives it
      character(len=:), allocatable :: design_note    !! rows and checksum of the design file
      integer, allocatable :: design_key(:)
      real(wp), allocatable :: design(:, :)           !! (keys, rows); runs faster than the axes
   contains
      procedure :: case_count
      procedure :: case_values
      procedure :: field_times
      procedure :: time_span
      procedure :: swept_keys
      procedure :: uses_model
      procedure :: matters
      procedure :: path_of
      procedure :: effective_text
   end type deck_type

contains

   !> Number of cases.
   pure integer(i8) function case_count(self) result(n)
      class(deck_type), intent(in) :: self
      integer :: i

      n = 1
      do i = 1, size(self%axis)
         n = n*size(self%axis(i)%value)
      end do
      if (self%has_design) n = n*size(self%design, 2)
   end function case_count

   !> All values of one case; only reed.action_area_mm2 and pressure.event_ms may be NaN, for their defaults.
   pure subroutine case_values(self, i, value)
      class(deck_type), intent(in) :: self
      integer(i8), intent(in) :: i                !! 1 to case_count
      real(wp), intent(out) :: value(n_keys)
      integer(i8) :: rest, n
      integer :: k, file

      value = self%value
      rest = i - 1
      if (self%has_design) then
         n = size(self%design, 2)
         value(self%design_key) = self%design(:, int(mod(rest, n)) + 1)
         rest = rest/n
      end if
      do k = size(self%axis), 1, -1
         n = size(self%axis(k)%value)
         value(self%axis(k)%key) = self%axis(k)%value(mod(rest, n) + 1)
         rest = rest/n
      end do
      if (.not. ieee_is_nan(value(key_run_t_end_ms))) return
      file = nint(value(key_pressure_file))
      if (file < 1 .or. file > size(self%trace)) return
      if (size(self%trace(file)%time) > 0) value(key_run_t_end_ms) = self%trace(file)%time(size(self%trace(file)%time))
   end subroutine case_values

   !> Times of the film pressure fields [s]; empty where none are asked for or no model has any.
   pure function field_times(self) result(time)
      class(deck_type), intent(in) :: self
      real(wp), allocatable :: time(:)

      time = [real(wp) ::]
      if (.not. any(self%uses_model([model_film, model_film_table]))) return
      if (allocated(self%fields%value)) time = self%fields%value
   end function field_times

   !> Earliest start and latest end of all cases [s].
   pure subroutine time_span(self, start, finish)
      class(deck_type), intent(in) :: self
      real(wp), intent(out) :: start, finish
      integer :: i

      start = 0.0_wp
      if (size(self%trace) > 0) start = minval([(self%trace(i)%time(1), i = 1, size(self%trace))])
      finish = self%value(key_run_t_end_ms)
      do i = 1, size(self%axis)
         if (self%axis(i)%key == key_run_t_end_ms) finish = maxval(self%axis(i)%value)
      end do
      if (self%has_design) then
         do i = 1, size(self%design_key)
            if (self%design_key(i) == key_run_t_end_ms) finish = maxval(self%design(i, :))
         end do
      end if
      if (.not. ieee_is_nan(finish)) return
      finish = start
      do i = 1, size(self%trace)
         finish = max(finish, self%trace(i)%time(size(self%trace(i)%time)))
      end do
   end subroutine time_span

   !> The keys that vary, bar the model: columns of the results, in the order of the axes.
   pure function swept_keys(self) result(list)
      class(deck_type), intent(in) :: self
      integer, allocatable :: list(:)
      integer :: i

      list = [(self%axis(i)%key, i = 1, size(self%axis))]
      if (self%has_design) list = [list, self%design_key]
      list = pack(list, list /= key_run_model)
   end function swept_keys

   !> Is any case run with this model?
   elemental logical function uses_model(self, model)
      class(deck_type), intent(in) :: self
      integer, intent(in) :: model
      integer :: i

      uses_model = nint(self%value(key_run_model)) == model
      do i = 1, size(self%axis)
         if (self%axis(i)%key == key_run_model) uses_model = any(nint(self%axis(i)%value) == model)
      end do
      if (.not. self%has_design) return
      do i = 1, size(self%design_key)
         if (self%design_key(i) == key_run_model) uses_model = any(nint(self%design(i, :)) == model)
      end do
   end function uses_model

   !> Does a key have an effect on any case?
   pure logical function matters(self, key)
      class(deck_type), intent(in) :: self
      integer, intent(in) :: key
      integer :: model
      logical :: has_load

      matters = .false.
      do model = 1, n_models
         if (keys(key)%for_model(model)) matters = matters .or. self%uses_model(model)
      end do
      if (keys(key)%for_kind > 0) matters = matters .and. nint(self%value(key_pressure_kind)) == keys(key)%for_kind
      has_load = choice_name(key_hydro_load, nint(self%value(key_hydro_load))) /= "none"
      if (key == key_run_trace_dt_ms) matters = self%value(key_run_traces) > 0.5_wp
      if (key == key_fluid_density_kg_m3) matters = has_load
      if (key == key_fluid_viscosity_pa_s) matters = has_load &
         & .or. any(self%uses_model([model_squeeze, model_film, model_film_table]))
   end function matters

   !> A file name of the deck as one that opens from here.
   pure function path_of(self, name) result(path)
      class(deck_type), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: path

      path = self%folder//name
      if (index(name, "/") == 1) path = name
   end function path_of

   !> A complete deck of every value that has an effect or was given, which read_deck takes for the same cases.
   !>
   !> Comments name the rows and checksums of the files, so that two such texts differ if a file does.
   function effective_text(self) result(text)
      class(deck_type), intent(in) :: self
      character(len=:), allocatable :: text
      type(text_builder) :: build
      character(len=:), allocatable :: group, setting
      integer :: key, i

      group = ""
      do key = 1, n_keys
         setting = base_text(self, key)
         if (setting == "") cycle
         if (keys(key)%group /= group) then
            if (group /= "") call build%line("/")
            group = trim(keys(key)%group)
            call build%line("&"//group)
         end if
         call build%line("   "//trim(keys(key)%name)//" = "//setting)
      end do
      call build%line("/")
      do i = 1, size(self%axis)
         if (self%axis(i)%key == key_run_model) cycle
         call build%line("&sweep")
         call build%line("   key = "//quoted(full_name(self%axis(i)%key))//",")
         call build%line("   "//axis_text(self, self%axis(i)))
         call build%line("/")
      end do
      if (self%has_design) then
         call build%line("&design file = "//quoted(self%design_name)//" /")
         call build%line("! "//self%design_name//": "//self%design_note)
      end if
      do i = 1, size(self%trace)
         call build%line("! "//self%trace_name(i)%s//": "//self%trace(i)%note)
      end do
      text = build%text()
   end function effective_text

   !> One base value; empty where there is none to tell.
   function base_text(self, key) result(text)
      class(deck_type), intent(in) :: self
      integer, intent(in) :: key
      character(len=:), allocatable :: text
      integer :: i

      text = ""
      if (.not. (self%matters(key) .or. self%given(key))) return
      select case (key)
      case (key_run_title)
         text = quoted(self%title)
      case (key_run_model)
         text = quoted(value_text(key, self%value(key)))
         do i = 1, size(self%axis)
            if (self%axis(i)%key == key) text = value_list(self, self%axis(i))
         end do
      case (key_film_fields_ms)
         if (allocated(self%fields%value)) text = value_list(self, self%fields)
      case (key_pressure_file)
         i = nint(self%value(key))
         if (i > 0) text = quoted(self%trace_name(i)%s)
      case default
         text = value_text(key, self%value(key))
         if (text /= "" .and. keys(key)%kind == choice_key) text = quoted(text)
      end select
   end function base_text

   !> The values of an axis as its &sweep gives them.
   function axis_text(self, axis) result(text)
      class(deck_type), intent(in) :: self
      type(axis_type), intent(in) :: axis
      character(len=:), allocatable :: text

      if (allocated(axis%range)) then
         text = axis%range
      else
         text = "values = "//value_list(self, axis)
      end if
   end function axis_text

   !> The values of an axis, a new line after every eight.
   function value_list(self, axis) result(text)
      class(deck_type), intent(in) :: self
      type(axis_type), intent(in) :: axis
      character(len=:), allocatable :: text
      type(text_builder) :: build
      integer :: i

      do i = 1, size(axis%value)
         select case (keys(axis%key)%kind)
         case (text_key)
            call build%add(quoted(self%trace_name(nint(axis%value(i)))%s))
         case (choice_key)
            call build%add(quoted(value_text(axis%key, axis%value(i))))
         case default
            call build%add(value_text(axis%key, axis%value(i)))
         end select
         if (i < size(axis%value)) call build%add(","//merge(new_line("a"), " ", mod(i, 8) == 0))
      end do
      text = build%text()
   end function value_list

   !> A text in a deck's quotes.
   pure function quoted(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: quoted
      integer :: i

      quoted = "'"
      do i = 1, len(text)
         if (text(i:i) == "'") quoted = quoted//"'"
         quoted = quoted//text(i:i)
      end do
      quoted = quoted//"'"
   end function quoted

end module rv_cases
