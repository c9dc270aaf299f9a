!> One value of a key from its word in a deck or a design file, and what is wrong or odd about it.
module rv_key_value
   use rv_kinds, only : wp, i8
   use rv_text, only : lower, text_type, to_text
   use rv_number, only : parse_real, parse_integer, parse_logical
   use rv_text_builder, only : append_text
   use rv_suggest, only : closest
   use rv_keys, only : keys, n_rows, real_key, integer_key, logical_key, choice_key, text_key, to_si, from_si, &
      & choice_count, choice_name, choice_index, full_name, key_film_gap_mm, key_solver_width
   implicit none
   private
   public :: read_value, odd_value, range_text, unknown_choice, names_of_group, names_of_keys, suggestion, unit_advice

   real(wp), parameter :: smallest_gap_mm = 1.0e-6_wp   !! of a film that is not closed: a few molecules

contains

   !> Read a value; texts are only checked, their value is 0. `trouble` is empty on success.
   subroutine read_value(key, word, is_quoted, value, trouble)
      integer, intent(in) :: key
      character(len=*), intent(in) :: word     !! without quotes
      logical, intent(in) :: is_quoted
      real(wp), intent(out) :: value           !! as in a vector of values
      character(len=:), allocatable, intent(out) :: trouble

      value = 0.0_wp
      select case (keys(key)%kind)
      case (real_key, integer_key, logical_key)
         trouble = ""
         if (is_quoted) trouble = "must stand without quotes"
         if (trouble == "") call read_bare_value(key, word, value, trouble)
      case (choice_key)
         value = real(choice_index(key, word), wp)
         trouble = unknown_choice(key, word)
         if (trouble == "" .and. .not. is_quoted) trouble = "must stand in quotes: '"//word//"'"
      case default
         trouble = text_trouble(key, word)
         if (.not. is_quoted) trouble = "must be a text in quotes: '"//word//"'"
      end select
   end subroutine read_value

   !> Read a number or a logical.
   subroutine read_bare_value(key, word, value, trouble)
      integer, intent(in) :: key
      character(len=*), intent(in) :: word
      real(wp), intent(out) :: value
      character(len=:), allocatable, intent(out) :: trouble
      integer(i8) :: number
      logical :: flag

      value = 0.0_wp
      select case (keys(key)%kind)
      case (logical_key)
         call parse_logical(word, flag, trouble)
         value = merge(1.0_wp, 0.0_wp, flag)
         return
      case (integer_key)
         call parse_integer(word, number, trouble)
         value = real(number, wp)
      case default
         call parse_real(word, value, trouble)
         if (trouble == "not a number" .and. has_unit(key, word)) trouble = trouble//unit_advice(key)
      end select
      if (trouble == "") trouble = range_trouble(key, value)
      if (trouble == "" .and. key == key_solver_width .and. popcnt(nint(value)) /= 1) trouble = "must be a power of two"
      value = to_si(key, value)
   end subroutine read_bare_value

   !> A number with its unit behind it, or that unit behind a blank: a common slip.
   logical function has_unit(key, word)
      integer, intent(in) :: key
      character(len=*), intent(in) :: word

      has_unit = verify(word, "+-.0123456789") > 1 .or. lower(word) == lower(trim(keys(key)%unit))
   end function has_unit

   function unit_advice(key) result(advice)
      integer, intent(in) :: key
      character(len=:), allocatable :: advice

      advice = ""
      if (keys(key)%unit /= "") advice = "; its unit is "//trim(keys(key)%unit)//", write the number alone"
   end function unit_advice

   !> Outside the allowed range?
   function range_trouble(key, value) result(trouble)
      integer, intent(in) :: key
      real(wp), intent(in) :: value   !! in the deck's unit
      character(len=:), allocatable :: trouble

      trouble = ""
      associate (lowest => keys(key)%lowest)
         if (value >= lowest .and. value <= keys(key)%highest .and. .not. is_too_thin(key, value)) return
         if (lowest > 0.0_wp .and. value <= 0.0_wp) then
            trouble = "must be > 0"//unit_in_parentheses(key)
         else if (value < 0.0_wp .and. abs(lowest) <= 0.0_wp) then
            trouble = "must be >= 0"//unit_in_parentheses(key)
         else if (key == key_film_gap_mm) then
            trouble = "must be "//range_text(key)//unit_in_parentheses(key)
         else
            trouble = "must be from "//range_text(key)//unit_in_parentheses(key)
         end if
      end associate
   end function range_trouble

   !> A film of less than some molecules that is not closed?
   pure logical function is_too_thin(key, value)
      integer, intent(in) :: key
      real(wp), intent(in) :: value   !! in the deck's unit

      is_too_thin = key == key_film_gap_mm .and. value > 0.0_wp .and. value < smallest_gap_mm
   end function is_too_thin

   !> "0.001 to 1000", and of the gap "0, or 1e-6 to 1000"
   function range_text(key) result(text)
      integer, intent(in) :: key
      character(len=:), allocatable :: text

      text = to_text(keys(key)%lowest)//" to "//to_text(keys(key)%highest)
      if (key == key_film_gap_mm) text = "0, or "//to_text(smallest_gap_mm)//" to "//to_text(keys(key)%highest)
   end function range_text

   function unit_in_parentheses(key) result(text)
      integer, intent(in) :: key
      character(len=:), allocatable :: text

      text = ""
      if (keys(key)%unit /= "") text = " ("//trim(keys(key)%unit)//")"
   end function unit_in_parentheses

   function text_trouble(key, text) result(trouble)
      integer, intent(in) :: key
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: trouble

      trouble = ""
      if (len(text) > nint(keys(key)%highest)) then
         trouble = "has "//to_text(len(text))//" bytes; at most "//to_text(nint(keys(key)%highest))//" are taken"
      else if (len_trim(text) < nint(keys(key)%lowest)) then
         trouble = "must not be empty"
      end if
   end function text_trouble

   !> Not among the choices? Empty if it is.
   function unknown_choice(key, word) result(trouble)
      integer, intent(in) :: key
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: trouble
      type(text_type), allocatable :: list(:)
      integer :: i

      trouble = ""
      if (choice_index(key, word) > 0) return
      allocate(list(choice_count(key)))
      do i = 1, size(list)
         list(i)%s = choice_name(key, i)
         trouble = trouble//merge(", ", "  ", i > 1)//"'"//list(i)%s//"'"
      end do
      trouble = "must be one of "//trouble(3:)//suggestion(word, list)
   end function unknown_choice

   !> A number so far from the usual that another unit is likely; empty if it is not.
   function odd_value(key, value) result(text)
      integer, intent(in) :: key
      real(wp), intent(in) :: value   !! as in a vector of values
      character(len=:), allocatable :: text
      real(wp) :: size_of_it

      text = ""
      if (keys(key)%kind /= real_key) return
      size_of_it = abs(from_si(key, value))
      if (size_of_it <= 0.0_wp) return
      if (size_of_it < keys(key)%usual_low) text = "unusually small"
      if (size_of_it > keys(key)%usual_high) text = "unusually large"
      if (text == "" .or. keys(key)%unit == "") return
      text = text//" for "//trim(keys(key)%unit)//other_unit(trim(keys(key)%unit), size_of_it < keys(key)%usual_low)
   end function odd_value

   !> The unit somebody may have had in mind.
   pure function other_unit(unit, is_small) result(question)
      character(len=*), intent(in) :: unit
      logical, intent(in) :: is_small
      character(len=:), allocatable :: question
      character(len=*), parameter :: table(3, 7) = reshape([character(len=10) :: &
         & "mm", "m", "um", "mm2", "m2", "um2", "ms", "s", "us", "kPa", "bar or MPa", "Pa", &
         & "GPa", "TPa", "MPa or Pa", "kg/m3", "g/cm3", "g/m3", "Pa s", "", "mPa s"], [3, 7])
      integer :: i

      question = ""
      do i = 1, size(table, 2)
         if (table(1, i) == unit) question = trim(table(merge(2, 3, is_small), i))
      end do
      if (question /= "") question = "; was it given in "//question//"?"
   end function other_unit

   !> Names of the keys of a group.
   function names_of_group(group) result(list)
      character(len=*), intent(in) :: group
      type(text_type), allocatable :: list(:)
      integer :: key

      allocate(list(0))
      do key = 1, n_rows
         if (keys(key)%group == group) call append_text(list, trim(keys(key)%name))
      end do
   end function names_of_group

   !> Names of the keys that sweeps and designs may vary, with their groups.
   function names_of_keys() result(list)
      type(text_type), allocatable :: list(:)
      integer :: key

      allocate(list(0))
      do key = 1, n_rows
         if (keys(key)%sweepable) call append_text(list, full_name(key))
      end do
   end function names_of_keys

   !> "; did you mean 'x'?", or nothing.
   function suggestion(word, list) result(text)
      character(len=*), intent(in) :: word
      type(text_type), intent(in) :: list(:)
      character(len=:), allocatable :: text

      text = closest(word, list)
      if (text /= "") text = "; did you mean '"//text//"'?"
   end function suggestion

end module rv_key_value
