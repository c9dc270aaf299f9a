!> The columns of a result: the end of a name is the unit, and the factor leads there from SI.
program test_columns
   use rv_kinds, only : wp
   use rv_columns, only : column_type, measure_columns, fact_columns, trace_columns
   use check, only : suite_type
   implicit none
   type(suite_type) :: suite
   integer, parameter :: n = 10
   character(len=7), parameter :: ending(n) = [character(len=7) :: "_mm3_ms", "_mm_ms", "_n_s_m", "_n_m", "_mm", "_ms", "_kpa", &
      & "_kg", "_hz", "_n"]
   character(len=8), parameter :: unit(n) = [character(len=8) :: "mm3 ms-1", "mm ms-1", "N s m-1", "N m-1", "mm", "ms", "kPa", &
      & "kg", "Hz", "N"]
   real(wp), parameter :: factor(n) = [1.0e6_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0e3_wp, 1.0e3_wp, 1.0e-3_wp, 1.0_wp, 1.0_wp, 1.0_wp]

   call all_columns()
   call suite%finish()

contains

   subroutine all_columns()
      type(column_type), allocatable :: column(:), facts(:), traces(:)
      integer :: i

      column = measure_columns()
      facts = fact_columns()
      traces = trace_columns()
      column = [column, facts, traces]
      do i = 1, size(column)
         call unit_of(column(i))
         call suite%true("its name is its own", count(column%name == column(i)%name) == 1)
         call suite%true("it is explained", len_trim(column(i)%long_name) > 10 &
            & .and. len_trim(column(i)%long_name) < len(column(i)%long_name))
      end do
   end subroutine all_columns

   !> A name without a known ending is a number without unit.
   subroutine unit_of(one)
      type(column_type), intent(in) :: one
      integer :: k

      do k = 1, n
         if (index(one%name, trim(ending(k))//" ") > 0) exit
      end do
      if (k <= n) then
         call suite%text(trim(one%name)//": unit", one%unit, unit(k))
         call suite%close(trim(one%name)//": factor", one%to_unit, factor(k), 1.0e-15_wp, 0.0_wp)
      else
         call suite%text(trim(one%name)//": unit", one%unit, "1")
         call suite%close(trim(one%name)//": factor", one%to_unit, 1.0_wp, 0.0_wp, 0.0_wp)
      end if
   end subroutine unit_of

end program test_columns
