!> The grammar of a deck: groups of settings with the place of every word, and every fault of form.
!>
!> Namelist text as f90nml and gfortran take it, less what hides mistakes: `&group key = value, ... /`
!> with scalars and lists, repeat counts (3*0.1) and ! comments. Array indices, null values, $group and
!> &end are refused. What a word means is not looked at here.
module rv_deck_scan
   use rv_kinds, only : i8
   use rv_text, only : lower, to_text
   use rv_number, only : parse_integer
   use rv_faults, only : fault_list, clip
   use rv_deck_reader, only : deck_reader, new_deck_reader, place_type, word_type, end_of_text, name_characters
   implicit none
   private
   public :: deck_scan, scan_deck, entry_type, group_type

   !> One setting: a name and its values.
   type :: entry_type
      type(word_type) :: name
      integer :: first_value = 1, last_value = 0   !! places in deck_scan%value
   end type entry_type

   !> One group.
   type :: group_type
      type(word_type) :: name
      integer :: first_entry = 1, last_entry = 0   !! places in deck_scan%entry
      logical :: is_empty = .true.                 !! nothing stands in it, not even a fault
   end type group_type

   !> A deck taken apart.
   type :: deck_scan
      character(len=:), allocatable :: file   !! its name in messages
      type(deck_reader) :: reader
      type(group_type), allocatable :: group(:)
      type(entry_type), allocatable :: entry(:)
      type(word_type), allocatable :: value(:)
      integer :: groups = 0, entries = 0, values = 0   !! so many are in use
   end type deck_scan

   integer, parameter :: most_values = 1000000   !! in one deck, repeats counted

contains

   !> Take a deck apart; every fault of form is added to `faults`.
   subroutine scan_deck(text, file, scan, faults)
      character(len=*), intent(in) :: text   !! in UTF-8, without NUL
      character(len=*), intent(in) :: file
      type(deck_scan), intent(out) :: scan
      type(fault_list), intent(inout) :: faults
      logical :: is_told   !! the text outside groups where the reader stands

      scan%reader = new_deck_reader(text)
      scan%file = file
      allocate(scan%group(16), scan%entry(64), scan%value(256))
      is_told = .false.
      do
         call scan%reader%skip_blanks()
         select case (scan%reader%here())
         case (end_of_text)
            exit
         case ("&", "$")
            call scan_group(scan, faults)
            is_told = .false.
         case default
            if (.not. is_told) call tell_outside(scan, faults)
            is_told = .true.
            call scan%reader%skip_line()
         end select
      end do
   end subroutine scan_deck

   !> The reader stands on the & of a group.
   subroutine scan_group(scan, faults)
      type(deck_scan), intent(inout) :: scan
      type(fault_list), intent(inout) :: faults
      type(group_type) :: group
      type(place_type) :: start
      character(len=1) :: mark
      character(len=:), allocatable :: name
      logical :: is_torn   !! a text without its closing quote may have swallowed the /

      start = scan%reader%now
      mark = scan%reader%here()
      call scan%reader%advance()
      call scan%reader%take_any_of(name_characters, group%name)
      name = scan%reader%word_text(group%name)
      if (lower(name) == "end" .or. (name == "" .and. mark == "$")) then
         call tell(scan, start, faults, "'"//mark//name//"' closes no group; a group ends with '/'")
         return
      else if (name == "") then
         call tell(scan, start, faults, "a group's name must follow '&' directly, as in '&run'")
         call scan%reader%skip_blanks()
         call scan%reader%take_any_of(name_characters, group%name)
         name = scan%reader%word_text(group%name)
      else if (mark == "$") then
         call tell(scan, start, faults, "old form of a group; write '&"//name//" ... /'")
      end if
      group%name%start = start
      group%name%is_broken = name == ""

      is_torn = .false.
      group%first_entry = scan%entries + 1
      do
         call scan%reader%skip_blanks()
         if (index("/&$"//end_of_text, scan%reader%here()) > 0) exit
         group%is_empty = .false.
         call scan_entry(scan, faults, name, is_torn)
      end do
      group%last_entry = scan%entries
      call append_group(scan, group)
      if (scan%reader%here() == "/") then
         call scan%reader%advance()
      else if (.not. took_old_end(scan, faults)) then
         if (.not. is_torn) call tell(scan, start, faults, "&"//name//" is not closed: no '/' "//before_text(scan))
      end if
   end subroutine scan_group

   !> &end, $end and $ close a group in old decks.
   logical function took_old_end(scan, faults)
      type(deck_scan), intent(inout) :: scan
      type(fault_list), intent(inout) :: faults
      type(place_type) :: start
      type(word_type) :: name
      character(len=1) :: mark

      took_old_end = .false.
      if (scan%reader%here() == end_of_text) return
      start = scan%reader%now
      mark = scan%reader%here()
      call scan%reader%advance()
      call scan%reader%take_any_of(name_characters, name)
      took_old_end = lower(scan%reader%word_text(name)) == "end" .or. (mark == "$" .and. name%last < name%first)
      if (took_old_end) then
         call tell(scan, start, faults, "old form of a group's end; write '/'")
      else
         scan%reader%now = start
      end if
   end function took_old_end

   !> Where a group without an end stops: "before '&film' in line 7" or "before the end of the file".
   function before_text(scan) result(text)
      type(deck_scan), intent(inout) :: scan
      character(len=:), allocatable :: text
      type(place_type) :: start
      type(word_type) :: name

      text = "before the end of the file"
      if (scan%reader%here() == end_of_text) return
      start = scan%reader%now
      call scan%reader%advance()
      call scan%reader%take_any_of(name_characters, name)
      scan%reader%now = start
      text = "before '"//scan%reader%here()//scan%reader%word_text(name)//"' in line "//to_text(start%line)
   end function before_text

   !> Read `name = value, value ...` up to the next name, the end of the group or of the file.
   subroutine scan_entry(scan, faults, group, is_torn)
      type(deck_scan), intent(inout) :: scan
      type(fault_list), intent(inout) :: faults
      character(len=*), intent(in) :: group
      logical, intent(inout) :: is_torn
      type(entry_type) :: entry
      character(len=:), allocatable :: name

      if (took_hash_comment(scan, faults)) return
      call scan%reader%take_word(entry%name)
      name = scan%reader%word_text(entry%name)
      call scan%reader%skip_blanks()
      if (name == "") then
         call tell(scan, scan%reader%now, faults, "the name of a key is due here, not "//scan%reader%here())
         call skip_to_key(scan%reader)
         return
      end if
      if (scan%reader%here() == "=") then
         call scan%reader%advance()
         call check_name(scan, entry%name, faults)
      else
         entry%name%is_broken = .true.
         call tell(scan, entry%name%start, faults, "'key = value' is due: no '=' after '"//clip(name, 40)//"'")
      end if
      entry%first_value = scan%values + 1
      call scan_values(scan, faults, group//"."//clip(name, 40), entry%name%start, is_torn)
      entry%last_value = scan%values
      call append_entry(scan, entry)
   end subroutine scan_entry

   !> A name has letters, digits and underscores; array indices get a sentence of their own.
   subroutine check_name(scan, name, faults)
      type(deck_scan), intent(in) :: scan
      type(word_type), intent(inout) :: name
      type(fault_list), intent(inout) :: faults
      character(len=:), allocatable :: text
      integer :: bad

      text = scan%reader%word_text(name)
      bad = verify(text, name_characters)
      name%is_broken = bad > 0
      if (bad == 0) return
      if (bad > 1 .and. index(" (%", text(bad:bad)) > 0) then
         call tell(scan, name%start, faults, "'"//clip(text, 40)//"': array indices are not taken; list the values: " &
            & //text(:bad - 1)//" = value, value")
      else
         call tell(scan, name%start, faults, "'"//clip(text, 40)//"' is not the name of a key: letters, digits and _")
      end if
   end subroutine check_name

   !> The mark is a comment's in other languages.
   logical function took_hash_comment(scan, faults)
      type(deck_scan), intent(inout) :: scan
      type(fault_list), intent(inout) :: faults

      took_hash_comment = scan%reader%here() == "#"
      if (.not. took_hash_comment) return
      call tell(scan, scan%reader%now, faults, "comments start with '!', not '#'")
      call scan%reader%skip_line()
   end function took_hash_comment

   !> Pass what is no setting, up to the next key or the end of the group.
   subroutine skip_to_key(reader)
      type(deck_reader), intent(inout) :: reader
      type(word_type) :: word

      do
         if (at_quote(reader)) then
            call reader%take_quoted(word)
         else
            call reader%take_word(word)
            if (word%last < word%first) call reader%advance()
         end if
         call reader%skip_blanks()
         if (index("/&$"//end_of_text, reader%here()) > 0) return
         if (at_key(reader)) return
      end do
   end subroutine skip_to_key

   !> Read the values of one setting; the reader stands behind its =.
   subroutine scan_values(scan, faults, name, start, is_torn)
      type(deck_scan), intent(inout) :: scan
      type(fault_list), intent(inout) :: faults
      character(len=*), intent(in) :: name     !! group.key, for messages
      type(place_type), intent(in) :: start    !! of the key
      logical, intent(inout) :: is_torn
      logical :: is_due, is_empty
      type(word_type) :: word

      is_due = .true.     ! a value, after = and a comma
      is_empty = .true.   ! nothing seen
      do
         call scan%reader%skip_blanks()
         select case (scan%reader%here())
         case (end_of_text, "&", "$")
            exit
         case ("/")
            if (.not. slash_in_word(scan%reader)) exit
            call scan%reader%take_any_of("", word)
            call take_unquoted_path(scan, faults, name, word)
         case (",")
            if (is_due) call tell(scan, scan%reader%now, faults, name//": a value is missing before this comma")
            call scan%reader%advance()
            is_due = .true.
            is_empty = .false.
            cycle
         case ("=")
            call tell(scan, scan%reader%now, faults, name//": this '=' has no place here")
            call scan%reader%advance()
            cycle
         case default
            if (took_hash_comment(scan, faults)) cycle
            if (at_key(scan%reader)) exit
            call scan_value(scan, faults, name, is_torn)
         end select
         is_due = .false.
         is_empty = .false.
      end do
      if (is_empty) call tell(scan, start, faults, name//": no value after '='")
   end subroutine scan_values

   !> Read one value with its repeat count.
   subroutine scan_value(scan, faults, name, is_torn)
      type(deck_scan), intent(inout) :: scan
      type(fault_list), intent(inout) :: faults
      character(len=*), intent(in) :: name
      logical, intent(inout) :: is_torn
      type(word_type) :: word
      integer :: repeat

      repeat = 1
      if (.not. at_quote(scan%reader)) then
         call scan%reader%take_word(word)
         call split_repeat(scan, faults, name, word, repeat)
      end if
      if (word%last < word%first .and. at_quote(scan%reader)) then
         call scan%reader%take_quoted(word)
         if (word%is_broken) call tell(scan, word%start, faults, &
            & name//": the text is not closed: no "//word%quote//" before the end of the line")
         is_torn = is_torn .or. word%is_broken
      else if (slash_in_word(scan%reader)) then
         call take_unquoted_path(scan, faults, name, word)
      end if
      call append_values(scan, faults, name, word, repeat)
   end subroutine scan_value

   !> Take the count off a word such as 3*0.1.
   subroutine split_repeat(scan, faults, name, word, repeat)
      type(deck_scan), intent(in) :: scan
      type(fault_list), intent(inout) :: faults
      character(len=*), intent(in) :: name
      type(word_type), intent(inout) :: word
      integer, intent(out) :: repeat
      character(len=:), allocatable :: text, trouble
      integer(i8) :: count
      integer :: star

      repeat = 1
      text = scan%reader%word_text(word)
      star = index(text, "*")
      if (star < 2 .or. verify(text(:max(1, star - 1)), "0123456789") > 0) return
      call parse_integer(text(:star - 1), count, trouble)
      if (trouble == "" .and. count >= 1 .and. count <= most_values) then
         repeat = int(count)
      else
         call tell(scan, word%start, faults, name//": a repeat count must be from 1 to "//to_text(most_values))
         word%is_broken = .true.
      end if
      word%first = word%first + star
      if (word%first <= word%last .or. at_quote(scan%reader) .or. word%is_broken) return
      call tell(scan, word%start, faults, name//" = "//text//": a value must follow '*' directly")
      word%is_broken = .true.
   end subroutine split_repeat

   !> An unquoted / inside a value: gfortran would end the group there and say nothing.
   subroutine take_unquoted_path(scan, faults, name, word)
      type(deck_scan), intent(inout) :: scan
      type(fault_list), intent(inout) :: faults
      character(len=*), intent(in) :: name
      type(word_type), intent(inout) :: word

      call scan%reader%take_path(word)
      word%is_broken = .true.
      call tell(scan, word%start, faults, name//" = "//clip(scan%reader%word_text(word), 60) &
         & //": a '/' ends the group unless it stands in quotes; put a text in quotes")
   end subroutine take_unquoted_path

   !> Does the reader stand on a / that more text follows directly?
   pure logical function slash_in_word(reader)
      type(deck_reader), intent(in) :: reader

      slash_in_word = reader%here() == "/" .and. index(" !&$"//achar(9)//achar(10)//achar(13)//end_of_text, &
         & reader%next()) == 0
   end function slash_in_word

   pure logical function at_quote(reader)
      type(deck_reader), intent(in) :: reader

      at_quote = index("'"//'"', reader%here()) > 0
   end function at_quote

   !> Is the next word the name of a setting, that is, does = follow it?
   logical function at_key(reader)
      type(deck_reader), intent(inout) :: reader
      type(place_type) :: start
      type(word_type) :: word

      start = reader%now
      call reader%take_word(word)
      call reader%skip_blanks()
      at_key = reader%here() == "=" .and. word%first <= word%last
      reader%now = start
   end function at_key

   subroutine tell(scan, place, faults, text)
      type(deck_scan), intent(in) :: scan
      type(place_type), intent(in) :: place
      type(fault_list), intent(inout) :: faults
      character(len=*), intent(in) :: text

      call faults%add(scan%file, place%line, place%column, text)
   end subroutine tell

   !> What stands outside all groups, told once for each stretch of it.
   subroutine tell_outside(scan, faults)
      type(deck_scan), intent(inout) :: scan
      type(fault_list), intent(inout) :: faults
      type(place_type) :: start
      character(len=:), allocatable :: advice, text

      start = scan%reader%now
      call scan%reader%skip_line()
      text = scan%reader%text(start%at:scan%reader%now%at - 1)
      if (index(text, achar(13)) > 0) text = text(:index(text, achar(13)) - 1)
      if (text(1:1) == "#") then
         advice = "comments start with '!', not '#'"
      else if (scan%groups > 0) then
         advice = "did a '/' close the group above it too early?"
      else
         advice = "a group starts with its name, as in '&run'"
      end if
      call tell(scan, start, faults, "text outside all groups: '"//clip(text, 40)//"'; "//advice)
   end subroutine tell_outside

   subroutine append_group(scan, group)
      type(deck_scan), intent(inout) :: scan
      type(group_type), intent(in) :: group
      type(group_type) :: filler

      if (scan%groups == size(scan%group)) scan%group = [scan%group, spread(filler, 1, scan%groups)]
      scan%groups = scan%groups + 1
      scan%group(scan%groups) = group
   end subroutine append_group

   subroutine append_entry(scan, entry)
      type(deck_scan), intent(inout) :: scan
      type(entry_type), intent(in) :: entry
      type(entry_type) :: filler

      if (scan%entries == size(scan%entry)) scan%entry = [scan%entry, spread(filler, 1, scan%entries)]
      scan%entries = scan%entries + 1
      scan%entry(scan%entries) = entry
   end subroutine append_entry

   subroutine append_values(scan, faults, name, word, repeat)
      type(deck_scan), intent(inout) :: scan
      type(fault_list), intent(inout) :: faults
      character(len=*), intent(in) :: name
      type(word_type), intent(in) :: word
      integer, intent(in) :: repeat
      type(word_type) :: filler

      if (scan%values + repeat > most_values) then
         call tell(scan, word%start, faults, name//": more than "//to_text(most_values)//" values in one deck")
         return
      end if
      do while (scan%values + repeat > size(scan%value))
         scan%value = [scan%value, spread(filler, 1, size(scan%value))]
      end do
      scan%value(scan%values + 1:scan%values + repeat) = word
      scan%values = scan%values + repeat
   end subroutine append_values

end module rv_deck_scan
