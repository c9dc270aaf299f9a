!> Where a results.nc comes from, read from the file itself.
module rv_results_origin
   use, intrinsic :: iso_fortran_env, only : int8
   use netcdf, only : nf90_close, nf90_enotatt, nf90_get_att, nf90_get_var, nf90_global, nf90_inq_dimid, nf90_inq_varid, &
      & nf90_inquire_attribute, nf90_inquire_dimension, nf90_noerr, nf90_nowrite, nf90_open, nf90_strerror
   use rv_kinds, only : i8
   use rv_error, only : error_type, fail, rv_bad_input, rv_io
   use rv_status, only : status_ok
   use rv_manifest, only : manifest_type
   implicit none
   private
   public :: read_origin

   integer, parameter :: stretch = 65536   !! cases read at a time

contains

   !> Deck, effective values and version that made the file, and how its cases ended.
   !>
   !> Codes of `error`: rv_bad_input for a NetCDF file of something else, rv_io for one that cannot be read.
   subroutine read_origin(path, origin, cases, failed, error)
      character(len=*), intent(in) :: path
      type(manifest_type), intent(out) :: origin   !! what `difference` compares
      integer(i8), intent(out) :: cases, failed
      type(error_type), allocatable, intent(out) :: error
      integer :: file, flag, ignored

      cases = 0
      failed = 0
      flag = nf90_open(path, nf90_nowrite, file)
      if (flag == nf90_noerr) then
         call get_attribute(file, "deck_name", origin%deck_name, flag)
         call get_attribute(file, "deck", origin%deck, flag)
         call get_attribute(file, "effective_values", origin%effective, flag)
         call get_attribute(file, "code_version", origin%code_version, flag)
         call count_failures(file, cases, failed, flag)
         ignored = nf90_close(file)
      end if
      if (flag == nf90_enotatt) then
         call fail(error, rv_bad_input, "'"//path//"' was not written by reedvalve")
      else if (flag /= nf90_noerr) then
         call fail(error, rv_io, "cannot read '"//path//"': "//trim(nf90_strerror(flag)))
      end if
   end subroutine read_origin

   !> `flag`: nothing is done after a failure.
   subroutine get_attribute(file, name, text, flag)
      integer, intent(in) :: file
      character(len=*), intent(in) :: name
      character(len=:), allocatable, intent(out) :: text
      integer, intent(inout) :: flag
      integer :: length

      length = 0
      if (flag == nf90_noerr) flag = nf90_inquire_attribute(file, nf90_global, name, len=length)
      if (flag /= nf90_noerr) length = 0   ! whatever a failed inquiry made of it
      allocate(character(len=length) :: text)
      if (flag == nf90_noerr .and. length > 0) flag = nf90_get_att(file, nf90_global, name, text)
   end subroutine get_attribute

   subroutine count_failures(file, cases, failed, flag)
      integer, intent(in) :: file
      integer(i8), intent(out) :: cases, failed
      integer, intent(inout) :: flag
      integer(int8) :: status(stretch)
      integer :: dim, var, total, first, n

      cases = 0
      failed = 0
      total = 0
      if (flag == nf90_noerr) flag = nf90_inq_dimid(file, "case", dim)
      if (flag == nf90_noerr) flag = nf90_inquire_dimension(file, dim, len=total)
      if (flag == nf90_noerr) flag = nf90_inq_varid(file, "status", var)
      do first = 1, total, stretch
         n = min(stretch, total - first + 1)
         if (flag == nf90_noerr) flag = nf90_get_var(file, var, status(:n), [first], [n])
         if (flag /= nf90_noerr) return
         failed = failed + count(status(:n) /= status_ok)
      end do
      cases = total
   end subroutine count_failures

end module rv_results_origin
