!> summary.csv: one row for each case, written block by block in constant memory (RFC 4180, UTF-8, line feeds).
module rv_results_csv
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type
   use rv_text, only : text_type, to_text
   use rv_posix, only : number_text
   use rv_file, only : file_type
   use rv_block, only : column_type, measure_columns, n_measures
   use rv_status, only : status_name
   use rv_manifest, only : input_type, kind_number, manifest_type
   use rv_parts, only : part_type
   implicit none
   private
   public :: csv_writer

   character(len=1), parameter :: newline = achar(10)
   integer, parameter :: input_digits = 15     !! as many as a deck can give and get back
   integer, parameter :: measure_digits = 12   !! beyond the finest tolerance a deck can ask for

   !> A summary being written. create, put for every part in the order of the blocks, close.
   type :: csv_writer
      private
      type(file_type) :: file
      type(input_type), allocatable :: input(:)
      real(wp) :: to_unit(n_measures) = 1.0_wp
   contains
      procedure :: create
      procedure :: put
      procedure :: close => close_file
   end type csv_writer

contains

   !> Make the file and its header.
   subroutine create(self, path, manifest, error)
      class(csv_writer), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(manifest_type), intent(in) :: manifest
      type(error_type), allocatable, intent(out) :: error
      type(column_type) :: measures(n_measures)
      character(len=:), allocatable :: line
      integer :: i

      self%input = manifest%input
      measures = measure_columns()
      self%to_unit = measures%to_unit
      line = "case"
      do i = 1, size(self%input)
         line = line//","//self%input(i)%name
      end do
      do i = 1, n_measures
         line = line//","//trim(measures(i)%name)
      end do
      call self%file%create(path, error)
      if (.not. allocated(error)) call self%file%put_text(line//",status,message"//newline, error)
   end subroutine create

   !> Write one block's cases.
   subroutine put(self, part, error)
      class(csv_writer), intent(inout) :: self
      type(part_type), intent(in) :: part
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: line
      integer :: j, i

      associate (result => part%result)
         do j = 1, size(result%status)
            line = to_text(result%first + j - 1)
            do i = 1, size(self%input)
               line = line//","//input_field(self%input(i), part%input(i, j))
            end do
            do i = 1, n_measures
               line = line//","//number_field(result%measure(i, j)*self%to_unit(i), measure_digits)
            end do
            line = line//","//status_name(result%status(j))//","//quoted(result%message(j)%s)//newline
            call self%file%put_text(line, error)
            if (allocated(error)) return
         end do
      end associate
   end subroutine put

   !> Bring the file to the disk and close it; without `error`, just close it.
   subroutine close_file(self, error)
      class(csv_writer), intent(inout) :: self
      type(error_type), allocatable, optional, intent(out) :: error

      if (.not. present(error)) then
         call self%file%close()
         return
      end if
      call self%file%sync(error)
      if (.not. allocated(error)) call self%file%close(error)
   end subroutine close_file

   function input_field(input, value) result(field)
      type(input_type), intent(in) :: input
      real(wp), intent(in) :: value
      character(len=:), allocatable :: field

      if (input%kind == kind_number) then
         field = number_field(value, input_digits)
      else
         field = quoted(input%word(nint(value))%s)
      end if
   end function input_field

   !> Empty for what did not happen.
   function number_field(value, digits) result(field)
      real(wp), intent(in) :: value
      integer, intent(in) :: digits
      character(len=:), allocatable :: field

      field = ""
      if (.not. ieee_is_nan(value)) field = number_text(value, digits)
   end function number_field

   !> `text` as a CSV field, in quotes where it needs them.
   pure function quoted(text) result(field)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: field
      integer :: i

      field = text
      if (scan(text, ',"'//newline//achar(13)) == 0) return
      field = '"'
      do i = 1, len(text)
         field = field//text(i:i)
         if (text(i:i) == '"') field = field//'"'
      end do
      field = field//'"'
   end function quoted

end module rv_results_csv
