!> What the integrator sees of a group of cases, whatever their model.
!>
!> A case is a lane: `dofs` generalised displacements q with q'' = a(q, q', t). States are arrays
!> (width, dofs), the lane running fastest. The tip displacement is u = sum of tip_k q_k.
module rv_valve_lanes
   use rv_kinds, only : wp
   implicit none
   private
   public :: valve_lanes, no_film_gap, most_dofs

   real(wp), parameter :: no_film_gap = 1.0e3_wp  !! gap of a lane without film: no reed comes near [m]
   integer, parameter :: most_dofs = 64           !! degrees of freedom of a case, at most

   !> Cases of one model side by side.
   type, abstract :: valve_lanes
      integer :: width = 0                         !! cases
      integer :: dofs = 1                          !! degrees of freedom of a case
      integer :: traces = 0                        !! values in a trace sample
      integer :: nodes = 0                         !! nodes of a film pressure field; 0: the model has none
      real(wp), allocatable :: inlet(:), outlet(:) !! amplitudes of the pressure history [Pa] or [-], (width)
      real(wp), allocatable :: gap(:)              !! g0 [m], (width)
      logical, allocatable :: has_film(:)          !! (width)
      real(wp) :: explicit_up_to = 10.0_wp         !! stiffness_ratio where explicit and implicit steps cost alike, as measured
      real(wp), allocatable :: tip(:)              !! tip displacement per unit of each q, (dofs)
      character(len=:), allocatable :: closure     !! a sentence of the film that was closed last: where
      real(wp), allocatable :: lowest_pressure(:)  !! lowest film pressure seen [Pa], huge if none was, (width)
   contains
      procedure(acceleration_of), deferred :: acceleration
      procedure(linear_form_of), deferred :: linearise
      procedure(film_force_of), deferred :: film_force
      procedure(equilibrium_of), deferred :: equilibrium
      procedure(scales_of), deferred :: scales
      procedure(trace_of), deferred :: trace_values
      procedure(silence_lane), deferred :: silence
      procedure :: correction
      procedure :: stiffness_ratio
      procedure :: decay
      procedure :: fastest_decay
      procedure :: film_forces
      procedure :: pressure_field
   end type valve_lanes

   abstract interface
      !> Accelerations of lanes first..last. `closed` is the first of them whose film is closed, or 0.
      subroutine acceleration_of(self, first, last, inlet, outlet, q, v, a, closed)
         import :: valve_lanes, wp
         class(valve_lanes), intent(inout) :: self
         integer, intent(in) :: first, last
         real(wp), intent(in) :: inlet, outlet                  !! factors of the pressure history
         real(wp), intent(in) :: q(first:last, self%dofs)
         real(wp), intent(in) :: v(first:last, self%dofs)
         real(wp), intent(out) :: a(first:last, self%dofs)
         integer, intent(out) :: closed
      end subroutine acceleration_of

      !> Accelerations of lanes first..last and their derivatives with respect to q and v.
      subroutine linear_form_of(self, first, last, inlet, outlet, q, v, a, a_q, a_v, closed)
         import :: valve_lanes, wp
         class(valve_lanes), intent(inout) :: self
         integer, intent(in) :: first, last
         real(wp), intent(in) :: inlet, outlet
         real(wp), intent(in) :: q(first:last, self%dofs)
         real(wp), intent(in) :: v(first:last, self%dofs)
         real(wp), intent(out) :: a(first:last, self%dofs)
         real(wp), intent(out) :: a_q(first:last, self%dofs, self%dofs)   !! da_i/dq_k at (:, i, k)
         real(wp), intent(out) :: a_v(first:last, self%dofs, self%dofs)
         integer, intent(out) :: closed
      end subroutine linear_form_of

      !> Force with which the film resists the motion of one lane, referred to the tip, and its rate of change.
      !>
      !> Positive against closing. Film models also keep the lowest film pressure they see.
      subroutine film_force_of(self, lane, inlet, outlet, q, v, a, force, rate)
         import :: valve_lanes, wp
         class(valve_lanes), intent(inout) :: self
         integer, intent(in) :: lane
         real(wp), intent(in) :: inlet, outlet
         real(wp), intent(in) :: q(self%dofs), v(self%dofs), a(self%dofs)
         real(wp), intent(out) :: force   !! [N]
         real(wp), intent(out) :: rate    !! [N s-1]
      end subroutine film_force_of

      !> Static displacements under given factors; not found where the pressure closes the film.
      subroutine equilibrium_of(self, inlet, outlet, q, found)
         import :: valve_lanes, wp
         class(valve_lanes), intent(inout) :: self
         real(wp), intent(in) :: inlet, outlet
         real(wp), intent(out) :: q(self%width, self%dofs)
         logical, intent(out) :: found(self%width)
      end subroutine equilibrium_of

      !> Sizes of displacement and velocity that the tolerance is relative to, for a largest pressure difference.
      subroutine scales_of(self, span, q_scale, v_scale)
         import :: valve_lanes, wp
         class(valve_lanes), intent(in) :: self
         real(wp), intent(in) :: span(self%width)   !! [Pa]
         real(wp), intent(out) :: q_scale(self%width, self%dofs)
         real(wp), intent(out) :: v_scale(self%width, self%dofs)
      end subroutine scales_of

      !> One trace sample of one lane.
      subroutine trace_of(self, lane, inlet, outlet, q, v, value)
         import :: valve_lanes, wp
         class(valve_lanes), intent(inout) :: self
         integer, intent(in) :: lane
         real(wp), intent(in) :: inlet, outlet
         real(wp), intent(in) :: q(self%dofs), v(self%dofs)
         real(wp), intent(out) :: value(self%traces)
      end subroutine trace_of

      !> Take a lane out: no force, so that it stays at q = v = 0.
      subroutine silence_lane(self, lane)
         import :: valve_lanes
         class(valve_lanes), intent(inout) :: self
         integer, intent(in) :: lane
      end subroutine silence_lane
   end interface

contains

   !> Newton's correction dv for v = base_v + gamma a(base_q + gamma v, v) of lanes first..last, of one degree of freedom,
   !> and the film under the tip at v.
   subroutine correction(self, first, last, inlet, outlet, gamma, base_q, base_v, v, dv, film, closed)
      class(valve_lanes), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: gamma                                        !! [s], > 0
      real(wp), dimension(first:last), intent(in) :: base_q, base_v, v     !! [m], [m s-1]
      real(wp), dimension(first:last), intent(out) :: dv, film             !! [m s-1], [m]
      integer, intent(out) :: closed
      real(wp), dimension(first:last) :: q, a, a_q, a_v

      q = base_q + gamma*v
      film = q + self%gap(first:last)
      call self%linearise(first, last, inlet, outlet, q, v, a, a_q, a_v, closed)
      dv = -(v - base_v - gamma*a)/(1.0_wp - gamma*(a_v + gamma*a_q))
   end subroutine correction

   !> What an explicit method pays for: rate of decay at rest over natural frequency, of every lane [-].
   !>
   !> Models that only an implicit method can integrate are as stiff as can be.
   pure function stiffness_ratio(self) result(ratio)
      class(valve_lanes), intent(in) :: self
      real(wp) :: ratio(self%width)

      ratio = huge(1.0_wp)
   end function stiffness_ratio

   !> Rate at which the film brings one lane's velocity to that of its quasi-static motion [s-1]; 0 if not known.
   pure real(wp) function decay(self, lane, q)
      class(valve_lanes), intent(in) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: q(self%dofs)

      associate (unused => [real(lane, wp), q])
      end associate
      decay = 0.0_wp
   end function decay

   !> The largest decay of all lanes [s-1], of those whose film acts at velocities v. Models of many lanes have a faster one.
   pure real(wp) function fastest_decay(self, q, v)
      class(valve_lanes), intent(in) :: self
      real(wp), intent(in), dimension(self%width, self%dofs) :: q, v
      integer :: i

      associate (unused => v)
      end associate
      fastest_decay = 0.0_wp
      do i = 1, self%width
         fastest_decay = max(fastest_decay, self%decay(i, q(i, :)))
      end do
   end function fastest_decay

   !> film_force of all lanes, none where a lane has no film. Models of many lanes have a faster one of their own.
   subroutine film_forces(self, inlet, outlet, q, v, a, force, rate)
      class(valve_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in), dimension(self%width, self%dofs) :: q, v, a
      real(wp), intent(out), dimension(self%width) :: force, rate   !! [N], [N s-1]
      integer :: i

      force = 0.0_wp
      rate = 0.0_wp
      do i = 1, self%width
         if (self%has_film(i)) call self%film_force(i, inlet, outlet, q(i, :), v(i, :), a(i, :), force(i), rate(i))
      end do
   end subroutine film_forces

   !> Film pressure of one lane at the nodes of its mesh [Pa]. Models without a film field have no nodes.
   subroutine pressure_field(self, lane, inlet, outlet, q, v, pressure)
      class(valve_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs)
      real(wp), intent(out) :: pressure(self%nodes)

      associate (unused => [inlet, outlet, q, v, real(lane, wp)])
      end associate
      pressure = 0.0_wp
   end subroutine pressure_field

end module rv_valve_lanes
