!> A deck while it is being read: its words, what they name, what was wrong, and the deck so far.
module rv_deck_draft
   use rv_kinds, only : wp
   use rv_text, only : text_type, lower, to_text
   use rv_text_builder, only : append_text
   use rv_faults, only : fault_list, clip
   use rv_deck_reader, only : word_type
   use rv_deck_scan, only : deck_scan, entry_type, group_type
   use rv_keys, only : keys, n_rows, find_key, full_name
   use rv_key_value, only : read_value, odd_value, names_of_group, suggestion, unit_advice
   use rv_cases, only : deck_type, axis_type, mention_type
   implicit none
   private
   public :: draft_type, find_keys, name_trace

   !> Everything the parts of read_deck share.
   type :: draft_type
      type(deck_scan) :: scan
      integer, allocatable :: key(:)       !! row of the key table each entry names; 0: none, or its fault is told
      logical :: is_bad(n_rows) = .false.  !! a fault was found in the key's value
      integer :: sweep_line(n_rows) = 0    !! where each key is swept; 0: it is not
      type(deck_type) :: deck
      type(fault_list) :: faults
   contains
      procedure :: tell
      procedure :: warn
      procedure :: mark
      procedure :: group_name
      procedure :: value_count
      procedure :: value_word
      procedure :: shown
      procedure :: take_value
      procedure :: tell_surplus
      procedure :: add_axis
   end type draft_type

   integer, parameter :: most_trace_files = 1000

contains

   !> Find what every entry names; tell unknown and repeated groups and keys.
   subroutine find_keys(draft)
      type(draft_type), intent(inout) :: draft
      character(len=:), allocatable :: group
      integer :: g, e

      allocate(draft%key(draft%scan%entries))
      draft%key = 0
      do g = 1, draft%scan%groups
         if (draft%scan%group(g)%name%is_broken) cycle
         group = draft%group_name(g)
         if (.not. any(keys%group == group)) then
            call draft%tell(draft%scan%group(g)%name, "&"//clip(group, 40)//": there is no such group" &
               & //suggestion(group, names_of_groups()))
            cycle
         end if
         call check_repeated_group(draft, g)
         if (draft%scan%group(g)%is_empty .and. group /= "sweep" .and. group /= "design") then
            call draft%warn(draft%scan%group(g)%name, "&"//group//" is empty")
         end if
         do e = draft%scan%group(g)%first_entry, draft%scan%group(g)%last_entry
            call find_entry(draft, group, draft%scan%group(g)%first_entry, e)
         end do
      end do
   end subroutine find_keys

   !> Only &sweep may come more than once.
   subroutine check_repeated_group(draft, g)
      type(draft_type), intent(inout) :: draft
      integer, intent(in) :: g
      integer :: other

      if (draft%group_name(g) == "sweep") return
      do other = 1, g - 1
         if (draft%group_name(other) /= draft%group_name(g)) cycle
         call draft%tell(draft%scan%group(g)%name, "&"//draft%group_name(g)//" a second time; the first is in line " &
            & //to_text(draft%scan%group(other)%name%start%line)//": put all its keys there")
         return
      end do
   end subroutine check_repeated_group

   !> Find what one entry names.
   subroutine find_entry(draft, group, first, e)
      type(draft_type), intent(inout) :: draft
      character(len=*), intent(in) :: group
      integer, intent(in) :: first   !! entry of the group
      integer, intent(in) :: e
      character(len=:), allocatable :: name
      integer :: key, other

      if (draft%scan%entry(e)%name%is_broken) return
      name = lower(draft%scan%reader%word_text(draft%scan%entry(e)%name))
      key = find_key(group, name)
      if (key == 0) then
         call draft%tell(draft%scan%entry(e)%name, group//"."//clip(name, 40)//": there is no such key" &
            & //key_advice(group, name))
         return
      end if
      do other = first, e - 1
         if (draft%key(other) /= key) cycle
         call draft%tell(draft%scan%entry(e)%name, full_name(key)//" a second time; the first is in line " &
            & //to_text(draft%scan%entry(other)%name%start%line))
         return
      end do
      draft%key(e) = key
   end subroutine find_entry

   !> Where an unknown key may belong, or what it may be.
   function key_advice(group, name) result(advice)
      character(len=*), intent(in) :: group, name
      character(len=:), allocatable :: advice
      integer :: key

      advice = suggestion(name, names_of_group(group))
      do key = 1, n_rows
         if (keys(key)%name == name) advice = "; it belongs to &"//trim(keys(key)%group)
      end do
   end function key_advice

   function names_of_groups() result(list)
      type(text_type), allocatable :: list(:)
      integer :: key

      allocate(list(0))
      do key = 1, n_rows
         if (all(keys(:key - 1)%group /= keys(key)%group)) call append_text(list, trim(keys(key)%group))
      end do
   end function names_of_groups

   !> Add a fault at a word of the deck.
   subroutine tell(self, word, text)
      class(draft_type), intent(inout) :: self
      type(word_type), intent(in) :: word
      character(len=*), intent(in) :: text

      call self%faults%add(self%scan%file, word%start%line, word%start%column, text)
   end subroutine tell

   !> Add a warning at a word of the deck.
   subroutine warn(self, word, text)
      class(draft_type), intent(inout) :: self
      type(word_type), intent(in) :: word
      character(len=*), intent(in) :: text

      call self%faults%warn(self%scan%file, word%start%line, word%start%column, text)
   end subroutine warn

   !> Note that a word of the deck gives a key.
   subroutine mark(self, key, word)
      class(draft_type), intent(inout) :: self
      integer, intent(in) :: key
      type(word_type), intent(in) :: word

      self%deck%given(key) = .true.
      self%deck%line(key) = word%start%line
      self%deck%column(key) = word%start%column
   end subroutine mark

   !> The name of a group in lower case.
   function group_name(self, g) result(name)
      class(draft_type), intent(in) :: self
      integer, intent(in) :: g
      character(len=:), allocatable :: name

      name = lower(self%scan%reader%word_text(self%scan%group(g)%name))
   end function group_name

   !> Number of values of an entry.
   pure integer function value_count(self, e)
      class(draft_type), intent(in) :: self
      integer, intent(in) :: e

      value_count = self%scan%entry(e)%last_value - self%scan%entry(e)%first_value + 1
   end function value_count

   !> The i-th value of an entry; its name if it has none.
   pure function value_word(self, e, i) result(word)
      class(draft_type), intent(in) :: self
      integer, intent(in) :: e, i
      type(word_type) :: word

      word = self%scan%entry(e)%name
      if (i <= self%value_count(e)) word = self%scan%value(self%scan%entry(e)%first_value + i - 1)
   end function value_word

   !> A word as it stands in the deck, cut to fit into a message.
   function shown(self, word) result(text)
      class(draft_type), intent(in) :: self
      type(word_type), intent(in) :: word
      character(len=:), allocatable :: text

      text = clip(self%scan%reader%word_text(word), 40)
      if (word%quote /= " ") text = word%quote//text//word%quote
   end function shown

   !> Read the i-th value of an entry as one of `key`; tell what is wrong, and warn of what is odd.
   subroutine take_value(self, e, i, key, value, is_good)
      class(draft_type), intent(inout) :: self
      integer, intent(in) :: e, i, key
      real(wp), intent(out) :: value
      logical, intent(out) :: is_good
      type(word_type) :: word
      character(len=:), allocatable :: trouble

      word = self%value_word(e, i)
      value = 0.0_wp
      is_good = .not. word%is_broken
      if (word%is_broken) return
      call read_value(key, self%scan%reader%word_text(word), word%quote /= " ", value, trouble)
      is_good = trouble == ""
      if (.not. is_good) then
         call self%tell(word, full_name(key)//" = "//self%shown(word)//": "//trouble)
      else if (odd_value(key, value) /= "") then
         call self%warn(word, full_name(key)//" = "//self%shown(word)//": "//odd_value(key, value))
      end if
   end subroutine take_value

   !> Tell of an entry that has more than one value where one of `key` is due: a unit in place of the second, or `advice`.
   subroutine tell_surplus(self, e, key, advice)
      class(draft_type), intent(inout) :: self
      integer, intent(in) :: e, key
      character(len=*), intent(in) :: advice
      character(len=:), allocatable :: text
      type(word_type) :: second

      second = self%value_word(e, 2)
      text = full_name(self%key(e))//": one value is due, "//to_text(self%value_count(e))//" are given"
      if (second%quote == " " .and. scan(self%scan%reader%word_text(second), "+-.0123456789") /= 1) then
         text = text//unit_advice(key)
      else
         text = text//advice
      end if
      call self%tell(second, text)
   end subroutine tell_surplus

   !> One more axis, which runs faster than those before it.
   subroutine add_axis(self, axis)
      class(draft_type), intent(inout) :: self
      type(axis_type), intent(in) :: axis
      type(axis_type), allocatable :: longer(:)
      integer :: n

      n = size(self%deck%axis)
      allocate(longer(n + 1))
      longer(:n) = self%deck%axis
      longer(n + 1) = axis
      call move_alloc(longer, self%deck%axis)
   end subroutine add_axis

   !> The place of a trace file in the deck's list, in which it is put if it is not there; 0 if the list is full.
   subroutine name_trace(draft, name, file, line, column, place)
      type(draft_type), intent(inout) :: draft
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: file    !! that names it, and where
      integer, intent(in) :: line, column
      integer, intent(out) :: place
      type(mention_type), allocatable :: longer(:)

      do place = 1, size(draft%deck%trace_name)
         if (draft%deck%trace_name(place)%s == name) return
      end do
      if (place > most_trace_files) then
         call draft%faults%add(file, line, column, "more than "//to_text(most_trace_files)//" trace files in one deck")
         place = 0
         return
      end if
      call append_text(draft%deck%trace_name, name)
      call append_text(draft%deck%trace_file, draft%deck%path_of(name))
      allocate(longer(place))
      longer(:place - 1) = draft%deck%trace_mention
      longer(place)%file = file
      longer(place)%line = line
      longer(place)%column = column
      call move_alloc(longer, draft%deck%trace_mention)
   end subroutine name_trace

end module rv_deck_draft
