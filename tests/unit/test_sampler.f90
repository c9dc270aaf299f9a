!> Traces: the grid is filled once, from dense output, where the run is; it is empty where the run is not.
program test_sampler
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp
   use rv_dense, only : derivative, value_at
   use rv_error, only : error_type
   use rv_pressure, only : square_wave, new_square_wave
   use rv_sampler, only : sampler_type, new_sampler
   use rv_step, only : step_type, new_step
   use rv_text, only : to_text
   use check, only : suite_type
   use spring_lanes, only : spring_valve, new_spring_valve
   implicit none
   type(suite_type) :: suite
   type(square_wave) :: history
   type(error_type), allocatable :: error
   integer, parameter :: dofs = 2
   !> A quintic, which dense output meets exactly; every displacement of every lane is a multiple of it.
   real(wp), parameter :: curve(0:5) = [1.0_wp, -0.5_wp, 0.25_wp, 0.125_wp, -0.0625_wp, 0.03125_wp]
   real(wp), parameter :: knot(6) = [1.0_wp, 1.1_wp, 1.5_wp, 2.5_wp, 2.6_wp, 3.0_wp]
   real(wp), parameter :: limit = 64.0_wp*epsilon(1.0_wp)

   call new_square_wave(history, 10.0_wp, 4.0_wp, error)   ! falls from 3 s on
   call suite%no_error("a wave", error)
   call inside()
   call before_and_after()
   call at_the_ends()
   call no_grid()
   call failed_lane()
   call suite%finish()

contains

   !> Many samples in one step and none in another: displacement and velocity of the tip of each lane.
   subroutine inside()
      real(wp) :: time(9), u, p, outlet
      type(sampler_type) :: sampler
      integer :: i, lane

      time = [1.05_wp, 1.2_wp, 1.3_wp, 1.4_wp, 1.45_wp, 1.9_wp, 2.4_wp, 2.7_wp, 2.9_wp]
      call sampled(sampler, time)
      do lane = 1, 3
         do i = 1, size(time)
            u = tip_factor(lane)*value_at(curve, time(i))
            call suite%close("tip of lane "//to_text(lane)//" at "//to_text(time(i))//" s", sampler%value(i, 1, lane), u, &
               & limit, 0.0_wp)
            call history%factors(time(i), p, outlet)
            call suite%close("its pressure then", sampler%value(i, 3, lane), 10.0_wp*real(lane, wp)*p - outlet, limit, 0.0_wp)
         end do
         call suite%close("largest error of its velocity", maxval([(abs(sampler%value(i, 2, lane) &
            & - tip_factor(lane)*value_at(derivative(curve), time(i))), i=1, size(time))]), 0.0_wp, 0.0_wp, 16.0_wp*limit)
      end do
   end subroutine inside

   !> The case runs from 1 to 3 s on a grid from 0 to 4 s.
   subroutine before_and_after()
      type(sampler_type) :: sampler
      real(wp) :: time(17)
      integer :: i

      time = [(0.25_wp*real(i, wp), i=0, 16)]
      call sampled(sampler, time)
      call suite%true("nothing before the start", all(ieee_is_nan(sampler%value(:4, :, :))))
      call suite%true("all between start and end", .not. any(ieee_is_nan(sampler%value(5:13, :, :))))
      call suite%true("nothing after the end", all(ieee_is_nan(sampler%value(14:, :, :))))
   end subroutine before_and_after

   !> Samples on the start, on ends of steps and on the end of the run; the start needs no step.
   subroutine at_the_ends()
      type(sampler_type) :: sampler
      integer :: i

      call sampled(sampler, knot)
      do i = 1, size(knot)
         call suite%close("sample on knot "//to_text(i), sampler%value(i, 1, 1), value_at(curve, knot(i)), limit, 0.0_wp)
      end do
      call sampled(sampler, [1.0_wp, 2.0_wp], steps=0)
      do i = 1, 3
         call suite%close("the start, without a step", sampler%value(1, 1, i), tip_factor(i)*value_at(curve, 1.0_wp), limit, 0.0_wp)
         call suite%close("its velocity", sampler%value(1, 2, i), tip_factor(i)*value_at(derivative(curve), 1.0_wp), limit, 0.0_wp)
      end do
      call suite%true("no more than that", all(ieee_is_nan(sampler%value(2, :, :))))
   end subroutine at_the_ends

   subroutine no_grid()
      type(sampler_type) :: sampler

      call sampled(sampler, [real(wp) ::])
      call suite%equal("samples without a grid", size(sampler%value, 1), 0)
      call suite%equal("lanes all the same", size(sampler%value, 3), 3)
   end subroutine no_grid

   !> The second lane fails at 1.5 s.
   subroutine failed_lane()
      type(sampler_type) :: sampler
      real(wp), parameter :: time(4) = [1.2_wp, 1.5_wp, 1.6_wp, 3.0_wp]

      call sampled(sampler, time, fails_at=1.5_wp)
      call suite%true("a lane that fails is known up to there", .not. any(ieee_is_nan(sampler%value(:2, :, 2))))
      call suite%true("and no further", all(ieee_is_nan(sampler%value(3:, :, 2))))
      call suite%true("the others are known to the end", .not. any(ieee_is_nan(sampler%value(:, :, [1, 3]))))
   end subroutine failed_lane

   !> Tip of a lane over the curve: 2 q1 - q2, q1 = lane*curve, q2 = curve.
   pure real(wp) function tip_factor(lane)
      integer, intent(in) :: lane

      tip_factor = 2.0_wp*real(lane, wp) - 1.0_wp
   end function tip_factor

   !> Sample three lanes along the knots.
   subroutine sampled(sampler, time, steps, fails_at)
      type(sampler_type), intent(out) :: sampler
      real(wp), intent(in) :: time(:)
      integer, intent(in), optional :: steps          !! all unless given
      real(wp), intent(in), optional :: fails_at      !! instant from which the second lane is out
      type(spring_valve) :: lanes
      type(step_type) :: step
      real(wp), allocatable :: q(:, :), v(:, :), a(:, :)
      integer :: k, last

      call new_spring_valve(lanes, 3, dofs)
      lanes%inlet = [10.0_wp, 20.0_wp, 30.0_wp]
      lanes%outlet = 1.0_wp
      lanes%tip = [2.0_wp, -1.0_wp]
      last = size(knot)
      if (present(steps)) last = 1 + steps
      call new_sampler(sampler, time, lanes)
      call new_step(step, knot(1), state(curve, knot(1)), state(derivative(curve), knot(1)), &
         & state(derivative(derivative(curve)), knot(1)), lanes%tip, spread(.true., 1, 3))
      call sampler%sample(step, lanes, history)
      do k = 2, last
         if (present(fails_at)) step%live(2) = knot(k - 1) < fails_at
         q = state(curve, knot(k))
         v = state(derivative(curve), knot(k))
         a = state(derivative(derivative(curve)), knot(k))
         call step%go_on(knot(k), q, v, a)
         call sampler%sample(step, lanes, history)
      end do
   end subroutine sampled

   !> Lane i: q1 = i c(t), q2 = c(t).
   pure function state(c, t) result(q)
      real(wp), intent(in) :: c(0:), t
      real(wp) :: q(3, dofs)

      q(:, 1) = [1.0_wp, 2.0_wp, 3.0_wp]*value_at(c, t)
      q(:, 2) = value_at(c, t)
   end function state

end program test_sampler
