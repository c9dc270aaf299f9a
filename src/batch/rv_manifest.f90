!> What a results folder is made from and how its results are described: all that a merge needs besides the parts.
!>
!> It is written once, before the first part, and is the identity of a run: parts belong together if and only if
!> they were made under the same manifest, to the byte.
module rv_manifest
   use, intrinsic :: iso_fortran_env, only : int32
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_bad_input, rv_io
   use rv_text, only : text_type, to_text
   use rv_checksum, only : crc32_text
   use rv_field_mesh, only : field_mesh
   use rv_row_text, only : row_text
   use rv_records, only : add_record, next_record, record_count, record_value
   implicit none
   private
   public :: manifest_type, input_type, kind_number, kind_choice, kind_text

   integer, parameter :: kind_number = 1   !! a value in the deck's unit
   integer, parameter :: kind_choice = 2   !! the index of one of some words without blanks
   integer, parameter :: kind_text = 3     !! the index of one of some texts, such as file names

   character(len=*), parameter :: first_record = "reedvalve_manifest"
   character(len=*), parameter :: format_version = "2"

   !> One column that tells the cases apart: the model, or a swept key.
   type :: input_type
      character(len=:), allocatable :: name, unit, long_name
      integer :: kind = kind_number
      type(text_type), allocatable :: word(:)   !! what an index stands for; empty for numbers
   end type input_type

   type :: manifest_type
      character(len=:), allocatable :: code_version
      character(len=:), allocatable :: deck_name  !! without folder and ending
      character(len=:), allocatable :: deck       !! the deck's bytes
      character(len=:), allocatable :: title
      character(len=:), allocatable :: effective  !! every effective value, and checksums of the files the deck names
      integer(i8) :: cases = 0
      integer :: blocks = 0
      type(input_type), allocatable :: input(:)   !! the model first
      real(wp), allocatable :: time(:)            !! of the traces [ms]; empty without traces
      integer :: traces = 0                       !! values in a trace sample
      integer :: compress = 0                     !! of results.nc, 0 to 9
      logical :: has_csv = .true.                 !! there is to be a summary.csv
      type(field_mesh) :: fields                  !! of the film's pressure, if they are stored
   contains
      procedure :: to_text => manifest_to_text
      procedure :: from_text => manifest_from_text
      procedure :: identity
      procedure :: difference
   end type manifest_type

contains

   pure function manifest_to_text(self) result(text)
      class(manifest_type), intent(in) :: self
      character(len=:), allocatable :: text
      integer :: i

      text = ""
      call add_record(text, first_record, format_version)
      call add_record(text, "code_version", self%code_version)
      call add_record(text, "deck_name", self%deck_name)
      call add_record(text, "deck", self%deck)
      call add_record(text, "title", self%title)
      call add_record(text, "effective_values", self%effective)
      call add_record(text, "cases", to_text(self%cases))
      call add_record(text, "blocks", to_text(self%blocks))
      call add_record(text, "time_ms", reals_to_text(self%time))
      call add_record(text, "traces", to_text(self%traces))
      call add_record(text, "compress", to_text(self%compress))
      call add_record(text, "csv", trim(merge("yes", "no ", self%has_csv)))
      call add_record(text, "field_time_ms", reals_to_text(self%fields%time))
      call add_record(text, "node_x_mm", reals_to_text(self%fields%x))
      call add_record(text, "node_y_mm", reals_to_text(self%fields%y))
      call add_record(text, "rings", to_text(self%fields%rings))
      do i = 1, size(self%input)
         call add_record(text, "input", input_to_text(self%input(i)))
      end do
   end function manifest_to_text

   !> Read what to_text wrote. The checksum of the file is not its business: a manifest is written whole or not at all.
   !>
   !> Codes of `error`: rv_bad_input for the manifest of another version, rv_io for what is no whole manifest.
   subroutine manifest_from_text(self, text, error)
      class(manifest_type), intent(out) :: self
      character(len=*), intent(in) :: text
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: name, value
      integer :: at, status, i

      at = 1
      call next_record(text, at, name, value)
      if (len(text) == 0) then
         call fail(error, rv_io, "it is empty")
      else if (name /= first_record) then
         call fail(error, rv_io, "it is damaged")
      else if (value /= format_version) then
         call fail(error, rv_bad_input, "it was written by another version of reedvalve")
      end if
      if (allocated(error)) return
      self%code_version = record_value(text, "code_version")
      self%deck_name = record_value(text, "deck_name")
      self%deck = record_value(text, "deck")
      self%title = record_value(text, "title")
      self%effective = record_value(text, "effective_values")
      call reals_from_text(record_value(text, "time_ms"), self%time, status)
      if (status == 0) call reals_from_text(record_value(text, "field_time_ms"), self%fields%time, status)
      if (status == 0) call reals_from_text(record_value(text, "node_x_mm"), self%fields%x, status)
      if (status == 0) call reals_from_text(record_value(text, "node_y_mm"), self%fields%y, status)
      value = record_value(text, "rings")
      if (status == 0) read(value, *, iostat=status) self%fields%rings
      value = record_value(text, "traces")
      if (status == 0) read(value, *, iostat=status) self%traces
      value = record_value(text, "compress")
      if (status == 0) read(value, *, iostat=status) self%compress
      self%has_csv = record_value(text, "csv") == "yes"
      value = record_value(text, "cases")
      if (status == 0) read(value, *, iostat=status) self%cases
      value = record_value(text, "blocks")
      if (status == 0) read(value, *, iostat=status) self%blocks
      allocate(self%input(record_count(text, "input")))
      i = 0
      do while (name /= "")
         call next_record(text, at, name, value)
         if (name /= "input") cycle
         i = i + 1
         call input_from_text(value, self%input(i))
      end do
      if (status /= 0 .or. at <= len(text)) call fail(error, rv_io, "it is damaged")
   end subroutine manifest_from_text

   !> Checksum of the whole manifest: every part carries it.
   function identity(self) result(crc)
      class(manifest_type), intent(in) :: self
      integer(int32) :: crc

      crc = crc32_text(self%to_text())
   end function identity

   !> In what `other`, found in a results folder, differs from this one, as a person would put it; empty if in nothing.
   pure function difference(self, other) result(text)
      class(manifest_type), intent(in) :: self
      class(manifest_type), intent(in) :: other
      character(len=:), allocatable :: text

      text = ""
      if (other%deck_name /= self%deck_name) then
         text = "it was made by another deck, '"//other%deck_name//"'"
      else if (other%deck /= self%deck) then
         text = "the deck was edited since"
      else if (other%code_version /= self%code_version) then
         text = "it was made by reedvalve "//other%code_version//" and this is "//self%code_version
      else if (other%effective /= self%effective) then
         text = "a file that the deck names was changed since"
      end if
   end function difference

   pure function input_to_text(input) result(text)
      type(input_type), intent(in) :: input
      character(len=:), allocatable :: text
      integer :: i

      text = ""
      call add_record(text, "name", input%name)
      call add_record(text, "unit", input%unit)
      call add_record(text, "long_name", input%long_name)
      call add_record(text, "kind", to_text(input%kind))
      do i = 1, size(input%word)
         call add_record(text, "word", input%word(i)%s)
      end do
   end function input_to_text

   pure subroutine input_from_text(text, input)
      character(len=*), intent(in) :: text
      type(input_type), intent(out) :: input
      character(len=:), allocatable :: name, value
      integer :: at, status, i

      input%name = record_value(text, "name")
      input%unit = record_value(text, "unit")
      input%long_name = record_value(text, "long_name")
      value = record_value(text, "kind")
      read(value, *, iostat=status) input%kind
      if (status /= 0) input%kind = kind_number
      allocate(input%word(record_count(text, "word")))
      at = 1
      i = 0
      do while (i < size(input%word))
         call next_record(text, at, name, value)
         if (name /= "word") cycle
         i = i + 1
         input%word(i)%s = value
      end do
   end subroutine input_from_text

   !> Exact: 17 digits of a double read back the same.
   pure function reals_to_text(time) result(text)
      real(wp), intent(in) :: time(:)
      character(len=:), allocatable :: text
      type(row_text) :: row
      integer :: i

      call row%add_whole(size(time, kind=i8))
      call row%add(" ")
      do i = 1, size(time)
         call row%add_number(time(i), 17)
         call row%add(" ")
      end do
      text = row%bytes(:row%used)
   end function reals_to_text

   pure subroutine reals_from_text(text, time, status)
      character(len=*), intent(in) :: text
      real(wp), allocatable, intent(out) :: time(:)
      integer, intent(out) :: status
      integer :: n

      read(text, *, iostat=status) n
      if (status /= 0) n = 0
      allocate(time(n))
      if (status /= 0) return
      read(text, *, iostat=status) n, time
      if (status /= 0) time = 0.0_wp
   end subroutine reals_from_text

end module rv_manifest
