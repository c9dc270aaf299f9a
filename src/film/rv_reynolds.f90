!> The two-dimensional Reynolds equation on the land, for a reed that moves in given shapes.
!>
!> div( h^3/(12 mu) grad p ) = dh/dt,  h = g0 + sum q_j phi_j,  dh/dt = sum q'_j phi_j,
!> p = p_in on the hole's edge and p_out on the free edges, or, with edge elongation beta,
!> -(h^3/(12 mu)) dp/dn = h^2 (p - p_side)/(12 mu beta); no flow through clamp and symmetry line.
!> Pressures are taken relative to p_out. The equation is linear in p for given h:
!> p = (p_in - p_out) P_0 - sum q'_j P_j. Galerkin, quadratic elements, 3 x 3 Gauss points; one banded
!> Cholesky factorisation (LAPACK dpbtrf) and N + 1 right-hand sides. Reynolds (1886), doi:10.1098/rstl.1886.0005.
module rv_reynolds
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp
   use rv_error, only : error_type, fail, rv_domain, rv_not_converged
   use rv_film_mesh, only : film_mesh, nodes_per_element, points_per_element
   use rv_text, only : to_text
   implicit none
   private
   public :: film_type, new_film, film_state

   integer, parameter :: pairs = nodes_per_element*(nodes_per_element + 1)/2  !! of an element's nodes, a >= b

   !> Mesh and shapes of one planform. `half` integrals are over the half land.
   type :: film_type
      type(film_mesh) :: mesh
      integer :: shapes = 0
      real(wp) :: elongation = 0.0_wp            !! beta, edge elongation over the film thickness [-]; 0: pressure given
      real(wp), allocatable :: phi(:, :)         !! shapes at the Gauss points (points, shapes) [-]
      real(wp), allocatable :: phi_node(:, :)    !! at the nodes (nodes, shapes)
      real(wp), allocatable :: phi_edge(:, :)    !! at the edges' points (3*edges, shapes)
      real(wp), allocatable :: sweep(:, :)       !! half: int shape function * phi dA [m2], (nodes, shapes)
      real(wp), allocatable, private :: product(:, :, :)    !! weight*grad.grad of two shape functions [-], (pair, point, element)
      real(wp), allocatable, private :: derivative(:, :, :) !! gradients by components [m-1], (2*point, node, element)
      integer, allocatable, private :: place(:, :)          !! of an element's pair in the matrix (pairs, elements)
      integer, allocatable, private :: unknown(:)           !! number of a node's unknown; 0: its pressure is given
      integer, private :: unknowns = 0
      integer, private :: band = 0
   contains
      procedure :: solve
      procedure :: pressure_of
      procedure :: force_slope
      procedure :: inflow
   end type film_type

   !> The film at one instant.
   type :: film_state
      real(wp) :: gap = 0.0_wp                  !! g0 [m]
      real(wp) :: viscosity = 0.0_wp            !! mu [Pa s]
      real(wp), allocatable :: q(:)             !! displacements [m], (shapes)
      real(wp), allocatable :: thickness(:)     !! h at the Gauss points [m]
      real(wp), allocatable :: pressure(:, :)   !! P_0 [-], P_1, ... [Pa s m-1], (nodes, 0:shapes)
      real(wp), allocatable :: land(:)          !! int P_0 phi_i dA over the whole land [m2], (shapes)
      real(wp), allocatable :: damping(:, :)    !! int P_j phi_i dA over the whole land [N s m-1], (shapes, shapes)
   end type film_state

   interface
      subroutine dpbtrf(uplo, n, kd, ab, ldab, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, kd, ldab
         real(wp), intent(inout) :: ab(ldab, *)
         integer, intent(out) :: info
      end subroutine dpbtrf

      subroutine dpbtrs(uplo, n, kd, nrhs, ab, ldab, b, ldb, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, kd, nrhs, ldab, ldb
         real(wp), intent(in) :: ab(ldab, *)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dpbtrs
   end interface

contains

   !> Build a film from shapes given at Gauss points, nodes and edge points of the mesh.
   subroutine new_film(self, mesh, phi, phi_node, phi_edge, elongation)
      type(film_type), intent(out) :: self
      type(film_mesh), intent(in) :: mesh
      real(wp), intent(in) :: phi(:, :)        !! (points, shapes) [-]
      real(wp), intent(in) :: phi_node(:, :)   !! (nodes, shapes)
      real(wp), intent(in) :: phi_edge(:, :)   !! (3*edges, shapes)
      real(wp), intent(in) :: elongation       !! beta [-], >= 0
      integer :: n

      self%mesh = mesh
      self%shapes = size(phi, 2)
      self%elongation = elongation
      self%phi = phi
      self%phi_node = phi_node
      self%phi_edge = phi_edge
      allocate(self%unknown(mesh%nodes), source=0)
      do n = 1, mesh%nodes
         if (elongation <= 0.0_wp .and. (mesh%on_hole(n) .or. mesh%on_free(n))) cycle
         self%unknowns = self%unknowns + 1
         self%unknown(n) = self%unknowns
      end do
      call tabulate_elements(self)
   end subroutine new_film

   !> What the elements need at every solve, laid out for it: products of gradients and their places in the matrix.
   subroutine tabulate_elements(self)
      type(film_type), intent(inout) :: self
      integer :: e, p, k, a, b, pair, first

      associate (mesh => self%mesh)
         allocate(self%sweep(mesh%nodes, self%shapes), source=0.0_wp)
         allocate(self%product(pairs, points_per_element, mesh%elements), self%place(pairs, mesh%elements))
         allocate(self%derivative(2*points_per_element, nodes_per_element, mesh%elements))
         do e = 1, mesh%elements
            associate (u => self%unknown(mesh%node(:, e)))
               first = minval(u, mask=u > 0)
               self%band = max(self%band, maxval(u) - min(first, maxval(u)))
            end associate
         end do
         do e = 1, mesh%elements
            pair = 0
            do b = 1, nodes_per_element
               do a = b, nodes_per_element
                  pair = pair + 1
                  self%place(pair, e) = place_in_matrix(self, mesh%node(a, e), mesh%node(b, e))
                  do k = 1, points_per_element
                     p = points_per_element*(e - 1) + k
                     self%product(pair, k, e) = mesh%weight(p)*dot_product(mesh%gradient(a, :, p), mesh%gradient(b, :, p))
                  end do
               end do
            end do
            do k = 1, points_per_element
               p = points_per_element*(e - 1) + k
               self%derivative(k, :, e) = mesh%gradient(:, 1, p)
               self%derivative(points_per_element + k, :, e) = mesh%gradient(:, 2, p)
               do a = 1, nodes_per_element
                  self%sweep(mesh%node(a, e), :) = self%sweep(mesh%node(a, e), :) &
                     & + mesh%weight(p)*mesh%shape(a, k)*self%phi(p, :)
               end do
            end do
         end do
      end associate
   end subroutine tabulate_elements

   !> Place of entry (a, b) in the matrix: the lower band by columns, then one entry for each unknown that holds
   !> its coupling to the hole's edge; 0 for what never matters, so that assembly need not ask.
   pure integer function place_in_matrix(self, a, b) result(place)
      type(film_type), intent(in) :: self
      integer, intent(in) :: a, b   !! nodes
      integer :: row, column

      row = max(self%unknown(a), self%unknown(b))
      column = min(self%unknown(a), self%unknown(b))
      place = 0
      if (column > 0) then
         place = (column - 1)*(self%band + 1) + row - column + 1
      else if (row > 0 .and. (self%mesh%on_hole(a) .or. self%mesh%on_hole(b))) then
         place = (self%band + 1)*self%unknowns + row
      end if
   end function place_in_matrix

   !> Pressures, forces and damping for displacements q. Fails with rv_domain where the film is closed.
   subroutine solve(self, gap, viscosity, q, state, error)
      class(film_type), intent(in) :: self
      real(wp), intent(in) :: gap              !! g0 [m]
      real(wp), intent(in) :: viscosity        !! mu [Pa s], > 0
      real(wp), intent(in) :: q(:)             !! [m], (shapes)
      type(film_state), intent(out) :: state
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: matrix(0:(self%band + 2)*self%unknowns), rhs(self%unknowns, 0:self%shapes)
      integer :: info, n

      call describe(self, gap, viscosity, q, state, error)
      if (allocated(error)) return
      call assemble(self, state, matrix, rhs)
      call dpbtrf("L", self%unknowns, self%band, matrix(1:), self%band + 1, info)
      if (info == 0) call dpbtrs("L", self%unknowns, self%band, self%shapes + 1, matrix(1:), self%band + 1, rhs, &
         & self%unknowns, info)
      if (info /= 0) then
         call fail(error, rv_not_converged, "film pressure: LAPACK returned info = "//to_text(info))
         return
      end if
      do n = 1, self%mesh%nodes
         if (self%unknown(n) > 0) then
            state%pressure(n, :) = rhs(self%unknown(n), :)
         else
            state%pressure(n, 1:) = 0.0_wp
            state%pressure(n, 0) = merge(1.0_wp, 0.0_wp, self%mesh%on_hole(n))
         end if
      end do
      state%land = 2.0_wp*matmul(state%pressure(:, 0), self%sweep)
      state%damping = 2.0_wp*matmul(transpose(self%sweep), state%pressure(:, 1:))
   end subroutine solve

   !> The film's thickness; pressures, forces and damping are NaN until solved for.
   subroutine describe(self, gap, viscosity, q, state, error)
      type(film_type), intent(in) :: self
      real(wp), intent(in) :: gap, viscosity, q(:)
      type(film_state), intent(out) :: state
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: nan
      integer :: place

      nan = ieee_value(1.0_wp, ieee_quiet_nan)
      state%gap = gap
      state%viscosity = viscosity
      state%q = q
      state%thickness = gap + matmul(self%phi, q)
      allocate(state%pressure(self%mesh%nodes, 0:self%shapes), state%land(self%shapes), &
         & state%damping(self%shapes, self%shapes), source=nan)
      associate (at_nodes => gap + matmul(self%phi_node, q))
         if (minval(at_nodes) > 0.0_wp .and. minval(state%thickness) > 0.0_wp) return
         place = minloc(at_nodes, 1)
      end associate
      call fail(error, rv_domain, "the film under the reed is closed at x = "//to_text(1.0e3_wp*self%mesh%x(place), 4) &
         & //" mm, y = "//to_text(1.0e3_wp*self%mesh%y(place), 4)//" mm")
   end subroutine describe

   !> Matrix and right-hand sides of P_0, P_1, ...; the unit pressure on the hole's edge moves to that of P_0.
   subroutine assemble(self, state, matrix, rhs)
      type(film_type), intent(in) :: self
      type(film_state), intent(in) :: state
      real(wp), intent(out) :: matrix(0:)
      real(wp), intent(out) :: rhs(:, 0:)
      real(wp) :: conductance(points_per_element)
      integer :: e, p, n

      matrix = 0.0_wp
      do e = 1, self%mesh%elements
         p = points_per_element*(e - 1)
         conductance = state%thickness(p + 1:p + points_per_element)**3/(12.0_wp*state%viscosity)
         call add_element(self%product(:, :, e), conductance, self%place(:, e), matrix)
      end do
      rhs(:, 0) = -matrix((self%band + 1)*self%unknowns + 1:)
      do n = 1, self%mesh%nodes
         if (self%unknown(n) > 0) rhs(self%unknown(n), 1:) = self%sweep(n, :)
      end do
      if (self%elongation > 0.0_wp) call add_edges(self, state, matrix, rhs)
   end subroutine assemble

   !> Add an element to the matrix. Its sizes are constants here, which halves the time.
   pure subroutine add_element(product, conductance, place, matrix)
      real(wp), intent(in) :: product(pairs, points_per_element), conductance(points_per_element)
      integer, intent(in) :: place(pairs)
      real(wp), intent(inout) :: matrix(0:)
      real(wp) :: element(pairs)
      integer :: k

      element = conductance(1)*product(:, 1)
      do k = 2, points_per_element
         element = element + conductance(k)*product(:, k)
      end do
      do k = 1, pairs
         matrix(place(k)) = matrix(place(k)) + element(k)
      end do
   end subroutine add_element

   !> Elongated edges: conductance h^2/(12 mu beta) to the pressure beyond.
   subroutine add_edges(self, state, matrix, rhs)
      type(film_type), intent(in) :: self
      type(film_state), intent(in) :: state
      real(wp), intent(inout) :: matrix(0:)
      real(wp), intent(inout) :: rhs(:, 0:)
      real(wp) :: conductance
      integer :: e, k, a, b, n, place

      do e = 1, size(self%mesh%edge_on_hole)
         do k = 1, 3
            conductance = edge_conductance(self, state, e, k)
            do b = 1, 3
               n = self%unknown(self%mesh%edge_node(b, e))
               if (self%mesh%edge_on_hole(e)) rhs(n, 0) = rhs(n, 0) + conductance*self%mesh%edge_shape(b, k)
               do a = b, 3
                  place = place_in_matrix(self, self%mesh%edge_node(a, e), self%mesh%edge_node(b, e))
                  matrix(place) = matrix(place) + conductance*self%mesh%edge_shape(a, k)*self%mesh%edge_shape(b, k)
               end do
            end do
         end do
      end do
   end subroutine add_edges

   !> h^2/(12 mu beta) times the weight of edge point k of edge e [m3 s-1 Pa-1].
   pure real(wp) function edge_conductance(self, state, e, k) result(conductance)
      type(film_type), intent(in) :: self
      type(film_state), intent(in) :: state
      integer, intent(in) :: e, k
      real(wp) :: h

      h = state%gap + dot_product(self%phi_edge(3*(e - 1) + k, :), state%q)
      conductance = self%mesh%edge_weight(k, e)*h**2/(12.0_wp*state%viscosity*self%elongation)
   end function edge_conductance

   !> Film pressure at the nodes, relative to p_out [Pa].
   pure function pressure_of(self, state, rate, drop) result(p)
      class(film_type), intent(in) :: self
      type(film_state), intent(in) :: state
      real(wp), intent(in) :: rate(:)      !! q' [m s-1], (shapes)
      real(wp), intent(in) :: drop         !! p_in - p_out [Pa]
      real(wp) :: p(self%mesh%nodes)

      p = drop*state%pressure(:, 0) - matmul(state%pressure(:, 1:), rate)
   end function pressure_of

   !> Derivative of the land's generalised forces with respect to q, at fixed q' and pressures [N m-1].
   !>
   !> Differentiating K(q) p = f(q) gives dF_i/dq_k = P_i^T (df/dq_k - dK/dq_k p): no further solve,
   !> since the P_i are the adjoint solutions.
   function force_slope(self, state, rate, drop) result(slope)
      class(film_type), intent(in) :: self
      type(film_state), intent(in) :: state
      real(wp), intent(in) :: rate(:)
      real(wp), intent(in) :: drop
      real(wp) :: slope(self%shapes, self%shapes)   !! dF_i/dq_k
      integer, parameter :: n = points_per_element
      real(wp) :: grad(2*n), flow(2*n), c(n), power(n)
      real(wp) :: p_node(self%mesh%nodes)
      integer :: e, i, k, p

      p_node = self%pressure_of(state, rate, drop)
      slope = 0.0_wp
      do e = 1, self%mesh%elements
         p = n*(e - 1)
         c = -0.5_wp*self%mesh%weight(p + 1:p + n)*state%thickness(p + 1:p + n)**2/state%viscosity
         flow = gradients(self%derivative(:, :, e), p_node(self%mesh%node(:, e)))
         flow = [c, c]*flow
         do i = 1, self%shapes
            grad = gradients(self%derivative(:, :, e), state%pressure(self%mesh%node(:, e), i))
            power = grad(:n)*flow(:n) + grad(n + 1:)*flow(n + 1:)
            do k = 1, self%shapes
               slope(i, k) = slope(i, k) + dot_product(power, self%phi(p + 1:p + n, k))
            end do
         end do
      end do
      if (self%elongation > 0.0_wp) slope = slope + edge_slope(self, state, p_node, drop)
   end function force_slope

   !> Gradient of a field at an element's points: its first components, then the second ones.
   pure function gradients(derivative, field) result(grad)
      real(wp), intent(in) :: derivative(2*points_per_element, nodes_per_element), field(nodes_per_element)
      real(wp) :: grad(2*points_per_element)
      integer :: a

      grad = field(1)*derivative(:, 1)
      do a = 2, nodes_per_element
         grad = grad + field(a)*derivative(:, a)
      end do
   end function gradients

   !> The elongated edges' part of force_slope: d(h^2)/dq_k = 2 h phi_k.
   function edge_slope(self, state, p_node, drop) result(slope)
      type(film_type), intent(in) :: self
      type(film_state), intent(in) :: state
      real(wp), intent(in) :: p_node(:)
      real(wp), intent(in) :: drop
      real(wp) :: slope(self%shapes, self%shapes)
      real(wp) :: jump, h, c
      integer :: e, k, p, i

      slope = 0.0_wp
      do e = 1, size(self%mesh%edge_on_hole)
         associate (node => self%mesh%edge_node(:, e))
            do k = 1, 3
               p = 3*(e - 1) + k
               h = state%gap + dot_product(self%phi_edge(p, :), state%q)
               jump = dot_product(p_node(node), self%mesh%edge_shape(:, k))
               if (self%mesh%edge_on_hole(e)) jump = jump - drop
               c = -4.0_wp*edge_conductance(self, state, e, k)/h*jump
               do i = 1, self%shapes
                  slope(i, :) = slope(i, :) + c*self%phi_edge(p, :) &
                     & *dot_product(state%pressure(node, i), self%mesh%edge_shape(:, k))
               end do
            end do
         end associate
      end do
   end function edge_slope

   !> Volume flow of the whole reed: into the film at the hole's edge, out of it at the free edges [m3 s-1].
   !>
   !> From the residuals of the discrete equations at the nodes of each edge, so that inflow - outflow equals
   !> the swept volume rate to rounding.
   subroutine inflow(self, state, rate, drop, in, out)
      class(film_type), intent(in) :: self
      type(film_state), intent(in) :: state
      real(wp), intent(in) :: rate(:)
      real(wp), intent(in) :: drop
      real(wp), intent(out) :: in, out
      real(wp) :: p_node(self%mesh%nodes), residual(self%mesh%nodes), element(nodes_per_element), c, grad(2), p_edge
      integer :: e, k, p

      p_node = self%pressure_of(state, rate, drop)
      in = 0.0_wp
      out = 0.0_wp
      if (self%elongation > 0.0_wp) then
         do e = 1, size(self%mesh%edge_on_hole)
            do k = 1, 3
               p_edge = dot_product(p_node(self%mesh%edge_node(:, e)), self%mesh%edge_shape(:, k))
               c = 2.0_wp*edge_conductance(self, state, e, k)
               if (self%mesh%edge_on_hole(e)) then
                  in = in + c*(drop - p_edge)
               else
                  out = out + c*p_edge
               end if
            end do
         end do
         return
      end if
      residual = matmul(self%sweep, rate)
      do e = 1, self%mesh%elements
         element = 0.0_wp
         do k = 1, points_per_element
            p = points_per_element*(e - 1) + k
            grad = matmul(p_node(self%mesh%node(:, e)), self%mesh%gradient(:, :, p))
            c = self%mesh%weight(p)*state%thickness(p)**3/(12.0_wp*state%viscosity)
            element = element + c*matmul(self%mesh%gradient(:, :, p), grad)
         end do
         residual(self%mesh%node(:, e)) = residual(self%mesh%node(:, e)) + element
      end do
      in = 2.0_wp*sum(residual, mask=self%mesh%on_hole)
      out = -2.0_wp*sum(residual, mask=self%mesh%on_free)
   end subroutine inflow

end module rv_reynolds
