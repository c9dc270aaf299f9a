!> Traces: the response on a grid of times, from dense output.
module rv_sampler
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_dense, only : value_at, derivative
   use rv_lumped, only : lumped_lanes
   use rv_pressure, only : pressure_history
   use rv_step, only : step_type
   implicit none
   private
   public :: sampler_type, new_sampler, n_traces

   integer, parameter :: n_traces = 5  !! displacement, velocity, inlet, outlet, film force: m, m s-1, Pa, Pa, N

   !> Samples taken so far.
   type :: sampler_type
      real(wp), allocatable :: time(:)        !! the grid [s], rising
      real(wp), allocatable :: value(:, :, :) !! (time, n_traces, width); NaN where the case did not get to
      integer, private :: next = 1            !! first grid time still to be sampled
   contains
      procedure :: sample
   end type sampler_type

contains

   pure subroutine new_sampler(self, time, width)
      type(sampler_type), intent(out) :: self
      real(wp), intent(in) :: time(:)
      integer, intent(in) :: width

      self%time = time
      allocate(self%value(size(time), n_traces, width), source=ieee_value(1.0_wp, ieee_quiet_nan))
   end subroutine new_sampler

   !> Fill the grid up to the end of a step. A step of no length samples its instant.
   pure subroutine sample(self, step, lanes, history)
      class(sampler_type), intent(inout) :: self
      type(step_type), intent(in) :: step
      type(lumped_lanes), intent(in) :: lanes
      class(pressure_history), intent(in) :: history
      real(wp), dimension(step%width) :: u, v, force
      real(wp) :: h, s, c(0:5), inlet, outlet
      integer :: i

      h = step%t1 - step%t0
      do while (self%next <= size(self%time))
         if (self%time(self%next) > step%t1) return
         if (self%time(self%next) < step%t0) then   ! before the start of this case
            self%next = self%next + 1
            cycle
         end if
         if (h > 0.0_wp) then
            s = (self%time(self%next) - step%t0)/h
            do i = 1, step%width
               c = step%path(i)
               u(i) = value_at(c, s)
               v(i) = value_at(derivative(c), s)/h
            end do
         else
            u = step%u1
            v = step%v1
         end if
         call history%factors(self%time(self%next), inlet, outlet)
         call lanes%film_force(u, v, force)
         self%value(self%next, 1, :) = u
         self%value(self%next, 2, :) = v
         self%value(self%next, 3, :) = lanes%inlet*inlet
         self%value(self%next, 4, :) = lanes%outlet*outlet
         self%value(self%next, 5, :) = force
         self%next = self%next + 1
      end do
   end subroutine sample

end module rv_sampler
