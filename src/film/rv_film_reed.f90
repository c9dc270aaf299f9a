!> One planform ready for the film models: plate modes, static shape, film mesh, integrals over hole and land.
!>
!> Depends on a, D, B, Poisson's ratio, the edge elongation and the number of modes only; thickness, density,
!> modulus, gap, liquid and pressures come later, so that all cases of such a sweep share one.
module rv_film_reed
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type
   use rv_film_mesh, only : film_mesh, new_film_mesh, land_weights
   use rv_hydrodynamic_function, only : maali_function, sader_function
   use rv_hydrodynamic_load, only : fluid_type, load_sader, load_none
   use rv_planform, only : planform_type, new_planform, point_set, reed_points, hole_points
   use rv_plate, only : plate_type, new_plate
   use rv_reynolds, only : film_type, new_film
   implicit none
   private
   public :: film_reed, new_film_reed, fluid_matrices

   integer, parameter :: points = 12  !! quadrature points a direction over reed and hole: exact to degree 23, two shapes have 18

   !> The modes' film and the static shape's film.
   type :: film_reed
      type(plate_type) :: plate
      type(film_type) :: film                     !! shapes: the modes
      type(film_type) :: static_film              !! shape: the static one
      real(wp), allocatable :: hole(:)            !! int_hole phi_j dA [m2], (modes)
      real(wp) :: static_hole = 0.0_wp            !! of the static shape [m2]
      real(wp) :: hole_area = 0.0_wp              !! pi D^2/4 [m2]
      real(wp), allocatable :: land_weight(:)     !! int shape function dA over the whole land [m2], (nodes)
      real(wp), allocatable :: root_weight(:)     !! the same over part A, x < a
      real(wp), allocatable, private :: chord(:)  !! widths of the reed at the quadrature points, each once [m]
      real(wp), allocatable, private :: gram(:, :, :)  !! int phi_i phi_j dA where it is that wide [m2]; the static shape last
   end type film_reed

contains

   !> Solve the plate and build the mesh. On failure `self` is a default one.
   subroutine new_film_reed(self, root, hole_diameter, tip, width, poisson_ratio, modes, elongation, error, around, across)
      type(film_reed), intent(out) :: self
      real(wp), intent(in) :: root, hole_diameter, tip, width   !! a, D, b, B [m]
      real(wp), intent(in) :: poisson_ratio                     !! [-]
      integer, intent(in) :: modes
      real(wp), intent(in) :: elongation                        !! beta [-], >= 0
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in), optional :: around(3), across        !! elements of the film mesh, see new_film_mesh
      type(planform_type) :: form
      type(film_mesh) :: mesh
      type(point_set) :: hole

      call new_planform(form, root, hole_diameter, tip, width, error)
      if (allocated(error)) return
      call new_plate(self%plate, form, poisson_ratio, modes, error)
      if (allocated(error)) return
      call new_film_mesh(mesh, form, around, across)
      associate (plate => self%plate, ex => reshape(mesh%edge_x, [size(mesh%edge_x)]), &
         & ey => reshape(mesh%edge_y, [size(mesh%edge_y)]))
         call new_film(self%film, mesh, plate%mode_values(mesh%px, mesh%py), plate%mode_values(mesh%x, mesh%y), &
            & plate%mode_values(ex, ey), elongation)
         call new_film(self%static_film, mesh, plate%static_values(mesh%px, mesh%py), &
            & plate%static_values(mesh%x, mesh%y), plate%static_values(ex, ey), elongation)
         hole = hole_points(form, points)
         self%hole = 2.0_wp*matmul(hole%weight, plate%mode_values(hole%x, hole%y))
         self%static_hole = 2.0_wp*dot_product(hole%weight, reshape(plate%static_values(hole%x, hole%y), [size(hole%x)]))
         self%hole_area = pi*form%hole_radius**2
         self%land_weight = 2.0_wp*land_weights(mesh, form, 2.0_wp*form%length)
         self%root_weight = 2.0_wp*land_weights(mesh, form, form%root)
      end associate
      call sort_by_chord(self)
   end subroutine new_film_reed

   !> The products of the shapes over the whole reed, apart by the reed's local width.
   subroutine sort_by_chord(self)
      type(film_reed), intent(inout) :: self
      type(point_set) :: reed
      real(wp), allocatable :: phi(:, :)
      integer :: k, j, n

      reed = reed_points(self%plate%form, points)
      n = self%plate%modes + 1
      allocate(phi(size(reed%x), n))
      phi(:, :n - 1) = self%plate%mode_values(reed%x, reed%y)
      phi(:, n:) = self%plate%static_values(reed%x, reed%y)
      self%chord = [real(wp) ::]
      do k = 1, size(reed%chord)
         if (all(abs(self%chord - reed%chord(k)) > 0.0_wp)) self%chord = [self%chord, reed%chord(k)]
      end do
      allocate(self%gram(n, n, size(self%chord)), source=0.0_wp)
      do k = 1, size(reed%chord)
         associate (gram => self%gram(:, :, minloc(abs(self%chord - reed%chord(k)), 1)))
            do j = 1, n
               gram(:, j) = gram(:, j) + 2.0_wp*reed%weight(k)*phi(k, :)*phi(k, j)
            end do
         end associate
      end do
   end subroutine sort_by_chord

   !> Added mass [kg] and damping [N s m-1] at angular frequency omega, for modes and static shape (last):
   !> int (pi/4) rho_f b [Gamma_r | omega Gamma_i] phi_i phi_j dA over the whole reed, b the local chord and
   !> Re = rho_f omega b^2/(4 mu) with it. Sader (1998), doi:10.1063/1.368002, strip by strip.
   subroutine fluid_matrices(self, choice, fluid, omega, mass, damping)
      type(film_reed), intent(in) :: self
      integer, intent(in) :: choice                       !! load_maali, load_sader or load_none
      type(fluid_type), intent(in) :: fluid
      real(wp), intent(in) :: omega                       !! [rad s-1], > 0
      real(wp), intent(out) :: mass(:, :), damping(:, :)  !! (modes + 1, modes + 1)
      complex(wp) :: gamma
      real(wp) :: reynolds, per_area
      integer :: k

      mass = 0.0_wp
      damping = 0.0_wp
      if (choice == load_none) return
      do k = 1, size(self%chord)
         reynolds = 0.25_wp*fluid%density*omega*self%chord(k)**2/fluid%viscosity
         if (choice == load_sader) then
            gamma = sader_function(reynolds)
         else
            gamma = maali_function(reynolds)
         end if
         per_area = 0.25_wp*pi*fluid%density*self%chord(k)
         mass = mass + per_area*real(gamma)*self%gram(:, :, k)
         damping = damping + per_area*omega*aimag(gamma)*self%gram(:, :, k)
      end do
   end subroutine fluid_matrices

end module rv_film_reed
