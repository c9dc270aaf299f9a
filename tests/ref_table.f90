!> Reference tables: text files of numbers in columns; lines that start with '#' are comments.
module ref_table
   use, intrinsic :: iso_fortran_env, only : error_unit
   use rv_kinds, only : wp
   use rv_text, only : to_text
   implicit none
   private
   public :: read_table

contains

   !> All rows of a file. A file or a row that cannot be read ends the program: the suite has nothing to compare with.
   subroutine read_table(path, columns, table)
      character(len=*), intent(in) :: path
      integer, intent(in) :: columns
      real(wp), allocatable, intent(out) :: table(:, :)   !! (columns, rows)
      character(len=512) :: line
      real(wp), allocatable :: row(:), grown(:, :)
      integer :: unit, stat, n

      open(newunit=unit, file=path, status="old", action="read", iostat=stat)
      if (stat /= 0) call give_up("cannot open "//path)
      allocate(row(columns), table(columns, 0))
      do
         read(unit, '(a)', iostat=stat) line
         if (stat /= 0) exit
         if (line == "" .or. line(1:1) == "#") cycle
         read(line, *, iostat=stat) row
         n = size(table, 2)
         if (stat /= 0) call give_up(path//": no row of numbers after row "//to_text(n))
         allocate(grown(columns, n + 1))
         grown(:, :n) = table
         grown(:, n + 1) = row
         call move_alloc(grown, table)
      end do
      close(unit)
   end subroutine read_table

   subroutine give_up(message)
      character(len=*), intent(in) :: message

      write(error_unit, '(a)') message
      error stop 1
   end subroutine give_up

end module ref_table
