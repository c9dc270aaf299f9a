!> What the film models' times owe to modes, mesh and tolerance; the order in the step; a small motion against the
!> linear equation it becomes.
program test_film_convergence
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_film_reed, only : film_reed
   use rv_film_valve, only : film_valve
   use rv_lanes, only : lane_outcome, lane_settings
   use rv_pressure, only : square_wave, new_square_wave
   use rv_reynolds, only : film_state
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_film, only : no_times, oil, paper_case, paper_reed, run_film, run_table
   use paper_valve, only : kpa, mm, ms
   implicit none

   !> M q'' + C q' + K q = R(t) f with constant matrices.
   type :: linear_motion
      real(wp) :: inverse_mass(4, 4), damping(4, 4), stiffness(4), load(4)
      type(square_wave) :: wave
   end type linear_motion

   type(suite_type) :: suite
   integer, parameter :: fall = 5, closing = 6
   real(wp), parameter :: gap = 0.05_wp*mm, inlet = 20.0_wp*kpa

   call modes()
   call mesh()
   call tolerance()
   call order_in_the_step()
   call small_motion()
   call suite%finish()

contains

   !> Fall and closing time [s] of the paper's valve.
   function times(reed, rtol) result(time)
      type(film_reed), intent(in) :: reed
      real(wp), intent(in) :: rtol
      real(wp) :: time(2)
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings

      settings%t_end = 25.0_wp*ms
      settings%rtol = rtol
      call run_film(reed, paper_case(reed, gap, inlet), settings, no_times, outcome)
      time = outcome%measure([fall, closing], 1)
   end function times

   !> Ever more modes: the times rise to a limit, the reference values; four modes are within 0.35 %.
   subroutine modes()
      integer, parameter :: number(5) = [1, 2, 4, 6, 12]
      real(wp) :: time(2, 5), off(2, 4)
      integer :: k

      do k = 1, 5
         time(:, k) = times(paper_reed(number(k)), 1.0e-5_wp)
      end do
      off = time(:, :4)/spread(time(:, 5), 2, 4) - 1.0_wp
      do k = 1, 4
         call suite%true(to_text(number(k))//" modes less 12: fall "//to_text(100.0_wp*off(1, k), 2)//" %, closing " &
            & //to_text(100.0_wp*off(2, k), 2)//" %", all(off(:, k) < 0.0_wp))
      end do
      call suite%true("each number of modes is closer than the one before", all(abs(off(:, 2:)) < 0.7_wp*abs(off(:, :3))))
      call suite%close("four modes, worst", maxval(abs(off(:, 3))), 0.0_wp, 0.0_wp, 3.5e-3_wp)
      call suite%close("twelve modes: fall time [ms]", time(1, 5)/ms, 1.547_wp, 1.0e-3_wp, 0.0_wp)
      call suite%close("closing time [ms]", time(2, 5)/ms, 3.894_wp, 1.0e-3_wp, 0.0_wp)
   end subroutine modes

   !> The mesh's part of the times, by the table: of fourth order, below 0.1 % at the default.
   subroutine mesh()
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      type(film_reed) :: reed
      type(film_valve) :: valve(1)
      real(wp) :: time(2, 3), order(2)
      integer :: k

      settings%t_end = 25.0_wp*ms
      settings%rtol = 1.0e-9_wp
      do k = 1, 3
         reed = paper_reed(1, finer=2**(k - 1))
         valve(1) = paper_case(reed, gap, inlet)
         call run_table(reed, valve, settings, no_times, outcome)
         time(:, k) = outcome%measure([fall, closing], 1)
      end do
      order = log((time(:, 2) - time(:, 1))/(time(:, 3) - time(:, 2)))/log(2.0_wp)
      call suite%close("order of the fall time in the mesh", order(1), 4.0_wp, 0.0_wp, 0.4_wp)
      call suite%close("order of the closing time", order(2), 4.0_wp, 0.0_wp, 0.4_wp)
      call suite%close("default mesh over one four times as fine", maxval(abs(time(:, 1)/time(:, 3) - 1.0_wp)), 0.0_wp, 0.0_wp, &
         & 1.0e-3_wp)
   end subroutine mesh

   !> Ten times the tolerance bounds the error of the times, relative to their size.
   subroutine tolerance()
      real(wp), parameter :: rtol(2) = [1.0e-4_wp, 1.0e-6_wp]
      type(film_reed) :: reed
      real(wp) :: exact(2)
      integer :: k

      reed = paper_reed(2)
      exact = times(reed, 1.0e-9_wp)
      do k = 1, 2
         call suite%close("tolerance "//to_text(rtol(k))//": fall and closing time off by", &
            & maxval(abs(times(reed, rtol(k))/exact - 1.0_wp)), 0.0_wp, 0.0_wp, 10.0_wp*rtol(k))
      end do
   end subroutine tolerance

   !> Fixed steps over opening and closing: the fifth order of the method, as far as the stiff modes let it.
   subroutine order_in_the_step()
      real(wp) :: u(4), order
      integer :: k

      do k = 1, 4
         u(k) = displacement(0.05_wp*ms/2.0_wp**(k - 1))
      end do
      order = log(abs((u(2) - u(3))/(u(3) - u(4))))/log(2.0_wp)
      call suite%close("observed order", order, 5.0_wp, 0.0_wp, 0.6_wp)
      call suite%close("steps of 0.0125 ms: displacement off by [mm]", (u(3) - u(4))/mm, 0.0_wp, 0.0_wp, 1.0e-8_wp)
   end subroutine order_in_the_step

   !> Displacement at 2.25 ms, mid in the closing of a wave of 4 ms.
   real(wp) function displacement(step) result(u)
      real(wp), intent(in) :: step
      type(film_reed) :: reed
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings

      settings%t_end = 2.25_wp*ms
      settings%fixed_step = step
      settings%rtol = 1.0e-12_wp   ! of the stage equations
      reed = paper_reed(3)
      call run_film(reed, paper_case(reed, gap, inlet), settings, [settings%t_end], outcome, wave_4ms())
      u = outcome%trace(1, 1, 1)
   end function displacement

   function wave_4ms() result(wave)
      type(square_wave) :: wave
      type(error_type), allocatable :: error

      call new_square_wave(wave, 4.0_wp*ms, 1.0_wp*ms, error)
      if (allocated(error)) error stop "the wave is refused"
   end function wave_4ms

   !> At 1e-6 kPa the film keeps its thickness: constant matrices, marched by the classical Runge-Kutta method.
   subroutine small_motion()
      integer, parameter :: samples = 9
      real(wp), parameter :: step = 1.0e-3_wp*ms, pressure = 1.0e-6_wp*kpa
      type(film_reed) :: reed
      type(film_valve) :: valve
      type(film_state) :: film
      type(linear_motion) :: linear
      type(lane_outcome) :: outcome
      type(lane_settings) :: settings
      type(error_type), allocatable :: error
      real(wp) :: y(8), off, time(samples)
      integer :: i, n

      reed = paper_reed(4)
      valve = paper_case(reed, gap, pressure)
      time = [(0.4_wp*ms*real(i, wp), i = 1, samples)]
      settings%t_end = 4.0_wp*ms
      settings%rtol = 1.0e-9_wp
      call run_film(reed, valve, settings, time, outcome, wave_4ms())
      call reed%film%solve(gap, oil%viscosity, [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], film, error)
      linear = linear_motion(inverse_of(valve%mass), valve%damping + film%damping, valve%stiffness, &
         & pressure*(reed%hole + film%land), wave_4ms())
      y = 0.0_wp
      off = 0.0_wp
      do i = 1, samples
         do n = 1, nint(0.4_wp*ms/step)
            call runge_kutta_step(linear, 0.4_wp*ms*real(i - 1, wp) + step*real(n - 1, wp), step, y)
         end do
         off = max(off, abs(outcome%trace(i, 1, 1) - sum(y(:4))))
      end do
      call suite%close("small motion against the linear equation, relative to its largest displacement", &
         & off/maxval(outcome%trace(:, 1, 1)), 0.0_wp, 0.0_wp, 1.0e-7_wp)
   end subroutine small_motion

   subroutine runge_kutta_step(linear, t, step, y)
      type(linear_motion), intent(in) :: linear
      real(wp), intent(in) :: t, step
      real(wp), intent(inout) :: y(8)
      real(wp) :: k(8, 4)

      k(:, 1) = slope(linear, t, y)
      k(:, 2) = slope(linear, t + 0.5_wp*step, y + 0.5_wp*step*k(:, 1))
      k(:, 3) = slope(linear, t + 0.5_wp*step, y + 0.5_wp*step*k(:, 2))
      k(:, 4) = slope(linear, t + step, y + step*k(:, 3))
      y = y + step/6.0_wp*(k(:, 1) + 2.0_wp*k(:, 2) + 2.0_wp*k(:, 3) + k(:, 4))
   end subroutine runge_kutta_step

   function slope(linear, t, y) result(rate)
      type(linear_motion), intent(in) :: linear
      real(wp), intent(in) :: t, y(8)
      real(wp) :: rate(8), inlet_factor, outlet_factor

      call linear%wave%factors(t, inlet_factor, outlet_factor)
      rate(:4) = y(5:)
      rate(5:) = matmul(linear%inverse_mass, inlet_factor*linear%load - matmul(linear%damping, y(5:)) - linear%stiffness*y(:4))
   end function slope

   !> Inverse of a symmetric positive definite matrix by Gauss and Jordan.
   pure function inverse_of(matrix) result(inverse)
      real(wp), intent(in) :: matrix(:, :)
      real(wp) :: inverse(size(matrix, 1), size(matrix, 1)), a(size(matrix, 1), size(matrix, 1))
      integer :: i, j

      a = matrix
      inverse = 0.0_wp
      do i = 1, size(a, 1)
         inverse(i, i) = 1.0_wp
      end do
      do i = 1, size(a, 1)
         inverse(i, :) = inverse(i, :)/a(i, i)
         a(i, :) = a(i, :)/a(i, i)
         do j = 1, size(a, 1)
            if (j == i) cycle
            inverse(j, :) = inverse(j, :) - a(j, i)*inverse(i, :)
            a(j, :) = a(j, :) - a(j, i)*a(i, :)
         end do
      end do
   end function inverse_of

end program test_film_convergence
