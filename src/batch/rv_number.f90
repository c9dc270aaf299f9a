!> Words of a deck or a CSV file as numbers, and the reason why one is none.
module rv_number
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int, c_int64_t
   use rv_kinds, only : wp, i8
   use rv_text, only : lower
   implicit none
   private
   public :: parse_real, parse_integer, parse_logical, tidy

   ! What C finds; all else is no number.
   integer(c_int), parameter :: is_fine = 0, is_too_large = 2, is_too_small = 3

   interface
      !> Uses the last byte of `word` for itself.
      pure subroutine c_real(word, length, value, verdict) bind(C, name="rv_number_real")
         import :: c_char, c_double, c_int, c_int64_t
         character(kind=c_char), intent(inout) :: word(*)
         integer(c_int64_t), value :: length   !! without the last
         real(c_double), intent(out) :: value
         integer(c_int), intent(out) :: verdict
      end subroutine c_real
   end interface

contains

   !> Read a real: digits with an optional point and an exponent after e or d. `trouble` is empty on success.
   pure subroutine parse_real(word, value, trouble)
      character(len=*), intent(in) :: word   !! without blanks around it
      real(wp), intent(out) :: value         !! 0 on trouble
      character(len=:), allocatable, intent(out) :: trouble
      character(len=:), allocatable :: number
      integer(c_int) :: verdict

      allocate(character(len=len(word) + 1) :: number)
      number(:len(word)) = word
      call c_real(number, len(word, c_int64_t), value, verdict)
      select case (verdict)
      case (is_fine)
         trouble = ""
      case (is_too_large)
         trouble = "too large for a double-precision number"
      case (is_too_small)
         trouble = "too small for a double-precision number"
      case default
         trouble = why_no_number(lower(word))
      end select
   end subroutine parse_real

   pure function why_no_number(word) result(trouble)
      character(len=*), intent(in) :: word   !! in lower case
      character(len=:), allocatable :: trouble

      trouble = "not a number"
      if (is_one_of(unsigned(word), ["nan", "inf"]) .or. unsigned(word) == "infinity" &
         & .or. index(unsigned(word), "nan(") == 1) trouble = "NaN and infinity are not allowed"
      if (word == "") trouble = "a number is missing"
   end function why_no_number

   !> Read a whole number.
   pure subroutine parse_integer(word, value, trouble)
      character(len=*), intent(in) :: word
      integer(i8), intent(out) :: value      !! 0 on trouble
      character(len=:), allocatable, intent(out) :: trouble
      integer :: stat

      value = 0
      trouble = ""
      if (len(unsigned(word)) == 0 .or. verify(unsigned(word), "0123456789") > 0) then
         trouble = "not a whole number"
         return
      end if
      read(word, *, iostat=stat) value
      if (stat == 0) return
      value = 0
      trouble = "too large"
   end subroutine parse_integer

   !> Read a logical: .true., T, true, .f., ... in any case.
   pure subroutine parse_logical(word, value, trouble)
      character(len=*), intent(in) :: word
      logical, intent(out) :: value          !! false on trouble
      character(len=:), allocatable, intent(out) :: trouble
      character(len=*), parameter :: true_words(4) = [character(len=7) :: ".true.", "true", "t", ".t."]
      character(len=*), parameter :: false_words(4) = [character(len=7) :: ".false.", "false", "f", ".f."]

      trouble = ""
      value = is_one_of(lower(word), true_words)
      if (.not. (value .or. is_one_of(lower(word), false_words))) trouble = "must be .true. or .false."
   end subroutine parse_logical

   !> `x` rounded to 15 digits, so that a computed 0.15000000000000002 prints as a person would write it.
   !>
   !> Powers of ten up to 10^22 are exact, so one division gives the double nearest to the decimal;
   !> numbers beyond that reach stay as they are.
   elemental real(wp) function tidy(x)
      real(wp), intent(in) :: x
      real(wp) :: scale
      integer :: shift

      tidy = x
      if (.not. (abs(x) >= 1.0e-8_wp .and. abs(x) < 1.0e14_wp)) return
      shift = 14 - floor(log10(abs(x)))
      scale = 10.0_wp**shift
      tidy = anint(x*scale)/scale
   end function tidy

   pure function unsigned(word) result(tail)
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: tail

      tail = word
      if (len(word) == 0) return
      if (scan(word(1:1), "+-") == 1) tail = word(2:)
   end function unsigned

   pure logical function is_one_of(word, list)
      character(len=*), intent(in) :: word, list(:)

      is_one_of = any(list == word)
   end function is_one_of

end module rv_number
