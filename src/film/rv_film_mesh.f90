!> The film's mesh: quadratic elements on rays about the hole's centre, mapped exactly on the land.
!>
!> r = R_h + eta (rho(theta) - R_h), 0 <= eta <= 1 from the hole's edge outwards, 0 <= theta <= pi from the
!> symmetry line at the tip round to the one at the clamp. rho is the outer arc up to theta = 90 deg, the long
!> side up to the clamp's corner, the clamp from there on. Nodes are numbered along the rays, radius fastest.
module rv_film_mesh
   use rv_kinds, only : wp, pi
   use rv_gauss, only : gauss_legendre
   use rv_planform, only : planform_type
   implicit none
   private
   public :: film_mesh, new_film_mesh, new_annulus_mesh, land_weights, nodes_per_element, points_per_element

   integer, parameter :: nodes_per_element = 9
   integer, parameter :: points_per_element = 9   !! 3 x 3 Gauss points
   integer, parameter :: on_arc = 1, on_side = 2, on_clamp = 3
   integer, parameter :: default_around(3) = [6, 4, 2]  !! elements on arc, side and clamp
   integer, parameter :: default_across = 3

   !> Mesh of the half land. Points are the Gauss points of all elements, element by element.
   type :: film_mesh
      integer :: elements = 0
      integer :: nodes = 0
      integer :: rings = 0                          !! nodes along a ray
      real(wp), allocatable, private :: corner(:, :)  !! theta and eta ranges and outer edge of the elements, (5, elements)
      real(wp), allocatable :: x(:), y(:)           !! nodes [m], (nodes)
      integer, allocatable :: node(:, :)            !! (nodes_per_element, elements)
      logical, allocatable :: on_hole(:)            !! node lies on the hole's edge
      logical, allocatable :: on_free(:)            !! node lies on a free outer edge
      real(wp), allocatable :: px(:), py(:)         !! Gauss points [m], (points_per_element*elements)
      real(wp), allocatable :: weight(:)            !! [m2], the same
      real(wp), allocatable :: shape(:, :)          !! shape functions at the Gauss points of any element [-], (node, point)
      real(wp), allocatable :: gradient(:, :, :)    !! d(shape)/dr and (1/r) d(shape)/dtheta [m-1], (node, 2, point)
      integer, allocatable :: edge_node(:, :)       !! the three nodes of each pressure edge, (3, edges)
      logical, allocatable :: edge_on_hole(:)       !! which pressure the edge sees, (edges)
      real(wp), allocatable :: edge_weight(:, :)    !! arc length weights at the edge's three Gauss points [m], (3, edges)
      real(wp), allocatable :: edge_x(:, :), edge_y(:, :)   !! those points [m], (3, edges)
      real(wp) :: edge_shape(3, 3) = 0.0_wp         !! edge shape functions (node, point)
   end type film_mesh

contains

   !> Mesh of the reed's land with given numbers of elements on arc, side and clamp, and across.
   subroutine new_film_mesh(self, form, around, across)
      type(film_mesh), intent(out) :: self
      type(planform_type), intent(in) :: form
      integer, intent(in), optional :: around(3)   !! [6, 4, 2] unless given
      integer, intent(in), optional :: across      !! 3 unless given
      integer :: number(3), layers, k
      real(wp) :: corner(0:3)
      real(wp), allocatable :: theta(:)
      integer, allocatable :: edge(:)

      number = default_around
      if (present(around)) number = around
      layers = default_across
      if (present(across)) layers = across
      corner = [0.0_wp, 0.5_wp*pi, pi - atan2(form%radius, form%centre), pi]
      theta = [corner(0)]
      edge = [integer ::]
      do k = 1, 3
         theta = [theta, evenly(corner(k - 1), corner(k), number(k))]
         edge = [edge, spread(k, 1, number(k))]
      end do
      call build(self, form, theta, edge, layers)
   end subroutine new_film_mesh

   !> Mesh of a half annulus with pressure edges inside and outside: has closed forms to check against.
   subroutine new_annulus_mesh(self, inner, outer, around, across)
      type(film_mesh), intent(out) :: self
      real(wp), intent(in) :: inner, outer   !! radii [m]
      integer, intent(in) :: around, across  !! elements

      call build(self, planform_type(hole_radius=inner, radius=outer), [0.0_wp, evenly(0.0_wp, pi, around)], &
         & spread(on_arc, 1, around), across)
   end subroutine new_annulus_mesh

   !> Ends of n equal parts of lo..hi.
   pure function evenly(lo, hi, n) result(x)
      real(wp), intent(in) :: lo, hi
      integer, intent(in) :: n
      real(wp) :: x(n)
      integer :: i

      x = [(lo + (hi - lo)*real(i, wp)/real(n, wp), i = 1, n)]
   end function evenly

   subroutine build(self, form, theta, edge, across)
      type(film_mesh), intent(out) :: self
      type(planform_type), intent(in) :: form
      real(wp), intent(in) :: theta(0:)     !! element corners around [rad]
      integer, intent(in) :: edge(:)        !! outer edge of the elements on a ray: on_arc, on_side, on_clamp
      integer, intent(in) :: across

      self%rings = 2*across + 1
      call place_nodes(self, form, theta, edge)
      call place_points(self, form, theta, edge, across)
      call place_edges(self, form, theta, edge)
   end subroutine build

   subroutine place_nodes(self, form, theta, edge)
      type(film_mesh), intent(inout) :: self
      type(planform_type), intent(in) :: form
      real(wp), intent(in) :: theta(0:)
      integer, intent(in) :: edge(:)
      real(wp) :: t, rho, slope, r
      integer :: ray, sector, k, n

      self%nodes = (2*size(edge) + 1)*self%rings
      allocate(self%x(self%nodes), self%y(self%nodes))
      allocate(self%on_hole(self%nodes), self%on_free(self%nodes), source=.false.)
      n = 0
      do ray = 0, 2*size(edge)
         sector = min(ray/2 + 1, size(edge))
         t = theta(sector - 1) + 0.5_wp*(theta(sector) - theta(sector - 1))*real(ray - 2*(sector - 1), wp)
         call outer_edge(form, edge(sector), t, rho, slope)
         do k = 0, self%rings - 1
            n = n + 1
            r = form%hole_radius + (rho - form%hole_radius)*real(k, wp)/real(self%rings - 1, wp)
            self%x(n) = form%centre + r*cos(t)
            self%y(n) = r*sin(t)
            self%on_hole(n) = k == 0
         end do
         self%on_free(n) = any(edge(max(1, (ray + 1)/2):sector) /= on_clamp)
      end do
   end subroutine place_nodes

   subroutine place_points(self, form, theta, edge, across)
      type(film_mesh), intent(inout) :: self
      type(planform_type), intent(in) :: form
      real(wp), intent(in) :: theta(0:)
      integer, intent(in) :: edge(:)
      integer, intent(in) :: across
      real(wp) :: g(3), w(3), t, eta, rho, slope, dt, de, r
      real(wp), dimension(3) :: around_value, around_slope, across_value, across_slope
      real(wp), dimension(nodes_per_element) :: by_eta, by_theta
      integer :: sector, layer, j, m, e, p

      self%elements = size(edge)*across
      call gauss_legendre(0.0_wp, 1.0_wp, g, w)
      allocate(self%corner(5, self%elements))
      allocate(self%node(nodes_per_element, self%elements), self%shape(nodes_per_element, points_per_element))
      p = self%elements*points_per_element
      allocate(self%px(p), self%py(p), self%weight(p), self%gradient(nodes_per_element, 2, p))
      de = 1.0_wp/real(across, wp)
      e = 0
      p = 0
      do sector = 1, size(edge)
         dt = theta(sector) - theta(sector - 1)
         do layer = 1, across
            e = e + 1
            self%corner(:, e) = [theta(sector - 1), theta(sector), real(layer - 1, wp)*de, real(layer, wp)*de, &
               & real(edge(sector), wp)]
            do j = 0, 2
               self%node(3*j + 1:3*j + 3, e) = (2*(sector - 1) + j)*self%rings + 2*(layer - 1) + [1, 2, 3]
            end do
            do j = 1, 3
               call quadratic(g(j), around_value, around_slope)
               t = theta(sector - 1) + dt*g(j)
               call outer_edge(form, edge(sector), t, rho, slope)
               do m = 1, 3
                  call quadratic(g(m), across_value, across_slope)
                  p = p + 1
                  eta = (real(layer - 1, wp) + g(m))*de
                  r = form%hole_radius + eta*(rho - form%hole_radius)
                  self%px(p) = form%centre + r*cos(t)
                  self%py(p) = r*sin(t)
                  self%weight(p) = w(j)*w(m)*dt*de*r*(rho - form%hole_radius)
                  self%shape(:, 3*(j - 1) + m) = outer_product(around_value, across_value)
                  by_eta = outer_product(around_value, across_slope)/de
                  by_theta = outer_product(around_slope, across_value)/dt
                  self%gradient(:, 1, p) = by_eta/(rho - form%hole_radius)
                  self%gradient(:, 2, p) = (by_theta - by_eta*eta*slope/(rho - form%hole_radius))/r
               end do
            end do
         end do
      end do
   end subroutine place_points

   !> The edges with a pressure: the hole's first, then the free ones.
   subroutine place_edges(self, form, theta, edge)
      type(film_mesh), intent(inout) :: self
      type(planform_type), intent(in) :: form
      real(wp), intent(in) :: theta(0:)
      integer, intent(in) :: edge(:)
      real(wp) :: g(3), w(3), unused(3), t, rho, slope, dt
      integer :: sector, j, e, side, edges

      call gauss_legendre(0.0_wp, 1.0_wp, g, w)
      do j = 1, 3
         call quadratic(g(j), self%edge_shape(:, j), unused)
      end do
      edges = size(edge) + count(edge /= on_clamp)
      allocate(self%edge_node(3, edges), self%edge_on_hole(edges), self%edge_weight(3, edges))
      allocate(self%edge_x(3, edges), self%edge_y(3, edges))
      e = 0
      do side = 0, 1
         do sector = 1, size(edge)
            if (side == 1 .and. edge(sector) == on_clamp) cycle
            e = e + 1
            self%edge_on_hole(e) = side == 0
            self%edge_node(:, e) = (2*(sector - 1) + [0, 1, 2])*self%rings + 1 + side*(self%rings - 1)
            dt = theta(sector) - theta(sector - 1)
            do j = 1, 3
               t = theta(sector - 1) + dt*g(j)
               rho = form%hole_radius
               slope = 0.0_wp
               if (side == 1) call outer_edge(form, edge(sector), t, rho, slope)
               self%edge_weight(j, e) = w(j)*dt*sqrt(rho**2 + slope**2)
               self%edge_x(j, e) = form%centre + rho*cos(t)
               self%edge_y(j, e) = rho*sin(t)
            end do
         end do
      end do
   end subroutine place_edges

   !> Outer radius rho(theta) and its derivative.
   pure subroutine outer_edge(form, edge, theta, rho, slope)
      type(planform_type), intent(in) :: form
      integer, intent(in) :: edge
      real(wp), intent(in) :: theta
      real(wp), intent(out) :: rho, slope   !! [m], [m rad-1]

      select case (edge)
      case (on_arc)
         rho = form%radius
         slope = 0.0_wp
      case (on_side)
         rho = form%radius/sin(theta)
         slope = -rho*cos(theta)/sin(theta)
      case default
         rho = -form%centre/cos(theta)
         slope = rho*sin(theta)/cos(theta)
      end select
   end subroutine outer_edge

   !> int shape function dA over the part x < limit of the half land, for every node [m2].
   !>
   !> The line x = limit cuts the elements: along each ray the integral is split where it crosses, and the rays of an
   !> element are split where it enters or leaves the element, so that every integrand is smooth.
   function land_weights(self, form, limit) result(weight)
      type(film_mesh), intent(in) :: self
      type(planform_type), intent(in) :: form
      real(wp), intent(in) :: limit   !! [m]
      real(wp) :: weight(self%nodes)
      integer, parameter :: rays = 12, depth = 4   !! along a ray the rule is exact
      real(wp), parameter :: sliver = 1.0e-14_wp   !! parts of an element that are left out [rad]
      real(wp) :: ray(rays), ray_weight(rays), point(depth), point_weight(depth), part(0:3)
      integer :: e, j, k

      weight = 0.0_wp
      call gauss_legendre(0.0_wp, 1.0_wp, ray, ray_weight)
      call gauss_legendre(0.0_wp, 1.0_wp, point, point_weight)
      do e = 1, self%elements
         part = [self%corner(1, e), crossing_of_line(self, form, e, 3, limit), crossing_of_line(self, form, e, 4, limit), &
            & self%corner(2, e)]
         part(1:2) = [minval(part(1:2)), maxval(part(1:2))]
         do k = 1, 3
            if (.not. part(k) - part(k - 1) > sliver) cycle
            do j = 1, rays
               call add_ray(part(k - 1) + (part(k) - part(k - 1))*ray(j), (part(k) - part(k - 1))*ray_weight(j))
            end do
         end do
      end do

   contains

      !> What a ray of element e has of the part x < limit.
      subroutine add_ray(theta, around)
         real(wp), intent(in) :: theta    !! [rad]
         real(wp), intent(in) :: around   !! the ray's weight [rad]
         real(wp) :: rho, slope, crossing, cut(2), eta, r
         real(wp), dimension(3) :: around_value, across_value, unused
         integer :: m

         call outer_edge(form, nint(self%corner(5, e)), theta, rho, slope)
         associate (t0 => self%corner(1, e), t1 => self%corner(2, e), lo => self%corner(3, e), hi => self%corner(4, e))
            call quadratic((theta - t0)/(t1 - t0), around_value, unused)
            crossing = huge(1.0_wp)
            if (abs(cos(theta)) > 0.0_wp) crossing = (limit - form%centre)/cos(theta)
            crossing = min(hi, max(lo, (crossing - form%hole_radius)/(rho - form%hole_radius)))
            cut = [lo, crossing]
            if (cos(theta) < 0.0_wp) cut = [crossing, hi]   ! x falls along the ray: inside beyond the crossing
            if (.not. cut(2) > cut(1)) return
            do m = 1, depth
               eta = cut(1) + (cut(2) - cut(1))*point(m)
               r = form%hole_radius + eta*(rho - form%hole_radius)
               call quadratic((eta - lo)/(hi - lo), across_value, unused)
               weight(self%node(:, e)) = weight(self%node(:, e)) + around*(cut(2) - cut(1))*point_weight(m) &
                  & *r*(rho - form%hole_radius)*outer_product(around_value, across_value)
            end do
         end associate
      end subroutine add_ray

   end function land_weights

   !> Where an element's inner (side = 3) or outer (4) mesh line crosses x = limit, or the nearer end of it [rad].
   pure real(wp) function crossing_of_line(self, form, e, side, limit) result(theta)
      type(film_mesh), intent(in) :: self
      type(planform_type), intent(in) :: form
      integer, intent(in) :: e, side
      real(wp), intent(in) :: limit
      real(wp) :: lo, hi, rho, slope
      integer :: i

      lo = self%corner(1, e)
      hi = self%corner(2, e)
      do i = 1, digits(lo)   ! x falls along the line from the tip to the clamp
         theta = 0.5_wp*(lo + hi)
         call outer_edge(form, nint(self%corner(5, e)), theta, rho, slope)
         if (form%centre + (form%hole_radius + self%corner(side, e)*(rho - form%hole_radius))*cos(theta) > limit) then
            lo = theta
         else
            hi = theta
         end if
      end do
   end function crossing_of_line

   !> The three quadratic shape functions on 0..1 and their derivatives.
   pure subroutine quadratic(s, value, slope)
      real(wp), intent(in) :: s
      real(wp), intent(out) :: value(3), slope(3)

      value = [(1.0_wp - s)*(1.0_wp - 2.0_wp*s), 4.0_wp*s*(1.0_wp - s), s*(2.0_wp*s - 1.0_wp)]
      slope = [4.0_wp*s - 3.0_wp, 4.0_wp - 8.0_wp*s, 4.0_wp*s - 1.0_wp]
   end subroutine quadratic

   !> (around) x (across) in the nodes' order: across fastest.
   pure function outer_product(around, across) result(both)
      real(wp), intent(in) :: around(3), across(3)
      real(wp) :: both(nodes_per_element)
      integer :: j

      do j = 1, 3
         both(3*j - 2:3*j) = around(j)*across
      end do
   end function outer_product

end module rv_film_mesh
