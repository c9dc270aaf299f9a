!> The reed as a Kirchhoff plate: vibration modes and the static shape under a pressed hole, by Ritz's method.
!>
!> w(x, y) = sum c_ij (x/L)^2 P_i(2x/L - 1) P_2j(y/R): clamped at x = 0, symmetric in y, free elsewhere
!> (natural conditions). Energies per half reed:
!> U = (D_p/2) int (w_xx + w_yy)^2 - 2 (1 - nu)(w_xx w_yy - w_xy^2) dA,  T = (rho h/2) int w_t^2 dA,
!> D_p = E h^3/(12 (1 - nu^2)). Timoshenko & Woinowsky-Krieger, Theory of Plates and Shells, ch. 10.
!> Everything here is for D_p = 1 and rho h = 1: shapes do not depend on them, stiffness is proportional to D_p,
!> mass to rho h. The generalised eigenproblem goes to LAPACK's dsygv; eigenvalues converge from above.
module rv_plate
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type, fail, rv_bad_input, rv_not_converged
   use rv_planform, only : planform_type, point_set, reed_points, hole_points
   use rv_text, only : to_text
   implicit none
   private
   public :: plate_type, new_plate

   integer, parameter :: along = 8   !! terms in x
   integer, parameter :: across = 4  !! terms in y
   integer, parameter :: spare = 8   !! quadrature points a direction beyond the terms in x

   !> Modes and static shape of one planform; all shapes are 1 at the tip.
   type :: plate_type
      type(planform_type) :: form
      integer :: modes = 0
      real(wp), allocatable :: mass(:)       !! int phi^2 dA over the whole reed: modal mass over rho h [m2], (modes)
      real(wp), allocatable :: stiffness(:)  !! modal stiffness over D_p [m-2], (modes)
      real(wp) :: static_mass = 0.0_wp       !! the same for the static shape [m2]
      real(wp) :: static_stiffness = 0.0_wp  !! its generalised stiffness over D_p [m-2]
      real(wp) :: hole_stiffness = 0.0_wp    !! pressed hole: pressure times its area over the tip displacement, over D_p [m-2]
      integer, private :: nx = along, ny = across
      real(wp), allocatable, private :: coefficient(:, :)  !! (terms, modes)
      real(wp), allocatable, private :: static_shape(:)    !! (terms): 1 at the tip
   contains
      procedure :: mode_values
      procedure :: static_values
   end type plate_type

   interface
      subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
         import :: wp
         integer, intent(in) :: itype, n, lda, ldb, lwork
         character, intent(in) :: jobz, uplo
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         real(wp), intent(out) :: w(*), work(*)
         integer, intent(out) :: info
      end subroutine dsygv

      subroutine dposv(uplo, n, nrhs, a, lda, b, ldb, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: info
      end subroutine dposv
   end interface

contains

   !> Solve for the lowest symmetric modes and the static shape. On failure `self` has no modes.
   subroutine new_plate(self, form, poisson_ratio, modes, error, terms_along, terms_across)
      type(plate_type), intent(out) :: self
      type(planform_type), intent(in) :: form
      real(wp), intent(in) :: poisson_ratio   !! nu [-], -1 < nu < 0.5
      integer, intent(in) :: modes            !! number of modes, 1 to the number of terms
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in), optional :: terms_along, terms_across   !! Ritz terms, 8 x 4 unless given
      real(wp), allocatable :: stiffness(:, :), mass(:, :), load(:, :)
      integer :: terms, info

      if (present(terms_along)) self%nx = terms_along
      if (present(terms_across)) self%ny = terms_across
      terms = self%nx*self%ny
      if (.not. (poisson_ratio > -1.0_wp .and. poisson_ratio < 0.5_wp)) then
         call fail(error, rv_bad_input, "the plate needs -1 < Poisson's ratio < 0.5, not "//to_text(poisson_ratio))
         return
      end if
      if (modes < 1 .or. modes > terms) then
         call fail(error, rv_bad_input, "the plate has 1 to "//to_text(terms)//" modes, not "//to_text(modes))
         return
      end if
      self%form = form
      call assemble(self, poisson_ratio, stiffness, mass, load)
      call solve_static(self, stiffness, mass, load, info)
      if (info == 0) call solve_modes(self, stiffness, mass, modes, info)
      if (info /= 0) call fail(error, rv_not_converged, "plate modes: LAPACK returned info = "//to_text(info))
   end subroutine new_plate

   !> Matrices of the whole reed (twice the half) and the load of unit pressure on the hole.
   subroutine assemble(self, nu, stiffness, mass, load)
      type(plate_type), intent(in) :: self
      real(wp), intent(in) :: nu
      real(wp), allocatable, intent(out) :: stiffness(:, :), mass(:, :), load(:, :)
      type(point_set) :: points
      real(wp), allocatable, dimension(:) :: w, wxx, wyy, wxy
      real(wp) :: weight
      integer :: terms, k, j

      terms = self%nx*self%ny
      allocate(stiffness(terms, terms), mass(terms, terms), load(terms, 1), source=0.0_wp)
      allocate(w(terms), wxx(terms), wyy(terms), wxy(terms))
      points = reed_points(self%form, max(self%nx, 2*self%ny) + spare)
      do k = 1, size(points%x)
         call basis(self, points%x(k), points%y(k), w, wxx, wyy, wxy)
         weight = 2.0_wp*points%weight(k)
         do j = 1, terms
            stiffness(:, j) = stiffness(:, j) + weight*(wxx*wxx(j) + wyy*wyy(j) &
               & + nu*(wxx*wyy(j) + wyy*wxx(j)) + 2.0_wp*(1.0_wp - nu)*wxy*wxy(j))
            mass(:, j) = mass(:, j) + weight*w*w(j)
         end do
      end do
      points = hole_points(self%form, self%nx + spare)
      do k = 1, size(points%x)
         call basis(self, points%x(k), points%y(k), w, wxx, wyy, wxy)
         load(:, 1) = load(:, 1) + 2.0_wp*points%weight(k)*w
      end do
   end subroutine assemble

   subroutine solve_static(self, stiffness, mass, load, info)
      type(plate_type), intent(inout) :: self
      real(wp), intent(in) :: stiffness(:, :), mass(:, :), load(:, :)
      integer, intent(out) :: info
      real(wp) :: factor(size(load, 1), size(load, 1)), shape(size(load, 1), 1), tip(1, 1)
      integer :: n

      n = size(load, 1)
      factor = stiffness
      shape = load
      call dposv("L", n, 1, factor, n, shape, n, info)
      if (info /= 0) return
      tip = values(self, [self%form%length], [0.0_wp], shape)
      self%static_shape = shape(:, 1)/tip(1, 1)
      self%static_mass = dot_product(self%static_shape, matmul(mass, self%static_shape))
      self%static_stiffness = dot_product(self%static_shape, load(:, 1))/tip(1, 1)
      self%hole_stiffness = pi*self%form%hole_radius**2/tip(1, 1)
   end subroutine solve_static

   subroutine solve_modes(self, stiffness, mass, modes, info)
      type(plate_type), intent(inout) :: self
      real(wp), intent(inout) :: stiffness(:, :), mass(:, :)   !! overwritten
      integer, intent(in) :: modes
      integer, intent(out) :: info
      real(wp) :: eigenvalue(size(mass, 1)), work(64*size(mass, 1)), tip(1, modes)
      integer :: n, j

      n = size(mass, 1)
      call dsygv(1, "V", "L", n, stiffness, n, mass, n, eigenvalue, work, size(work), info)
      if (info /= 0) return
      self%modes = modes
      tip = values(self, [self%form%length], [0.0_wp], stiffness(:, :modes))
      self%mass = 1.0_wp/tip(1, :)**2
      self%stiffness = eigenvalue(:modes)*self%mass
      allocate(self%coefficient(n, modes))
      do j = 1, modes
         self%coefficient(:, j) = stiffness(:, j)/tip(1, j)
      end do
   end subroutine solve_modes

   !> Modes at points, (points, modes) [-]: 1 at the tip.
   function mode_values(self, x, y) result(phi)
      class(plate_type), intent(in) :: self
      real(wp), intent(in) :: x(:), y(:)   !! [m]
      real(wp) :: phi(size(x), self%modes)

      phi = values(self, x, y, self%coefficient)
   end function mode_values

   !> Static shape under a pressed hole at points, (points, 1) [-]: 1 at the tip.
   function static_values(self, x, y) result(phi)
      class(plate_type), intent(in) :: self
      real(wp), intent(in) :: x(:), y(:)   !! [m]
      real(wp) :: phi(size(x), 1)

      phi = values(self, x, y, reshape(self%static_shape, [size(self%static_shape), 1]))
   end function static_values

   function values(self, x, y, coefficient) result(phi)
      class(plate_type), intent(in) :: self
      real(wp), intent(in) :: x(:), y(:), coefficient(:, :)
      real(wp) :: phi(size(x), size(coefficient, 2))
      real(wp), dimension(self%nx*self%ny) :: w, wxx, wyy, wxy
      integer :: k

      do k = 1, size(x)
         call basis(self, x(k), y(k), w, wxx, wyy, wxy)
         phi(k, :) = matmul(w, coefficient)
      end do
   end function values

   !> All terms and their second derivatives at one point.
   pure subroutine basis(self, x, y, w, wxx, wyy, wxy)
      type(plate_type), intent(in) :: self
      real(wp), intent(in) :: x, y
      real(wp), intent(out) :: w(:)                    !! [-]
      real(wp), intent(out) :: wxx(:), wyy(:), wxy(:)  !! [m-2]
      real(wp), dimension(0:self%nx - 1, 0:2) :: px, f
      real(wp), dimension(0:2*self%ny - 2, 0:2) :: py
      real(wp) :: xi, l, r
      integer :: i, j, k

      l = self%form%length
      r = self%form%radius
      xi = x/l
      px = legendre(2.0_wp*xi - 1.0_wp, self%nx - 1)
      px(:, 1) = 2.0_wp*px(:, 1)
      px(:, 2) = 4.0_wp*px(:, 2)
      f(:, 0) = xi**2*px(:, 0)
      f(:, 1) = (2.0_wp*xi*px(:, 0) + xi**2*px(:, 1))/l
      f(:, 2) = (2.0_wp*px(:, 0) + 4.0_wp*xi*px(:, 1) + xi**2*px(:, 2))/l**2
      py = legendre(y/r, 2*self%ny - 2)
      k = 0
      do j = 0, self%ny - 1
         do i = 0, self%nx - 1
            k = k + 1
            w(k) = f(i, 0)*py(2*j, 0)
            wxx(k) = f(i, 2)*py(2*j, 0)
            wxy(k) = f(i, 1)*py(2*j, 1)/r
            wyy(k) = f(i, 0)*py(2*j, 2)/r**2
         end do
      end do
   end subroutine basis

   !> Legendre polynomials 0 to n with first and second derivatives at z.
   pure function legendre(z, n) result(p)
      real(wp), intent(in) :: z
      integer, intent(in) :: n
      real(wp) :: p(0:n, 0:2)
      real(wp) :: a, b
      integer :: k

      p(0, :) = [1.0_wp, 0.0_wp, 0.0_wp]
      if (n > 0) p(1, :) = [z, 1.0_wp, 0.0_wp]
      do k = 2, n
         a = real(2*k - 1, wp)/real(k, wp)
         b = real(k - 1, wp)/real(k, wp)
         p(k, 0) = a*z*p(k - 1, 0) - b*p(k - 2, 0)
         p(k, 1) = a*(p(k - 1, 0) + z*p(k - 1, 1)) - b*p(k - 2, 1)
         p(k, 2) = a*(2.0_wp*p(k - 1, 1) + z*p(k - 1, 2)) - b*p(k - 2, 2)
      end do
   end function legendre

end module rv_plate
