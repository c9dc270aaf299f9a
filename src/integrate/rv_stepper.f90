!> One valve under pressures that somebody else computes: step by step, each pressure linear over a step.
!>
!> All that a step depends on is the state: time, displacements, velocities and the length of step to try first. Each
!> step works on a copy of the lanes as they were made, so that nothing they remember leads past the state: who saves
!> it and goes back gets the same bits. Order and error are those of run_lanes; a corner of the pressure lies between
!> two steps, where the integrator starts anew.
module rv_stepper
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_lanes, only : lane_settings, lane_outcome, run_lanes
   use rv_pressure, only : pressure_history
   use rv_status, only : status_ok
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: stepper_type, linear_pressure, new_stepper

   !> Two pressures that go straight from their values at the start to those at the end.
   type, extends(pressure_history) :: linear_pressure
      real(wp) :: finish = 0.0_wp     !! [s], > start
      real(wp) :: inlet(2) = 0.0_wp   !! at start and finish [Pa]
      real(wp) :: outlet(2) = 0.0_wp  !! [Pa]
      real(wp) :: scale = 0.0_wp      !! pressure difference that the tolerance is of, whatever this step's is [Pa]
   contains
      procedure :: factors => linear_factors
      procedure :: span => linear_span
      procedure :: stops => linear_stops
   end type linear_pressure

   !> One valve at one instant.
   type :: stepper_type
      class(valve_lanes), allocatable, private :: lanes   !! as made, of pressure amplitudes 1
      type(lane_settings), private :: settings
      real(wp), private :: scale = 0.0_wp                 !! [Pa]
      real(wp) :: t = 0.0_wp                              !! [s]
      real(wp) :: next_step = 0.0_wp                      !! length of step to try first [s]; 0: not known yet
      real(wp), allocatable :: state(:)                   !! displacements [m], then velocities [m s-1]
      real(wp), allocatable :: sample(:)                  !! trace values at t; before the first step NaN but for the motion
      logical :: has_stepped = .false.                    !! else the first step finds the equilibrium, if so set
      logical :: has_failed = .false.                     !! in the last step: the state is the one before it
   contains
      procedure :: step
   end type stepper_type

contains

   !> Begin at rest at time t. `lanes` is one case of pressure amplitudes 1, and is used up.
   subroutine new_stepper(self, lanes, settings, scale, t)
      type(stepper_type), intent(out) :: self
      class(valve_lanes), allocatable, intent(inout) :: lanes
      type(lane_settings), intent(in) :: settings   !! its times are not looked at
      real(wp), intent(in) :: scale                 !! largest pressure difference to be expected [Pa], > 0
      real(wp), intent(in) :: t                     !! [s]

      call move_alloc(lanes, self%lanes)
      self%settings = settings
      self%scale = scale
      self%t = t
      allocate(self%state(2*self%lanes%dofs), source=0.0_wp)
      allocate(self%sample(self%lanes%traces), source=ieee_value(1.0_wp, ieee_quiet_nan))
      if (.not. settings%from_equilibrium) self%sample(:2) = 0.0_wp
   end subroutine new_stepper

   !> Go on to t_end. On failure the state stays as it was.
   subroutine step(self, t_end, inlet, outlet, status, message)
      class(stepper_type), intent(inout) :: self
      real(wp), intent(in) :: t_end       !! [s], > t
      real(wp), intent(in) :: inlet(2)    !! pressures now and at t_end [Pa]
      real(wp), intent(in) :: outlet(2)   !! [Pa]
      integer, intent(out) :: status      !! status_
      character(len=:), allocatable, intent(out) :: message   !! empty on success
      class(valve_lanes), allocatable :: lanes
      type(linear_pressure) :: pressure
      type(lane_outcome) :: outcome

      pressure%start = self%t
      pressure%event = self%t
      pressure%cycle_end = self%t
      pressure%finish = t_end
      pressure%inlet = inlet
      pressure%outlet = outlet
      pressure%scale = self%scale
      self%settings%t_end = t_end
      self%settings%first_step = min(self%next_step, t_end - self%t)
      if (self%has_stepped) self%settings%state = self%state
      if (.not. self%has_stepped .and. allocated(self%settings%state)) deallocate(self%settings%state)
      allocate(lanes, source=self%lanes)
      call run_lanes(lanes, pressure, self%settings, [t_end], outcome)
      status = outcome%status(1)
      message = outcome%message(1)%s
      self%has_failed = status /= status_ok
      if (self%has_failed) return
      self%t = t_end
      self%state = outcome%state
      self%next_step = outcome%last_step
      self%sample = outcome%trace(1, :, 1)
      self%has_stepped = .true.
   end subroutine step

   pure subroutine linear_factors(self, t, inlet, outlet)
      class(linear_pressure), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out) :: inlet, outlet
      real(wp) :: part

      part = (t - self%start)/(self%finish - self%start)
      inlet = (1.0_wp - part)*self%inlet(1) + part*self%inlet(2)
      outlet = (1.0_wp - part)*self%outlet(1) + part*self%outlet(2)
   end subroutine linear_factors

   pure real(wp) function linear_span(self, inlet, outlet) result(span)
      class(linear_pressure), intent(in) :: self
      real(wp), intent(in) :: inlet, outlet

      span = self%scale*max(abs(inlet), abs(outlet))
   end function linear_span

   pure function linear_stops(self, t_end) result(t)
      class(linear_pressure), intent(in) :: self
      real(wp), intent(in) :: t_end
      real(wp), allocatable :: t(:)

      t = pack([self%finish, t_end], [self%finish < t_end, .true.])
   end function linear_stops

end module rv_stepper
