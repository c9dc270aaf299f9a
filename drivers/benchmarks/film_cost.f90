!> What the film model costs as its mesh and its modes grow: film_cost DECK [MESHES]
!>
!> Prints a Markdown table of processor times, each the least of some rounds: of one solution of the Reynolds equation
!> for the pressure's and every mode's share, of one slope of the film's forces for the Jacobian, and of the deck's first
!> case, which must be of the model film. MESHES: finest film.mesh (3 unless given).
program film_cost
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use rv_block, only : block_result, run_block
   use rv_deck, only : deck_type, read_deck
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_film_case, only : film_of_case
   use rv_film_reed, only : film_reed
   use rv_film_valve, only : film_valve
   use rv_keys, only : key_film_mesh, key_film_modes, key_pressure_inlet_kpa, key_run_model, model_film, n_keys
   use rv_kinds, only : i8, wp
   use rv_reynolds, only : film_state
   use rv_status, only : status_ok
   implicit none
   integer, parameter :: modes(5) = [1, 2, 4, 6, 8]
   integer, parameter :: rounds = 5
   real(wp), parameter :: long_case = 1.0_wp   !! run but once [s]
   real(wp), parameter :: us = 1.0e-6_wp, ms = 1.0e-3_wp
   type(deck_type) :: deck
   type(fault_list) :: faults
   type(error_type), allocatable :: error
   character(len=4096) :: path, word
   integer :: finest, mesh, i, stat

   call get_command_argument(1, path)
   call get_command_argument(2, word)
   finest = 3
   stat = 0
   if (word /= "") read(word, *, iostat=stat) finest
   if (stat /= 0 .or. path == "") call give_up("usage: film_cost DECK [MESHES]")
   call read_deck(trim(path), deck, faults, error)
   if (allocated(error)) call give_up(error%message)
   if (faults%errors() > 0) call give_up(faults%text(1))
   write(output_unit, '(a)') "| mesh | modes | unknowns | a solution µs | a slope µs | a case ms |", "|---|---|---|---|---|---|"
   do mesh = 1, finest
      do i = 1, size(modes)
         call tell_cost(mesh, modes(i))
      end do
   end do

contains

   !> One row of the table.
   subroutine tell_cost(mesh, modes)
      integer, intent(in) :: mesh, modes
      real(wp) :: value(n_keys), time(3)
      type(film_reed) :: reed
      type(film_valve) :: valve
      integer :: k

      deck%value(key_film_mesh) = real(mesh, wp)
      deck%value(key_film_modes) = real(modes, wp)
      call deck%case_values(1_i8, value)
      if (nint(value(key_run_model)) /= model_film) call give_up("the deck's first case is not of the model film")
      call film_of_case(value, reed, valve, error)
      if (allocated(error)) call give_up(error%message)
      time = huge(1.0_wp)
      do k = 1, rounds
         time(:2) = min(time(:2), film_times(reed, valve, value(key_pressure_inlet_kpa), 400/mesh**3))
         if (k == 1 .or. time(3) < long_case) time(3) = min(time(3), case_time())
      end do
      write(output_unit, '("|", 3(1x, i0, " |"), 2(1x, f0.1, " |"), 1x, f0.1, " |")') mesh, modes, &
         & count(.not. (reed%film%mesh%on_hole .or. reed%film%mesh%on_free)), time(:2)/us, time(3)/ms
      flush(output_unit)
   end subroutine tell_cost

   !> One solution and one slope at openings up to a gap [s].
   function film_times(reed, valve, drop, repeats) result(time)
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(in) :: valve
      real(wp), intent(in) :: drop       !! [Pa]
      integer, intent(in) :: repeats
      real(wp) :: time(2), start, middle, finish
      real(wp) :: q(valve%modes), slope(valve%modes, valve%modes)
      type(film_state) :: state
      integer :: k

      q = 0.0_wp
      slope = 0.0_wp
      call cpu_time(start)
      do k = 1, repeats
         q(1) = valve%gap*real(k, wp)/real(repeats, wp)
         call reed%film%solve(valve%gap, valve%viscosity, q, state, error)
      end do
      call cpu_time(middle)
      do k = 1, repeats
         q(1) = 1.0e-3_wp*real(k, wp)
         slope = slope + reed%film%force_slope(state, q, drop)
      end do
      call cpu_time(finish)
      if (allocated(error)) call give_up(error%message)
      if (.not. sum(abs(slope)) > 0.0_wp) call give_up("the film has no slope")
      time = [middle - start, finish - middle]/real(repeats, wp)
   end function film_times

   !> The first case from deck values to results, plate and mesh included [s].
   real(wp) function case_time() result(time)
      type(block_result) :: result
      real(wp) :: start, finish

      call cpu_time(start)
      call run_block(deck, 1_i8, 1_i8, result)
      call cpu_time(finish)
      if (result%status(1) /= status_ok) call give_up(result%message(1)%s)
      time = finish - start
   end function case_time

   subroutine give_up(text)
      character(len=*), intent(in) :: text

      write(error_unit, '(a)') "film_cost: "//text
      stop 1
   end subroutine give_up

end program film_cost
