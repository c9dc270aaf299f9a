!> The decks named on the command line read without a remark; what a deck writes about itself reads as the same cases.
program test_inputs
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_text_file, only : folder_of
   use rv_keys, only : n_keys
   use rv_deck, only : deck_type, read_deck
   use check, only : suite_type
   use deck_trial, only : read_trial, write_file, lines
   implicit none
   type(suite_type) :: suite
   character(len=4096) :: path
   integer :: i

   do i = 1, command_argument_count()
      call get_command_argument(i, path)
      call check_input(trim(path))
   end do
   call suite%true("decks were named", command_argument_count() > 0)
   call write_file("t.csv", lines("t_ms,p_diff_kpa~500,20~502,10~504,0~"))
   call write_file("it's.csv", lines("t_ms,p_diff_kpa~500,20~502,10~503,0~"))
   call write_file("plan.csv", lines("pressure.inlet_kpa,film.gap_mm~7.77,0.123456789012345678~8,0.2~"))
   call check_text("odd numbers", "&run title = 'it''s ""odd""' / &film gap_mm = 0.12345678901234567 k_s = 1d-17/ " &
      & //"&reed action_area_mm2 = 3.3333333333333335, youngs_modulus_gpa = 109.99999999999999 /")
   call check_text("sweeps", "&sweep key = 'film.gap_mm', from = 0.05, to = 0.3, count = 64 /~&sweep key = " &
      & //"'pressure.inlet_kpa' values = 3.3333333333333331, 5, 5.1, 5.2, 5.3, 5.4, 5.5, 5.6, 5.7, 5.8, 1e-2 /~" &
      & //"&sweep key = 'solver.rtol', from = 1e-3, to = 1e-9, count = 13, scale = 'log' /")
   call check_text("models", &
      & "&run model = 'squeeze', 'traditional', traces = T, start = 'equilibrium', block_size = 7 /")
   call check_text("traces", "&pressure kind = 'trace', event_ms = 500.1 /~" &
      & //"&sweep key = 'pressure.file', values = 't.csv', 'it''s.csv' /")
   call check_text("one trace", "&pressure kind = 'trace', event_ms = 500.1, file = 'it''s.csv' /")
   call check_text("design", "&run model = 'squeeze', 'traditional' / &design file = 'plan.csv' /")
   call check_text("keys without effect", "&run model = 'traditional' / &film gap_mm = 0.2 / &pressure event_ms = 3 /")
   call suite%finish()

contains

   subroutine check_input(path)
      character(len=*), intent(in) :: path
      type(deck_type) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error

      call read_deck(path, deck, faults, error)
      call suite%no_error(path, error)
      call suite%text(path//": no remark", faults%all_text(), "")
      if (faults%errors() == 0) call check_again(path, deck, folder_of(path))
   end subroutine check_input

   subroutine check_text(what, text)
      character(len=*), intent(in) :: what, text
      type(deck_type) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error

      call read_trial(text, deck, faults, error)
      call suite%equal(what//": no faults", faults%errors(), 0)
      if (faults%errors() == 0) call check_again(what, deck, "")
   end subroutine check_text

   !> Write, read, compare: every value of every case, to the last bit.
   subroutine check_again(what, deck, folder)
      character(len=*), intent(in) :: what, folder
      type(deck_type), intent(in) :: deck
      type(deck_type) :: again
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      real(wp) :: a(n_keys), b(n_keys)
      integer(i8) :: i
      integer :: unit, different

      call write_file(folder//"again.nml", deck%effective_text())
      call read_deck(folder//"again.nml", again, faults, error)
      open(newunit=unit, file=folder//"again.nml")
      close(unit, status="delete")
      call suite%no_error(what//", again", error)
      call suite%equal(what//", again: no faults", faults%errors(), 0)
      if (faults%errors() > 0) call suite%text(what//", again", faults%all_text(), "")
      if (faults%errors() > 0) return
      call suite%true(what//", again: cases", again%case_count() == deck%case_count())
      call suite%text(what//", again: title", again%title, deck%title)
      different = 0
      do i = 1, min(deck%case_count(), again%case_count())
         call deck%case_values(i, a)
         call again%case_values(i, b)
         different = different + count(.not. (abs(a - b) <= 0.0_wp .or. (ieee_is_nan(a) .and. ieee_is_nan(b))))
      end do
      call suite%equal(what//", again: values that differ", different, 0)
      call suite%text(what//", again: as it writes itself", again%effective_text(), deck%effective_text())
   end subroutine check_again

end program test_inputs
