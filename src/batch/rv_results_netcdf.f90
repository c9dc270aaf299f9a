!> results.nc: written case block by case block in constant memory, from nothing but the manifest and the parts.
!>
!> NetCDF-4 with a fixed case dimension, so that the file is the same bytes whoever computed the parts and when.
!> Variables are chunked along the cases; NaN is the fill value, so what did not happen reads as missing.
module rv_results_netcdf
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only : int8
   use netcdf, only : nf90_byte, nf90_char, nf90_clobber, nf90_close, nf90_create, nf90_def_dim, nf90_def_var, &
      & nf90_def_var_fill, nf90_double, nf90_enddef, nf90_global, nf90_int, nf90_netcdf4, nf90_noerr, &
      & nf90_put_att, nf90_put_var, nf90_strerror
   use rv_kinds, only : wp, i8
   use rv_error, only : error_type, fail, rv_io
   use rv_text, only : text_type
   use rv_block, only : column_type, fact_columns, measure_columns, n_facts, n_measures, n_traces, &
      & trace_columns
   use rv_status, only : n_statuses, n_warnings, status_name, warning_name
   use rv_field_mesh, only : field_mesh
   use rv_manifest, only : input_type, kind_choice, kind_text, manifest_type
   use rv_parts, only : part_type
   use rv_version, only : code_version, compiler_text, library_text
   implicit none
   private
   public :: netcdf_writer, expected_size, sample_values

   real(wp), parameter :: kilo = 1.0e3_wp       !! Pa to kPa
   integer, parameter :: message_length = 200   !! longer messages are cut

   integer, parameter :: chunk_cases = 16384           !! cases in one chunk of a variable without time
   integer, parameter :: chunk_messages = 64           !! small: where messages are rare, each makes a whole chunk
   integer, parameter :: chunk_bytes = 1048576         !! of a chunk with time, about
   integer, parameter :: cache_size = 2                !! for each variable [MiB]; the library's own may be 16
   integer, parameter :: fixed_bytes = 131072          !! of an empty file, about
   integer, parameter :: bytes_real = storage_size(1.0_wp)/8

   !> A results file being written. create, put for every part in the order of the blocks, close.
   type :: netcdf_writer
      private
      character(len=:), allocatable :: path
      logical :: is_open = .false.
      integer :: file = 0
      integer :: case_dim = 0
      integer :: compress = 0
      integer :: case_var = 0
      integer :: time_var = 0
      type(input_type), allocatable :: input(:)
      integer, allocatable :: input_var(:)
      type(column_type) :: measure(n_measures), fact(n_facts), trace(n_traces)
      integer :: measure_var(n_measures) = 0
      integer :: fact_var(n_facts) = 0
      integer :: trace_var(n_traces) = 0
      integer :: status_var = 0, warnings_var = 0, message_var = 0
      integer :: times = 0, traces = 0
      integer :: field_var = 0, nodes = 0, field_times = 0
      integer :: mesh_var(4) = 0                 !! x, y, faces, times
      integer :: flag = nf90_noerr               !! of the first call that failed
      character(len=:), allocatable :: at         !! what that call was about
   contains
      procedure :: create
      procedure :: put
      procedure :: close => close_file
      procedure, private :: note
      procedure, private :: give_up
      procedure, private :: define_attributes
      procedure, private :: define_cases
      procedure, private :: define_inputs
      procedure, private :: define_columns
      procedure, private :: define_traces
      procedure, private :: define_fields
      procedure, private :: put_mesh
      procedure, private :: describe
      procedure, private :: describe_flags
      procedure, private :: describe_words
      procedure, private :: put_input
      procedure, private :: put_messages
   end type netcdf_writer

contains

   !> Make the file and everything in it but the cases' values.
   subroutine create(self, path, manifest, error)
      class(netcdf_writer), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(manifest_type), intent(in) :: manifest
      type(error_type), allocatable, intent(out) :: error

      self%path = path
      self%flag = nf90_noerr
      self%input = manifest%input
      self%times = size(manifest%time)
      self%traces = manifest%traces
      self%compress = manifest%compress
      self%measure = measure_columns()
      self%fact = fact_columns()
      self%trace = trace_columns()
      call self%note(nf90_create(path, ior(nf90_netcdf4, nf90_clobber), self%file), "the file")
      self%is_open = self%flag == nf90_noerr
      call self%note(nf90_def_dim(self%file, "case", int(manifest%cases), self%case_dim), "dimension case")
      call self%define_attributes(manifest)
      call self%define_cases(int(manifest%cases))
      call self%define_inputs(int(manifest%cases))
      call self%define_columns(int(manifest%cases))
      if (self%times > 0) call self%define_traces(int(manifest%cases))
      if (size(manifest%fields%time) > 0) call self%define_fields(int(manifest%cases), manifest%fields)
      call self%note(nf90_enddef(self%file), "the definitions")
      if (self%times > 0) call self%note(nf90_put_var(self%file, self%time_var, manifest%time), "time_ms")
      if (self%nodes > 0) call self%put_mesh(manifest%fields)
      call self%give_up(error)
   end subroutine create

   !> Write one block's cases.
   subroutine put(self, part, error)
      class(netcdf_writer), intent(inout) :: self
      type(part_type), intent(in) :: part
      type(error_type), allocatable, intent(out) :: error
      integer :: first, n, i

      associate (result => part%result)
         first = int(result%first)
         n = size(result%status)
         call self%note(nf90_put_var(self%file, self%case_var, [(first + i, i=0, n - 1)], [first], [n]), "case")
         do i = 1, size(self%input)
            call self%put_input(i, part%input(i, :), first)
         end do
         do i = 1, n_measures
            call self%note(nf90_put_var(self%file, self%measure_var(i), result%measure(i, :)*self%measure(i)%to_unit, &
               & [first], [n]), trim(self%measure(i)%name))
         end do
         do i = 1, n_facts
            call self%note(nf90_put_var(self%file, self%fact_var(i), result%fact(i, :)*self%fact(i)%to_unit, &
               & [first], [n]), trim(self%fact(i)%name))
         end do
         call self%note(nf90_put_var(self%file, self%status_var, int(result%status, int8), [first], [n]), "status")
         call self%note(nf90_put_var(self%file, self%warnings_var, int(result%warnings, int8), [first], [n]), &
            & "warnings")
         call self%put_messages(result%message, first)
         do i = 1, merge(self%traces, 0, self%times > 0)
            call self%note(nf90_put_var(self%file, self%trace_var(i), result%trace(:, i, :)*self%trace(i)%to_unit, &
               & [1, first], [self%times, n]), trim(self%trace(i)%name))
         end do
         if (self%nodes > 0) call self%note(nf90_put_var(self%file, self%field_var, result%field/kilo, &
            & [1, 1, first], [self%nodes, self%field_times, n]), "film_pressure_kpa")
      end associate
      call self%give_up(error)
   end subroutine put

   !> Close; harmless when nothing is open. Without `error`, whatever happens then is of no interest.
   subroutine close_file(self, error)
      class(netcdf_writer), intent(inout) :: self
      type(error_type), allocatable, optional, intent(out) :: error
      integer :: flag

      if (.not. self%is_open) return
      self%is_open = .false.
      flag = nf90_close(self%file)
      if (.not. present(error)) return
      call self%note(flag, "its end")
      call self%give_up(error)
   end subroutine close_file

   !> Keep the first failure.
   subroutine note(self, flag, at)
      class(netcdf_writer), intent(inout) :: self
      integer, intent(in) :: flag
      character(len=*), intent(in) :: at

      if (self%flag /= nf90_noerr .or. flag == nf90_noerr) return
      self%flag = flag
      self%at = at
   end subroutine note

   !> Turn the first failure into an error.
   subroutine give_up(self, error)
      class(netcdf_writer), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error

      if (self%flag == nf90_noerr) return
      call fail(error, rv_io, "cannot write '"//self%path//"': "//trim(nf90_strerror(self%flag)) &
         & //" (while writing "//self%at//")")
      call self%close()
   end subroutine give_up

   subroutine define_attributes(self, manifest)
      class(netcdf_writer), intent(inout) :: self
      type(manifest_type), intent(in) :: manifest

      call global("Conventions", "CF-1.10"//trim(merge(" UGRID-1.0", "          ", size(manifest%fields%x) > 0)))
      call global("title", manifest%title)
      call global("deck_name", manifest%deck_name)
      call global("deck", manifest%deck)
      call global("effective_values", manifest%effective)
      call global("code_version", code_version)
      call global("compiler", compiler_text())
      call global("library_versions", library_text())

   contains

      subroutine global(name, text)
         character(len=*), intent(in) :: name, text

         call self%note(nf90_put_att(self%file, nf90_global, name, text), "attribute "//name)
      end subroutine global

   end subroutine define_attributes

   !> The case number, how each case ended, and its message.
   subroutine define_cases(self, cases)
      class(netcdf_writer), intent(inout) :: self
      integer, intent(in) :: cases
      type(text_type) :: word(n_statuses), warning(n_warnings)
      integer :: length_dim, i

      do i = 1, n_statuses
         word(i)%s = status_name(i - 1)
      end do
      do i = 1, n_warnings
         warning(i)%s = warning_name(i)
      end do
      self%case_var = new_variable(self, "case", nf90_int, [self%case_dim], [min(cases, chunk_cases)])
      call self%describe(self%case_var, "1", "case number in the order of the deck, from 1")
      self%status_var = new_variable(self, "status", nf90_byte, [self%case_dim], [min(cases, chunk_cases)])
      call self%describe(self%status_var, "1", "how the case ended")
      call self%describe_flags(self%status_var, "flag_values", [(int(i - 1, int8), i=1, n_statuses)], word)
      self%warnings_var = new_variable(self, "warnings", nf90_byte, [self%case_dim], [min(cases, chunk_cases)])
      call self%describe(self%warnings_var, "1", "what to beware of in the case")
      call self%describe_flags(self%warnings_var, "flag_masks", [(int(2**(i - 1), int8), i=1, n_warnings)], warning)
      call self%note(nf90_def_dim(self%file, "message_length", message_length, length_dim), "message_length")
      self%message_var = new_variable(self, "message", nf90_char, [length_dim, self%case_dim], &
         & [message_length, min(cases, chunk_messages)])
      call self%describe(self%message_var, "1", "why the case failed, or what it warns of")
      call self%note(nf90_put_att(self%file, self%message_var, "_Encoding", "utf-8"), "message")
   end subroutine define_cases

   !> The model and the swept keys.
   subroutine define_inputs(self, cases)
      class(netcdf_writer), intent(inout) :: self
      integer, intent(in) :: cases
      integer :: i, j, dim, longest

      allocate(self%input_var(size(self%input)))
      do i = 1, size(self%input)
         associate (input => self%input(i), var => self%input_var(i))
            select case (input%kind)
            case (kind_text)
               longest = longest_word(input%word)
               call self%note(nf90_def_dim(self%file, input%name//"_length", longest, dim), input%name)
               var = new_variable(self, input%name, nf90_char, [dim, self%case_dim], &
                  & [longest, min(cases, max(1, chunk_bytes/longest))])
               call self%note(nf90_put_att(self%file, var, "_Encoding", "utf-8"), input%name)
            case (kind_choice)
               var = new_variable(self, input%name, nf90_byte, [self%case_dim], [min(cases, chunk_cases)])
               call self%describe_flags(var, "flag_values", [(int(j, int8), j=1, size(input%word))], input%word)
            case default
               var = new_variable(self, input%name, nf90_double, [self%case_dim], [min(cases, chunk_cases)])
            end select
            call self%describe(var, input%unit, input%long_name)
         end associate
      end do
   end subroutine define_inputs

   !> Measures and facts.
   subroutine define_columns(self, cases)
      class(netcdf_writer), intent(inout) :: self
      integer, intent(in) :: cases
      integer :: i

      do i = 1, n_measures
         self%measure_var(i) = new_variable(self, trim(self%measure(i)%name), nf90_double, [self%case_dim], &
            & [min(cases, chunk_cases)])
         call self%describe(self%measure_var(i), trim(self%measure(i)%unit), trim(self%measure(i)%long_name))
      end do
      do i = 1, n_facts
         self%fact_var(i) = new_variable(self, trim(self%fact(i)%name), nf90_double, [self%case_dim], &
            & [min(cases, chunk_cases)])
         call self%describe(self%fact_var(i), trim(self%fact(i)%unit), trim(self%fact(i)%long_name))
         if (self%fact(i)%meanings /= "") call self%describe_words(self%fact_var(i), trim(self%fact(i)%meanings))
      end do
   end subroutine define_columns

   !> The time coordinate and the histories.
   subroutine define_traces(self, cases)
      class(netcdf_writer), intent(inout) :: self
      integer, intent(in) :: cases
      integer :: time_dim, chunk(2), i

      chunk = trace_chunk(self%times)
      chunk(2) = min(cases, chunk(2))
      call self%note(nf90_def_dim(self%file, "time", self%times, time_dim), "dimension time")
      self%time_var = new_variable(self, "time_ms", nf90_double, [time_dim], [chunk(1)])
      call self%describe(self%time_var, "ms", "time")
      do i = 1, self%traces
         self%trace_var(i) = new_variable(self, trim(self%trace(i)%name), nf90_double, [time_dim, self%case_dim], chunk)
         call self%describe(self%trace_var(i), trim(self%trace(i)%unit), trim(self%trace(i)%long_name))
         call self%note(nf90_put_att(self%file, self%trace_var(i), "coordinates", "time_ms"), trim(self%trace(i)%name))
      end do
   end subroutine define_traces

   !> The film's pressure fields on their mesh, as UGRID 1.0 has it: topology, node coordinates, faces.
   subroutine define_fields(self, cases, fields)
      class(netcdf_writer), intent(inout) :: self
      integer, intent(in) :: cases
      type(field_mesh), intent(in) :: fields
      integer :: node_dim, time_dim, face_dim, corner_dim, var

      self%nodes = size(fields%x)
      self%field_times = size(fields%time)
      if (self%nodes == 0) return
      call self%note(nf90_def_dim(self%file, "film_node", self%nodes, node_dim), "dimension film_node")
      call self%note(nf90_def_dim(self%file, "field_time", self%field_times, time_dim), "dimension field_time")
      call self%note(nf90_def_dim(self%file, "film_face", size(fields%faces(), 2), face_dim), "dimension film_face")
      call self%note(nf90_def_dim(self%file, "corner", 4, corner_dim), "dimension corner")
      var = new_variable(self, "film_mesh", nf90_int, [integer ::], [integer ::])
      call self%describe(var, "1", "mesh of the film under the half reed, y >= 0")
      call self%note(nf90_put_att(self%file, var, "cf_role", "mesh_topology"), "film_mesh")
      call self%note(nf90_put_att(self%file, var, "topology_dimension", 2), "film_mesh")
      call self%note(nf90_put_att(self%file, var, "node_coordinates", "film_x_mm film_y_mm"), "film_mesh")
      call self%note(nf90_put_att(self%file, var, "face_node_connectivity", "film_faces"), "film_mesh")
      self%mesh_var(1) = new_variable(self, "film_x_mm", nf90_double, [node_dim], [self%nodes])
      call self%describe(self%mesh_var(1), "mm", "distance from the clamp along the reed")
      self%mesh_var(2) = new_variable(self, "film_y_mm", nf90_double, [node_dim], [self%nodes])
      call self%describe(self%mesh_var(2), "mm", "distance from the symmetry line")
      self%mesh_var(3) = new_variable(self, "film_faces", nf90_int, [corner_dim, face_dim], [4, size(fields%faces(), 2)])
      call self%describe(self%mesh_var(3), "1", "nodes of each face")
      call self%note(nf90_put_att(self%file, self%mesh_var(3), "cf_role", "face_node_connectivity"), "film_faces")
      call self%note(nf90_put_att(self%file, self%mesh_var(3), "start_index", 1), "film_faces")
      self%mesh_var(4) = new_variable(self, "field_time_ms", nf90_double, [time_dim], [self%field_times])
      call self%describe(self%mesh_var(4), "ms", "time of the film pressure fields")
      self%field_var = new_variable(self, "film_pressure_kpa", nf90_double, [node_dim, time_dim, self%case_dim], &
         & [self%nodes, self%field_times, min(cases, field_chunk(int(self%nodes, i8)*self%field_times))])
      call self%describe(self%field_var, "kPa", "film pressure, on the scale of inlet and outlet pressure")
      call self%note(nf90_put_att(self%file, self%field_var, "mesh", "film_mesh"), "film_pressure_kpa")
      call self%note(nf90_put_att(self%file, self%field_var, "location", "node"), "film_pressure_kpa")
      call self%note(nf90_put_att(self%file, self%field_var, "coordinates", "field_time_ms film_x_mm film_y_mm"), &
         & "film_pressure_kpa")
   end subroutine define_fields

   subroutine put_mesh(self, fields)
      class(netcdf_writer), intent(inout) :: self
      type(field_mesh), intent(in) :: fields

      call self%note(nf90_put_var(self%file, self%mesh_var(1), fields%x), "film_x_mm")
      call self%note(nf90_put_var(self%file, self%mesh_var(2), fields%y), "film_y_mm")
      call self%note(nf90_put_var(self%file, self%mesh_var(3), fields%faces()), "film_faces")
      call self%note(nf90_put_var(self%file, self%mesh_var(4), fields%time), "field_time_ms")
   end subroutine put_mesh

   !> A chunked variable, or a scalar; reals are filled with NaN.
   integer function new_variable(self, name, kind, dims, chunk) result(var)
      class(netcdf_writer), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: kind                 !! nf90_double, ...
      integer, intent(in) :: dims(:), chunk(:)
      real(wp) :: nan

      var = 0
      if (size(dims) == 0) then
         call self%note(nf90_def_var(self%file, name, kind, var), name)
         return
      end if
      call self%note(nf90_def_var(self%file, name, kind, dims, var, chunksizes=chunk, cache_size=cache_size, &
         & cache_nelems=509, cache_preemption=100, deflate_level=self%compress, &
         & shuffle=self%compress > 0 .and. any(kind == [nf90_double, nf90_int])), name)
      if (kind /= nf90_double) return
      nan = ieee_value(nan, ieee_quiet_nan)
      call self%note(nf90_def_var_fill(self%file, var, 0, nan), name)
   end function new_variable

   subroutine describe(self, var, unit, long_name)
      class(netcdf_writer), intent(inout) :: self
      integer, intent(in) :: var
      character(len=*), intent(in) :: unit        !! empty: a pure number
      character(len=*), intent(in) :: long_name

      if (unit == "") then
         call self%note(nf90_put_att(self%file, var, "units", "1"), long_name)
      else
         call self%note(nf90_put_att(self%file, var, "units", unit), long_name)
      end if
      call self%note(nf90_put_att(self%file, var, "long_name", long_name), long_name)
   end subroutine describe

   !> CF flags: `attribute` is flag_values or flag_masks.
   subroutine describe_flags(self, var, attribute, value, meaning)
      class(netcdf_writer), intent(inout) :: self
      integer, intent(in) :: var
      character(len=*), intent(in) :: attribute
      integer(int8), intent(in) :: value(:)
      type(text_type), intent(in) :: meaning(:)   !! words without blanks
      character(len=:), allocatable :: words
      integer :: i

      words = ""
      do i = 1, size(meaning)
         words = words//meaning(i)%s//" "
      end do
      call self%note(nf90_put_att(self%file, var, attribute, value), attribute)
      call self%note(nf90_put_att(self%file, var, "flag_meanings", trim(words)), "flag_meanings")
   end subroutine describe_flags

   !> CF flags of a real variable, as real as itself: its values 1, 2, ... stand for the words.
   subroutine describe_words(self, var, words)
      class(netcdf_writer), intent(inout) :: self
      integer, intent(in) :: var
      character(len=*), intent(in) :: words       !! with one blank between them
      integer :: i, n

      n = 1 + count([(words(i:i) == " ", i=1, len(words))])
      call self%note(nf90_put_att(self%file, var, "flag_values", [(real(i, wp), i=1, n)]), "flag_values")
      call self%note(nf90_put_att(self%file, var, "flag_meanings", words), "flag_meanings")
   end subroutine describe_words

   subroutine put_input(self, i, value, first)
      class(netcdf_writer), intent(inout) :: self
      integer, intent(in) :: i                    !! which input
      real(wp), intent(in) :: value(:)
      integer, intent(in) :: first
      integer :: flag, longest

      associate (input => self%input(i), var => self%input_var(i), n => size(value))
         select case (input%kind)
         case (kind_text)
            longest = longest_word(input%word)
            flag = nf90_put_var(self%file, var, padded(input%word, nint(value), longest), [1, first], [longest, n])
         case (kind_choice)
            flag = nf90_put_var(self%file, var, int(nint(value), int8), [first], [n])
         case default
            flag = nf90_put_var(self%file, var, value, [first], [n])
         end select
         call self%note(flag, input%name)
      end associate
   end subroutine put_input

   !> Only chunks with a message in them: those without one take no room in the file.
   subroutine put_messages(self, message, first)
      class(netcdf_writer), intent(inout) :: self
      type(text_type), intent(in) :: message(:)
      integer, intent(in) :: first                !! number of the first case
      integer :: i, top, k

      i = 1
      do while (i <= size(message))
         top = min(size(message), i + chunk_messages - 1 - modulo(first + i - 2, chunk_messages))
         if (any([(len(message(k)%s) > 0, k=i, top)])) call self%note(nf90_put_var(self%file, self%message_var, &
            & padded(message, [(k, k=i, top)], message_length), [1, first + i - 1], [message_length, top - i + 1]), "message")
         i = top + 1
      end do
   end subroutine put_messages

   !> Some of the texts in one length, filled up with zero bytes, which readers take for the end of a text.
   pure function padded(text, chosen, length) result(same)
      type(text_type), intent(in) :: text(:)
      integer, intent(in) :: chosen(:)
      integer, intent(in) :: length
      character(len=length), allocatable :: same(:)
      integer :: i, n

      allocate(same(size(chosen)), source=repeat(achar(0), length))
      do i = 1, size(chosen)
         n = min(len(text(chosen(i))%s), length)
         same(i)(:n) = text(chosen(i))%s(:n)
      end do
   end function padded

   pure integer function longest_word(word) result(longest)
      type(text_type), intent(in) :: word(:)
      integer :: i

      longest = 1
      do i = 1, size(word)
         longest = max(longest, len(word(i)%s))
      end do
   end function longest_word

   !> So many, or the next whole number of chunks where there is more than one.
   pure integer(i8) function in_chunks(n, chunk)
      integer(i8), intent(in) :: n
      integer, intent(in) :: chunk

      in_chunks = n
      if (n > chunk) in_chunks = chunk*((n + chunk - 1)/chunk)
   end function in_chunks

   !> Times and cases in a chunk of a history of so many times, if there are as many.
   pure function trace_chunk(times) result(chunk)
      integer, intent(in) :: times
      integer :: chunk(2)
      integer :: pieces

      pieces = (times*bytes_real + chunk_bytes - 1)/chunk_bytes
      chunk(1) = (times + pieces - 1)/pieces
      chunk(2) = max(1, chunk_bytes/(bytes_real*chunk(1)))
   end function trace_chunk

   !> Cases in a chunk of film fields of so many numbers a case, if there are as many.
   pure integer function field_chunk(samples) result(chunk)
      integer(i8), intent(in) :: samples

      chunk = int(max(1_i8, chunk_bytes/(bytes_real*samples)))
   end function field_chunk

   !> Numbers in the histories and film fields of one case.
   pure integer(i8) function sample_values(manifest) result(n)
      type(manifest_type), intent(in) :: manifest

      n = manifest%traces*size(manifest%time, kind=i8) + size(manifest%fields%time, kind=i8)*size(manifest%fields%x)
   end function sample_values

   !> About how large the file will be, messages left out; rather more than less, but for half where it is compressed.
   pure integer(i8) function expected_size(manifest) result(bytes)
      type(manifest_type), intent(in) :: manifest
      integer(i8) :: case_bytes, cases, samples
      integer :: i, chunk(2)

      cases = in_chunks(manifest%cases, chunk_cases)
      case_bytes = 6 + bytes_real*(n_measures + n_facts)
      do i = 1, size(manifest%input)
         case_bytes = case_bytes + bytes_real
         if (manifest%input(i)%kind == kind_text) case_bytes = case_bytes + longest_word(manifest%input(i)%word)
      end do
      bytes = cases*case_bytes
      if (size(manifest%time) > 0) then
         chunk = trace_chunk(size(manifest%time))
         samples = in_chunks(size(manifest%time, kind=i8), chunk(1))*in_chunks(manifest%cases, chunk(2))
         bytes = bytes + bytes_real*manifest%traces*samples
      end if
      if (size(manifest%fields%x) > 0) then
         samples = size(manifest%fields%time, kind=i8)*size(manifest%fields%x)
         bytes = bytes + bytes_real*samples*in_chunks(manifest%cases, field_chunk(samples))
      end if
      if (manifest%compress > 0) bytes = bytes/2
      bytes = bytes + bytes_real*size(manifest%time) + len(manifest%deck) + len(manifest%effective) + fixed_bytes &
         & + cases/chunk_cases*2048
   end function expected_size

end module rv_results_netcdf
