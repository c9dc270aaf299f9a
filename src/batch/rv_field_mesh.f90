!> The mesh on which film pressure fields are stored: nodes of the half land, in the order of the fields.
!>
!> The film's nodes lie on rays about the hole's centre, the same number on each: the cells between neighbours
!> make a mesh of quadrilaterals that any viewer can draw.
module rv_field_mesh
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_cases, only : deck_type
   use rv_film_mesh, only : film_mesh, new_film_mesh
   use rv_keys, only : n_keys, key_film_mesh, key_reed_a_mm, key_reed_b_mm, key_reed_hole_diameter_mm, key_reed_width_mm
   use rv_planform, only : planform_type, new_planform
   use rv_film_case, only : elements_around, elements_across
   implicit none
   private
   public :: field_mesh, deck_field_mesh

   !> Lengths in mm, times in ms, as results give them. Without fields there are no times and no nodes.
   type :: field_mesh
      real(wp), allocatable :: time(:)        !! of the fields [ms]
      real(wp), allocatable :: x(:), y(:)     !! nodes: from the clamp along the reed, across it [mm]
      integer :: rings = 0                    !! nodes along a ray
   contains
      procedure :: faces
   end type field_mesh

   real(wp), parameter :: milli = 1.0e3_wp   !! SI to mm and ms

contains

   !> The mesh of a deck's fields.
   subroutine deck_field_mesh(deck, self)
      type(deck_type), intent(in) :: deck
      type(field_mesh), intent(out) :: self
      type(planform_type) :: form
      type(film_mesh) :: mesh
      type(error_type), allocatable :: error
      real(wp) :: value(n_keys)
      integer :: refinement

      self%time = milli*deck%field_times()
      allocate(self%x(0), self%y(0))
      if (size(self%time) == 0) return
      call deck%case_values(1_i8, value)
      call new_planform(form, value(key_reed_a_mm), value(key_reed_hole_diameter_mm), value(key_reed_b_mm), &
         & value(key_reed_width_mm), error)
      if (allocated(error)) return   ! no film model runs then either
      refinement = nint(value(key_film_mesh))
      call new_film_mesh(mesh, form, around=refinement*elements_around, across=refinement*elements_across)
      self%x = milli*mesh%x
      self%y = milli*mesh%y
      self%rings = mesh%rings
   end subroutine deck_field_mesh

   !> The four nodes of each cell, counted from 1, (4, cells).
   pure function faces(self) result(node)
      class(field_mesh), intent(in) :: self
      integer, allocatable :: node(:, :)
      integer :: rays, ray, ring, n

      rays = 0
      if (self%rings > 0) rays = size(self%x)/self%rings
      allocate(node(4, max(0, rays - 1)*max(0, self%rings - 1)))
      n = 0
      do ray = 1, rays - 1
         do ring = 1, self%rings - 1
            n = n + 1
            node(:, n) = (ray - 1)*self%rings + ring + [0, 1, self%rings + 1, self%rings]
         end do
      end do
   end function faces

end module rv_field_mesh
