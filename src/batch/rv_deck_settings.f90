!> The base values of a deck: every group but &sweep and &design.
module rv_deck_settings
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp
   use rv_deck_reader, only : word_type
   use rv_deck_draft, only : draft_type, name_trace
   use rv_keys, only : keys, n_keys, full_name, default_value, text_key, real_key, key_run_title, key_run_model, &
      & key_run_start, key_run_t_end_ms, key_pressure_kind, key_pressure_file, kind_square, start_by_kind, start_rest, &
      & start_equilibrium, key_hydro_load, key_film_fields_ms, load_by_model, default_load, n_models
   use rv_cases, only : axis_type, deck_type
   implicit none
   private
   public :: read_settings, default_by_kind, default_by_model

   real(wp), parameter :: square_wave_end = 40.0e-3_wp  !! default of run.t_end_ms for square waves [s]

contains

   !> Put defaults and then the deck's values into the vector of values; several models are the first axis.
   subroutine read_settings(draft)
      type(draft_type), intent(inout) :: draft
      integer :: key, e

      draft%deck%title = ""
      do key = 1, n_keys
         draft%deck%value(key) = default_value(key)
      end do
      do e = 1, draft%scan%entries
         if (draft%key(e) >= 1 .and. draft%key(e) <= n_keys) call read_setting(draft, e, draft%key(e))
      end do
      call default_by_kind(draft%deck%value)
   end subroutine read_settings

   !> The defaults that depend on the pressure's kind; the end of a trace comes with its case.
   subroutine default_by_kind(value)
      real(wp), intent(inout) :: value(n_keys)
      logical :: is_square

      is_square = nint(value(key_pressure_kind)) == kind_square
      if (nint(value(key_run_start)) == start_by_kind) then
         value(key_run_start) = real(merge(start_rest, start_equilibrium, is_square), wp)
      end if
      if (is_square .and. ieee_is_nan(value(key_run_t_end_ms))) value(key_run_t_end_ms) = square_wave_end
   end subroutine default_by_kind

   !> The load's default, where all models share one; else each case takes its model's. Sweeps must have been read.
   subroutine default_by_model(deck)
      type(deck_type), intent(inout) :: deck
      integer, allocatable :: load(:)
      integer :: model

      if (nint(deck%value(key_hydro_load)) /= load_by_model) return
      load = pack([(default_load(model), model = 1, n_models)], deck%uses_model([(model, model = 1, n_models)]))
      if (all(load == load(1))) deck%value(key_hydro_load) = real(load(1), wp)
   end subroutine default_by_model

   subroutine read_setting(draft, e, key)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: e, key
      type(axis_type) :: axis
      integer :: i, n
      logical :: is_good

      n = draft%value_count(e)
      call draft%mark(key, draft%value_word(e, 1))
      draft%is_bad(key) = n == 0
      if (n > 1 .and. .not. keys(key)%list) then
         draft%is_bad(key) = .true.
         call draft%tell_surplus(e, key, list_advice(draft, e, key))
         return
      end if
      axis%key = key
      allocate(axis%value(n))
      do i = 1, n
         call draft%take_value(e, i, key, axis%value(i), is_good)
         if (.not. is_good) draft%is_bad(key) = .true.
      end do
      if (draft%is_bad(key)) return
      if (key == key_run_model) call check_models(draft, e, axis%value)
      if (keys(key)%kind == text_key) then
         call take_text(draft, e, key)
      else if (key == key_film_fields_ms) then
         call check_rising(draft, e, axis%value)
         draft%deck%fields = axis
      else
         draft%deck%value(key) = axis%value(1)
         if (n > 1) call draft%add_axis(axis)
      end if
   end subroutine read_setting

   !> What somebody who gives a list where one value is due may have wanted.
   function list_advice(draft, e, key) result(advice)
      type(draft_type), intent(in) :: draft
      integer, intent(in) :: e, key
      character(len=:), allocatable :: advice
      type(word_type) :: first, second
      logical :: has_comma

      first = draft%value_word(e, 1)
      second = draft%value_word(e, 2)
      advice = ""
      has_comma = second%first == first%last + 2
      if (has_comma) has_comma = draft%scan%reader%text(first%last + 1:first%last + 1) == ","
      if (has_comma .and. keys(key)%kind == real_key) then
         advice = "; a decimal has a point, not a comma"
      else if (keys(key)%sweepable) then
         advice = "; to vary it: &sweep key = '"//full_name(key)//"', values = ... /"
      end if
   end function list_advice

   subroutine check_models(draft, e, model)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: e
      real(wp), intent(in) :: model(:)
      integer :: i

      do i = 2, size(model)
         if (all(nint(model(:i - 1)) /= nint(model(i)))) cycle
         draft%is_bad(key_run_model) = .true.
         call draft%tell(draft%value_word(e, i), "run.model names "//draft%shown(draft%value_word(e, i))//" twice")
      end do
   end subroutine check_models

   subroutine check_rising(draft, e, time)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: e
      real(wp), intent(in) :: time(:)
      integer :: i

      do i = 2, size(time)
         if (time(i) > time(i - 1)) cycle
         draft%is_bad(key_film_fields_ms) = .true.
         call draft%tell(draft%value_word(e, i), "film.fields_ms: the times must rise, "//draft%shown(draft%value_word(e, i)) &
            & //" does not")
      end do
   end subroutine check_rising

   subroutine take_text(draft, e, key)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: e, key
      character(len=:), allocatable :: text
      integer :: place

      text = draft%scan%reader%word_text(draft%value_word(e, 1))
      if (key == key_run_title) draft%deck%title = text
      if (key /= key_pressure_file) return
      call name_trace(draft, text, draft%scan%file, draft%deck%line(key), draft%deck%column(key), place)
      draft%deck%value(key) = real(place, wp)
   end subroutine take_text

end module rv_deck_settings
