!> summary.csv: one row for each case, written block by block in constant memory (RFC 4180, UTF-8, line feeds).
!>
!> Making the text of a block's rows is the work: several threads may do that at a time, each for its own block.
module rv_results_csv
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_text, only : text_type
   use rv_row_text, only : field_type, row_text
   use rv_file, only : file_type
   use rv_block, only : column_type, measure_columns, n_measures
   use rv_status, only : n_statuses, status_name
   use rv_manifest, only : input_type, kind_number, manifest_type
   use rv_parts, only : part_type
   implicit none
   private
   public :: csv_writer

   character(len=1), parameter :: newline = achar(10)
   integer, parameter :: input_digits = 15     !! as many as a deck can give and get back
   integer, parameter :: measure_digits = 12   !! beyond the finest tolerance a deck can ask for

   !> The fields that the values of one column stand for; of numbers there are none.
   type :: field_list
      type(text_type), allocatable :: field(:)
   end type field_list

   !> A summary being written. create, put_rows for the rows of every part in the order of the blocks, close.
   type :: csv_writer
      private
      type(file_type) :: file
      type(field_list), allocatable :: input(:)
      type(field_list) :: status
      real(wp) :: to_unit(n_measures) = 1.0_wp
   contains
      procedure :: create
      procedure :: get_rows
      procedure :: put_rows
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

      call list_fields(self, manifest%input)
      measures = measure_columns()
      self%to_unit = measures%to_unit
      line = "case"
      do i = 1, size(manifest%input)
         line = line//","//manifest%input(i)%name
      end do
      do i = 1, n_measures
         line = line//","//trim(measures(i)%name)
      end do
      call self%file%create(path, error)
      if (.not. allocated(error)) call self%file%put_text(line//",status,message"//newline, error)
   end subroutine create

   !> The rows of one block's cases.
   pure subroutine get_rows(self, part, rows)
      class(csv_writer), intent(in) :: self
      type(part_type), intent(in) :: part
      type(row_text), intent(inout) :: rows
      type(field_type) :: input(size(self%input)), measure(n_measures)
      integer :: j, i

      call rows%clear()
      associate (result => part%result)
         do j = 1, size(result%status)
            call rows%add_whole(result%first + j - 1)
            do i = 1, size(self%input)
               if (size(self%input(i)%field) == 0) then
                  call rows%add_fields(part%input(i:i, j), input_digits, input(i:i))
               else
                  call rows%add(self%input(i)%field(nint(part%input(i, j)))%s)
               end if
            end do
            call rows%add_fields(result%measure(:, j)*self%to_unit, measure_digits, measure)
            call rows%add(self%status%field(result%status(j) + 1)%s)
            call rows%add(",")
            if (len(result%message(j)%s) > 0) call rows%add(quoted(result%message(j)%s))
            call rows%add(newline)
         end do
      end associate
   end subroutine get_rows

   !> Write rows.
   subroutine put_rows(self, rows, error)
      class(csv_writer), intent(inout) :: self
      type(row_text), intent(in) :: rows
      type(error_type), allocatable, intent(out) :: error

      if (rows%used > 0) call self%file%put_text(rows%bytes(:rows%used), error)
   end subroutine put_rows

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

   !> What words and statuses look like in a row, with the comma before them.
   subroutine list_fields(self, input)
      class(csv_writer), intent(inout) :: self
      type(input_type), intent(in) :: input(:)
      integer :: i, j

      if (allocated(self%input)) deallocate(self%input)
      allocate(self%input(size(input)))
      do i = 1, size(input)
         allocate(self%input(i)%field(merge(0, size(input(i)%word), input(i)%kind == kind_number)))
         do j = 1, size(self%input(i)%field)
            self%input(i)%field(j)%s = ","//quoted(input(i)%word(j)%s)
         end do
      end do
      if (allocated(self%status%field)) deallocate(self%status%field)
      allocate(self%status%field(n_statuses))
      do i = 1, n_statuses
         self%status%field(i)%s = ","//status_name(i - 1)
      end do
   end subroutine list_fields

   !> `text` as a CSV field, in quotes where it needs them.
   pure function quoted(text) result(field)
      character(len=*), intent(in) :: text
      character(len=quoted_length(text)) :: field
      integer :: i, n

      field = text
      if (len(field) == len(text)) return
      n = 1
      do i = 1, len(text)
         field(n + 1:n + 1) = text(i:i)
         n = n + merge(2, 1, text(i:i) == '"')
         if (text(i:i) == '"') field(n:n) = '"'
      end do
      field(1:1) = '"'
      field(len(field):) = '"'
   end function quoted

   !> No field that needs no quotes is as long as with them.
   pure integer function quoted_length(text) result(length)
      character(len=*), intent(in) :: text
      integer :: i

      length = len(text)
      if (scan(text, ',"'//newline//achar(13)) > 0) length = length + 2 + count([(text(i:i) == '"', i=1, len(text))])
   end function quoted_length

end module rv_results_csv
