!> The film mesh: area, shape functions and their gradients, edges, the part of the land before a line.
program test_film_mesh
   use rv_kinds, only : wp, pi
   use rv_film_mesh, only : film_mesh, new_film_mesh, new_annulus_mesh, land_weights, points_per_element
   use rv_gauss, only : gauss_legendre
   use rv_planform, only : planform_type
   use rv_text, only : to_text
   use check, only : suite_type
   use paper_film, only : paper_form
   use paper_valve, only : mm
   implicit none
   type(suite_type) :: suite

   call sizes()
   call areas()
   call shape_functions()
   call gradient_order()
   call edges()
   call root_of_the_annulus()
   call root_of_the_reed()
   call suite%finish()

contains

   function reed_mesh(finer) result(mesh)
      integer, intent(in) :: finer
      type(film_mesh) :: mesh

      call new_film_mesh(mesh, paper_form(), finer*[6, 4, 2], finer*3)
   end function reed_mesh

   subroutine sizes()
      type(film_mesh) :: mesh

      call new_film_mesh(mesh, paper_form())
      call suite%equal("elements of the default mesh", mesh%elements, 36)
      call suite%equal("nodes whose pressure is unknown", count(.not. (mesh%on_hole .or. mesh%on_free)), 129)
      call suite%true("all elements' nodes exist", all(mesh%node >= 1 .and. mesh%node <= mesh%nodes))
      call suite%true("all nodes lie on the half reed", all(mesh%x/mm > -1.0e-9_wp .and. mesh%x/mm < 7.5_wp + 1.0e-9_wp &
         & .and. mesh%y/mm > -1.0e-9_wp .and. mesh%y/mm < 3.0_wp + 1.0e-9_wp))
      call suite%close("corner of the clamp: nearest node [mm]", &
         & minval(sqrt(mesh%x**2 + (mesh%y - 3.0_wp*mm)**2))/mm, 0.0_wp, 0.0_wp, 1.0e-12_wp)
      call suite%true("the corner's pressure is the outlet's", mesh%on_free(minloc(mesh%x**2 + (mesh%y - 3.0_wp*mm)**2, 1)))
      call suite%true("no node between clamp and symmetry line has a given pressure", &
         & .not. any(mesh%on_free .and. mesh%x < 1.0e-9_wp*mm .and. mesh%y < 2.99_wp*mm))
   end subroutine sizes

   !> The annulus has the area to rounding (r dr dtheta), the reed to the order 6 of 3 x 3 Gauss points.
   subroutine areas()
      real(wp), parameter :: half_land = 13.5_wp*mm**2 + 0.25_wp*pi*(3.0_wp*mm)**2 - 0.5_wp*pi*(2.0_wp*mm)**2
      type(film_mesh) :: mesh
      real(wp) :: error(2)
      integer :: n

      call new_annulus_mesh(mesh, 2.0_wp*mm, 3.0_wp*mm, 5, 2)
      call suite%close("half the annulus' area", sum(mesh%weight), 0.5_wp*pi*5.0_wp*mm**2, 1.0e-13_wp, 0.0_wp)
      do n = 1, 2
         mesh = reed_mesh(n)
         error(n) = abs(sum(mesh%weight)/half_land - 1.0_wp)
         call suite%true("weights are positive", all(mesh%weight > 0.0_wp))
      end do
      call suite%close("half the land's area, relative error", error(1), 0.0_wp, 0.0_wp, 1.0e-6_wp)
      call suite%close("its order", log(error(1)/error(2))/log(2.0_wp), 6.0_wp, 0.0_wp, 0.5_wp)
   end subroutine areas

   !> They sum to 1, their gradients to 0; fields linear in r and in theta come back exactly.
   subroutine shape_functions()
      type(film_mesh) :: mesh
      real(wp) :: off(4), r, worst_sum, worst_gradient, grad(2)
      real(wp), allocatable :: radius(:), angle(:)
      integer :: e, k, p

      call new_annulus_mesh(mesh, 2.0_wp*mm, 3.0_wp*mm, 5, 2)
      radius = sqrt(mesh%x**2 + mesh%y**2)
      angle = atan2(mesh%y, mesh%x)
      worst_sum = maxval(abs(sum(mesh%shape, 1) - 1.0_wp))
      worst_gradient = maxval(abs(sum(mesh%gradient, 1)))*mm
      off = 0.0_wp
      do e = 1, mesh%elements
         do k = 1, points_per_element
            p = points_per_element*(e - 1) + k
            associate (node => mesh%node(:, e))
               r = sqrt(mesh%px(p)**2 + mesh%py(p)**2)
               off(1) = max(off(1), abs(dot_product(mesh%shape(:, k), radius(node)) - r)/mm)
               grad = matmul(radius(node), mesh%gradient(:, :, p))
               off(2) = max(off(2), maxval(abs(grad - [1.0_wp, 0.0_wp])))
               off(3) = max(off(3), abs(dot_product(mesh%shape(:, k), angle(node)) - atan2(mesh%py(p), mesh%px(p))))
               grad = matmul(angle(node), mesh%gradient(:, :, p))
               off(4) = max(off(4), maxval(abs(grad*r - [0.0_wp, 1.0_wp])))
            end associate
         end do
      end do
      call suite%close("sum of the shape functions less 1", worst_sum, 0.0_wp, 0.0_wp, 4.0_wp*epsilon(1.0_wp))
      call suite%close("sum of their gradients [mm-1]", worst_gradient, 0.0_wp, 0.0_wp, 1.0e-13_wp)
      call suite%close("r at the Gauss points [mm]", off(1), 0.0_wp, 0.0_wp, 1.0e-14_wp)
      call suite%close("its gradient", off(2), 0.0_wp, 0.0_wp, 1.0e-12_wp)
      call suite%close("theta at the Gauss points", off(3), 0.0_wp, 0.0_wp, 1.0e-14_wp)
      call suite%close("r times its gradient", off(4), 0.0_wp, 0.0_wp, 1.0e-12_wp)
   end subroutine shape_functions

   !> x and y are not in the space of polar elements: values of order 3, gradients of order 2, on every kind of edge.
   subroutine gradient_order()
      real(wp) :: coarse(4), fine(4), order(4)

      coarse = linear_field_errors(reed_mesh(2))
      fine = linear_field_errors(reed_mesh(4))
      order = log(coarse/fine)/log(2.0_wp)
      call suite%close("order of x", order(1), 3.0_wp, 0.0_wp, 0.3_wp)
      call suite%close("order of y", order(2), 3.0_wp, 0.0_wp, 0.3_wp)
      call suite%close("order of grad x", order(3), 2.0_wp, 0.0_wp, 0.3_wp)
      call suite%close("order of grad y", order(4), 2.0_wp, 0.0_wp, 0.3_wp)
      call suite%close("grad x on the mesh twice as fine, largest error", coarse(3), 0.0_wp, 0.0_wp, 2.0e-2_wp)
   end subroutine gradient_order

   !> Largest errors over the Gauss points of x, y [mm], grad x, grad y.
   function linear_field_errors(mesh) result(off)
      type(film_mesh), intent(in) :: mesh
      real(wp) :: off(4), t
      integer :: e, k, p

      off = 0.0_wp
      do e = 1, mesh%elements
         do k = 1, points_per_element
            p = points_per_element*(e - 1) + k
            t = atan2(mesh%py(p), mesh%px(p) - 4.5_wp*mm)
            associate (node => mesh%node(:, e), x => mesh%x(mesh%node(:, e)), y => mesh%y(mesh%node(:, e)))
               off(1) = max(off(1), abs(dot_product(mesh%shape(:, k), x) - mesh%px(p))/mm)
               off(2) = max(off(2), abs(dot_product(mesh%shape(:, k), y) - mesh%py(p))/mm)
               off(3) = max(off(3), maxval(abs(matmul(x, mesh%gradient(:, :, p)) - [cos(t), -sin(t)])))
               off(4) = max(off(4), maxval(abs(matmul(y, mesh%gradient(:, :, p)) - [sin(t), cos(t)])))
            end associate
         end do
      end do
   end function linear_field_errors

   !> Lengths of the edges with a pressure: half the hole's, the side, half the arc. No edge on the clamp.
   subroutine edges()
      type(film_mesh) :: mesh
      real(wp) :: length(2), off
      integer :: e, k

      mesh = reed_mesh(2)
      length = 0.0_wp
      off = 0.0_wp
      do e = 1, size(mesh%edge_on_hole)
         length = length + sum(mesh%edge_weight(:, e))*merge([1.0_wp, 0.0_wp], [0.0_wp, 1.0_wp], mesh%edge_on_hole(e))
         do k = 1, 3
            associate (node => mesh%edge_node(:, e))
               off = max(off, abs(dot_product(mesh%edge_shape(:, k), mesh%x(node)) - mesh%edge_x(k, e)), &
                  & abs(dot_product(mesh%edge_shape(:, k), mesh%y(node)) - mesh%edge_y(k, e)))
            end associate
         end do
         if (mesh%edge_on_hole(e) .neqv. all(mesh%on_hole(mesh%edge_node(:, e)))) off = huge(off)
         if (.not. mesh%edge_on_hole(e) .and. .not. all(mesh%on_free(mesh%edge_node(:, e)))) off = huge(off)
      end do
      call suite%close("half the hole's edge [mm]", length(1)/mm, 2.0_wp*pi, 1.0e-13_wp, 0.0_wp)
      call suite%close("free edges [mm]", length(2)/mm, 4.5_wp + 1.5_wp*pi, 1.0e-6_wp, 0.0_wp)
      call suite%close("edges lie on their nodes [mm]", off/mm, 0.0_wp, 0.0_wp, 5.0e-3_wp)
   end subroutine edges

   !> On an annulus the elements hold theta^2 r^2, and its integral over x < limit is a single one over theta.
   subroutine root_of_the_annulus()
      real(wp), parameter :: inner = 2.0_wp*mm, outer = 3.0_wp*mm
      real(wp), parameter :: limit(5) = [-2.5_wp, -2.0_wp, -0.7_wp, 1.3_wp, 2.2_wp]*mm
      type(film_mesh) :: mesh
      type(planform_type) :: form
      integer :: i

      call new_annulus_mesh(mesh, inner, outer, 6, 3)
      form = planform_type(hole_radius=inner, radius=outer)
      do i = 1, size(limit)
         call suite%close("int r^2 theta^2 over x < "//to_text(limit(i)/mm)//" mm [mm4]", &
            & sum(land_weights(mesh, form, limit(i))*(mesh%x**2 + mesh%y**2)*atan2(mesh%y, mesh%x)**2)/mm**4, &
            & part_integral(inner, outer, limit(i))/mm**4, 1.0e-12_wp, 0.0_wp)
      end do
      call suite%close("limit beyond the annulus [mm4]", &
         & sum(land_weights(mesh, form, 2.0_wp*outer)*(mesh%x**2 + mesh%y**2)*atan2(mesh%y, mesh%x)**2)/mm**4, &
         & pi**3/12.0_wp*65.0_wp, 1.0e-12_wp, 0.0_wp)
      call suite%close("limit before it", maxval(abs(land_weights(mesh, form, -1.1_wp*outer)))/mm**2, 0.0_wp, 0.0_wp, 0.0_wp)
   end subroutine root_of_the_annulus

   !> int theta^2 r^3 dr dtheta over inner < r < outer, x < limit, by many Gauss points between the kinks.
   real(wp) function part_integral(inner, outer, limit) result(value)
      real(wp), intent(in) :: inner, outer, limit
      real(wp) :: corner(0:3), t(200), w(200), cut
      integer :: k, j

      corner = [0.0_wp, acos(max(-1.0_wp, min(1.0_wp, limit/outer))), acos(max(-1.0_wp, min(1.0_wp, limit/inner))), pi]
      if (corner(2) < corner(1)) corner(1:2) = corner([2, 1])
      value = 0.0_wp
      do k = 1, 3
         call gauss_legendre(corner(k - 1), corner(k), t, w)
         do j = 1, 200
            cut = max(inner, min(outer, limit/cos(t(j))))
            if (cos(t(j)) < 0.0_wp) then
               if (limit >= 0.0_wp) cut = inner
               value = value + w(j)*t(j)**2*0.25_wp*(outer**4 - cut**4)
            else
               if (limit <= 0.0_wp) cut = inner
               value = value + w(j)*t(j)**2*0.25_wp*(cut**4 - inner**4)
            end if
         end do
      end do
   end function part_integral

   !> x < a touches the hole: a rectangle of 2.5 x 3 mm. Both parts together are the whole land.
   subroutine root_of_the_reed()
      real(wp), parameter :: behind = 2.0_wp*3.0_wp + 0.25_wp*pi*9.0_wp - 0.5_wp*pi*4.0_wp   !! half of part B [mm2]
      real(wp), allocatable :: whole(:), root(:)
      type(film_mesh) :: mesh

      mesh = reed_mesh(1)
      whole = land_weights(mesh, paper_form(), 15.0_wp*mm)
      root = land_weights(mesh, paper_form(), 2.5_wp*mm)
      call suite%close("half of part A [mm2]", sum(root)/mm**2, 7.5_wp, 1.0e-12_wp, 0.0_wp)
      call suite%close("parts A and B [mm2]", sum(root)/mm**2 + behind, sum(whole)/mm**2, 1.0e-12_wp, 0.0_wp)
      call suite%close("nothing of A beyond the hole's centre", maxval(abs(root), mask=mesh%x > 4.5_wp*mm)/mm**2, &
         & 0.0_wp, 0.0_wp, 0.0_wp)
      call suite%close("whole land: the elements' own integrals", maxval(abs(whole - node_areas(mesh)))/maxval(whole), &
         & 0.0_wp, 0.0_wp, 3.0e-4_wp)
      mesh = reed_mesh(4)
      root = land_weights(mesh, paper_form(), 2.5_wp*mm)
      call suite%close("part A on a fine mesh: int x [mm3]", sum(root*mesh%x)/mm**3, 3.0_wp*2.5_wp**2/2.0_wp, 2.0e-5_wp, 0.0_wp)
      call suite%close("int y^2 [mm4]", sum(root*mesh%y**2)/mm**4, 2.5_wp*9.0_wp, 2.0e-5_wp, 0.0_wp)
   end subroutine root_of_the_reed

   !> int shape function dA by the mesh's own points.
   pure function node_areas(mesh) result(area)
      type(film_mesh), intent(in) :: mesh
      real(wp) :: area(mesh%nodes)
      integer :: e, k

      area = 0.0_wp
      do e = 1, mesh%elements
         do k = 1, points_per_element
            area(mesh%node(:, e)) = area(mesh%node(:, e)) + mesh%weight(points_per_element*(e - 1) + k)*mesh%shape(:, k)
         end do
      end do
   end function node_areas

end program test_film_mesh
