!> The valves of the C API, and the handles that stand for them.
!>
!> A handle is a number, not an address: its place in a list and how often the place was given away. Closed handles,
!> copies of them and stray pointers are thus told from open ones without a look at memory that may be gone. The list
!> is the one variable of the library that all threads share; who reads or writes it is alone with it.
module rv_handles
   use, intrinsic :: iso_c_binding, only : c_int, c_intptr_t, c_null_ptr, c_ptr
   use rv_kinds, only : wp
   use rv_block, only : block_result
   use rv_setup, only : setup_type
   use rv_stepper, only : stepper_type
   implicit none
   private
   public :: valve_type, open_handle, close_handle, valve_of, number_of, handle_of

   !> One valve: its settings, its last run, its stepping, and what its last call had to say.
   type :: valve_type
      type(setup_type) :: setup
      type(block_result) :: result
      real(wp), allocatable :: time(:)           !! of the traces [s]
      logical :: has_run = .false.               !! since the last setting
      type(stepper_type) :: stepper
      logical :: is_stepping = .false.           !! since the last setting
      character(len=:), allocatable :: message
   end type valve_type

   type :: place_type
      type(valve_type), pointer :: valve => null()
      integer(c_intptr_t) :: uses = 0
   end type place_type

   integer(c_intptr_t), parameter :: mark = int(z'5256', c_intptr_t)   !! "RV" on top: no address looks so
   integer, parameter :: bits = 24                                     !! of a place, and of its uses
   integer(c_intptr_t), parameter :: low_bits = 2_c_intptr_t**bits - 1
   integer, parameter :: few_bits = 16                                 !! of a place in a number for Fortran 77; its uses have 15
   integer(c_intptr_t), parameter :: low_few = 2_c_intptr_t**few_bits - 1, low_uses = 2_c_intptr_t**(31 - few_bits) - 1
   type(place_type), allocatable :: places(:)

contains

   !> A handle for a valve, which the list then owns.
   subroutine open_handle(valve, handle)
      type(valve_type), pointer, intent(in) :: valve
      type(c_ptr), intent(out) :: handle
      integer(c_intptr_t) :: place

      !$omp critical (rv_handle_list)
      call find_place(place)
      places(place)%valve => valve
      places(place)%uses = iand(places(place)%uses + 1, low_bits)
      handle = handle_at(place)
      !$omp end critical (rv_handle_list)
   end subroutine open_handle

   !> A free place; the list grows if there is none.
   subroutine find_place(place)
      integer(c_intptr_t), intent(out) :: place
      type(place_type), allocatable :: longer(:)
      integer(c_intptr_t) :: n

      if (.not. allocated(places)) allocate(places(16))
      n = size(places, kind=c_intptr_t)
      do place = 1, n
         if (.not. associated(places(place)%valve)) return
      end do
      allocate(longer(2*n))
      longer(:n) = places
      call move_alloc(longer, places)
   end subroutine find_place

   !> The valve of a handle; null if it is none, or closed.
   subroutine valve_of(handle, valve)
      type(c_ptr), intent(in) :: handle
      type(valve_type), pointer, intent(out) :: valve

      !$omp critical (rv_handle_list)
      call look_up(handle, .false., valve)
      !$omp end critical (rv_handle_list)
   end subroutine valve_of

   !> Take a valve out of the list; it is the caller's then. Null as for valve_of.
   subroutine close_handle(handle, valve)
      type(c_ptr), intent(inout) :: handle
      type(valve_type), pointer, intent(out) :: valve

      !$omp critical (rv_handle_list)
      call look_up(handle, .true., valve)
      !$omp end critical (rv_handle_list)
      handle = c_null_ptr
   end subroutine close_handle

   !> The positive number that stands for an open handle in Fortran 77; 0 if it has none, past 65535 valves at once.
   pure integer(c_int) function number_of(handle) result(number)
      type(c_ptr), intent(in) :: handle
      integer(c_intptr_t) :: whole, place, uses

      whole = transfer(handle, whole)
      place = iand(whole, low_bits)
      uses = iand(shiftr(whole, bits), low_uses)
      number = 0
      if (place <= low_few) number = int(ior(shiftl(uses, few_bits), place), c_int)
   end function number_of

   !> The handle that such a number stands for; NULL if it was closed or never was one.
   type(c_ptr) function handle_of(number) result(handle)
      integer(c_int), intent(in) :: number
      integer(c_intptr_t) :: place

      handle = c_null_ptr
      place = iand(int(number, c_intptr_t), low_few)
      !$omp critical (rv_handle_list)
      if (allocated(places) .and. number > 0) then
         if (place >= 1 .and. place <= size(places, kind=c_intptr_t)) then
            if (iand(places(place)%uses, low_uses) == shiftr(number, few_bits)) handle = handle_at(place)
         end if
      end if
      !$omp end critical (rv_handle_list)
   end function handle_of

   !> The handle last given away for a place.
   type(c_ptr) function handle_at(place) result(handle)
      integer(c_intptr_t), intent(in) :: place

      handle = transfer(ior(shiftl(mark, 2*bits), ior(shiftl(places(place)%uses, bits), place)), handle)
   end function handle_at

   subroutine look_up(handle, take_out, valve)
      type(c_ptr), intent(in) :: handle
      logical, intent(in) :: take_out
      type(valve_type), pointer, intent(out) :: valve
      integer(c_intptr_t) :: number, place

      nullify(valve)
      number = transfer(handle, number)
      place = iand(number, low_bits)
      if (shiftr(number, 2*bits) /= mark .or. .not. allocated(places)) return
      if (place < 1 .or. place > size(places, kind=c_intptr_t)) return
      if (places(place)%uses /= iand(shiftr(number, bits), low_bits)) return
      valve => places(place)%valve
      if (take_out) nullify(places(place)%valve)
   end subroutine look_up

end module rv_handles
