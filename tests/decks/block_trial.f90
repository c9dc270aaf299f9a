!> Blocks run from a line of text, and results compared.
module block_trial
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_deck, only : deck_type
   use rv_block, only : block_result, run_block
   use check, only : suite_type
   use deck_trial, only : read_trial
   implicit none
   private
   public :: run_all, read_good, agree, same_bits

   !> places of measures
   integer, parameter, public :: steady = 1, rise = 2, opening = 3, overshoot = 4, fall = 5, closing = 6, zero = 7, &
      & undershoot = 8, peak = 9
   real(wp), parameter, public :: agreement = 1.0e-4_wp   !! of cases run in different company at rtol 1e-6
   !> twelve cases, neither rising nor falling
   character(len=*), parameter, public :: twelve = "&sweep key = 'film.gap_mm', values = 0.1, 0.04, 0.05 /~" &
      & //"&sweep key = 'pressure.inlet_kpa', values = 40, 5, 20, 10 /"

contains

   !> All cases of a deck as one block.
   subroutine run_all(suite, text, result)
      type(suite_type), intent(inout) :: suite
      character(len=*), intent(in) :: text
      type(block_result), intent(out) :: result
      type(deck_type) :: deck

      call read_good(suite, text, deck)
      call run_block(deck, 1_i8, deck%case_count(), result)
   end subroutine run_all

   !> A deck whose text has no fault; ~ is a line end.
   subroutine read_good(suite, text, deck)
      type(suite_type), intent(inout) :: suite
      character(len=*), intent(in) :: text
      type(deck_type), intent(out) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error

      call read_trial(text//"~", deck, faults, error)
      call suite%no_error("deck", error)
      if (faults%errors() > 0) call suite%text("a deck without faults", faults%all_text(), "")
   end subroutine read_good

   !> The same measures, relative to the steady displacement, to themselves, to the force; missing in both or in none.
   pure logical function agree(a, b)
      real(wp), intent(in) :: a(:, :), b(:, :)
      real(wp) :: size_of
      integer :: k, i

      agree = all(ieee_is_nan(a) .eqv. ieee_is_nan(b))
      do i = 1, size(a, 2)
         do k = 1, size(a, 1)
            if (ieee_is_nan(a(k, i))) cycle
            size_of = abs(b(k, i))
            if (k == overshoot .or. k == undershoot) size_of = b(steady, i)
            agree = agree .and. abs(a(k, i) - b(k, i)) <= agreement*size_of
         end do
      end do
   end function agree

   pure logical function same_bits(a, b)
      real(wp), intent(in) :: a(:, :), b(:, :)

      same_bits = all(transfer(a, [1_i8], size(a)) == transfer(b, [1_i8], size(b)))
   end function same_bits

end module block_trial
