!> An FMU from a deck of one case: a ZIP archive of the model description, the library, what it reads, and licences.
module rv_fmu_pack
   use, intrinsic :: iso_c_binding, only : c_char, c_f_pointer, c_int, c_loc, c_null_char, c_ptr, c_size_t
   use rv_cases, only : deck_type
   use rv_error, only : error_type, fail, rv_bad_input, rv_io
   use rv_file, only : claim_whole_file, read_whole_file, write_whole_file
   use rv_fmu_description, only : describe, library_name, trace_name, valve_deck
   use rv_keys, only : kind_trace, key_pressure_file, key_pressure_kind, n_keys
   use rv_kinds, only : i8, wp
   use rv_posix, only : c_text, path_file, path_kind, path_none
   use rv_text, only : text_type, to_text
   use rv_text_builder, only : append_text
   implicit none
   private
   public :: pack_fmu

   character(len=*), parameter :: license_file = "license.txt"
   !> Run-time libraries of the compiler, which come as shared ones only: those of this program go into the FMU.
   character(len=*), parameter :: companions(3) = [character(len=15) :: "libgfortran.so.", "libquadmath.so.", "libgomp.so."]
   integer, parameter :: longest_path = 4096   !! [byte]

   type :: archive_type
      type(text_type), allocatable :: name(:)
      type(text_type), allocatable :: data(:)
   end type archive_type

   interface
      integer(c_int) function c_folder(buffer, size) bind(C, name="rv_fmu_folder")
         import :: c_int, c_ptr, c_size_t
         type(c_ptr), value :: buffer
         integer(c_size_t), value :: size
      end function c_folder
      subroutine c_platform(buffer, size) bind(C, name="rv_fmu_platform")
         import :: c_ptr, c_size_t
         type(c_ptr), value :: buffer
         integer(c_size_t), value :: size
      end subroutine c_platform
      integer(c_int) function c_loaded(prefix, buffer, size) bind(C, name="rv_fmu_loaded_library")
         import :: c_char, c_int, c_ptr, c_size_t
         character(kind=c_char), intent(in) :: prefix(*)
         type(c_ptr), value :: buffer
         integer(c_size_t), value :: size
      end function c_loaded
      subroutine c_token(deck, size, token) bind(C, name="rv_fmu_token")
         import :: c_ptr, c_size_t
         type(c_ptr), value :: deck, token
         integer(c_size_t), value :: size
      end subroutine c_token
      integer(c_int) function c_archive(n, name, data, size, bytes, length) bind(C, name="rv_fmu_archive")
         import :: c_int, c_ptr, c_size_t
         integer(c_int), value :: n
         type(c_ptr), intent(in) :: name(*), data(*)
         integer(c_size_t), intent(in) :: size(*)
         type(c_ptr), intent(out) :: bytes
         integer(c_size_t), intent(out) :: length
      end function c_archive
      subroutine c_release(bytes) bind(C, name="rv_fmu_release")
         import :: c_ptr
         type(c_ptr), value :: bytes
      end subroutine c_release
   end interface

contains

   !> Write the FMU of a checked deck, whole or not at all.
   subroutine pack_fmu(deck, fmi, path, force, error)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: fmi     !! version of FMI: 2 or 3
      character(len=*), intent(in) :: path
      logical, intent(in) :: force   !! a file that is there may go
      type(error_type), allocatable, intent(out) :: error
      type(archive_type) :: archive
      character(len=:), allocatable :: bytes
      integer :: kind
      logical :: taken

      if (deck%case_count() /= 1_i8) then
         call fail(error, rv_bad_input, deck%path//": an FMU is one case, these are "//to_text(deck%case_count()))
         return
      end if
      call path_kind(path, kind, error)
      if (.not. allocated(error) .and. kind /= path_none .and. kind /= path_file) then
         call fail(error, rv_bad_input, "'"//path//"' is not a file")
      end if
      if (.not. allocated(error)) call collect(deck, fmi, archive, error)
      if (.not. allocated(error)) call zip(archive, bytes, error)
      if (allocated(error)) return
      taken = .false.
      if (force) then
         call write_whole_file(path, bytes, error)
      else
         call claim_whole_file(path, bytes, taken, error)
      end if
      if (taken) call fail(error, rv_bad_input, "'"//path &
         & //"' is there already; --force replaces it")
   end subroutine pack_fmu

   !> All that is in the FMU.
   subroutine collect(deck, fmi, archive, error)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: fmi
      type(archive_type), intent(out) :: archive
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: settings, description, folder, binaries

      allocate(archive%name(0), archive%data(0))
      call valve_deck(deck, settings)
      call describe(deck, fmi, token_of(settings), description)
      call add(archive, "modelDescription.xml", description)
      call find_folder(folder, error)
      if (.not. allocated(error)) call name_binaries(fmi, platform(), binaries, error)
      if (allocated(error)) return
      call add_file(archive, binaries//library_name//".so", folder//library_name//".so", error)
      if (.not. allocated(error)) call add_companions(archive, binaries, error)
      if (.not. allocated(error)) call add_file(archive, "documentation/licenses/license.txt", folder//license_file, error)
      call add(archive, "resources/valve.nml", settings)
      if (.not. allocated(error)) call add_trace(archive, deck, error)
   end subroutine collect

   subroutine add(archive, name, data)
      type(archive_type), intent(inout) :: archive
      character(len=*), intent(in) :: name, data

      call append_text(archive%name, name//c_null_char)
      call append_text(archive%data, data)
   end subroutine add

   subroutine add_file(archive, name, path, error)
      type(archive_type), intent(inout) :: archive
      character(len=*), intent(in) :: name, path
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: data
      logical :: found

      call read_whole_file(path, data, found, error)
      if (allocated(error)) return
      if (found) then
         call add(archive, name, data)
      else
         call fail(error, rv_io, "there is no '"//path//"', which goes into every FMU")
      end if
   end subroutine add_file

   subroutine add_companions(archive, binaries, error)
      type(archive_type), intent(inout) :: archive
      character(len=*), intent(in) :: binaries
      type(error_type), allocatable, intent(out) :: error
      character(len=longest_path), target :: buffer
      character(len=:), allocatable :: path
      integer :: i

      do i = 1, size(companions)
         if (c_loaded(c_text(trim(companions(i))), c_loc(buffer), len(buffer, c_size_t)) == 0) cycle
         path = buffer(:index(buffer, c_null_char) - 1)
         call add_file(archive, binaries//path(index(path, "/", back=.true.) + 1:), path, error)
         if (allocated(error)) return
      end do
   end subroutine add_companions

   subroutine add_trace(archive, deck, error)
      type(archive_type), intent(inout) :: archive
      type(deck_type), intent(in) :: deck
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: value(n_keys)

      call deck%case_values(1_i8, value)
      if (nint(value(key_pressure_kind)) /= kind_trace) return
      call add_file(archive, "resources/"//trace_name, deck%trace_file(nint(value(key_pressure_file)))%s, error)
   end subroutine add_trace

   !> Where the FMU's library lies: beside this program's folder as installed, or in the build tree.
   subroutine find_folder(folder, error)
      character(len=:), allocatable, intent(out) :: folder
      type(error_type), allocatable, intent(out) :: error
      character(len=longest_path), target :: buffer

      folder = ""
      if (c_folder(c_loc(buffer), len(buffer, c_size_t)) == 0) then
         folder = buffer(:index(buffer, c_null_char) - 1)
      else
         call fail(error, rv_io, "cannot find the library that goes into an FMU: there is no folder '" &
            & //buffer(:index(buffer, c_null_char) - 1)//"'")
      end if
   end subroutine find_folder

   !> Folder of the library in an FMU, with a / at its end. FMI 2.0 has names for few machines.
   subroutine name_binaries(fmi, machine, folder, error)
      integer, intent(in) :: fmi
      character(len=*), intent(in) :: machine   !! as FMI 3.0 names it
      character(len=:), allocatable, intent(out) :: folder
      type(error_type), allocatable, intent(out) :: error

      folder = "binaries/"//machine//"/"
      if (fmi == 3) return
      folder = "binaries/linux64/"
      if (machine /= "x86_64-linux") call fail(error, rv_bad_input, "FMI 2.0 has no name for '"//machine &
         & //"', this kind of machine: take --fmi 3")
   end subroutine name_binaries

   !> This kind of machine, as FMI 3.0 names it.
   function platform() result(name)
      character(len=:), allocatable :: name
      character(len=40), target :: buffer

      call c_platform(c_loc(buffer), len(buffer, c_size_t))
      name = buffer(:index(buffer, c_null_char) - 1)
   end function platform

   function token_of(settings) result(token)
      character(len=*), target, intent(in) :: settings
      character(len=:), allocatable :: token
      character(len=64), target :: buffer

      call c_token(c_loc(settings), len(settings, c_size_t), c_loc(buffer))
      token = buffer(:index(buffer, c_null_char) - 1)
   end function token_of

   subroutine zip(archive, bytes, error)
      type(archive_type), target, intent(in) :: archive
      character(len=:), allocatable, intent(out) :: bytes
      type(error_type), allocatable, intent(out) :: error
      type(c_ptr) :: name(size(archive%name)), data(size(archive%name)), packed
      integer(c_size_t) :: size_of(size(archive%name)), length
      integer :: i

      do i = 1, size(name)
         name(i) = c_loc(archive%name(i)%s)
         data(i) = c_loc(archive%data(i)%s)
         size_of(i) = len(archive%data(i)%s, c_size_t)
      end do
      if (c_archive(size(name, kind=c_int), name, data, size_of, packed, length) == 0) then
         call copy_from(packed, length, bytes)
      else
         call fail(error, rv_io, "the archive could not be made")
      end if
      call c_release(packed)
   end subroutine zip

   subroutine copy_from(packed, length, bytes)
      type(c_ptr), intent(in) :: packed
      integer(c_size_t), intent(in) :: length
      character(len=:), allocatable, intent(out) :: bytes
      character(kind=c_char, len=length), pointer :: text

      call c_f_pointer(packed, text)
      bytes = text
   end subroutine copy_from

end module rv_fmu_pack
