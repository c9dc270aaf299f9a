!> The reed's true planform: a rectangle from the clamp to the hole's centre, then a concentric semicircle.
!>
!> x runs from the clamp along the symmetry line, y across. All integrals are over the half y >= 0.
module rv_planform
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_gauss, only : gauss_legendre
   use rv_text, only : to_text
   implicit none
   private
   public :: planform_type, new_planform, point_set, reed_points, hole_points

   !> Lengths of the planform.
   type :: planform_type
      real(wp) :: root = 0.0_wp         !! a, clamp to the edge of the hole [m]
      real(wp) :: centre = 0.0_wp       !! x of the hole's centre, a + D/2 [m]
      real(wp) :: hole_radius = 0.0_wp  !! D/2 [m]
      real(wp) :: radius = 0.0_wp       !! B/2, of the tip's semicircle; half the width [m]
      real(wp) :: length = 0.0_wp       !! clamp to tip, a + D/2 + B/2 [m]
   end type planform_type

   !> Quadrature points of the half reed.
   type :: point_set
      real(wp), allocatable :: x(:), y(:)   !! [m]
      real(wp), allocatable :: weight(:)    !! [m2]
      real(wp), allocatable :: chord(:)     !! local width of the whole reed at x [m]
   end type point_set

contains

   !> Check the data and build a planform. On failure `self` is a default one.
   subroutine new_planform(self, root, hole_diameter, tip, width, error)
      type(planform_type), intent(out) :: self
      real(wp), intent(in) :: root            !! a [m], > 0
      real(wp), intent(in) :: hole_diameter   !! D [m], 0 < D < width
      real(wp), intent(in) :: tip             !! b [m]; must be (width - D)/2
      real(wp), intent(in) :: width           !! B [m]
      type(error_type), allocatable, intent(out) :: error

      if (.not. (root > 0.0_wp .and. hole_diameter > 0.0_wp .and. width > hole_diameter)) then
         call fail(error, rv_bad_input, "the film models need a > 0 and 0 < hole diameter < width")
         return
      end if
      if (.not. abs(tip - 0.5_wp*(width - hole_diameter)) <= 1.0e-6_wp*width) then
         call fail(error, rv_bad_input, "the film models need the tip concentric with the hole: b = (width - hole diameter)/2 = " &
            & //to_text(0.5e3_wp*(width - hole_diameter), 6)//" mm, not "//to_text(1.0e3_wp*tip, 6)//" mm")
         return
      end if
      self%root = root
      self%centre = root + 0.5_wp*hole_diameter
      self%hole_radius = 0.5_wp*hole_diameter
      self%radius = 0.5_wp*width
      self%length = self%centre + self%radius
   end subroutine new_planform

   !> Points over the whole half reed: n x n on the rectangle and n x n on the quarter disk.
   !>
   !> On the disk x - centre = R sin(alpha), y = R cos(alpha) s: smooth even for functions of the chord.
   pure function reed_points(form, n) result(points)
      type(planform_type), intent(in) :: form
      integer, intent(in) :: n
      type(point_set) :: points
      real(wp), dimension(n) :: x, wx, s, ws, alpha, wa
      real(wp) :: half
      integer :: i, j, k

      call gauss_legendre(0.0_wp, form%centre, x, wx)
      call gauss_legendre(0.0_wp, 1.0_wp, s, ws)
      call gauss_legendre(0.0_wp, 0.5_wp*pi, alpha, wa)
      allocate(points%x(2*n*n), points%y(2*n*n), points%weight(2*n*n), points%chord(2*n*n))
      k = 0
      do j = 1, n
         do i = 1, n
            k = k + 1
            points%x(k) = x(i)
            points%y(k) = form%radius*s(j)
            points%weight(k) = wx(i)*ws(j)*form%radius
            points%chord(k) = 2.0_wp*form%radius
         end do
      end do
      do j = 1, n
         do i = 1, n
            k = k + 1
            half = form%radius*cos(alpha(i))
            points%x(k) = form%centre + form%radius*sin(alpha(i))
            points%y(k) = half*s(j)
            points%weight(k) = wa(i)*ws(j)*half**2
            points%chord(k) = 2.0_wp*half
         end do
      end do
   end function reed_points

   !> Points over the half hole, n radial by 2n around.
   pure function hole_points(form, n) result(points)
      type(planform_type), intent(in) :: form
      integer, intent(in) :: n
      type(point_set) :: points
      real(wp) :: r(n), wr(n), theta(2*n), wt(2*n)
      integer :: i, j, k

      call gauss_legendre(0.0_wp, form%hole_radius, r, wr)
      call gauss_legendre(0.0_wp, pi, theta, wt)
      allocate(points%x(2*n*n), points%y(2*n*n), points%weight(2*n*n), points%chord(2*n*n))
      k = 0
      do j = 1, 2*n
         do i = 1, n
            k = k + 1
            points%x(k) = form%centre + r(i)*cos(theta(j))
            points%y(k) = r(i)*sin(theta(j))
            points%weight(k) = wr(i)*wt(j)*r(i)
            points%chord(k) = 2.0_wp*form%radius
         end do
      end do
   end function hole_points

end module rv_planform
