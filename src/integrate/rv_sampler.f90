!> Traces and fields: the response at given times, from dense output.
module rv_sampler
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_dense, only : value_at, derivative
   use rv_pressure, only : pressure_history
   use rv_step, only : step_type
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: sampler_type, new_sampler

   !> Rate of decay times step above which accelerations at the steps' ends tell nothing any more.
   real(wp), parameter :: stiff = 300.0_wp

   !> Samples taken so far: traces, and film pressure fields on a grid of their own.
   type :: sampler_type
      real(wp), allocatable :: value(:, :, :) !! (time, traces, width); NaN where the case did not get to
      real(wp), allocatable :: field(:, :, :) !! (nodes, field time, width) [Pa]; NaN likewise
      real(wp), allocatable, private :: time(:), field_time(:)   !! the grids [s], rising
      integer, private :: next = 1, next_field = 1               !! first times still to be sampled
   contains
      procedure :: sample
   end type sampler_type

contains

   pure subroutine new_sampler(self, time, lanes, field_time)
      type(sampler_type), intent(out) :: self
      real(wp), intent(in) :: time(:)
      class(valve_lanes), intent(in) :: lanes
      real(wp), intent(in), optional :: field_time(:)
      real(wp) :: nan

      nan = ieee_value(1.0_wp, ieee_quiet_nan)
      self%time = time
      self%field_time = [real(wp) ::]
      if (present(field_time)) self%field_time = field_time
      allocate(self%value(size(time), lanes%traces, lanes%width), source=nan)
      allocate(self%field(lanes%nodes, size(self%field_time), lanes%width), source=nan)
   end subroutine new_sampler

   !> Fill the grids up to the end of a step. A step of no length samples its instant.
   subroutine sample(self, step, lanes, history)
      class(sampler_type), intent(inout) :: self
      type(step_type), intent(in) :: step
      class(valve_lanes), intent(inout) :: lanes
      class(pressure_history), intent(in) :: history
      real(wp) :: inlet, outlet
      real(wp), dimension(lanes%dofs) :: q, v
      integer :: i

      do while (is_due(self%time, self%next, step))
         if (self%time(self%next) >= step%t0) then   ! else before the start of this case
            call history%factors(self%time(self%next), inlet, outlet)
            do i = 1, step%width
               if (.not. step%live(i)) cycle
               call state_at(step, lanes, i, self%time(self%next), q, v)
               call lanes%trace_values(i, inlet, outlet, q, v, self%value(self%next, :, i))
            end do
         end if
         self%next = self%next + 1
      end do
      do while (is_due(self%field_time, self%next_field, step))
         if (self%field_time(self%next_field) >= step%t0) then
            call history%factors(self%field_time(self%next_field), inlet, outlet)
            do i = 1, step%width
               if (.not. step%live(i)) cycle
               call state_at(step, lanes, i, self%field_time(self%next_field), q, v)
               call lanes%pressure_field(i, inlet, outlet, q, v, self%field(:, self%next_field, i))
            end do
         end if
         self%next_field = self%next_field + 1
      end do
   end subroutine sample

   pure logical function is_due(time, next, step)
      real(wp), intent(in) :: time(:)
      integer, intent(in) :: next
      type(step_type), intent(in) :: step

      is_due = .false.
      if (next <= size(time)) is_due = time(next) <= step%t1
   end function is_due

   pure subroutine state_at(step, lanes, i, t, q, v)
      type(step_type), intent(in) :: step
      class(valve_lanes), intent(in) :: lanes
      integer, intent(in) :: i
      real(wp), intent(in) :: t
      real(wp), intent(out) :: q(:), v(:)
      real(wp) :: h, c(0:5)
      logical :: follows_film
      integer :: k

      h = step%t1 - step%t0
      q = step%q1(i, :)
      v = step%v1(i, :)
      if (.not. h > 0.0_wp) return
      follows_film = lanes%decay(i, q)*h > stiff
      do k = 1, size(q)
         if (follows_film) then
            c = step%calm_path(i, k)
         else
            c = step%path(i, k)
         end if
         q(k) = value_at(c, (t - step%t0)/h)
         v(k) = value_at(derivative(c), (t - step%t0)/h)/h
      end do
   end subroutine state_at

end module rv_sampler
