!> The film model with N plate modes, as lanes of one case each.
module rv_film_lanes
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_film_reed, only : film_reed
   use rv_film_valve, only : film_valve
   use rv_reynolds, only : film_state, film_type
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: film_lanes, new_film_lanes, film_trace, film_traces, film_field

   integer, parameter :: film_traces = 10  !! values of film_trace

   interface
      subroutine dpotrf(uplo, n, a, lda, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: info
      end subroutine dpotrf

      subroutine dpotrs(uplo, n, nrhs, a, lda, b, ldb, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(in) :: a(lda, *)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dpotrs

      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv
   end interface

   !> One case; width is 1.
   type, extends(valve_lanes) :: film_lanes
      type(film_reed), allocatable, private :: reed
      type(film_valve), private :: valve
      real(wp), allocatable, private :: factor(:, :)   !! Cholesky factor of the mass matrix
      logical, private :: silent = .false.
   contains
      procedure :: acceleration
      procedure :: linearise
      procedure :: film_force
      procedure :: equilibrium
      procedure :: scales
      procedure :: trace_values
      procedure :: silence
      procedure :: pressure_field
   end type film_lanes

contains

   !> Lanes of one case.
   subroutine new_film_lanes(self, reed, valve)
      type(film_lanes), intent(out) :: self
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(in) :: valve
      integer :: info

      self%width = 1
      self%dofs = valve%modes
      self%traces = film_traces
      self%nodes = reed%film%mesh%nodes
      self%inlet = [valve%inlet]
      self%outlet = [valve%outlet]
      self%gap = [valve%gap]
      self%has_film = [.true.]
      allocate(self%tip(valve%modes), source=1.0_wp)
      self%lowest_pressure = [huge(1.0_wp)]
      self%reed = reed
      self%valve = valve
      self%factor = valve%mass
      call dpotrf("L", valve%modes, self%factor, valve%modes, info)   ! positive definite by construction
      if (info /= 0) self%silent = .true.
   end subroutine new_film_lanes

   subroutine acceleration(self, first, last, inlet, outlet, q, v, a, closed)
      class(film_lanes), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(first:last, self%dofs), v(first:last, self%dofs)
      real(wp), intent(out) :: a(first:last, self%dofs)
      integer, intent(out) :: closed
      type(film_state) :: state

      closed = 0
      a = 0.0_wp
      if (self%silent) return
      call find_acceleration(self, inlet, outlet, q(1, :), v(1, :), a(1, :), state, closed)
   end subroutine acceleration

   subroutine find_acceleration(self, inlet, outlet, q, v, a, state, closed)
      type(film_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet, q(:), v(:)
      real(wp), intent(out) :: a(:)
      type(film_state), intent(out) :: state
      integer, intent(out) :: closed
      type(error_type), allocatable :: error
      real(wp) :: force(self%dofs, 1)
      integer :: info

      closed = 1
      a = 0.0_wp
      call self%reed%film%solve(self%valve%gap, self%valve%viscosity, q, state, error)
      if (allocated(error)) then
         self%closure = error%message
         return
      end if
      closed = 0
      force(:, 1) = drop_of(self, inlet, outlet)*(self%reed%hole + state%land) &
         & - matmul(self%valve%damping + state%damping, v) - self%valve%stiffness*q
      call dpotrs("L", self%dofs, 1, self%factor, self%dofs, force, self%dofs, info)
      a = force(:, 1)
   end subroutine find_acceleration

   subroutine linearise(self, first, last, inlet, outlet, q, v, a, a_q, a_v, closed)
      class(film_lanes), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(first:last, self%dofs), v(first:last, self%dofs)
      real(wp), intent(out) :: a(first:last, self%dofs)
      real(wp), intent(out) :: a_q(first:last, self%dofs, self%dofs), a_v(first:last, self%dofs, self%dofs)
      integer, intent(out) :: closed
      type(film_state) :: state
      real(wp) :: slope(self%dofs, 2*self%dofs)
      integer :: n, i, info

      closed = 0
      a = 0.0_wp
      a_q = 0.0_wp
      a_v = 0.0_wp
      if (self%silent) return
      call find_acceleration(self, inlet, outlet, q(1, :), v(1, :), a(1, :), state, closed)
      if (closed > 0) return
      n = self%dofs
      slope(:, :n) = self%reed%film%force_slope(state, v(1, :), drop_of(self, inlet, outlet))
      do i = 1, n
         slope(i, i) = slope(i, i) - self%valve%stiffness(i)
      end do
      slope(:, n + 1:) = -(self%valve%damping + state%damping)
      call dpotrs("L", n, 2*n, self%factor, n, slope, n, info)
      a_q(1, :, :) = slope(:, :n)
      a_v(1, :, :) = slope(:, n + 1:)
   end subroutine linearise

   !> Film force on the first mode.
   subroutine film_force(self, lane, inlet, outlet, q, v, a, force, rate)
      class(film_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs), a(self%dofs)
      real(wp), intent(out) :: force, rate
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: slope(self%dofs, self%dofs)

      force = 0.0_wp
      rate = 0.0_wp
      if (self%silent) return
      call self%reed%film%solve(self%valve%gap, self%valve%viscosity, q, state, error)
      if (allocated(error)) return
      slope = self%reed%film%force_slope(state, v, 0.0_wp)
      force = -dot_product(state%damping(1, :), v)
      rate = dot_product(slope(1, :), v) - dot_product(state%damping(1, :), a)
      self%lowest_pressure(lane) = min(self%lowest_pressure(lane), self%outlet(lane)*outlet &
         & + minval(self%reed%film%pressure_of(state, v, drop_of(self, inlet, outlet))))
   end subroutine film_force

   !> K q = (p_in - p_out) (int_hole phi + int_land P_0(q) phi) by Newton's method from the film-free solution.
   subroutine equilibrium(self, inlet, outlet, q, found)
      class(film_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(out) :: q(self%width, self%dofs)
      logical, intent(out) :: found(self%width)
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp), dimension(self%dofs) :: x, rest
      real(wp) :: slope(self%dofs, self%dofs), step(self%dofs, 1), drop
      integer :: iteration, i, pivot(self%dofs), info

      found = .false.
      q = 0.0_wp
      if (self%silent) return
      drop = drop_of(self, inlet, outlet)
      rest = 0.0_wp
      x = max(0.0_wp, drop)*self%reed%hole/self%valve%stiffness
      do iteration = 1, 100
         call self%reed%film%solve(self%valve%gap, self%valve%viscosity, x, state, error)
         if (allocated(error)) then
            x = 0.5_wp*(x + rest)   ! rest, the last open state, leads back
            cycle
         end if
         rest = x
         slope = -self%reed%film%force_slope(state, 0.0_wp*x, drop)
         do i = 1, self%dofs
            slope(i, i) = slope(i, i) + self%valve%stiffness(i)
         end do
         step(:, 1) = drop*(self%reed%hole + state%land) - self%valve%stiffness*x
         call dgesv(self%dofs, 1, slope, self%dofs, pivot, step, self%dofs, info)
         if (info /= 0) return
         x = x + step(:, 1)
         found(1) = maxval(abs(step)) <= 1.0e-13_wp*(maxval(abs(x)) + self%valve%gap)
         if (found(1)) exit
      end do
      q(1, :) = x
   end subroutine equilibrium

   subroutine scales(self, span, q_scale, v_scale)
      class(film_lanes), intent(in) :: self
      real(wp), intent(in) :: span(self%width)
      real(wp), intent(out) :: q_scale(self%width, self%dofs), v_scale(self%width, self%dofs)

      q_scale = span(1)*self%reed%hole_area/self%valve%hole_stiffness
      q_scale = min(q_scale, self%valve%gap/3.0_wp)
      where (.not. q_scale > 0.0_wp) q_scale = 1.0e-3_wp*self%valve%gap
      v_scale = self%valve%omega*q_scale
   end subroutine scales

   subroutine trace_values(self, lane, inlet, outlet, q, v, value)
      class(film_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs)
      real(wp), intent(out) :: value(self%traces)

      value = film_trace(self%reed, self%reed%film, self%valve%gap, self%valve%viscosity, &
         & self%inlet(lane)*inlet, self%outlet(lane)*outlet, q, v)
   end subroutine trace_values

   !> Tip displacement [m] and velocity [m s-1]; inlet and outlet pressure [Pa]; film force [N]; forces on part A (land,
   !> x < a), B (rest of the land) and C (hole) of pressure above the outlet's [N]; flow out at the free edges
   !> [m3 s-1]; lowest film pressure [Pa]. What needs a film is NaN where it is closed.
   function film_trace(reed, film, gap, viscosity, inlet, outlet, q, v) result(value)
      type(film_reed), intent(in) :: reed
      type(film_type), intent(in) :: film
      real(wp), intent(in) :: gap, viscosity, inlet, outlet, q(:), v(:)
      real(wp) :: value(film_traces)
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: p(film%mesh%nodes), in, out

      value(:4) = [sum(q), sum(v), inlet, outlet]
      value(5:) = ieee_value(1.0_wp, ieee_quiet_nan)
      call film%solve(gap, viscosity, q, state, error)
      if (allocated(error)) return
      p = film%pressure_of(state, v, inlet - outlet)
      call film%inflow(state, v, inlet - outlet, in, out)
      value(5) = -dot_product(state%damping(1, :), v)
      value(6) = dot_product(reed%root_weight, p)
      value(7) = dot_product(reed%land_weight, p) - value(6)
      value(8) = (inlet - outlet)*reed%hole_area
      value(9) = out
      value(10) = outlet + minval(p)
   end function film_trace

   subroutine pressure_field(self, lane, inlet, outlet, q, v, pressure)
      class(film_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs)
      real(wp), intent(out) :: pressure(self%nodes)

      pressure = film_field(self%reed%film, self%valve%gap, self%valve%viscosity, &
         & self%inlet(lane)*inlet, self%outlet(lane)*outlet, q, v)
   end subroutine pressure_field

   !> Film pressure at the nodes [Pa], on the scale of inlet and outlet; NaN where the film is closed.
   function film_field(film, gap, viscosity, inlet, outlet, q, v) result(p)
      type(film_type), intent(in) :: film
      real(wp), intent(in) :: gap, viscosity, inlet, outlet, q(:), v(:)
      real(wp) :: p(film%mesh%nodes)
      type(film_state) :: state
      type(error_type), allocatable :: error

      p = ieee_value(1.0_wp, ieee_quiet_nan)
      call film%solve(gap, viscosity, q, state, error)
      if (.not. allocated(error)) p = outlet + film%pressure_of(state, v, inlet - outlet)
   end function film_field

   subroutine silence(self, lane)
      class(film_lanes), intent(inout) :: self
      integer, intent(in) :: lane

      self%silent = .true.
      self%has_film(lane) = .false.
   end subroutine silence

   pure real(wp) function drop_of(self, inlet, outlet) result(drop)
      type(film_lanes), intent(in) :: self
      real(wp), intent(in) :: inlet, outlet

      drop = self%inlet(1)*inlet - self%outlet(1)*outlet
   end function drop_of

end module rv_film_lanes
