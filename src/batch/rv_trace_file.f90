!> Measured pressures from a CSV file.
module rv_trace_file
   use rv_kinds, only : wp
   implicit none
   private
   public :: trace_data

   !> One trace in SI.
   type :: trace_data
      real(wp), allocatable :: time(:)     !! [s], rising
      real(wp), allocatable :: inlet(:)    !! [Pa], (size(time))
      real(wp), allocatable :: outlet(:)   !! [Pa], (size(time))
      character(len=:), allocatable :: note   !! number of rows and checksum of the file
   end type trace_data

end module rv_trace_file
