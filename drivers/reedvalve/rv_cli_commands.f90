!> The commands of the program; each returns its exit status.
module rv_cli_commands
   use omp_lib, only : omp_get_max_threads
   use rv_block, only : block_count, block_result, run_block, trace_times
   use rv_cli_arguments, only : arguments_type
   use rv_cli_output, only : complain, exit_bad, exit_fine, remark, say, status_of
   use rv_cli_progress, only : duration_text, progress_bar
   use rv_cli_report, only : counted, report_run
   use rv_crew, only : crew_type
   use rv_deck, only : deck_type, read_deck
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_faults, only : fault_list
   use rv_inputs, only : new_manifest
   use rv_key_text, only : write_template
   use rv_keys, only : default_value, full_name, key_run_model, keys, real_key, value_text
   use rv_kinds, only : wp, i8
   use rv_manifest, only : manifest_type
   use rv_modes, only : modes_text
   use rv_posix, only : catch_signals, is_terminal, seconds
   use rv_room, only : expected_room, room_type, size_text
   use rv_run, only : merge_folder, run_options, run_outcome, run_with_crew
   use rv_text, only : to_text
   implicit none
   private
   public :: run_command, merge_command, check_command, cases_command, modes_command, template_command
   public :: load_deck

   integer(i8), parameter :: sample_cases = 64      !! cases in one sample for the estimate: as many as share lanes
   integer, parameter :: samples = 4                !! spread over the deck
   real(wp), parameter :: sample_seconds = 2.0_wp   !! no further sample after that [s]
   real(wp), parameter :: long_run = 10.0_wp        !! worth a thought about threads [s]
   character(len=*), parameter :: notice = "reedvalve: stopping when the blocks under way are done" &
      & //" (once more stops at once, and they are lost)"

contains

   integer function run_command(arguments, crew) result(status)
      type(arguments_type), intent(in) :: arguments
      class(crew_type), intent(inout) :: crew
      type(deck_type) :: deck
      type(run_options) :: options
      type(run_outcome) :: outcome
      type(progress_bar) :: progress
      type(error_type), allocatable :: error
      logical :: loaded

      ! before all meet: no rank begins a run that another would be killed in by a mere word to stop
      progress%quiet = arguments%quiet .or. .not. crew%leads
      call watch_signals(progress%quiet)
      call load_for_all(arguments, crew, deck, loaded, status)
      if (.not. loaded) return
      options%folder = arguments%folder
      if (options%folder == "") options%folder = deck%name
      options%threads = arguments%threads
      if (options%threads == 0) options%threads = crew%usual_threads
      options%resume = arguments%resume
      options%force = arguments%force
      options%slice = arguments%slice
      options%slices = arguments%slices
      call run_with_crew(deck, options, crew, progress, outcome, error)
      if (.not. crew%leads) return
      call progress%clear()
      status = report_run(arguments, options%folder, outcome, error)
   end function run_command

   !> Every process reads the deck by itself, the leader tells what is wrong. Only if all of them can run it is it
   !> loaded for any.
   subroutine load_for_all(arguments, crew, deck, loaded, status)
      type(arguments_type), intent(in) :: arguments
      class(crew_type), intent(inout) :: crew
      type(deck_type), intent(out) :: deck
      logical, intent(out) :: loaded
      integer, intent(out) :: status              !! for the end of the program; the leader's counts
      type(fault_list) :: faults
      type(error_type), allocatable :: error

      status = exit_fine
      if (crew%leads) then
         status = load_deck(arguments, deck)
         if (status /= exit_fine) call fail(error, rv_bad_input, "the leader has told why")
      else
         call read_deck(arguments%operand, deck, faults, error)
         if (.not. allocated(error) .and. faults%errors() > 0) call fail(error, rv_bad_input, faults%text(1))
      end if
      call crew%share(error)
      loaded = .not. allocated(error)
      if (loaded .or. status /= exit_fine .or. .not. crew%leads) return
      call complain(error%message)
      status = status_of(error)
   end subroutine load_for_all

   integer function merge_command(arguments) result(status)
      type(arguments_type), intent(in) :: arguments
      type(run_outcome) :: outcome
      type(progress_bar) :: progress
      type(error_type), allocatable :: error

      progress%quiet = arguments%quiet
      call watch_signals(arguments%quiet)
      call merge_folder(arguments%operand, arguments%threads, progress, outcome, error)
      call progress%clear()
      status = report_run(arguments, arguments%operand, outcome, error)
   end function merge_command

   integer function check_command(arguments) result(status)
      type(arguments_type), intent(in) :: arguments
      type(deck_type) :: deck

      status = load_deck(arguments, deck)
      if (status == exit_fine .and. .not. arguments%quiet) call say(arguments%operand//" is fine: " &
         & //counted(deck%case_count(), "case")//".")
   end function check_command

   !> A commented deck of all keys, for standard output.
   integer function template_command(arguments) result(status)
      type(arguments_type), intent(in) :: arguments
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text, model

      model = arguments%operand
      if (model == "") model = value_text(key_run_model, default_value(key_run_model))
      call write_template(model, text, error)
      status = exit_fine
      if (allocated(error)) then
         call complain(error%message)
         status = status_of(error)
      else
         call say(text(:len(text) - 1))
      end if
   end function template_command

   !> What plate and film of the first case say, for standard output.
   integer function modes_command(arguments) result(status)
      type(arguments_type), intent(in) :: arguments
      type(deck_type) :: deck
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text

      status = load_deck(arguments, deck)
      if (status /= exit_fine) return
      call modes_text(deck, text, error)
      if (allocated(error)) then
         call complain(arguments%operand//": "//error%message)
         status = status_of(error)
      else
         call say(text(:len(text) - 1))
      end if
   end function modes_command

   !> What would run, how many cases, and about how long it would take.
   integer function cases_command(arguments) result(status)
      type(arguments_type), intent(in) :: arguments
      type(deck_type) :: deck
      type(manifest_type) :: manifest
      type(room_type) :: room
      real(wp) :: cost
      integer :: i, blocks, threads

      status = load_deck(arguments, deck)
      if (status /= exit_fine) return
      blocks = block_count(deck)
      call say(counted(deck%case_count(), "case")//" in "//counted(int(blocks, i8), "block"))
      do i = 1, size(deck%axis)
         call say("  "//axis_line(deck, i))
      end do
      if (deck%has_design) call say("  design of "//counted(size(deck%design, 2, i8), "row")//": "//design_keys(deck))
      if (size(trace_times(deck)) > 0) call say("  traces of "//to_text(size(trace_times(deck)))//" times a case")
      threads = arguments%threads
      if (threads == 0) threads = omp_get_max_threads()
      cost = seconds_per_case(deck)*real(deck%case_count(), wp)
      call new_manifest(deck, manifest)
      room = expected_room(manifest)
      call say("About "//duration_text(cost/real(min(threads, blocks), wp))//" with " &
         & //counted(int(min(threads, blocks), i8), "thread")//" to compute, estimated from a few cases run just now." &
         & //" Writing comes on top" &
         & //trim(merge(": run.compress makes it slower.", ".                              ", manifest%compress > 0)))
      call say(size_text(room%netcdf)//" for results.nc and "//csv_text(manifest, room)//", and "//size_text(room%parts) &
         & //" for parts until "//trim(merge("both are written.", "it is written.   ", manifest%has_csv)))
      if (blocks < threads .and. cost > long_run) call say("A block runs on one thread: run.block_size = " &
         & //to_text((deck%case_count() + threads - 1)/threads)//" or less would keep " &
         & //counted(int(threads, i8), "thread")//" busy.")
   end function cases_command

   !> "408 kB for summary.csv"
   pure function csv_text(manifest, room) result(text)
      type(manifest_type), intent(in) :: manifest
      type(room_type), intent(in) :: room
      character(len=:), allocatable :: text

      text = "no summary.csv"
      if (manifest%has_csv) text = size_text(room%csv)//" for summary.csv"
   end function csv_text

   !> Read a deck and tell its faults and warnings; exit_fine if it can be run.
   integer function load_deck(arguments, deck) result(status)
      type(arguments_type), intent(in) :: arguments
      type(deck_type), intent(out) :: deck
      type(fault_list) :: faults
      type(error_type), allocatable :: error
      integer :: i

      call read_deck(arguments%operand, deck, faults, error)
      status = exit_fine
      if (allocated(error)) then
         call complain(error%message)
         status = status_of(error)
         return
      end if
      do i = 1, faults%count()
         if (.not. (faults%is_warning(i) .and. arguments%quiet)) call remark(faults%text(i))
      end do
      if (faults%errors() == 0) return
      call complain(counted(int(faults%errors(), i8), "fault")//" in "//arguments%operand//"; nothing was run")
      status = exit_bad
   end function load_deck

   !> Without the handler a run is as safe, only less polite; a failure to set it is no reason to stop.
   subroutine watch_signals(quiet)
      logical, intent(in) :: quiet
      type(error_type), allocatable :: ignored

      if (quiet) then
         call catch_signals("", ignored)
      else if (is_terminal(2)) then
         call catch_signals(new_line("a")//notice//new_line("a"), ignored)   ! behind the bar
      else
         call catch_signals(notice//new_line("a"), ignored)
      end if
   end subroutine watch_signals

   !> Mean time of a case on one thread, from samples spread over the deck [s].
   real(wp) function seconds_per_case(deck)
      type(deck_type), intent(in) :: deck
      type(block_result) :: result
      integer(i8) :: n, first, last, done
      real(wp) :: start, elapsed
      integer :: i

      n = deck%case_count()
      done = 0
      start = seconds()
      do i = 1, samples
         first = 1 + (n - 1)*(i - 1)/samples
         last = min(n, first + sample_cases - 1)
         call run_block(deck, first, last, result)
         done = done + last - first + 1
         elapsed = seconds() - start
         if (done >= n .or. elapsed > sample_seconds) exit
      end do
      seconds_per_case = elapsed/real(done, wp)
   end function seconds_per_case

   !> "pressure.inlet_kpa: 8 values, 5 to 40 kPa"
   function axis_line(deck, i) result(line)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: i
      character(len=:), allocatable :: line
      integer :: j

      associate (axis => deck%axis(i))
         line = full_name(axis%key)//": "//counted(size(axis%value, kind=i8), "value")
         if (keys(axis%key)%kind == real_key) then
            line = line//", "//value_text(axis%key, minval(axis%value))//" to " &
               & //value_text(axis%key, maxval(axis%value))//" "//trim(keys(axis%key)%unit)
         else
            do j = 1, min(4, size(axis%value))
               line = line//", "//word_of(deck, axis%key, axis%value(j))
            end do
            if (size(axis%value) > 4) line = line//", ..."
         end if
      end associate
   end function axis_line

   function design_keys(deck) result(line)
      type(deck_type), intent(in) :: deck
      character(len=:), allocatable :: line
      integer :: i

      line = full_name(deck%design_key(1))
      do i = 2, size(deck%design_key)
         line = line//", "//full_name(deck%design_key(i))
      end do
   end function design_keys

   function word_of(deck, key, value) result(word)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: key
      real(wp), intent(in) :: value
      character(len=:), allocatable :: word

      word = value_text(key, value)
      if (word == "") word = deck%trace_name(nint(value))%s
   end function word_of

end module rv_cli_commands
