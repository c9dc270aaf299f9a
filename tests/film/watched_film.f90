!> Film lanes that are watched while they run: the volume balance at every step and all displacements as traces.
module watched_film
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_film_lanes, only : film_lanes, new_film_lanes
   use rv_film_reed, only : film_reed
   use rv_film_valve, only : film_valve
   use rv_reynolds, only : film_state
   use paper_film, only : oil
   implicit none
   private
   public :: watched_lanes, new_watched_lanes, balance_type

   !> What was seen; lives outside the lanes, which the run uses up.
   type :: balance_type
      integer :: states = 0             !! looked at: every accepted step, and more about the largest film force
      real(wp) :: worst = 0.0_wp        !! |inflow - outflow - swept rate| over the largest of the three
      real(wp) :: thinnest = huge(1.0_wp)  !! film [m]
   end type balance_type

   type, extends(film_lanes) :: watched_lanes
      type(film_reed), allocatable :: planform
      type(balance_type), pointer :: balance => null()
   contains
      procedure :: film_force
      procedure :: trace_values
   end type watched_lanes

contains

   subroutine new_watched_lanes(self, reed, valve, balance)
      type(watched_lanes), intent(out) :: self
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(in) :: valve
      type(balance_type), target, intent(in) :: balance

      call new_film_lanes(self%film_lanes, reed, valve)
      self%planform = reed
      self%balance => balance
      self%traces = 2*self%dofs
   end subroutine new_watched_lanes

   subroutine film_force(self, lane, inlet, outlet, q, v, a, force, rate)
      class(watched_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs), a(self%dofs)
      real(wp), intent(out) :: force, rate
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: in, out, swept

      call self%film_lanes%film_force(lane, inlet, outlet, q, v, a, force, rate)
      associate (film => self%planform%film)
         call film%solve(self%gap(lane), oil%viscosity, q, state, error)
         if (allocated(error)) return
         call film%inflow(state, v, self%inlet(lane)*inlet - self%outlet(lane)*outlet, in, out)
         swept = 2.0_wp*sum(matmul(film%sweep, v))
      end associate
      self%balance%states = self%balance%states + 1
      self%balance%thinnest = min(self%balance%thinnest, minval(state%thickness))
      if (max(abs(in), abs(out), abs(swept)) > 0.0_wp) then
         self%balance%worst = max(self%balance%worst, abs(in - out - swept)/max(abs(in), abs(out), abs(swept)))
      end if
   end subroutine film_force

   !> Displacements, then velocities.
   subroutine trace_values(self, lane, inlet, outlet, q, v, value)
      class(watched_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs)
      real(wp), intent(out) :: value(self%traces)

      associate (unused => [inlet, outlet, real(lane, wp)])
      end associate
      value = [q, v]
   end subroutine trace_values

end module watched_film
