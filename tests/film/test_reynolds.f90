!> The Reynolds equation against closed forms: annulus, Stefan's disk, rectangles, elongated edges, a film of
!> uneven thickness, a manufactured solution; orders of convergence.
program test_reynolds
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type
   use rv_film_mesh, only : film_mesh, new_annulus_mesh, nodes_per_element, points_per_element
   use rv_gauss, only : gauss_legendre
   use rv_reynolds, only : film_state, film_type, new_film
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_film, only : rigid_film
   use paper_valve, only : mm
   implicit none
   type(suite_type) :: suite
   real(wp), parameter :: h = 0.1_wp*mm, mu = 0.0484_wp, inner = 2.0_wp*mm, outer = 3.0_wp*mm

   call annulus()
   call elongated_annulus()
   call stefan_disk()
   call rectangles()
   call cone()
   call manufactured()
   call suite%finish()

contains

   !> Land area int P_0 dA [m2] and squeeze coefficient [N s m-1] of the film of even thickness h on a mesh.
   function even_film(mesh, elongation) result(pair)
      type(film_mesh), intent(in) :: mesh
      real(wp), intent(in) :: elongation
      real(wp) :: pair(2)
      type(film_type) :: film
      type(film_state) :: state
      type(error_type), allocatable :: error

      film = rigid_film(mesh, elongation)
      call film%solve(h, mu, [0.0_wp], state, error)
      if (allocated(error)) error stop "an even film is refused"
      pair = [state%land(1), state%damping(1, 1)]
   end function even_film

   function annulus_mesh(across) result(mesh)
      integer, intent(in) :: across
      type(film_mesh) :: mesh

      call new_annulus_mesh(mesh, inner, outer, 4, across)
   end function annulus_mesh

   !> p = ln(r_o/r)/ln(r_o/r_i) from the hole; the squeeze pressure adds a parabola. Order 4 in the pressure's integrals.
   subroutine annulus()
      type(film_type) :: film
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: pair(2, 3), exact(2), in, out, flow
      integer :: n

      exact = radial_film(0.0_wp, .true.)
      call suite%close("closed form of the pressure area [mm2]", exact(1)/mm**2, 6.80393_wp, 1.0e-6_wp, 0.0_wp)
      call suite%close("closed form of the squeeze coefficient [N s/m]", exact(2), 0.762336_wp, 1.0e-6_wp, 0.0_wp)
      do n = 1, 3
         pair(:, n) = even_film(annulus_mesh(2**(n - 1)), 0.0_wp)
      end do
      call suite%close("annulus, 4 layers: pressure area [mm2]", pair(1, 3)/mm**2, 6.80393_wp, 1.0e-4_wp, 0.0_wp)
      call suite%close("squeeze coefficient [N s/m]", pair(2, 3), 0.762336_wp, 1.0e-4_wp, 0.0_wp)
      call check_order("annulus", pair, exact)
      film = rigid_film(annulus_mesh(4), 0.0_wp)
      call film%solve(h, mu, [0.0_wp], state, error)
      call film%inflow(state, [0.0_wp], 1.0e3_wp, in, out)
      flow = 1.0e3_wp*pi*h**3/(6.0_wp*mu*log(outer/inner))
      call suite%close("leakage at 1 kPa, in [mm3/s]", in/mm**3, flow/mm**3, 1.0e-4_wp, 0.0_wp)
      call suite%close("out [mm3/s]", out/mm**3, flow/mm**3, 1.0e-4_wp, 0.0_wp)
      call suite%true("0 <= P_0 <= 1 and P_1 >= 0 everywhere", all(state%pressure(:, 0) >= 0.0_wp &
         & .and. state%pressure(:, 0) <= 1.0_wp .and. state%pressure(:, 1) >= 0.0_wp))
   end subroutine annulus

   subroutine elongated_annulus()
      real(wp), parameter :: beta(2) = [0.65_wp, 5.0_wp]
      real(wp) :: pair(2, 3)
      integer :: n, i

      do i = 1, 2
         do n = 1, 3
            pair(:, n) = even_film(annulus_mesh(2**(n - 1)), beta(i))
         end do
         call check_order("edge elongation "//to_text(beta(i)), pair, radial_film(beta(i), .true.))
      end do
      pair(:, 1) = even_film(annulus_mesh(4), 1.0e-7_wp)
      pair(:, 2) = even_film(annulus_mesh(4), 0.0_wp)
      call suite%close("no elongation is the limit: area", pair(1, 1)/pair(1, 2), 1.0_wp, 0.0_wp, 1.0e-6_wp)
      call suite%close("squeeze coefficient", pair(2, 1)/pair(2, 2), 1.0_wp, 0.0_wp, 1.0e-6_wp)
   end subroutine elongated_annulus

   !> A hole edge without flow: its nodes are unknowns like others. With a small hole, Stefan's disk.
   subroutine stefan_disk()
      type(film_mesh) :: mesh
      real(wp) :: pair(2, 3), exact(2)
      integer :: n

      exact = radial_film(0.0_wp, .false.)
      do n = 1, 3
         mesh = annulus_mesh(2**(n - 1))
         mesh%on_hole = .false.
         pair(:, n) = even_film(mesh, 0.0_wp)
      end do
      call check_order("annulus with a closed inner edge", pair(2:2, :), exact(2:2))
      call new_annulus_mesh(mesh, 1.0e-3_wp*outer, outer, 2, 8)
      mesh%on_hole = .false.
      pair(:, 1) = even_film(mesh, 0.0_wp)
      call suite%close("Stefan's disk, 3 pi mu R^4/(2 h^3) [N s/m]", pair(2, 1), 18.47445_wp, 1.0e-4_wp, 0.0_wp)
   end subroutine stefan_disk

   !> Half-width meshes of Cartesian elements, symmetric in y. The series is that of the twisted bar. In open corners
   !> p ~ r^2 ln r, which costs the order a little.
   subroutine rectangles()
      real(wp) :: pair(2, 3)
      integer :: n

      do n = 1, 3
         pair(:, n) = even_film(rectangle_mesh(7.5_wp*mm, 3.0_wp*mm, 2**(n + 1), 2**(n + 1), .true.), 0.0_wp)
      end do
      call suite%close("7.5 x 6 mm, four open edges [N s/m]", pair(2, 3), 40.39562_wp, 1.0e-4_wp, 0.0_wp)
      call check_order("four open edges", pair(2:2, :), [bar_series(7.5_wp*mm, 6.0_wp*mm)])
      do n = 1, 3
         pair(:, n) = even_film(rectangle_mesh(7.5_wp*mm, 3.0_wp*mm, 2**(n + 1), 2**(n + 1), .false.), 0.0_wp)
      end do
      call suite%close("with one wall on a 6 mm side [N s/m]", pair(2, 3), 58.65665_wp, 1.0e-4_wp, 0.0_wp)
      call check_order("three open edges", pair(2:2, :), [0.5_wp*bar_series(15.0_wp*mm, 6.0_wp*mm)])
   end subroutine rectangles

   !> Values on meshes of 1, 2, 4 times as many layers: the last within 1e-4, the errors of order 4.
   subroutine check_order(name, value, exact)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value(:, :), exact(:)   !! (quantities, meshes), (quantities)
      integer :: k

      do k = 1, size(exact)
         call suite%close(name//", quantity "//to_text(k)//", finest mesh over exact", value(k, 3)/exact(k), 1.0_wp, &
            & 0.0_wp, 1.0e-4_wp)
         call suite%close(name//", order", &
            & log(abs(value(k, 2) - exact(k))/abs(value(k, 3) - exact(k)))/log(2.0_wp), 4.0_wp, 0.0_wp, 0.4_wp)
      end do
   end subroutine check_order

   !> Annulus, even film: p = c_1 + c_2 ln r - S r^2/4 with S = 12 mu V/h^3; -h beta dp/dn = p - p_side on both edges,
   !> or no flow at the inner one. Area for p_in = 1, V = 0; force for V = 1, p_in = 0.
   function radial_film(beta, open_hole) result(pair)
      real(wp), intent(in) :: beta
      logical, intent(in) :: open_hole
      real(wp) :: pair(2), m(2, 2), b(2), c(2), s, det
      integer :: k

      do k = 1, 2
         s = 0.0_wp
         if (k == 2) s = 12.0_wp*mu/h**3
         m(1, :) = [1.0_wp, log(outer) + h*beta/outer]
         b(1) = 0.25_wp*s*outer**2 + 0.5_wp*h*beta*s*outer
         m(2, :) = [1.0_wp, log(inner) - h*beta/inner]
         b(2) = merge(1.0_wp, 0.0_wp, k == 1) + 0.25_wp*s*inner**2 - 0.5_wp*h*beta*s*inner
         if (.not. open_hole) then
            m(2, :) = [0.0_wp, 1.0_wp/inner]
            b(2) = 0.5_wp*s*inner
         end if
         det = m(1, 1)*m(2, 2) - m(1, 2)*m(2, 1)
         c = [b(1)*m(2, 2) - b(2)*m(1, 2), m(1, 1)*b(2) - m(2, 1)*b(1)]/det
         pair(k) = 2.0_wp*pi*(0.5_wp*c(1)*(outer**2 - inner**2) - s*(outer**4 - inner**4)/16.0_wp &
            & + c(2)*(outer**2*(0.5_wp*log(outer) - 0.25_wp) - inner**2*(0.5_wp*log(inner) - 0.25_wp)))
      end do
   end function radial_film

   !> Squeeze coefficient of an open a x b rectangle: 12 mu/h^3 times the torsion integral over 4 [N s m-1].
   pure real(wp) function bar_series(a, b) result(c)
      real(wp), intent(in) :: a, b
      real(wp) :: sum
      integer :: n

      sum = 0.0_wp
      do n = 199, 1, -2
         sum = sum + tanh(0.5_wp*real(n, wp)*pi*a/b)/real(n, wp)**5
      end do
      c = mu/h**3*a*b**3*(1.0_wp - 192.0_wp*b/(pi**5*a)*sum)
   end function bar_series

   !> 0 < x < length, 0 < y < width: given pressure at y = width, x = length and, if `open`, x = 0.
   function rectangle_mesh(length, width, nx, ny, open) result(mesh)
      real(wp), intent(in) :: length, width
      integer, intent(in) :: nx, ny
      logical, intent(in) :: open
      type(film_mesh) :: mesh
      real(wp) :: g(3), w(3), dx, dy, fx(3, 2), fy(3, 2)
      integer :: i, j, k, l, e, p, n, rows

      rows = 2*ny + 1
      dx = length/real(nx, wp)
      dy = width/real(ny, wp)
      mesh%nodes = (2*nx + 1)*rows
      mesh%elements = nx*ny
      mesh%x = [((0.5_wp*dx*real(i, wp), j = 0, 2*ny), i = 0, 2*nx)]
      mesh%y = [((0.5_wp*dy*real(j, wp), j = 0, 2*ny), i = 0, 2*nx)]
      mesh%on_free = [((j == 2*ny .or. i == 2*nx .or. (open .and. i == 0), j = 0, 2*ny), i = 0, 2*nx)]
      allocate(mesh%on_hole(mesh%nodes), source=.false.)
      allocate(mesh%node(nodes_per_element, mesh%elements), mesh%shape(nodes_per_element, points_per_element))
      p = mesh%elements*points_per_element
      allocate(mesh%px(p), mesh%py(p), mesh%weight(p), mesh%gradient(nodes_per_element, 2, p))
      allocate(mesh%edge_on_hole(0), mesh%edge_node(3, 0))
      call gauss_legendre(0.0_wp, 1.0_wp, g, w)
      do e = 1, mesh%elements
         i = (e - 1)/ny
         j = mod(e - 1, ny)
         mesh%node(:, e) = [((2*i + k)*rows + 2*j + [1, 2, 3], k = 0, 2)]
         do l = 1, 3
            do k = 1, 3
               n = 3*(l - 1) + k
               p = points_per_element*(e - 1) + n
               fx = quadratic(g(l))
               fy = quadratic(g(k))
               mesh%px(p) = dx*(real(i, wp) + g(l))
               mesh%py(p) = dy*(real(j, wp) + g(k))
               mesh%weight(p) = w(l)*w(k)*dx*dy
               mesh%shape(:, n) = [fx(1, 1)*fy(:, 1), fx(2, 1)*fy(:, 1), fx(3, 1)*fy(:, 1)]
               mesh%gradient(:, 1, p) = [fx(1, 2)*fy(:, 1), fx(2, 2)*fy(:, 1), fx(3, 2)*fy(:, 1)]/dx
               mesh%gradient(:, 2, p) = [fx(1, 1)*fy(:, 2), fx(2, 1)*fy(:, 2), fx(3, 1)*fy(:, 2)]/dy
            end do
         end do
      end do
   end function rectangle_mesh

   !> Quadratic shape functions on 0..1 and their slopes, (node, 2).
   pure function quadratic(s) result(f)
      real(wp), intent(in) :: s
      real(wp) :: f(3, 2)

      f(:, 1) = [(1.0_wp - s)*(1.0_wp - 2.0_wp*s), 4.0_wp*s*(1.0_wp - s), s*(2.0_wp*s - 1.0_wp)]
      f(:, 2) = [4.0_wp*s - 3.0_wp, 4.0_wp - 8.0_wp*s, 4.0_wp*s - 1.0_wp]
   end function quadratic

   !> A conical film, h from h_0 to 4 h_0 over the annulus: dp/dr ~ 1/(r h^3), by single integrals. The second shape,
   !> 1 everywhere, is not displaced: it sums up the pressure.
   subroutine cone()
      type(film_mesh) :: mesh
      type(film_type) :: film
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: r(60), w(60), drop, value(2, 3), in, out, exact(2)
      integer :: n

      call gauss_legendre(inner, outer, r, w)
      associate (thickness => h*(1.0_wp + 3.0_wp*(r - inner)/(outer - inner)))
         drop = sum(w/(r*thickness**3))
         exact = [pi*sum(w*(r**2 - inner**2)/(r*thickness**3))/drop, 1.0e3_wp*pi/(6.0_wp*mu*drop)]
      end associate
      do n = 1, 3
         mesh = annulus_mesh(10*2**(n - 1))
         call new_film(film, mesh, cone_shapes(mesh%px, mesh%py), cone_shapes(mesh%x, mesh%y), &
            & cone_shapes([mesh%edge_x], [mesh%edge_y]), 0.0_wp)
         call film%solve(h, mu, [3.0_wp*h, 0.0_wp], state, error)
         if (allocated(error)) error stop "the conical film is refused"
         call film%inflow(state, [0.0_wp, 0.0_wp], 1.0e3_wp, in, out)
         value(:, n) = [state%land(2), in]
      end do
      call check_order("conical film: pressure area and leakage", value, exact)
   end subroutine cone

   pure function cone_shapes(x, y) result(phi)
      real(wp), intent(in) :: x(:), y(:)
      real(wp) :: phi(size(x), 2)

      phi(:, 1) = (sqrt(x**2 + y**2) - inner)/(outer - inner)
      phi(:, 2) = 1.0_wp
   end function cone_shapes

   !> A film that varies along and around, h = h_0 (1 + x/(2 r_o)), and p = sin(pi s) cos(2 theta): the second shape
   !> is -div(h^3/(12 mu) grad p), so that P_2 = p. Pressures of order 3 or better, damping C_22 of order 4.
   subroutine manufactured()
      type(film_mesh) :: mesh
      type(film_type) :: film
      type(film_state) :: state
      type(error_type), allocatable :: error
      real(wp) :: off(4), damping(4)
      integer :: n

      do n = 1, 4
         call new_annulus_mesh(mesh, inner, outer, 4*2**(n - 1), 2**(n - 1))
         call new_film(film, mesh, made_shapes(mesh%px, mesh%py), made_shapes(mesh%x, mesh%y), &
            & made_shapes([mesh%edge_x], [mesh%edge_y]), 0.0_wp)
         call film%solve(h, mu, [0.5_wp*h, 0.0_wp], state, error)
         if (allocated(error)) error stop "the manufactured film is refused"
         off(n) = maxval(abs(state%pressure(:, 2) - made_pressure(mesh%x, mesh%y)))
         damping(n) = state%damping(2, 2)
      end do
      call suite%close("manufactured film, largest error of a node's pressure", off(4), 0.0_wp, 0.0_wp, 1.0e-3_wp)
      call suite%true("its order is 3 or better: "//to_text(log(off(3)/off(4))/log(2.0_wp), 3), off(3)/off(4) > 2.0_wp**2.8_wp)
      call suite%close("order of the damping", log((damping(2) - damping(3))/(damping(3) - damping(4)))/log(2.0_wp), 4.0_wp, &
         & 0.0_wp, 0.3_wp)
   end subroutine manufactured

   pure function made_pressure(x, y) result(p)
      real(wp), intent(in) :: x(:), y(:)
      real(wp) :: p(size(x))

      p = sin(pi*(sqrt(x**2 + y**2) - inner)/(outer - inner))*cos(2.0_wp*atan2(y, x))
   end function made_pressure

   pure function made_shapes(x, y) result(phi)
      real(wp), intent(in) :: x(:), y(:)
      real(wp) :: phi(size(x), 2)
      real(wp), dimension(size(x)) :: r, t, s, k, film, p, p_r, p_rr, p_t, p_tt
      real(wp), parameter :: wave = pi/(outer - inner)

      r = sqrt(x**2 + y**2)
      t = atan2(y, x)
      s = wave*(r - inner)
      phi(:, 1) = x/outer
      film = h*(1.0_wp + 0.5_wp*phi(:, 1))
      k = film**3/(12.0_wp*mu)
      p = sin(s)*cos(2.0_wp*t)
      p_r = wave*cos(s)*cos(2.0_wp*t)
      p_rr = -wave**2*p
      p_t = -2.0_wp*sin(s)*sin(2.0_wp*t)
      p_tt = -4.0_wp*p
      phi(:, 2) = -k*(p_rr + p_r/r + p_tt/r**2) &
         & - 3.0_wp*k/film*0.5_wp*h/outer*(cos(t)*p_r - sin(t)*p_t/r)
   end function made_shapes

end program test_reynolds
