!> The fast film model as lanes: one static shape, A_land and C_s from a table.
!>
!> m u'' + (c_a + C_s(u)) u' + k u = (p_in - p_out) (int_hole psi + A_land(u)), psi the static shape: the
!> two-state equation of the lumped models with a first-principles film. All lanes share one planform.
module rv_table_lanes
   use rv_kinds, only : wp
   use rv_film_lanes, only : film_field, film_trace, film_traces
   use rv_film_reed, only : film_reed
   use rv_film_table, only : film_table
   use rv_film_valve, only : film_valve
   use rv_valve_lanes, only : valve_lanes, no_film_gap
   implicit none
   private
   public :: table_lanes, new_table_lanes

   !> Cases side by side; arrays are (width).
   type, extends(valve_lanes) :: table_lanes
      type(film_reed), allocatable, private :: reed
      type(film_table), private :: table
      real(wp), allocatable, private :: inverse_mass(:)   !! [kg-1]
      real(wp), allocatable, private :: damping(:)        !! c_a [N s m-1]
      real(wp), allocatable, private :: stiffness(:)      !! k [N m-1]
      real(wp), allocatable, private :: inverse_gap(:)    !! [m-1]
      real(wp), allocatable, private :: film_scale(:)     !! mu/g0^3 [Pa s m-3]
      real(wp), allocatable, private :: viscosity(:)      !! mu [Pa s]
      real(wp), allocatable, private :: hole(:)           !! int_hole psi dA [m2]; 0: silent
   contains
      procedure :: acceleration
      procedure :: linearise
      procedure :: stiffness_ratio
      procedure :: film_force
      procedure :: equilibrium
      procedure :: scales
      procedure :: trace_values
      procedure :: silence
      procedure :: pressure_field
   end type table_lanes

contains

   !> Put cases of one planform side by side.
   subroutine new_table_lanes(self, reed, table, valve)
      type(table_lanes), intent(out) :: self
      type(film_reed), intent(in) :: reed
      type(film_table), intent(in) :: table
      type(film_valve), intent(in) :: valve(:)
      integer :: w

      w = size(valve)
      self%width = w
      self%traces = film_traces
      self%nodes = reed%static_film%mesh%nodes
      self%reed = reed
      self%table = table
      self%inlet = valve%inlet
      self%outlet = valve%outlet
      self%gap = valve%gap
      allocate(self%has_film(w), source=.true.)
      self%tip = [1.0_wp]
      allocate(self%lowest_pressure(w), source=huge(1.0_wp))
      self%inverse_mass = 1.0_wp/(valve%static_mass + valve%static_added_mass)
      self%damping = valve%static_damping
      self%stiffness = valve%static_stiffness
      self%inverse_gap = 1.0_wp/valve%gap
      self%film_scale = valve%viscosity*self%inverse_gap**3
      self%viscosity = valve%viscosity
      allocate(self%hole(w), source=reed%static_hole)
   end subroutine new_table_lanes

   subroutine acceleration(self, inlet, outlet, q, v, a, closed)
      class(table_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%width, self%dofs), v(self%width, self%dofs)
      real(wp), intent(out) :: a(self%width, self%dofs)
      integer, intent(out) :: closed
      real(wp), dimension(self%width) :: y, y_slope, area, area_slope
      integer :: i

      call self%table%look_up(1.0_wp + q(:, 1)*self%inverse_gap, y, y_slope, area, area_slope)
      do i = 1, self%width
         a(i, 1) = ((self%inlet(i)*inlet - self%outlet(i)*outlet)*(self%hole(i) + area(i)) - self%stiffness(i)*q(i, 1) &
            & - (self%damping(i) + self%film_scale(i)/y(i)**3)*v(i, 1))*self%inverse_mass(i)
      end do
      closed = first_closed(self%table%lowest, 1.0_wp + q(:, 1)*self%inverse_gap)
   end subroutine acceleration

   subroutine linearise(self, first, last, inlet, outlet, q, v, a, a_q, a_v, closed)
      class(table_lanes), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(first:last, self%dofs), v(first:last, self%dofs)
      real(wp), intent(out) :: a(first:last, self%dofs)
      real(wp), intent(out) :: a_q(first:last, self%dofs, self%dofs), a_v(first:last, self%dofs, self%dofs)
      integer, intent(out) :: closed
      real(wp), dimension(first:last) :: y, y_slope, area, area_slope
      real(wp) :: drop, film
      integer :: i

      call self%table%look_up(1.0_wp + q(:, 1)*self%inverse_gap(first:last), y, y_slope, area, area_slope)
      do i = first, last
         drop = self%inlet(i)*inlet - self%outlet(i)*outlet
         film = self%film_scale(i)/y(i)**3
         a(i, 1) = (drop*(self%hole(i) + area(i)) - self%stiffness(i)*q(i, 1) - (self%damping(i) + film)*v(i, 1)) &
            & *self%inverse_mass(i)
         a_q(i, 1, 1) = ((drop*area_slope(i) + 3.0_wp*film*y_slope(i)/y(i)*v(i, 1))*self%inverse_gap(i) &
            & - self%stiffness(i))*self%inverse_mass(i)
         a_v(i, 1, 1) = -(self%damping(i) + film)*self%inverse_mass(i)
      end do
      closed = first_closed(self%table%lowest, 1.0_wp + q(:, 1)*self%inverse_gap(first:last))
      if (closed > 0) closed = first - 1 + closed
   end subroutine linearise

   !> -C_s u' and its rate. A reed that closes leaves no place of the film below the pressures beyond its edges.
   subroutine film_force(self, lane, inlet, outlet, q, v, a, force, rate)
      class(table_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs), a(self%dofs)
      real(wp), intent(out) :: force, rate
      real(wp) :: x, y, y_slope, area, area_slope, film, drop, low

      x = 1.0_wp + q(1)*self%inverse_gap(lane)
      call self%table%look_up(x, y, y_slope, area, area_slope)
      film = self%film_scale(lane)/y**3
      force = -film*v(1)
      rate = film*(3.0_wp*y_slope/y*self%inverse_gap(lane)*v(1)**2 - a(1))
      if (.not. self%has_film(lane)) return
      drop = self%inlet(lane)*inlet - self%outlet(lane)*outlet
      low = min(0.0_wp, drop)
      if (v(1) > 0.0_wp) low = self%table%lowest_pressure(x, drop, -force)
      self%lowest_pressure(lane) = min(self%lowest_pressure(lane), self%outlet(lane)*outlet + low)
   end subroutine film_force

   pure function stiffness_ratio(self) result(ratio)
      class(table_lanes), intent(in) :: self
      real(wp) :: ratio(self%width)
      real(wp) :: y, y_slope, area, area_slope

      call self%table%look_up(1.0_wp, y, y_slope, area, area_slope)
      ratio = (self%damping + self%film_scale/y**3)*sqrt(self%inverse_mass/self%stiffness)
   end function stiffness_ratio

   !> k u = (p_in - p_out) (int_hole psi + A_land(u)) by Newton's method, kept above the table's lowest x.
   subroutine equilibrium(self, inlet, outlet, q, found)
      class(table_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(out) :: q(self%width, self%dofs)
      logical, intent(out) :: found(self%width)
      real(wp) :: drop, u, step, lowest, y, y_slope, area, area_slope
      integer :: i, iteration

      do i = 1, self%width
         drop = self%inlet(i)*inlet - self%outlet(i)*outlet
         lowest = self%gap(i)*(self%table%lowest - 1.0_wp)
         found(i) = .false.
         q(i, 1) = 0.0_wp
         if (.not. self%stiffness(i) > 0.0_wp) cycle
         u = max(0.5_wp*lowest, drop*self%hole(i)/self%stiffness(i))
         do iteration = 1, 100
            call self%table%look_up(1.0_wp + u*self%inverse_gap(i), y, y_slope, area, area_slope)
            step = (drop*(self%hole(i) + area) - self%stiffness(i)*u) &
               & /(self%stiffness(i) - drop*area_slope*self%inverse_gap(i))
            step = max(step, 0.9_wp*(lowest - u))
            u = u + step
            found(i) = abs(step) <= 1.0e-13_wp*(abs(u) + self%gap(i))
            if (found(i)) exit
         end do
         found(i) = found(i) .and. u > lowest + 1.0e-6_wp*self%gap(i)
         q(i, 1) = u
      end do
   end subroutine equilibrium

   subroutine scales(self, span, q_scale, v_scale)
      class(table_lanes), intent(in) :: self
      real(wp), intent(in) :: span(self%width)
      real(wp), intent(out) :: q_scale(self%width, self%dofs), v_scale(self%width, self%dofs)

      q_scale(:, 1) = min(span*self%hole/self%stiffness, 10.0_wp*self%gap)
      where (.not. q_scale(:, 1) > 0.0_wp) q_scale(:, 1) = 1.0e-3_wp*self%gap
      v_scale(:, 1) = q_scale(:, 1)*sqrt(self%stiffness*self%inverse_mass)
   end subroutine scales

   !> As of the film model, from one solution of the Reynolds equation a sample.
   subroutine trace_values(self, lane, inlet, outlet, q, v, value)
      class(table_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs)
      real(wp), intent(out) :: value(self%traces)

      value = film_trace(self%reed, self%reed%static_film, self%gap(lane), self%viscosity(lane), &
         & self%inlet(lane)*inlet, self%outlet(lane)*outlet, q, v)
   end subroutine trace_values

   subroutine pressure_field(self, lane, inlet, outlet, q, v, pressure)
      class(table_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs)
      real(wp), intent(out) :: pressure(self%nodes)

      pressure = film_field(self%reed%static_film, self%gap(lane), self%viscosity(lane), &
         & self%inlet(lane)*inlet, self%outlet(lane)*outlet, q, v)
   end subroutine pressure_field

   subroutine silence(self, lane)
      class(table_lanes), intent(inout) :: self
      integer, intent(in) :: lane

      self%inlet(lane) = 0.0_wp
      self%outlet(lane) = 0.0_wp
      self%film_scale(lane) = 0.0_wp
      self%has_film(lane) = .false.
      self%gap(lane) = no_film_gap
      self%inverse_gap(lane) = 1.0_wp/no_film_gap
      self%stiffness(lane) = 0.0_wp
      self%damping(lane) = 0.0_wp
      self%inverse_mass(lane) = 0.0_wp
   end subroutine silence

   !> First lane whose tip is below the table.
   pure integer function first_closed(lowest, x) result(lane)
      real(wp), intent(in) :: lowest   !! of the table
      real(wp), intent(in) :: x(:)     !! film under the tip over the gap

      lane = 0
      if (all(x > lowest)) return
      do lane = 1, size(x)
         if (.not. x(lane) > lowest) return
      end do
   end function first_closed

end module rv_table_lanes
