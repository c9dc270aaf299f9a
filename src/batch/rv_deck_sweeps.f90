!> The axes of a deck: its &sweep groups.
module rv_deck_sweeps
   use rv_kinds, only : wp
   use rv_text, only : lower, to_text
   use rv_number, only : tidy
   use rv_deck_reader, only : word_type
   use rv_deck_draft, only : draft_type, name_trace
   use rv_keys, only : keys, n_keys, n_rows, find_key, full_name, real_key, to_si, from_si, value_text, choice_name, &
      & key_run_model, key_pressure_file, key_sweep_key, key_sweep_values, key_sweep_from, key_sweep_to, &
      & key_sweep_count, key_sweep_scale
   use rv_key_value, only : names_of_keys, suggestion
   use rv_cases, only : axis_type
   implicit none
   private
   public :: read_sweeps, find_swept_key

contains

   !> Add an axis for every &sweep.
   subroutine read_sweeps(draft)
      type(draft_type), intent(inout) :: draft
      integer :: g

      do g = 1, draft%scan%groups
         if (draft%group_name(g) == "sweep") call read_sweep(draft, g)
      end do
   end subroutine read_sweeps

   subroutine read_sweep(draft, g)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: g
      integer :: entry(n_rows)   !! of each key of the group; 0: not given
      type(axis_type) :: axis
      integer :: e
      logical :: is_good

      entry = 0
      do e = draft%scan%group(g)%first_entry, draft%scan%group(g)%last_entry
         if (draft%key(e) > 0) entry(draft%key(e)) = e
      end do
      call read_swept_key(draft, g, entry(key_sweep_key), axis%key)
      if (axis%key == 0) return
      call check_form(draft, g, entry, axis%key, is_good)
      if (.not. is_good) return
      if (entry(key_sweep_values) > 0) then
         call read_list(draft, entry(key_sweep_values), axis, is_good)
      else
         call read_range(draft, g, entry, axis, is_good)
      end if
      if (is_good) call draft%add_axis(axis)
      if (.not. is_good) draft%is_bad(axis%key) = .true.
   end subroutine read_sweep

   !> Find the key a sweep varies; 0 if there is none, or its fault is told.
   subroutine read_swept_key(draft, g, e, key)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: g, e
      integer, intent(out) :: key
      type(word_type) :: word
      character(len=:), allocatable :: name, trouble
      real(wp) :: unused
      logical :: is_good

      key = 0
      if (e == 0) then
         call draft%tell(draft%scan%group(g)%name, "&sweep: sweep.key must name the key to vary: key = 'group.name'")
         return
      end if
      word = draft%value_word(e, 1)
      if (draft%value_count(e) /= 1) then
         if (draft%value_count(e) > 1) call draft%tell(draft%value_word(e, 2), "sweep.key: one key for each &sweep")
         return
      end if
      call draft%take_value(e, 1, key_sweep_key, unused, is_good)
      if (.not. is_good) return
      name = draft%scan%reader%word_text(word)
      call find_swept_key(name, key, trouble)
      if (key == key_run_model) trouble = "list the models in &run: model = 'traditional', 'squeeze'"
      if (trouble == "" .and. key > 0) trouble = repeat_trouble(draft, key)
      if (trouble == "") then
         draft%sweep_line(key) = word%start%line
         call draft%mark(key, word)
      else
         call draft%tell(word, "sweep.key = "//draft%shown(word)//": "//trouble)
         key = 0
      end if
   end subroutine read_swept_key

   !> Find a key by its full name; `trouble` is empty if it is one that can vary.
   subroutine find_swept_key(name, key, trouble)
      character(len=*), intent(in) :: name
      integer, intent(out) :: key   !! 0 if there is none
      character(len=:), allocatable, intent(out) :: trouble
      character(len=:), allocatable :: low
      integer :: dot, other

      trouble = ""
      low = lower(name)
      dot = index(low, ".")
      key = 0
      if (dot > 1) key = find_key(low(:dot - 1), low(dot + 1:))
      if (key == 0) then
         trouble = "there is no such key"//suggestion(low, names_of_keys())
         do other = 1, n_keys
            if (keys(other)%name == low) trouble = "write it with its group: '"//full_name(other)//"'"
         end do
      else if (.not. keys(key)%sweepable) then
         trouble = "this key cannot vary from case to case; real keys, run.model and pressure.file can"
      end if
   end subroutine find_swept_key

   function repeat_trouble(draft, key) result(trouble)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: key
      character(len=:), allocatable :: trouble

      trouble = ""
      if (draft%sweep_line(key) > 0) trouble = "it is swept already in line "//to_text(draft%sweep_line(key))
   end function repeat_trouble

   !> Either values, or from, to and count?
   subroutine check_form(draft, g, entry, key, is_good)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: g, entry(n_rows), key
      logical, intent(out) :: is_good
      character(len=*), parameter :: rule = "give either values, or from, to and count"
      integer, parameter :: range_keys(4) = [key_sweep_from, key_sweep_to, key_sweep_count, key_sweep_scale]
      logical :: has(4), has_values
      character(len=:), allocatable :: trouble

      has = entry(range_keys) > 0
      has_values = entry(key_sweep_values) > 0
      trouble = ""
      if (has_values .and. any(has)) then
         trouble = rule//", not both"
      else if (any(has) .and. keys(key)%kind /= real_key) then
         trouble = "it has no numbers between from and to; list its values"
      else if (.not. (has_values .or. all(has(:3)))) then
         trouble = rule
      end if
      is_good = trouble == ""
      if (is_good) return
      associate (group => draft%scan%group(g))   ! a misspelt key there has been told, and is what is missing
         if (any(draft%key(group%first_entry:group%last_entry) == 0)) return
         call draft%tell(group%name, "&sweep of "//full_name(key)//": "//trouble)
      end associate
   end subroutine check_form

   !> The axis of a list of values.
   subroutine read_list(draft, e, axis, is_good)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: e
      type(axis_type), intent(inout) :: axis
      logical, intent(out) :: is_good
      type(word_type) :: word
      integer :: i, n, place
      logical :: is_read

      n = draft%value_count(e)
      allocate(axis%value(n))
      is_good = n > 0
      do i = 1, n
         call draft%take_value(e, i, axis%key, axis%value(i), is_read)
         is_good = is_good .and. is_read
         if (.not. is_read .or. axis%key /= key_pressure_file) cycle
         word = draft%value_word(e, i)
         call name_trace(draft, draft%scan%reader%word_text(word), draft%scan%file, word%start%line, &
            & word%start%column, place)
         axis%value(i) = real(place, wp)
      end do
      if (is_good) call warn_repeats(draft, e, axis%value)
   end subroutine read_list

   !> A value that comes twice is hardly meant.
   subroutine warn_repeats(draft, e, value)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: e
      real(wp), intent(in) :: value(:)
      integer, parameter :: most_compared = 1000   ! the search is quadratic
      integer :: i

      if (size(value) > most_compared) return
      do i = 2, size(value)
         if (all(abs(value(:i - 1) - value(i)) > 0.0_wp)) cycle
         call draft%warn(draft%value_word(e, i), "sweep.values: "//draft%shown(draft%value_word(e, i)) &
            & //" a second time; its cases are run twice")
         return
      end do
   end subroutine warn_repeats

   !> The axis of from, to and count.
   subroutine read_range(draft, g, entry, axis, is_good)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: g, entry(n_rows)
      type(axis_type), intent(inout) :: axis
      logical, intent(out) :: is_good
      real(wp) :: from, to, count, scale
      logical :: good(4)

      scale = 1.0_wp
      good = .true.
      call read_one(draft, entry(key_sweep_from), axis%key, from, good(1))
      call read_one(draft, entry(key_sweep_to), axis%key, to, good(2))
      call read_one(draft, entry(key_sweep_count), key_sweep_count, count, good(3))
      if (entry(key_sweep_scale) > 0) call read_one(draft, entry(key_sweep_scale), key_sweep_scale, scale, good(4))
      is_good = all(good)
      if (.not. is_good) return
      if (abs(to - from) <= 0.0_wp) then
         call draft%tell(draft%value_word(entry(key_sweep_to), 1), "sweep.to must differ from sweep.from")
         is_good = .false.
      else if (nint(scale) == 2 .and. min(from, to) <= 0.0_wp) then
         call draft%tell(draft%scan%group(g)%name, "&sweep of "//full_name(axis%key) &
            & //": scale = 'log' needs from and to > 0")
         is_good = .false.
      end if
      if (.not. is_good) return
      axis%value = to_si(axis%key, points(from_si(axis%key, from), from_si(axis%key, to), nint(count), &
         & is_log=nint(scale) == 2))
      axis%range = "from = "//value_text(axis%key, from)//", to = "//value_text(axis%key, to)//", count = " &
         & //to_text(nint(count))
      if (nint(scale) == 2) axis%range = axis%range//", scale = '"//choice_name(key_sweep_scale, 2)//"'"
   end subroutine read_range

   !> Read an entry that has one value.
   subroutine read_one(draft, e, key, value, is_good)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: e, key
      real(wp), intent(out) :: value
      logical, intent(out) :: is_good

      value = 0.0_wp
      is_good = draft%value_count(e) == 1
      if (is_good) call draft%take_value(e, 1, key, value, is_good)
      if (draft%value_count(e) > 1) call draft%tell_surplus(e, key, "")
   end subroutine read_one

   !> `n` numbers from `from` to `to`, equal differences or equal ratios apart, rounded to what a person would write.
   pure function points(from, to, n, is_log) result(x)
      real(wp), intent(in) :: from, to
      integer, intent(in) :: n   !! >= 2
      logical, intent(in) :: is_log
      real(wp) :: x(n)
      real(wp) :: share(n)
      integer :: i

      share = [(real(i, wp)/real(n - 1, wp), i = 0, n - 1)]
      if (is_log) then
         x = tidy(from*(to/from)**share)
      else
         x = tidy([((from*real(n - 1 - i, wp) + to*real(i, wp))/real(n - 1, wp), i = 0, n - 1)])
      end if
      x(1) = from
      x(n) = to
   end function points

end module rv_deck_sweeps
