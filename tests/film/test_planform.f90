!> The planform: integrals over reed and hole against closed forms, and what it refuses.
program test_planform
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type
   use rv_planform, only : planform_type, new_planform, point_set, reed_points, hole_points
   use check, only : suite_type
   use paper_film, only : paper_form
   use paper_valve, only : mm
   implicit none
   type(suite_type) :: suite

   call lengths()
   call reed_integrals()
   call hole_integrals()
   call refusals()
   call suite%finish()

contains

   subroutine lengths()
      type(planform_type) :: form

      form = paper_form()
      call suite%close("length a + D/2 + B/2 [mm]", form%length/mm, 7.5_wp, 4.0_wp*epsilon(1.0_wp), 0.0_wp)
      call suite%close("centre a + D/2 [mm]", form%centre/mm, 4.5_wp, 4.0_wp*epsilon(1.0_wp), 0.0_wp)
   end subroutine lengths

   !> Half the area, its moments, and the chord, which is a square root at the tip.
   subroutine reed_integrals()
      type(planform_type) :: form
      type(point_set) :: p
      real(wp) :: c, r

      form = paper_form()
      c = form%centre
      r = form%radius
      p = reed_points(form, 12)
      call suite%close("half area", sum(p%weight), r*c + 0.25_wp*pi*r**2, 1.0e-13_wp, 0.0_wp)
      call suite%close("int x", sum(p%weight*p%x), 0.5_wp*r*c**2 + 0.25_wp*pi*r**2*c + r**3/3.0_wp, 1.0e-13_wp, 0.0_wp)
      call suite%close("int y", sum(p%weight*p%y), 0.5_wp*r**2*c + r**3/3.0_wp, 1.0e-13_wp, 0.0_wp)
      call suite%close("int (x - c)^2 y^2", sum(p%weight*(p%x - c)**2*p%y**2), &
         & (r*c)**3/9.0_wp + pi*r**6/96.0_wp, 1.0e-13_wp, 0.0_wp)
      call suite%close("int chord", sum(p%weight*p%chord), 2.0_wp*r**2*c + 4.0_wp*r**3/3.0_wp, 1.0e-13_wp, 0.0_wp)
      call suite%true("points inside the reed", all(p%x > 0.0_wp .and. p%x < form%length .and. p%y > 0.0_wp &
         & .and. p%y < 0.5_wp*p%chord))
   end subroutine reed_integrals

   subroutine hole_integrals()
      type(planform_type) :: form
      type(point_set) :: p
      real(wp) :: a

      form = paper_form()
      a = form%hole_radius
      p = hole_points(form, 8)
      call suite%close("half the hole's area", sum(p%weight), 0.5_wp*pi*a**2, 1.0e-13_wp, 0.0_wp)
      call suite%close("int x", sum(p%weight*p%x), 0.5_wp*pi*a**2*form%centre, 1.0e-13_wp, 0.0_wp)
      call suite%close("int (x - c)^2 y^2", sum(p%weight*(p%x - form%centre)**2*p%y**2), pi*a**6/48.0_wp, 1.0e-13_wp, 0.0_wp)
   end subroutine hole_integrals

   subroutine refusals()
      type(planform_type) :: form
      type(error_type), allocatable :: error

      call new_planform(form, 2.5_wp*mm, 4.0_wp*mm, 1.2_wp*mm, 6.0_wp*mm, error)
      call suite%fails("b = 1.2 mm", error, "b = (width - hole diameter)/2 = 1 mm, not 1.2 mm")
      call suite%close("and the planform is a default one", form%length, 0.0_wp, 0.0_wp, 0.0_wp)
      call new_planform(form, 2.5_wp*mm, 4.0_wp*mm, 1.0_wp*mm*(1.0_wp + 1.0e-9_wp), 6.0_wp*mm, error)
      call suite%no_error("b with a rounding error", error)
      call new_planform(form, 0.0_wp, 4.0_wp*mm, 1.0_wp*mm, 6.0_wp*mm, error)
      call suite%fails("a = 0", error, "a > 0")
      call new_planform(form, 2.5_wp*mm, 6.0_wp*mm, 0.0_wp, 6.0_wp*mm, error)
      call suite%fails("hole as wide as the reed", error, "hole diameter < width")
      call new_planform(form, 2.5_wp*mm, 4.0_wp*mm, ieee_value(1.0_wp, ieee_quiet_nan), 6.0_wp*mm, error)
      call suite%fails("b = NaN", error, "not NaN mm")
   end subroutine refusals

end program test_planform
