!> Cases from a table: a CSV file whose header names keys and whose rows are cases.
module rv_design
   use, intrinsic :: iso_fortran_env, only : int64
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_text, only : to_text
   use rv_faults, only : clip
   use rv_text_file, only : read_text_file, check_encoding
   use rv_checksum, only : crc32_text, hex_text
   use rv_csv, only : csv_reader, new_csv_reader
   use rv_deck_reader, only : word_type
   use rv_deck_draft, only : draft_type, name_trace
   use rv_deck_sweeps, only : find_swept_key
   use rv_keys, only : keys, full_name, real_key, key_run_model, key_pressure_file, key_design_file
   use rv_key_value, only : read_value, odd_value
   implicit none
   private
   public :: read_design

   integer(int64), parameter :: most_bytes = 268435456_int64
   integer, parameter :: most_faults = 20   !! in one file; then reading stops

contains

   !> Read the file of &design, if the deck has one, into the deck's design.
   subroutine read_design(draft)
      type(draft_type), intent(inout) :: draft
      integer :: g, e
      real(wp) :: unused
      logical :: is_good

      do g = 1, draft%scan%groups
         if (draft%group_name(g) == "design") exit
      end do
      if (g > draft%scan%groups) return
      if (any(draft%sweep_line > 0)) call draft%tell(draft%scan%group(g)%name, &
         & "&design and &sweep together: the design's rows are the cases; put the swept values into them")
      do e = draft%scan%group(g)%first_entry, draft%scan%group(g)%last_entry
         if (draft%key(e) /= key_design_file) cycle
         if (draft%value_count(e) > 1) call draft%tell(draft%value_word(e, 2), "design.file: one file is due")
         if (draft%value_count(e) /= 1) return
         call draft%take_value(e, 1, key_design_file, unused, is_good)
         if (is_good) call read_design_file(draft, draft%value_word(e, 1))
         return
      end do
      call draft%tell(draft%scan%group(g)%name, "&design: design.file must name a CSV file: file = 'plan.csv'")
   end subroutine read_design

   subroutine read_design_file(draft, name)
      type(draft_type), intent(inout) :: draft
      type(word_type), intent(in) :: name
      character(len=:), allocatable :: path, text
      type(error_type), allocatable :: error
      type(csv_reader) :: reader
      integer :: before

      draft%deck%design_name = draft%scan%reader%word_text(name)
      path = draft%deck%path_of(draft%deck%design_name)
      call read_text_file(path, most_bytes, text, error)
      if (allocated(error)) then
         call draft%tell(name, "design.file: "//error%message)
         return
      end if
      before = draft%faults%errors()
      call check_encoding(text, path, draft%faults)
      if (draft%faults%errors() > before) return
      reader = new_csv_reader(text)
      call read_header(draft, reader, path, name)
      if (draft%faults%errors() > before) return
      call read_rows(draft, reader, path)
      draft%deck%has_design = draft%faults%errors() == before
      draft%deck%design_note = to_text(size(draft%deck%design, 2))//" rows, CRC-32 "//hex_text(crc32_text(text))
   end subroutine read_design_file

   !> Find the keys the columns are of.
   subroutine read_header(draft, reader, path, name)
      type(draft_type), intent(inout) :: draft
      type(csv_reader), intent(inout) :: reader
      character(len=*), intent(in) :: path
      type(word_type), intent(in) :: name   !! of the file in the deck
      character(len=:), allocatable :: trouble
      integer :: i, key

      allocate(draft%deck%design_key(0))
      if (.not. reader%next_row()) then
         call draft%faults%add(path, 0, 0, "there are no data; a header that names keys is due: film.gap_mm,film.k_s")
         return
      end if
      do i = 1, reader%fields
         call find_swept_key(reader%word(i), key, trouble)
         if (trouble == "" .and. any(draft%deck%design_key == key)) trouble = "a second column of this key"
         if (trouble == "" .and. key == key_run_model .and. size(draft%deck%axis) > 0) then
            trouble = "the deck lists several models in &run; name them in one place only"
         end if
         draft%deck%design_key = [draft%deck%design_key, key]
         if (trouble == "") then
            call draft%mark(key, name)
            cycle
         end if
         call draft%faults%add(path, reader%line, reader%field(i)%column, "'"//clip(reader%word(i), 40)//"': "//trouble)
      end do
   end subroutine read_header

   !> Read all rows; stop after some faults, for a wrong file has one in each row.
   subroutine read_rows(draft, reader, path)
      type(draft_type), intent(inout) :: draft
      type(csv_reader), intent(inout) :: reader
      character(len=*), intent(in) :: path
      real(wp), allocatable :: value(:, :)
      integer :: rows, before

      before = draft%faults%errors()
      allocate(value(size(draft%deck%design_key), reader%line_count()))
      rows = 0
      do while (reader%next_row() .and. draft%faults%errors() - before < most_faults)
         if (reader%fields /= size(value, 1)) then
            call draft%faults%add(path, reader%line, 1, to_text(reader%fields)//" columns; the header has " &
               & //to_text(size(value, 1)))
            cycle
         end if
         rows = rows + 1
         call read_row(draft, reader, path, value(:, rows), is_first=rows == 1)
      end do
      if (rows == 0 .and. draft%faults%errors() == before) then
         call draft%faults%add(path, 0, 0, "there are no rows of data")
      end if
      draft%deck%design = value(:, :rows)
   end subroutine read_rows

   subroutine read_row(draft, reader, path, value, is_first)
      type(draft_type), intent(inout) :: draft
      type(csv_reader), intent(in) :: reader
      character(len=*), intent(in) :: path
      real(wp), intent(out) :: value(:)
      logical, intent(in) :: is_first   !! odd values are told in the first row only
      character(len=:), allocatable :: trouble
      integer :: i, key, place

      do i = 1, size(value)
         key = draft%deck%design_key(i)
         associate (word => reader%text(reader%field(i)%first:reader%field(i)%last), column => reader%field(i)%column)
            call read_value(key, word, keys(key)%kind /= real_key, value(i), trouble)
            if (trouble /= "") then
               call draft%faults%add(path, reader%line, column, shown(key, word)//trouble)
            else if (key == key_pressure_file) then
               call name_trace(draft, word, path, reader%line, column, place)
               value(i) = real(place, wp)
            else if (is_first) then
               trouble = odd_value(key, value(i))
               if (trouble /= "") call draft%faults%warn(path, reader%line, column, shown(key, word)//trouble)
            end if
         end associate
      end do
   end subroutine read_row

   !> "film.gap_mm = -0.05: "
   function shown(key, word)
      integer, intent(in) :: key
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: shown

      shown = full_name(key)//" = "//clip(word, 40)//": "
   end function shown

end module rv_design
