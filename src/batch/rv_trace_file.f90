!> Measured pressures from a CSV file: time and inlet and outlet pressure, or their difference.
!>
!> The header names the columns with their units: t_ms, p_in_kpa, p_out_kpa or p_diff_kpa; time also in s and us,
!> pressures also in Pa, MPa and bar. Lines that start with # are comments.
module rv_trace_file
   use, intrinsic :: iso_fortran_env, only : int64
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_text, only : lower, to_text
   use rv_number, only : parse_real
   use rv_faults, only : fault_list, clip
   use rv_text_file, only : read_text_file, check_encoding
   use rv_checksum, only : crc32_text, hex_text
   use rv_csv, only : csv_reader, new_csv_reader
   implicit none
   private
   public :: trace_data, read_pressure_trace

   !> One trace in SI.
   type :: trace_data
      real(wp), allocatable :: time(:)     !! [s], rising
      real(wp), allocatable :: inlet(:)    !! [Pa], (size(time))
      real(wp), allocatable :: outlet(:)   !! [Pa], (size(time))
      character(len=:), allocatable :: note   !! number of rows and checksum of the file
   end type trace_data

   integer(int64), parameter :: most_bytes = 268435456_int64
   integer, parameter :: most_faults = 20            !! in one file; then reading stops
   real(wp), parameter :: latest = 1.0e6_wp          !! |t| [s]
   real(wp), parameter :: highest = 1.0e8_wp         !! |p| [Pa], the limit of pressure.inlet_kpa
   real(wp), parameter :: widest_gap = 20.0_wp       !! step over the median step

   !> What a column holds.
   integer, parameter :: is_time = 1, is_inlet = 2, is_outlet = 3, is_difference = 4, quantities = 4
   character(len=*), parameter :: quantity_name(quantities) = [character(len=7) :: "t_", "p_in_", "p_out_", "p_diff_"]

   !> Where the quantities stand; column 0: not in the file.
   type :: column_map
      integer :: column(quantities) = 0
      real(wp) :: multiply(quantities) = 1.0_wp   !! to SI
      real(wp) :: divide(quantities) = 1.0_wp
      character(len=12) :: name(quantities) = ""  !! in the header
   end type column_map

contains

   !> Read and check a trace. `error` tells of trouble with the file only.
   subroutine read_pressure_trace(path, trace, faults, error)
      character(len=*), intent(in) :: path
      type(trace_data), intent(out) :: trace   !! of use only if no fault was added
      type(fault_list), intent(inout) :: faults
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: text
      type(csv_reader) :: reader
      type(column_map) :: map
      integer, allocatable :: line(:)   !! of each row
      integer :: before

      allocate(trace%time(0), trace%inlet(0), trace%outlet(0))
      trace%note = ""
      call read_text_file(path, most_bytes, text, error)
      if (allocated(error)) return
      before = faults%errors()
      call check_encoding(text, path, faults)
      if (faults%errors() > before) return
      reader = new_csv_reader(text)
      call read_header(reader, path, map, faults)
      if (faults%errors() > before) return
      call read_rows(reader, path, map, trace, line, faults)
      if (faults%errors() > before) return
      call check_gaps(path, trace%time, line, faults)
      trace%note = to_text(size(trace%time))//" rows, CRC-32 "//hex_text(crc32_text(text))
   end subroutine read_pressure_trace

   !> Find the columns.
   subroutine read_header(reader, path, map, faults)
      type(csv_reader), intent(inout) :: reader
      character(len=*), intent(in) :: path
      type(column_map), intent(out) :: map
      type(fault_list), intent(inout) :: faults
      character(len=:), allocatable :: word
      character(len=*), parameter :: due = "a header such as t_ms,p_in_kpa,p_out_kpa or t_ms,p_diff_kpa is due"
      integer :: i, quantity
      real(wp) :: multiply, divide

      if (.not. reader%next_row()) then
         call faults%add(path, 0, 0, "there are no data; "//due)
         return
      end if
      do i = 1, reader%fields
         word = lower(reader%word(i))
         call find_quantity(word, quantity, multiply, divide)
         if (quantity == 0) cycle
         if (map%column(quantity) > 0) then
            call faults%add(path, reader%line, reader%field(i)%column, "a second column of this kind: "//word)
         else
            map%column(quantity) = i
            map%multiply(quantity) = multiply
            map%divide(quantity) = divide
            map%name(quantity) = word
         end if
      end do
      if (is_complete(map)) then
         call warn_unused(reader, path, faults)
      else if (reader%fields == 1 .and. index(reader%word(1), ";") > 0) then
         call faults%add(path, reader%line, 1, "columns are separated by commas, and decimals have a point")
      else
         call faults%add(path, reader%line, 1, due)
      end if
   end subroutine read_header

   subroutine warn_unused(reader, path, faults)
      type(csv_reader), intent(in) :: reader
      character(len=*), intent(in) :: path
      type(fault_list), intent(inout) :: faults
      real(wp) :: multiply, divide
      integer :: i, quantity

      do i = 1, reader%fields
         call find_quantity(lower(reader%word(i)), quantity, multiply, divide)
         if (quantity == 0) call faults%warn(path, reader%line, reader%field(i)%column, &
            & "column '"//clip(reader%word(i), 40)//"' is not used")
      end do
   end subroutine warn_unused

   !> Time, and either both pressures or their difference?
   pure logical function is_complete(map)
      type(column_map), intent(in) :: map
      logical :: has(quantities)

      has = map%column > 0
      is_complete = has(is_time) .and. (has(is_inlet) .eqv. has(is_outlet)) &
         & .and. (has(is_inlet) .neqv. has(is_difference))
   end function is_complete

   !> What a column's name says: the quantity, 0 if it is none, and its unit.
   pure subroutine find_quantity(name, quantity, multiply, divide)
      character(len=*), intent(in) :: name   !! in lower case
      integer, intent(out) :: quantity
      real(wp), intent(out) :: multiply, divide
      character(len=:), allocatable :: unit

      multiply = 1.0_wp
      divide = 1.0_wp
      do quantity = quantities, 1, -1
         if (index(name, trim(quantity_name(quantity))) /= 1) cycle
         unit = merge("t ", "p ", quantity == is_time)//name(len_trim(quantity_name(quantity)) + 1:)
         if (unit == "t ms") divide = 1.0e3_wp
         if (unit == "t us") divide = 1.0e6_wp
         if (unit == "p kpa") multiply = 1.0e3_wp
         if (unit == "p bar") multiply = 1.0e5_wp
         if (unit == "p mpa") multiply = 1.0e6_wp
         if (unit == "t s" .or. unit == "p pa" .or. multiply > 1.0_wp .or. divide > 1.0_wp) return
      end do
   end subroutine find_quantity

   !> Read all rows; stop after some faults, for a wrong file has one in each row.
   subroutine read_rows(reader, path, map, trace, line, faults)
      type(csv_reader), intent(inout) :: reader
      character(len=*), intent(in) :: path
      type(column_map), intent(in) :: map
      type(trace_data), intent(inout) :: trace
      integer, allocatable, intent(out) :: line(:)
      type(fault_list), intent(inout) :: faults
      real(wp), allocatable :: sample(:, :)   !! (quantity, row)
      integer :: columns, rows, before

      before = faults%errors()
      columns = reader%fields
      allocate(line(reader%line_count()))
      allocate(sample(quantities, size(line)))
      sample = 0.0_wp
      rows = 0
      do while (reader%next_row() .and. faults%errors() - before < most_faults)
         if (reader%fields /= columns) then
            call faults%add(path, reader%line, 1, to_text(reader%fields)//" columns; the header has "//to_text(columns))
            cycle
         end if
         rows = rows + 1
         line(rows) = reader%line
         call read_row(reader, path, map, sample(:, rows), faults)
         if (rows == 1) cycle
         if (sample(is_time, rows) > sample(is_time, rows - 1) .or. faults%errors() > before) cycle
         call faults%add(path, reader%line, reader%field(map%column(is_time))%column, &
            & "time must rise from row to row: "//reader%word(map%column(is_time))//" is not later than the row before")
      end do
      if (rows < 2 .and. faults%errors() == before) call faults%add(path, 0, 0, "two rows of data at least are needed")
      trace%time = sample(is_time, :rows)
      trace%inlet = sample(is_inlet, :rows) + sample(is_difference, :rows)
      trace%outlet = sample(is_outlet, :rows)
   end subroutine read_rows

   !> Read one row into SI.
   subroutine read_row(reader, path, map, sample, faults)
      type(csv_reader), intent(in) :: reader
      character(len=*), intent(in) :: path
      type(column_map), intent(in) :: map
      real(wp), intent(inout) :: sample(quantities)
      type(fault_list), intent(inout) :: faults
      character(len=:), allocatable :: trouble
      real(wp) :: value, limit
      integer :: quantity, column

      do quantity = 1, quantities
         column = map%column(quantity)
         if (column == 0) cycle
         call parse_real(reader%word(column), value, trouble)
         sample(quantity) = value*map%multiply(quantity)/map%divide(quantity)
         limit = merge(latest, highest, quantity == is_time)
         if (trouble == "" .and. abs(sample(quantity)) > limit) then
            trouble = "beyond the limit of "//to_text(1.0e-3_wp*limit)//" kPa"
            if (quantity == is_time) trouble = "beyond the limit of "//to_text(1.0e3_wp*limit)//" ms"
         end if
         if (trouble == "") cycle
         call faults%add(path, reader%line, reader%field(column)%column, trim(map%name(quantity))//" = '" &
            & //clip(reader%word(column), 40)//"': "//trim(trouble))
      end do
   end subroutine read_row

   !> A step much wider than the others is a hole in the data, which interpolation would hide.
   subroutine check_gaps(path, time, line, faults)
      character(len=*), intent(in) :: path
      real(wp), intent(in) :: time(:)   !! [s], rising
      integer, intent(in) :: line(:)    !! of each row
      type(fault_list), intent(inout) :: faults
      real(wp), allocatable :: step(:)
      integer :: i

      allocate(step, source=time(2:) - time(:size(time) - 1))
      if (size(step) < 3) return
      i = maxloc(step, dim=1)
      if (step(i) <= widest_gap*median(step)) return
      call faults%add(path, line(i + 1), 1, "a gap before this row: "//to_text(1.0e3_wp*step(i), 4)//" ms, more than " &
         & //to_text(nint(widest_gap))//" times the median step; fill it or cut the trace")
   end subroutine check_gaps

   !> The middle value, by repeated splitting: O(n) on average.
   pure real(wp) function median(x)
      real(wp), intent(in) :: x(:)
      real(wp), allocatable :: rest(:), lower_part(:)
      real(wp) :: pivot
      integer :: place

      allocate(rest, source=x)
      place = (size(x) + 1)/2
      do
         pivot = rest((size(rest) + 1)/2)
         lower_part = pack(rest, rest < pivot)
         if (place <= size(lower_part)) then
            rest = lower_part
         else if (place <= count(rest <= pivot)) then
            exit
         else
            place = place - count(rest <= pivot)
            rest = pack(rest, rest > pivot)
         end if
      end do
      median = pivot
   end function median

end module rv_trace_file
