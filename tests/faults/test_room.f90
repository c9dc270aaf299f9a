!> A monitor that weighs the parts on its way.
module part_scales
   use rv_error, only : error_type
   use rv_kinds, only : i8
   use rv_monitor, only : monitor_type, progress_type
   use rv_posix, only : path_kind
   implicit none
   private
   public :: scales, bytes_of

   !> Says nothing and never stops; adds up the parts on its way.
   type, extends(monitor_type) :: scales
      integer(i8) :: parts = 0   !! largest total seen [byte]
   contains
      procedure :: report => weigh
      procedure :: stop_asked => never
   end type scales

contains

   integer(i8) function bytes_of(path) result(bytes)
      character(len=*), intent(in) :: path
      type(error_type), allocatable :: error
      integer :: kind

      call path_kind(path, kind, error, bytes)
      if (allocated(error)) bytes = -1
   end function bytes_of

   !> What the parts weigh together.
   subroutine weigh(self, progress)
      class(scales), intent(inout) :: self
      type(progress_type), intent(in) :: progress
      integer(i8) :: total
      integer :: i

      if (progress%done < 0) return
      total = 0
      do i = 1, 64
         total = total + max(0_i8, bytes_of(part_path("room_lumped", i))) + max(0_i8, bytes_of(part_path("room_traced", i)))
      end do
      self%parts = max(self%parts, total)
   end subroutine weigh

   pure function part_path(folder, block) result(path)
      character(len=*), intent(in) :: folder
      integer, intent(in) :: block
      character(len=len(folder) + 27) :: path

      write(path, '(a, "/parts/block_", i9.9, ".part")') folder, block
   end function part_path

   logical function never(self)
      class(scales), intent(inout) :: self

      never = self%parts < 0
   end function never

end module part_scales
!> Room on the disk: what a run is said to take is what it takes, and is looked for before anything is computed.
program test_room
   use check, only : suite_type
   use part_scales, only : bytes_of, scales
   use rv_deck, only : deck_type, read_deck
   use rv_error, only : error_type
   use rv_faults, only : fault_list
   use rv_inputs, only : most_csv_cases, new_manifest
   use rv_file, only : write_whole_file
   use rv_kinds, only : wp, i8
   use rv_manifest, only : manifest_type
   use rv_posix, only : free_bytes
   use rv_room, only : check_room_for_run, expected_room, room_type, size_text
   use rv_run, only : run_deck, run_options, run_outcome
   use rv_text, only : to_text
   implicit none

   type(suite_type) :: suite

   call test_truth("lumped", "&run model = 'traditional', 'squeeze' /")
   call test_truth("traced", "&run model = 'squeeze', traces = .true., trace_dt_ms = 0.1 /")
   call test_compressed()
   call test_csv_choice()
   call test_refusal()
   call test_words()
   call suite%finish()

contains

   !> Parts and files of a run are as large as foreseen: none larger, none much smaller.
   subroutine test_truth(name, run_group)
      character(len=*), intent(in) :: name, run_group
      type(deck_type) :: deck
      type(manifest_type) :: manifest
      type(room_type) :: room
      type(run_options) :: options
      type(run_outcome) :: outcome
      type(scales) :: monitor
      type(error_type), allocatable :: error

      call read_text(name, run_group//" &sweep key = 'pressure.inlet_kpa', from = 5, to = 40, count = 300 /" &
         & //" &sweep key = 'film.gap_mm', from = 0.05, to = 0.3, count = 2 /", deck)
      call new_manifest(deck, manifest)
      room = expected_room(manifest)
      options%folder = "room_"//name
      options%threads = 1
      options%force = .true.
      monitor%parts = 0
      call run_deck(deck, options, monitor, outcome, error)
      call suite%no_error("run "//name, error)
      call compare(name//": parts", monitor%parts, room%parts, 0_i8)
      call compare(name//": results.nc", bytes_of("room_"//name//"/results.nc"), room%netcdf, 131072_i8)
      call compare(name//": summary.csv", bytes_of("room_"//name//"/summary.csv"), room%csv, 0_i8)
   end subroutine test_truth

   subroutine compare(what, found, foreseen, fixed)
      character(len=*), intent(in) :: what
      integer(i8), intent(in) :: found, foreseen  !! [byte]
      integer(i8), intent(in) :: fixed            !! what an empty file is allowed

      call suite%true(what//" of "//to_text(found)//" bytes are within the foreseen "//to_text(foreseen), &
         & found <= foreseen*101/100 .and. found > 0)
      call suite%true(what//" are not much less", found >= (foreseen - fixed)*7/10)
   end subroutine compare

   subroutine test_compressed()
      type(deck_type) :: deck
      type(manifest_type) :: manifest
      type(room_type) :: plain, small

      call read_text("compressed", "&run traces = .true., compress = 9 /", deck)
      call new_manifest(deck, manifest)
      call suite%equal("compression of the deck", manifest%compress, 9)
      small = expected_room(manifest)
      manifest%compress = 0
      plain = expected_room(manifest)
      call suite%true("compressed results take less", small%netcdf < plain%netcdf)
      call suite%true("their parts do not", small%parts == plain%parts)
   end subroutine test_compressed

   !> Left out beyond a number of cases, unless the deck says.
   subroutine test_csv_choice()
      call suite%true("a summary of few", has_csv("auto", 1000_i8))
      call suite%true("of as many as are fine", has_csv("auto", most_csv_cases))
      call suite%true("none of more", .not. has_csv("auto", most_csv_cases + 4))
      call suite%true("which is beyond 2 million", most_csv_cases == 2000000_i8)
      call suite%true("unless it is asked for", has_csv("always", 2*most_csv_cases))
      call suite%true("none if none is asked for", .not. has_csv("never", 1000_i8))
   end subroutine test_csv_choice

   logical function has_csv(choice, cases)
      character(len=*), intent(in) :: choice
      integer(i8), intent(in) :: cases
      type(deck_type) :: deck
      type(manifest_type) :: manifest
      type(room_type) :: room

      call read_text("choice", "&run csv = '"//choice//"' / &sweep key = 'pressure.inlet_kpa', from = 5, to = 40, count = " &
         & //to_text(cases/4)//" / &sweep key = 'film.gap_mm', values = 0.05, 0.1, 0.2, 0.3 /", deck)
      call new_manifest(deck, manifest)
      call suite%true("cases of "//choice, manifest%cases == cases)
      has_csv = manifest%has_csv
      room = expected_room(manifest)
      call suite%true("its room is foreseen if it is written", (room%csv > 0) .eqv. has_csv)
   end function has_csv

   subroutine test_refusal()
      type(deck_type) :: deck
      type(manifest_type) :: manifest
      type(error_type), allocatable :: error

      call read_text("refused", "&run traces = .true., trace_dt_ms = 1e-4 /" &
         & //" &sweep key = 'pressure.inlet_kpa', from = 5, to = 40, count = 1000000 /" &
         & //" &sweep key = 'film.gap_mm', from = 0.05, to = 0.3, count = 1000 /", deck)
      call new_manifest(deck, manifest)
      call check_room_for_run(".", manifest, 1.0_wp, .true., .false., error)
      call suite%fails("petabytes", error, "no room for this run: about 16000 TB of parts and 16000 TB of results at the same")
      call suite%true("with advice", index(error%message, "run.trace_dt_ms") > 0)
      call suite%true("but none that is too little", index(error%message, "run.compress") == 0)
      call check_room_for_run(".", manifest, 1.0_wp, .false., .false., error)
      call suite%fails("a slice has parts alone", error, "about 16000 TB of parts, and ")
      call check_room_for_run(".", manifest, 0.0_wp, .false., .false., error)
      call suite%no_error("nothing is left to write", error)
      call check_room_for_run(".", manifest, 0.0_wp, .true., .true., error)
      call suite%fails("only results are left to write", error, "about 16000 TB of results, and ")
      call suite%true("which no edited deck could", index(error%message, "go on there with --resume") > 0 &
         & .and. index(error%message, "run.") == 0)
      call check_room_for_run("no/such/folder", manifest, 1.0_wp, .true., .false., error)
      call suite%no_error("a disk that does not say", error)
      call test_advice()
   end subroutine test_refusal

   !> Results for which the disk is a little too small can be written smaller.
   subroutine test_advice()
      type(deck_type) :: deck
      type(manifest_type) :: manifest
      type(room_type) :: room
      type(error_type), allocatable :: error
      integer(i8) :: free

      call read_text("advised", "&run csv = 'always' /", deck)
      call new_manifest(deck, manifest)
      manifest%cases = 1000000
      room = expected_room(manifest)
      free = free_bytes(".")
      manifest%cases = nint(0.9_wp*real(free, wp)/real(room%netcdf, wp)*1.0e6_wp, i8)
      call check_room_for_run(".", manifest, 0.0_wp, .true., .false., error)
      call suite%fails("results that are too large by their summary", error, "no room for this run")
      call suite%true("can be compressed", index(error%message, "run.compress = 4") > 0)
      call suite%true("or have none", index(error%message, "run.csv = 'never'") > 0)
      manifest%has_csv = .false.
      manifest%compress = 4
      manifest%cases = 3*manifest%cases
      call check_room_for_run(".", manifest, 0.0_wp, .true., .false., error)
      call suite%fails("results that are small already", error, "are free; choose another folder with -o")
   end subroutine test_advice

   subroutine test_words()
      call suite%text("bytes", size_text(12_i8), "12 B")
      call suite%text("kilobytes", size_text(1500_i8), "1.5 kB")
      call suite%text("gigabytes", size_text(320000000000_i8), "320 GB")
   end subroutine test_words

   subroutine read_text(name, text, deck)
      character(len=*), intent(in) :: name, text
      type(deck_type), intent(out) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error

      call write_whole_file("room_"//name//".nml", text//new_line("a"), error)
      call read_deck("room_"//name//".nml", deck, faults, error)
      call suite%equal(name//": faults", faults%errors(), 0)
   end subroutine read_text

end program test_room
