!> Decks damaged at random: each is read to its end, and one that is taken says the same when it is written and read.
program test_damaged
   use rv_kinds, only : i8
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_deck, only : deck_type
   use check, only : suite_type
   use deck_trial, only : read_trial, write_file, lines
   implicit none
   integer, parameter :: trials = 3000
   character(len=*), parameter :: spice = "&/='"",!*()$%.+-#~ 0123456789eEnaif"//achar(9)//achar(13)//achar(0) &
      & //char(200)
   character(len=*), parameter :: healthy = &
      & "&run title = 'a title', model = 'traditional', 'squeeze', t_end_ms = 30.0, traces = T /~" &
      & //"! a comment with ' and /~&film gap_mm = 0.05, k_s = 7.5e-3, acts = ""both"" /~" &
      & //"&pressure kind = 'square', inlet_kpa = 20.0 /~&solver width = 8, max_steps = 1000 /~" &
      & //"&sweep key = 'film.gap_mm', values = 0.1, 2*0.2, 0.3 /~" &
      & //"&sweep key = 'pressure.inlet_kpa' from = 5, to = 40, count = 3, scale = 'log' /~"
   type(suite_type) :: suite
   integer(i8) :: state

   state = 20080101_i8
   call damage_decks()
   call suite%finish()

contains

   subroutine damage_decks()
      type(deck_type) :: deck, again
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      integer :: i, taken, changed

      call read_trial(healthy, deck, faults, error)
      call suite%equal("the healthy deck has no faults", faults%errors(), 0)
      taken = 0
      changed = 0
      do i = 1, trials
         text = damaged(lines(healthy))
         call read_trial(text, deck, faults, error)
         if (faults%errors() > 0) cycle
         taken = taken + 1
         call read_trial(deck%effective_text(), again, faults, error)
         if (faults%errors() > 0) then
            changed = changed + 1
         else if (again%effective_text() /= deck%effective_text()) then
            changed = changed + 1
         end if
         if (changed > 0) exit
      end do
      call suite%true("some are taken", taken > trials/50)
      call suite%true("some are refused", taken < trials/2)
      call suite%equal("decks that change when written and read", changed, 0)
      if (changed > 0) call suite%text("the deck that changes", text, "")
   end subroutine damage_decks

   !> One to four bytes changed, inserted, taken out, or the end cut off.
   function damaged(healthy) result(text)
      character(len=*), intent(in) :: healthy
      character(len=:), allocatable :: text
      character(len=1) :: c
      integer :: k, at

      text = healthy
      do k = 1, 1 + pick(4)
         at = 1 + pick(len(text))
         c = spice(1 + pick(len(spice)):)
         select case (pick(20))
         case (0:8)
            text = text(:at - 1)//c//text(at + 1:)
         case (9:13)
            text = text(:at - 1)//c//text(at:)
         case (14:18)
            text = text(:at - 1)//text(at + 1:)
         case default
            text = text(:at)
         end select
      end do
   end function damaged

   !> A whole number from 0 to n - 1, from a fixed sequence.
   integer function pick(n)
      integer, intent(in) :: n

      state = mod(state*1103515245_i8 + 12345_i8, 2147483648_i8)
      pick = int(mod(state/65536_i8, int(n, i8)))
   end function pick

end program test_damaged
