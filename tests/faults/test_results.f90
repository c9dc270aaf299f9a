!> results.nc and summary.csv: every value in its place and unit, every variable described, missing means missing.
program test_results
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only : int8
   use check, only : suite_type
   use netcdf, only : nf90_close, nf90_create, nf90_get_att, nf90_get_var, nf90_global, nf90_inq_varid, nf90_inquire, &
      & nf90_inquire_attribute, nf90_inquire_variable, nf90_netcdf4, nf90_noerr, nf90_nowrite, nf90_open
   use rv_block, only : n_facts, n_measures, n_traces
   use rv_error, only : error_type, rv_bad_input, rv_io
   use rv_file, only : read_whole_file
   use rv_kinds, only : wp, i8
   use rv_lanes, only : method_explicit, method_implicit
   use rv_manifest, only : input_type, kind_choice, kind_number, kind_text, manifest_type
   use rv_parts, only : part_type
   use rv_results_csv, only : csv_writer
   use rv_results_netcdf, only : expected_size, netcdf_writer
   use rv_results_origin, only : read_origin
   use rv_row_text, only : row_text
   use rv_text, only : to_text
   implicit none
   integer, parameter :: cases = 5, times = 3
   type(suite_type) :: suite
   type(manifest_type) :: manifest
   type(part_type) :: part(2)   !! cases 1 to 3 and 4 to 5
   real(wp) :: nan

   nan = ieee_value(nan, ieee_quiet_nan)
   call make_manifest()
   call make_part(part(1), 1, 3)
   call make_part(part(2), 4, 5)
   call test_csv()
   call test_netcdf()
   manifest%compress = 6
   call test_netcdf()
   manifest%compress = 0
   call test_messages()
   call test_origin()
   call test_no_place()
   call suite%finish()

contains

   subroutine test_csv()
      type(csv_writer) :: writer
      type(row_text) :: rows
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text, expected
      character(len=1), parameter :: nl = new_line("a")
      logical :: found
      integer :: i

      call writer%create("test.csv", manifest, error)
      call suite%no_error("create test.csv", error)
      do i = 1, size(part)
         call writer%get_rows(part(i), rows)
         call writer%put_rows(rows, error)
         call suite%no_error("write rows", error)
      end do
      call writer%close(error)
      call suite%no_error("close it", error)
      call read_whole_file("test.csv", text, found, error)
      expected = "case,model,film.gap_mm,pressure.file,steady_mm,rise_ms,opening_ms,overshoot_mm,fall_ms,closing_ms," &
         & //"zero_ms,undershoot_mm,peak_squeeze_n,status,message"//nl &
         & //'1,squeeze,0.1,"b, c.csv",1001,1002,,1004,1005,1006,1007,1008,1.009,ok,'//nl &
         & //'2,traditional,0.2,a.csv,2001,2002,,2004,2005,2006,2007,2008,2.009,film_closed,"why? ""so"", he said"'//nl
      call suite%text("its first rows", text(:min(len(text), len(expected))), expected)
      call suite%equal("its rows", count([(text(i:i) == nl, i=1, len(text))]), cases + 1)
   end subroutine test_csv

   subroutine test_netcdf()
      type(netcdf_writer) :: writer
      type(error_type), allocatable :: error
      integer :: file, variables, attributes, var, flag
      character(len=200) :: name
      real(wp) :: x(cases), trace(times, cases), fill
      integer(int8) :: byte(cases)
      character(len=200) :: message(cases)
      character(len=8) :: word(cases)

      call writer%create("test.nc", manifest, error)
      call suite%no_error("create test.nc", error)
      call writer%put(part(1), error)
      call writer%put(part(2), error)
      call writer%close(error)
      call suite%no_error("close it", error)
      call suite%equal("open it", nf90_open("test.nc", nf90_nowrite, file), nf90_noerr)
      call suite%equal("look at it", nf90_inquire(file, nVariables=variables, nAttributes=attributes), nf90_noerr)
      call suite%equal("variables", variables, 8 + n_measures + n_facts + n_traces)
      do var = 1, variables
         flag = nf90_inquire_variable(file, var, name=name)
         if (flag == nf90_noerr) flag = nf90_inquire_attribute(file, var, "units")
         if (flag == nf90_noerr) flag = nf90_inquire_attribute(file, var, "long_name")
         if (flag /= nf90_noerr) exit
      end do
      call suite%equal("all have units and a long name, up to "//trim(name), flag, nf90_noerr)

      call suite%equal("get fall_ms", nf90_get_var(file, number_of(file, "fall_ms"), x), nf90_noerr)
      call suite%close("fall_ms of case 4", x(4), 4005.0_wp, 1.0e-15_wp, 0.0_wp)
      call suite%equal("get opening_ms", nf90_get_var(file, number_of(file, "opening_ms"), x), nf90_noerr)
      call suite%true("what did not happen is NaN", all(ieee_is_nan(x)))
      var = number_of(file, "opening_ms")
      call suite%equal("its fill value", nf90_get_att(file, var, "_FillValue", fill), nf90_noerr)
      call suite%true("is NaN", ieee_is_nan(fill))
      call suite%equal("get film.gap_mm", nf90_get_var(file, number_of(file, "film.gap_mm"), x), nf90_noerr)
      call suite%close("the gap of case 5", x(5), 0.5_wp, 1.0e-15_wp, 0.0_wp)
      call suite%equal("get model", nf90_get_var(file, number_of(file, "model"), byte), nf90_noerr)
      call suite%true("models", all(byte == [2, 1, 2, 1, 2]))
      call suite%equal("get status", nf90_get_var(file, number_of(file, "status"), byte), nf90_noerr)
      call suite%true("status", all(byte == [0, 2, 0, 2, 0]))
      call suite%equal("get message", nf90_get_var(file, number_of(file, "message"), message), nf90_noerr)
      call suite%text("the message of case 4", message(4)(:index(message(4), achar(0)) - 1), 'why? "so", he said')
      call suite%text("the message of case 5", message(5)(1:1), achar(0))
      call suite%equal("get pressure.file", nf90_get_var(file, number_of(file, "pressure.file"), word), nf90_noerr)
      call suite%text("the file of case 3", word(3), "b, c.csv")
      call suite%text("the file of case 2", word(2), "a.csv"//repeat(achar(0), 3))
      call suite%equal("get inlet_kpa", nf90_get_var(file, number_of(file, "inlet_kpa"), trace), nf90_noerr)
      call suite%close("inlet of case 5 at the second time", trace(2, 5), 0.532_wp, 1.0e-14_wp, 0.0_wp)
      call suite%equal("get time_ms", nf90_get_var(file, number_of(file, "time_ms"), x(:times)), nf90_noerr)
      call suite%close("the last time", x(times), 0.04_wp, 1.0e-15_wp, 0.0_wp)
      call suite%text("title", attribute(file, "title"), "A title")
      call suite%text("deck", attribute(file, "deck"), manifest%deck)
      call suite%text("effective values", attribute(file, "effective_values"), "")
      call suite%true("libraries", index(attribute(file, "library_versions"), "SUNDIALS ") == 1)
      call test_flags(file)
      call suite%equal("close it", nf90_close(file), nf90_noerr)
   end subroutine test_netcdf

   !> Codes are explained as CF has it: values of the variable's own type, and a word for each.
   subroutine test_flags(file)
      integer, intent(in) :: file
      character(len=13), parameter :: name(3) = [character(len=13) :: "model", "status", "solver_method"]
      character(len=400) :: meanings
      real(wp) :: value(2)
      integer :: i, var, kind, of_values, length

      do i = 1, size(name)
         var = number_of(file, trim(name(i)))
         of_values = -1
         call suite%equal(trim(name(i)), nf90_inquire_variable(file, var, xtype=kind), nf90_noerr)
         call suite%equal("its flags", nf90_inquire_attribute(file, var, "flag_values", xtype=of_values, len=length), nf90_noerr)
         call suite%equal("are of its type", of_values, kind)
         meanings = ""
         call suite%equal("their meanings", nf90_get_att(file, var, "flag_meanings", meanings), nf90_noerr)
         call suite%equal("as many", 1 + count([(meanings(kind:kind) == " ", kind=1, len_trim(meanings))]), length)
      end do
      call suite%text("methods", trim(meanings), "implicit explicit")
      call suite%equal("their values", nf90_get_att(file, var, "flag_values", value), nf90_noerr)
      call suite%close("implicit", value(1), real(method_implicit, wp), 0.0_wp, 0.0_wp)
      call suite%close("explicit", value(2), real(method_explicit, wp), 0.0_wp, 0.0_wp)
   end subroutine test_flags

   !> Messages here and there among many cases, in blocks whose ends are not those of anything in the file.
   subroutine test_messages()
      integer, parameter :: many = 1000, step = 143
      type(netcdf_writer) :: writer
      type(manifest_type) :: large
      type(part_type) :: one
      type(error_type), allocatable :: error
      character(len=200) :: message(many)
      integer :: first, file, wrong, i

      large = manifest
      large%cases = many
      call writer%create("messages.nc", large, error)
      do first = 1, many, step
         call make_part(one, first, min(first + step - 1, many))
         do i = 1, size(one%result%status)
            one%result%message(i)%s = told(first + i - 1)
         end do
         call writer%put(one, error)
         call suite%no_error("put cases from "//to_text(first), error)
      end do
      call writer%close(error)
      call suite%equal("open it", nf90_open("messages.nc", nf90_nowrite, file), nf90_noerr)
      call suite%equal("get message", nf90_get_var(file, number_of(file, "message"), message), nf90_noerr)
      wrong = 0
      do i = 1, many
         if (message(i)(:index(message(i)//achar(0), achar(0)) - 1) /= told(i)) wrong = wrong + 1
      end do
      call suite%equal("wrong messages", wrong, 0)
      call suite%equal("close it", nf90_close(file), nf90_noerr)
   end subroutine test_messages

   !> What a case says: most say nothing, one says too much.
   function told(i) result(text)
      integer, intent(in) :: i
      character(len=:), allocatable :: text

      text = ""
      if (mod(i, 90) == 1 .or. abs(i - 500) < 3) text = "case "//to_text(i)
      if (i == 700) text = repeat("x", 200)
   end function told

   subroutine test_origin()
      type(manifest_type) :: origin
      type(error_type), allocatable :: error
      integer(i8) :: n, failed
      integer :: file

      call read_origin("test.nc", origin, n, failed, error)
      call suite%no_error("where test.nc comes from", error)
      call suite%text("its deck", origin%deck_name//": "//origin%deck, manifest%deck_name//": "//manifest%deck)
      call suite%equal("its cases", int(n), cases)
      call suite%equal("its failures", int(failed), 2)
      call read_origin("test.csv", origin, n, failed, error)
      call suite%fails("where a CSV comes from", error, "cannot read 'test.csv'")
      call suite%equal("which is trouble with a file", error%code, rv_io)
      call suite%equal("a file of another program", nf90_create("foreign.nc", nf90_netcdf4, file), nf90_noerr)
      call suite%equal("close it", nf90_close(file), nf90_noerr)
      call read_origin("foreign.nc", origin, n, failed, error)
      call suite%fails("where that comes from", error, "'foreign.nc' was not written by reedvalve")
      call suite%equal("which is sound", error%code, rv_bad_input)
      call suite%true("the size is foreseen", expected_size(manifest) > 0_i8)
   end subroutine test_origin

   subroutine test_no_place()
      type(netcdf_writer) :: netcdf
      type(csv_writer) :: csv
      type(error_type), allocatable :: error

      call netcdf%create("no/such/folder.nc", manifest, error)
      call suite%fails("a NetCDF file in no folder", error, "cannot write 'no/such/folder.nc'")
      call csv%create("no/such/folder.csv", manifest, error)
      call suite%fails("a CSV file in no folder", error, "cannot write 'no/such/folder.csv': No such file")
   end subroutine test_no_place

   subroutine make_manifest()
      integer :: i

      manifest%code_version = "0.0.1"
      manifest%deck_name = "deck"
      manifest%deck = "&run /"//new_line("a")//repeat("! a long deck"//new_line("a"), 9000)
      manifest%effective = ""
      manifest%title = "A title"
      manifest%cases = cases
      manifest%blocks = 2
      allocate(manifest%time(times), manifest%input(3))
      manifest%traces = n_traces
      allocate(manifest%fields%time(0), manifest%fields%x(0), manifest%fields%y(0))
      manifest%time = [(0.02_wp*(i - 1), i=1, times)]
      do i = 1, 3
         manifest%input(i)%unit = ""
         manifest%input(i)%long_name = "input "//to_text(i)
      end do
      manifest%input(1)%name = "model"
      manifest%input(1)%kind = kind_choice
      manifest%input(2)%name = "film.gap_mm"
      manifest%input(2)%unit = "mm"
      manifest%input(2)%kind = kind_number
      manifest%input(3)%name = "pressure.file"
      manifest%input(3)%kind = kind_text
      call give_words(manifest%input(1), "traditional", "squeeze")
      allocate(manifest%input(2)%word(0))
      call give_words(manifest%input(3), "a.csv", "b, c.csv")
   end subroutine make_manifest

   subroutine give_words(input, first, second)
      type(input_type), intent(inout) :: input
      character(len=*), intent(in) :: first, second

      allocate(input%word(2))
      input%word(1)%s = first
      input%word(2)%s = second
   end subroutine give_words

   !> In SI, measure m of case i is i + m/1000, its trace k at time t is 100 i + 10 k + t; every second case failed.
   subroutine make_part(one, first, last)
      type(part_type), intent(out) :: one
      integer, intent(in) :: first, last
      integer :: i, j, m, k, t

      one%result%first = first
      allocate(one%input(3, last - first + 1), one%result%measure(n_measures, last - first + 1))
      allocate(one%result%fact(n_facts, last - first + 1), source=1.0_wp)
      allocate(one%result%field(0, 0, last - first + 1))
      allocate(one%result%trace(times, n_traces, last - first + 1), one%result%status(last - first + 1))
      allocate(one%result%warnings(last - first + 1), one%result%message(last - first + 1))
      do j = 1, last - first + 1
         i = first + j - 1
         one%input(:, j) = [1.0_wp + mod(i, 2), 0.1_wp*i, 1.0_wp + mod(i, 2)]
         one%result%measure(:, j) = [(i + 0.001_wp*m, m=1, n_measures)]
         one%result%measure(3, j) = nan
         do k = 1, n_traces
            one%result%trace(:, k, j) = [(100.0_wp*i + 10.0_wp*k + t, t=1, times)]
         end do
         one%result%status(j) = merge(0, 2, mod(i, 2) == 1)
         one%result%warnings(j) = mod(i, 2)
         one%result%message(j)%s = ""
         if (mod(i, 2) == 0) one%result%message(j)%s = 'why? "so", he said'
      end do
   end subroutine make_part

   !> The number of a variable.
   integer function number_of(file, name) result(var)
      integer, intent(in) :: file
      character(len=*), intent(in) :: name

      if (nf90_inq_varid(file, name, var) /= nf90_noerr) var = -1
   end function number_of

   !> A global attribute.
   function attribute(file, name) result(text)
      integer, intent(in) :: file
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: text
      integer :: length

      if (nf90_inquire_attribute(file, nf90_global, name, len=length) /= nf90_noerr) length = 0
      allocate(character(len=length) :: text)
      if (length == 0) return
      if (nf90_get_att(file, nf90_global, name, text) /= nf90_noerr) text = "unreadable"
   end function attribute

end program test_results
