!> Words of a deck or a CSV file as numbers, and the reason why one is none.
module rv_number
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use rv_kinds, only : wp, i8
   use rv_text, only : lower
   implicit none
   private
   public :: parse_real, parse_integer, parse_logical, tidy

contains

   !> Read a real: digits with an optional point and an exponent after e or d. `trouble` is empty on success.
   pure subroutine parse_real(word, value, trouble)
      character(len=*), intent(in) :: word   !! without blanks around it
      real(wp), intent(out) :: value         !! 0 on trouble
      character(len=:), allocatable, intent(out) :: trouble
      character(len=:), allocatable :: number
      integer :: stat

      value = 0.0_wp
      trouble = ""
      number = lower(word)
      if (number == "") then
         trouble = "a number is missing"
      else if (is_one_of(unsigned(number), ["nan", "inf"]) .or. unsigned(number) == "infinity" &
         & .or. index(unsigned(number), "nan(") == 1) then
         trouble = "NaN and infinity are not allowed"
      else if (.not. is_real(number)) then
         trouble = "not a number"
      else
         read(number, *, iostat=stat) value
         if (stat /= 0 .or. .not. ieee_is_finite(value)) then
            trouble = "too large for a double-precision number"
         else if (abs(value) <= 0.0_wp .and. scan(mantissa(number), "123456789") > 0) then
            trouble = "too small for a double-precision number"
         end if
      end if
      if (trouble /= "") value = 0.0_wp
   end subroutine parse_real

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

   !> [sign] digits [. digits] [e|d [sign] digits], with a digit before or after the point.
   pure logical function is_real(word)
      character(len=*), intent(in) :: word   !! in lower case
      character(len=:), allocatable :: digits
      integer :: letter, point

      is_real = .false.
      letter = scan(word, "ed")
      if (letter > 0) then
         digits = unsigned(word(letter + 1:))
         if (len(digits) == 0 .or. verify(digits, "0123456789") > 0) return
      end if
      digits = unsigned(mantissa(word))
      point = index(digits, ".")
      if (point > 0) digits = digits(:point - 1)//digits(point + 1:)
      is_real = len(digits) > 0 .and. verify(digits, "0123456789") == 0
   end function is_real

   pure function mantissa(word) result(head)
      character(len=*), intent(in) :: word   !! in lower case
      character(len=:), allocatable :: head

      head = word(:scan(word//"e", "ed") - 1)
   end function mantissa

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
