!> The state of a valve that is stepped, as bytes that a caller keeps: numbers, and a checksum behind them.
module rv_state_bytes
   use, intrinsic :: iso_c_binding, only : c_loc
   use rv_kinds, only : wp, i8
   use rv_checksum, only : crc32_of
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_stepper, only : stepper_type
   implicit none
   private
   public :: state_count, save_state, restore_state

   real(wp), parameter :: mark = 5256.2_wp   !! first number of every state, and the version of this form
   integer, parameter :: head = 7            !! numbers before the displacements

contains

   !> Numbers in a state.
   pure integer function state_count(stepper) result(n)
      type(stepper_type), intent(in) :: stepper

      n = head + size(stepper%state) + size(stepper%sample) + 1
   end function state_count

   subroutine save_state(stepper, model, number)
      type(stepper_type), intent(in) :: stepper
      integer, intent(in) :: model                             !! of the valve
      real(wp), intent(out), target, contiguous :: number(:)   !! (state_count)

      number(:head) = [mark, real(model, wp), real(size(stepper%state), wp), real(size(stepper%sample), wp), &
         & merge(1.0_wp, 0.0_wp, stepper%has_stepped), stepper%t, stepper%next_step]
      associate (n => size(stepper%state))
         number(head + 1:head + n) = stepper%state
         number(head + n + 1:size(number) - 1) = stepper%sample
      end associate
      number(size(number)) = checksum(number)
   end subroutine save_state

   !> Go back to a saved state, of a valve of the same model with as many degrees of freedom. On failure nothing changes.
   subroutine restore_state(stepper, model, number, error)
      type(stepper_type), intent(inout) :: stepper
      integer, intent(in) :: model
      real(wp), intent(in), target, contiguous :: number(:)   !! (state_count)
      type(error_type), allocatable, intent(out) :: error
      logical :: fits

      associate (n => size(stepper%state))
         fits = all(abs(number(:4) - [mark, real([model, n, size(stepper%sample)], wp)]) <= 0.0_wp)
         if (fits) fits = abs(number(size(number)) - checksum(number)) <= 0.0_wp
         if (.not. fits) then
            call fail(error, rv_bad_input, "these bytes are no state of such a valve, or are damaged")
            return
         end if
         stepper%has_stepped = number(5) > 0.5_wp
         stepper%has_failed = .false.
         stepper%t = number(6)
         stepper%next_step = number(7)
         stepper%state = number(head + 1:head + n)
         stepper%sample = number(head + n + 1:size(number) - 1)
      end associate
   end subroutine restore_state

   real(wp) function checksum(number)
      real(wp), intent(in), target, contiguous :: number(:)

      checksum = real(crc32_of(c_loc(number), 8_i8*(size(number) - 1)), wp)
   end function checksum

end module rv_state_bytes
