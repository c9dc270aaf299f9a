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
   use rv_largest, only : largest
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
      procedure :: correction
      procedure :: stiffness_ratio
      procedure :: decay
      procedure :: fastest_decay
      procedure :: film_force
      procedure :: film_forces
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
      self%explicit_up_to = 5.0_wp
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

   subroutine acceleration(self, first, last, inlet, outlet, q, v, a, closed)
      class(table_lanes), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(first:last, self%dofs), v(first:last, self%dofs)
      real(wp), intent(out) :: a(first:last, self%dofs)
      integer, intent(out) :: closed
      real(wp), dimension(first:last) :: x, y, y_slope, area, area_slope
      real(wp) :: per_y, film
      integer :: i

      x = 1.0_wp + q(:, 1)*self%inverse_gap(first:last)
      call self%table%look_up_all(x, y, y_slope, area, area_slope)
      do i = first, last
         per_y = 1.0_wp/y(i)
         film = self%film_scale(i)*(per_y*per_y*per_y)
         a(i, 1) = ((self%inlet(i)*inlet - self%outlet(i)*outlet)*(self%hole(i) + area(i)) - self%stiffness(i)*q(i, 1) &
            & - (self%damping(i) + film)*v(i, 1))*self%inverse_mass(i)
      end do
      closed = first_closed(self%table%lowest, x)
      if (closed > 0) closed = first - 1 + closed
   end subroutine acceleration

   subroutine linearise(self, first, last, inlet, outlet, q, v, a, a_q, a_v, closed)
      class(table_lanes), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(first:last, self%dofs), v(first:last, self%dofs)
      real(wp), intent(out) :: a(first:last, self%dofs)
      real(wp), intent(out) :: a_q(first:last, self%dofs, self%dofs), a_v(first:last, self%dofs, self%dofs)
      integer, intent(out) :: closed
      real(wp), dimension(first:last) :: x, y, y_slope, area, area_slope
      integer :: n

      n = last - first + 1
      x = 1.0_wp + q(:, 1)*self%inverse_gap(first:last)
      call self%table%look_up_all(x, y, y_slope, area, area_slope)
      call slopes(n, inlet, outlet, self%inlet(first:last), self%outlet(first:last), self%hole(first:last), &
         & self%stiffness(first:last), self%damping(first:last), self%film_scale(first:last), self%inverse_gap(first:last), &
         & self%inverse_mass(first:last), y, y_slope, area, area_slope, q, v, a, a_q, a_v)
      closed = first_closed(self%table%lowest, x)
      if (closed > 0) closed = first - 1 + closed
   end subroutine linearise

   !> Accelerations and derivatives of n lanes as plain arrays, which the compiler turns into vector code.
   pure subroutine slopes(n, inlet, outlet, p_in, p_out, hole, stiffness, damping, film_scale, inverse_gap, inverse_mass, &
      & y, y_slope, area, area_slope, q, v, a, a_q, a_v)
      integer, intent(in) :: n
      real(wp), intent(in) :: inlet, outlet
      real(wp), dimension(n), intent(in) :: p_in, p_out, hole, stiffness, damping, film_scale, inverse_gap, inverse_mass
      real(wp), dimension(n), intent(in) :: y, y_slope, area, area_slope, q, v
      real(wp), dimension(n), intent(out) :: a, a_q, a_v
      real(wp) :: drop, film, per_y
      integer :: i

      do i = 1, n
         drop = p_in(i)*inlet - p_out(i)*outlet
         per_y = 1.0_wp/y(i)
         film = film_scale(i)*(per_y*per_y*per_y)
         a(i) = (drop*(hole(i) + area(i)) - stiffness(i)*q(i) - (damping(i) + film)*v(i))*inverse_mass(i)
         a_q(i) = ((drop*area_slope(i) + 3.0_wp*film*y_slope(i)*per_y*v(i))*inverse_gap(i) - stiffness(i))*inverse_mass(i)
         a_v(i) = -(damping(i) + film)*inverse_mass(i)
      end do
   end subroutine slopes

   !> The base type's correction, without arrays for what one lane needs once.
   subroutine correction(self, first, last, inlet, outlet, gamma, base_q, base_v, v, dv, film, closed)
      class(table_lanes), intent(inout) :: self
      integer, intent(in) :: first, last
      real(wp), intent(in) :: inlet, outlet, gamma
      real(wp), dimension(first:last), intent(in) :: base_q, base_v, v
      real(wp), dimension(first:last), intent(out) :: dv, film
      integer, intent(out) :: closed
      real(wp), dimension(first:last) :: x, y, y_slope, area, area_slope

      x = 1.0_wp + (base_q + gamma*v)*self%inverse_gap(first:last)
      call self%table%look_up_all(x, y, y_slope, area, area_slope)
      call correct(last - first + 1, inlet, outlet, gamma, self%inlet(first:last), self%outlet(first:last), &
         & self%hole(first:last), self%stiffness(first:last), self%damping(first:last), self%film_scale(first:last), &
         & self%inverse_gap(first:last), self%inverse_mass(first:last), y, y_slope, area, area_slope, base_q, base_v, v, dv)
      film = x*self%gap(first:last)
      closed = first_closed(self%table%lowest, x)
      if (closed > 0) closed = first - 1 + closed
   end subroutine correction

   pure subroutine correct(n, inlet, outlet, gamma, p_in, p_out, hole, stiffness, damping, film_scale, inverse_gap, &
      & inverse_mass, y, y_slope, area, area_slope, base_q, base_v, v, dv)
      integer, intent(in) :: n
      real(wp), intent(in) :: inlet, outlet, gamma
      real(wp), dimension(n), intent(in) :: p_in, p_out, hole, stiffness, damping, film_scale, inverse_gap, inverse_mass
      real(wp), dimension(n), intent(in) :: y, y_slope, area, area_slope, base_q, base_v, v
      real(wp), intent(out) :: dv(n)
      real(wp) :: drop, c, per_y, push, per_u
      integer :: i

      do i = 1, n
         drop = p_in(i)*inlet - p_out(i)*outlet
         per_y = 1.0_wp/y(i)
         c = film_scale(i)*(per_y*per_y*per_y)
         push = drop*(hole(i) + area(i)) - stiffness(i)*(base_q(i) + gamma*v(i)) - (damping(i) + c)*v(i)
         per_u = (drop*area_slope(i) + 3.0_wp*c*y_slope(i)*per_y*v(i))*inverse_gap(i) - stiffness(i)
         dv(i) = (base_v(i) - v(i) + gamma*push*inverse_mass(i)) &
            & /(1.0_wp + gamma*(damping(i) + c - gamma*per_u)*inverse_mass(i))
      end do
   end subroutine correct

   !> -C_s u' and its rate.
   subroutine film_force(self, lane, inlet, outlet, q, v, a, force, rate)
      class(table_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in) :: q(self%dofs), v(self%dofs), a(self%dofs)
      real(wp), intent(out) :: force, rate
      real(wp) :: x, y, y_slope, area, area_slope, film

      x = 1.0_wp + q(1)*self%inverse_gap(lane)
      call self%table%look_up(x, y, y_slope, area, area_slope)
      film = self%film_scale(lane)/y**3
      force = -film*v(1)
      rate = film*(3.0_wp*y_slope/y*self%inverse_gap(lane)*v(1)**2 - a(1))
      if (self%has_film(lane)) call keep_lowest(self, lane, x, outlet, self%inlet(lane)*inlet - self%outlet(lane)*outlet, &
         & v(1), -force)
   end subroutine film_force

   subroutine film_forces(self, inlet, outlet, q, v, a, force, rate)
      class(table_lanes), intent(inout) :: self
      real(wp), intent(in) :: inlet, outlet
      real(wp), intent(in), dimension(self%width, self%dofs) :: q, v, a
      real(wp), intent(out), dimension(self%width) :: force, rate
      real(wp), dimension(self%width) :: x, y, y_slope, area, area_slope, drop
      integer :: i

      x = 1.0_wp + q(:, 1)*self%inverse_gap
      call self%table%look_up_all(x, y, y_slope, area, area_slope)
      do i = 1, self%width
         force(i) = -self%film_scale(i)/(y(i)*y(i)*y(i))*v(i, 1)
         rate(i) = -force(i)*3.0_wp*y_slope(i)/y(i)*self%inverse_gap(i)*v(i, 1) &
            & - self%film_scale(i)/(y(i)*y(i)*y(i))*a(i, 1)
      end do
      drop = self%inlet*inlet - self%outlet*outlet
      do i = 1, self%width
         if (.not. self%has_film(i)) cycle
         call keep_lowest(self, i, x(i), outlet, drop(i), v(i, 1), -force(i))
      end do
   end subroutine film_forces

   !> A reed that closes leaves no place of the film below the pressures beyond its edges.
   subroutine keep_lowest(self, lane, x, outlet, drop, v, drag)
      type(table_lanes), intent(inout) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: x, outlet, drop, v, drag
      real(wp) :: low

      associate (lowest => self%lowest_pressure(lane), base => self%outlet(lane)*outlet)
         low = min(0.0_wp, drop)
         if (v > 0.0_wp) then
            if (x >= 1.0_wp .and. base + low - self%table%most_suction*drag >= lowest) return
            low = self%table%lowest_pressure(x, drop, drag)
         end if
         lowest = min(lowest, base + low)
      end associate
   end subroutine keep_lowest

   pure function stiffness_ratio(self) result(ratio)
      class(table_lanes), intent(in) :: self
      real(wp) :: ratio(self%width)
      real(wp) :: y, y_slope, area, area_slope

      call self%table%look_up(1.0_wp, y, y_slope, area, area_slope)
      ratio = (self%damping + self%film_scale/y**3)*sqrt(self%inverse_mass/self%stiffness)
   end function stiffness_ratio

   pure real(wp) function decay(self, lane, q)
      class(table_lanes), intent(in) :: self
      integer, intent(in) :: lane
      real(wp), intent(in) :: q(self%dofs)
      real(wp) :: y, y_slope, area, area_slope

      call self%table%look_up(1.0_wp + q(1)*self%inverse_gap(lane), y, y_slope, area, area_slope)
      decay = (self%damping(lane) + self%film_scale(lane)/y**3)*self%inverse_mass(lane)
   end function decay

   pure real(wp) function fastest_decay(self, q, v)
      class(table_lanes), intent(in) :: self
      real(wp), intent(in), dimension(self%width, self%dofs) :: q, v
      real(wp), dimension(self%width) :: x, y, y_slope, area, area_slope, rate

      associate (unused => v)
      end associate
      x = 1.0_wp + q(:, 1)*self%inverse_gap
      call self%table%look_up_all(x, y, y_slope, area, area_slope)
      rate = (self%damping + self%film_scale/(y*y*y))*self%inverse_mass
      fastest_decay = largest(rate)
   end function fastest_decay

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

      q_scale(:, 1) = min(span*self%hole/self%stiffness, self%gap/3.0_wp)
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
