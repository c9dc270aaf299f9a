!> The settings of one valve: any key of a deck by its name, checked as a deck is.
!>
!> Most of what it calls has deferred-length results, which threads must not share (see rv_text): callers see to that.
module rv_setup
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_text, only : text_type, lower, to_text
   use rv_faults, only : fault_list, clip
   use rv_text_builder, only : append_text
   use rv_deck, only : read_deck, start_deck
   use rv_deck_check, only : check_deck
   use rv_deck_draft, only : draft_type, name_trace
   use rv_deck_settings, only : default_by_kind, default_by_model
   use rv_cases, only : deck_type
   use rv_keys, only : keys, n_keys, find_key, full_name, default_value, from_si, to_si, value_text, real_key, &
      & logical_key, choice_key, text_key, key_run_title, key_film_fields_ms, key_film_gap_mm, key_pressure_file
   use rv_key_value, only : read_value, odd_value, suggestion
   implicit none
   private
   public :: setup_type, new_setup, read_setup, find_any_key

   character(len=*), parameter :: no_fields = "pressure fields go to the results of a run of a deck; a valve has none"
   real(wp), parameter :: surely_fine_gap = 1.0e-6_wp         !! in mm; smaller ones have a rule of their own

   !> Settings; build them with new_setup or read_setup.
   type :: setup_type
      type(deck_type), private :: deck    !! what was set, else the keys' defaults; of one case
      type(deck_type) :: ready            !! the same checked and complete, if is_checked
      logical :: is_checked = .false.
   contains
      procedure :: set
      procedure :: get_number
      procedure :: get_word
      procedure :: tell_set
      procedure :: check
      procedure :: sweep
   end type setup_type

contains

   !> Every key has its default.
   subroutine new_setup(self)
      type(setup_type), intent(out) :: self

      call start_deck("", self%deck)
      self%deck%text = ""
      call put_defaults(self%deck)
   end subroutine new_setup

   !> The settings of a deck of one case. `error` tells all its faults, `warnings` what it warns of.
   subroutine read_setup(self, path, warnings, error)
      type(setup_type), intent(out) :: self
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: warnings
      type(error_type), allocatable, intent(out) :: error
      type(fault_list) :: faults
      real(wp) :: value(n_keys)

      warnings = ""
      call read_deck(path, self%deck, faults, error)
      if (allocated(error)) return
      warnings = faults%all_text()
      if (faults%errors() > 0) then
         call fail(error, rv_bad_input, warnings)
      else if (self%deck%case_count() /= 1_i8) then
         call fail(error, rv_bad_input, path//": a deck of "//to_text(self%deck%case_count()) &
            & //" cases; a valve is one case, a sweep runs many")
      end if
      if (allocated(error)) return
      if (self%deck%given(key_film_fields_ms)) warnings = warnings//path//": warning: film.fields_ms: "//no_fields//new_line("a")
      call self%deck%case_values(1_i8, value)
      call make_plain(self%deck, value)
   end subroutine read_setup

   !> The only case of a deck as base values, without axes; the defaults stay open to change with what is set later.
   subroutine make_plain(deck, value)
      type(deck_type), intent(inout) :: deck
      real(wp), intent(in) :: value(n_keys)
      character(len=:), allocatable :: file
      logical :: given(n_keys)

      given = deck%given
      call put_defaults(deck)
      where (given) deck%value = value
      deck%line = 0
      deck%column = 0
      deck%has_design = .false.
      deck%given(key_film_fields_ms) = .false.
      if (allocated(deck%fields%value)) deallocate(deck%fields%value)
      deallocate(deck%axis, deck%trace)
      allocate(deck%axis(0))
      if (nint(value(key_pressure_file)) < 1) return
      file = deck%trace_name(nint(value(key_pressure_file)))%s
      call put_trace(deck, file)
   end subroutine make_plain

   subroutine put_defaults(deck)
      type(deck_type), intent(inout) :: deck
      integer :: key

      do key = 1, n_keys
         deck%value(key) = default_value(key)
      end do
   end subroutine put_defaults

   !> Name the one trace file.
   subroutine put_trace(deck, name)
      type(deck_type), intent(inout) :: deck
      character(len=*), intent(in) :: name
      type(draft_type) :: draft
      integer :: place

      draft%deck = deck
      deallocate(draft%deck%trace_name, draft%deck%trace_mention, draft%deck%trace_file)
      allocate(draft%deck%trace_name(0), draft%deck%trace_mention(0), draft%deck%trace_file(0))
      call name_trace(draft, name, deck%path, 0, 0, place)
      deck = draft%deck
      deck%value(key_pressure_file) = real(place, wp)
   end subroutine put_trace

   !> Set a key from a word as it stands in a deck, texts and choices without their quotes.
   subroutine set(self, name, word, is_number, warning, error)
      class(setup_type), intent(inout) :: self
      character(len=*), intent(in) :: name, word
      logical, intent(in) :: is_number                        !! of the caller's: no word for a key that takes words
      character(len=:), allocatable, intent(out) :: warning   !! empty: none
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: trouble, spelt
      real(wp) :: value
      integer :: key

      warning = ""
      call find_any_key(name, key, error)
      if (allocated(error)) return
      spelt = word
      if (is_number .and. keys(key)%kind == logical_key) then   ! 1 and 0 are what get_number tells
         if (word == "1") spelt = ".true."
         if (word == "0") spelt = ".false."
      end if
      call read_value(key, spelt, any(keys(key)%kind == [choice_key, text_key]), value, trouble)
      if (is_number .and. keys(key)%kind == text_key) trouble = "it is a word: set it as text"
      if (key == key_film_fields_ms) trouble = no_fields
      if (trouble /= "") then
         call fail(error, rv_bad_input, full_name(key)//" = "//clip(word, 40)//": "//trouble)
         return
      end if
      if (odd_value(key, value) /= "") warning = full_name(key)//" = "//clip(word, 40)//": "//odd_value(key, value)
      self%is_checked = .false.
      self%deck%given(key) = .true.
      select case (key)
      case (key_run_title)
         self%deck%title = word
      case (key_pressure_file)
         call put_trace(self%deck, word)
      case default
         self%deck%value(key) = value
      end select
   end subroutine set

   !> The value of a key in its own unit; NaN where it has none. Choices and files are words.
   subroutine get_number(self, name, value, error)
      class(setup_type), intent(in) :: self
      character(len=*), intent(in) :: name
      real(wp), intent(out) :: value
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: all_values(n_keys)
      integer :: key

      value = default_value(key_film_fields_ms)   ! none: NaN
      call find_any_key(name, key, error)
      if (allocated(error)) return
      if (any(keys(key)%kind == [choice_key, text_key])) then
         call fail(error, rv_bad_input, full_name(key)//": it is a word: ask for it as text")
         return
      end if
      all_values = self%deck%value
      call default_by_kind(all_values)
      value = from_si(key, all_values(key))
   end subroutine get_number

   !> The value of any key as a deck spells it, without quotes; empty where it has none.
   subroutine get_word(self, name, word, error)
      class(setup_type), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable, intent(out) :: word
      type(error_type), allocatable, intent(out) :: error
      type(deck_type) :: deck
      integer :: key

      word = ""
      call find_any_key(name, key, error)
      if (allocated(error)) return
      deck = self%deck
      call default_by_kind(deck%value)
      call default_by_model(deck)
      word = value_text(key, deck%value(key))
      if (key == key_run_title) word = deck%title
      if (key == key_pressure_file .and. size(deck%trace_name) > 0) word = deck%trace_name(1)%s
   end subroutine get_word

   !> Whether a key has been given, by the deck or by `set`.
   subroutine tell_set(self, name, is_set, error)
      class(setup_type), intent(in) :: self
      character(len=*), intent(in) :: name
      logical, intent(out) :: is_set
      type(error_type), allocatable, intent(out) :: error
      integer :: key

      is_set = .false.
      call find_any_key(name, key, error)
      if (.not. allocated(error)) is_set = self%deck%given(key)
   end subroutine tell_set

   !> Make `ready`: what keys must share, and the trace file.
   subroutine check(self, warnings, error)
      class(setup_type), intent(inout) :: self
      character(len=:), allocatable, intent(out) :: warnings
      type(error_type), allocatable, intent(out) :: error

      warnings = ""
      if (self%is_checked) return
      call complete(self%deck, self%ready, warnings, error)
      self%is_checked = .not. allocated(error)
   end subroutine check

   !> A deck whose cases differ from these settings in some keys.
   subroutine sweep(self, names, number, deck, warnings, error)
      class(setup_type), intent(in) :: self
      type(text_type), intent(in) :: names(:)
      real(wp), intent(in) :: number(:, :)      !! in the keys' units, (size(names), cases)
      type(deck_type), intent(out) :: deck
      character(len=:), allocatable, intent(out) :: warnings
      type(error_type), allocatable, intent(out) :: error
      type(deck_type) :: base
      integer :: i

      warnings = ""
      base = self%deck
      allocate(base%design_key(size(names)), base%design(size(names), size(number, 2)))
      do i = 1, size(names)
         call find_any_key(names(i)%s, base%design_key(i), error)
         if (.not. allocated(error)) call check_column(base%design_key(:i), number(i, :), error)
         if (allocated(error)) return
         base%design(i, :) = to_si(base%design_key(i), number(i, :))
         base%given(base%design_key(i)) = .true.
      end do
      base%has_design = .true.
      call complete(base, deck, warnings, error)
   end subroutine sweep

   !> Whether a key can vary, does not come twice, and takes all these numbers.
   subroutine check_column(column, number, error)
      integer, intent(in) :: column(:)       !! keys, the last one is looked at
      real(wp), intent(in) :: number(:)
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: trouble
      real(wp) :: unused
      integer :: key, i

      key = column(size(column))
      trouble = ""
      if (.not. keys(key)%sweepable .or. keys(key)%kind /= real_key) trouble = "only real keys can vary from case to case"
      if (any(column(:size(column) - 1) == key)) trouble = "a second column of this key"
      if (trouble /= "") then
         call fail(error, rv_bad_input, full_name(key)//": "//trouble)
         return
      end if
      do i = 1, size(number)
         if (number(i) >= keys(key)%lowest .and. number(i) <= keys(key)%highest &
            & .and. (key /= key_film_gap_mm .or. number(i) >= surely_fine_gap)) cycle
         call read_value(key, to_text(number(i)), .false., unused, trouble)
         if (trouble == "") cycle
         call fail(error, rv_bad_input, "case "//to_text(i)//": "//full_name(key)//" = "//to_text(number(i))//": "//trouble)
         return
      end do
   end subroutine check_column

   !> Defaults that depend on other keys, and all checks but those of single values.
   subroutine complete(deck, ready, warnings, error)
      type(deck_type), intent(in) :: deck
      type(deck_type), intent(out) :: ready
      character(len=:), allocatable, intent(out) :: warnings
      type(error_type), allocatable, intent(out) :: error
      type(draft_type) :: draft

      draft%deck = deck
      draft%scan%file = deck%path
      call default_by_kind(draft%deck%value)
      call default_by_model(draft%deck)
      call check_deck(draft)
      warnings = draft%faults%all_text()
      if (draft%faults%errors() > 0) then
         call fail(error, rv_bad_input, warnings)
      else
         ready = draft%deck
      end if
   end subroutine complete

   !> The key of a full name, "film.gap_mm", in any case. Those of &sweep and &design are no settings.
   subroutine find_any_key(name, key, error)
      character(len=*), intent(in) :: name
      integer, intent(out) :: key
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: low, advice
      type(text_type), allocatable :: list(:)
      integer :: dot, other

      low = lower(name)
      dot = index(low, ".")
      key = 0
      if (dot > 1) key = find_key(low(:dot - 1), low(dot + 1:))
      if (key >= 1 .and. key <= n_keys) return
      allocate(list(0))
      do other = 1, n_keys
         call append_text(list, full_name(other))
      end do
      advice = suggestion(clip(low, 60), list)
      do other = 1, n_keys
         if (keys(other)%name == low) advice = "; write it with its group: '"//full_name(other)//"'"
      end do
      if (key > n_keys) advice = " of one valve; a sweep runs many cases"
      call fail(error, rv_bad_input, "'"//clip(name, 60)//"': there is no such key"//advice)
   end subroutine find_any_key

end module rv_setup
