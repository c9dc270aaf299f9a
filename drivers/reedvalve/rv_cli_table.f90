!> The words of the command line. The parser, --help, the manual page and the completion of shells are all made of them.
module rv_cli_table
   implicit none
   private
   public :: command_type, commands, word_type, options, files, statuses, about, mpi_usage, mpi_help, on_signals, takes

   !> A command, the word for its operand, the options it takes, and how it is used and what for; where this is empty,
   !> --help does not tell of it.
   type :: command_type
      character(len=8) :: name
      character(len=8) :: operand
      logical :: needs_operand
      character(len=48) :: options
      character(len=32) :: usage
      character(len=64) :: help
   end type command_type

   !> A word, the name of the value behind it, if there is one, and what it means.
   type :: word_type
      character(len=16) :: name
      character(len=4) :: value
      character(len=96) :: help
   end type word_type

   character(len=*), parameter :: about = "how a cantilever reed valve opens and closes in oil"

   character(len=*), parameter :: mpi_usage = "mpirun -n N reedvalve_mpi run DECK [options]"
   character(len=*), parameter :: mpi_help = "the same on MPI ranks"

   type(command_type), parameter :: commands(9) = [ &
      & command_type("template", "MODEL", .false., "", &
      & "template [MODEL] > my.nml", "start a deck: every key with its unit, default and meaning"), &
      & command_type("check", "DECK", .true., "--quiet", &
      & "check DECK", "tell all that is wrong with a deck; run nothing"), &
      & command_type("cases", "DECK", .true., "--threads", &
      & "cases DECK", "tell what would run, and about how long"), &
      & command_type("run", "DECK", .true., "-o --threads --slice --resume --force --quiet", &
      & "run DECK [options]", "run all cases of a deck"), &
      & command_type("modes", "DECK", .true., "--quiet", &
      & "modes DECK", "plate modes in vacuum and oil; k_a and k_s that match the film"), &
      & command_type("merge", "DIR", .true., "--threads --quiet", &
      & "merge DIR", "write the results of a run whose cases are all finished"), &
      & command_type("fmu", "DECK", .true., "-o --fmi --force --quiet", &
      & "fmu DECK [options]", "pack a valve for co-simulation (FMI) in other programs"), &
      & command_type("help", "COMMAND", .false., "", "", ""), &
      & command_type("version", "", .false., "", "", "")]

   type(word_type), parameter :: options(7) = [ &
      & word_type("-o", "DIR", "folder for the results (default: the deck's name without .nml, here); fmu: its file"), &
      & word_type("--fmi", "V", "version of FMI, 2 or 3 (default: 3)"), &
      & word_type("--threads", "N", "threads to use (default: all processors; of an MPI rank: 1)"), &
      & word_type("--slice", "I/N", "run slice I of N only; slices may run at once, on many hosts; then: reedvalve merge DIR"), &
      & word_type("--resume", "", "go on with a run that was stopped or killed"), &
      & word_type("--force", "", "replace results that are there"), &
      & word_type("--quiet", "", "print errors only")]

   type(word_type), parameter :: files(3) = [ &
      & word_type("DIR/summary.csv", "", "one row a case"), &
      & word_type("DIR/results.nc", "", "everything"), &
      & word_type("DIR/run.log", "", "when and where")]

   character(len=*), parameter :: on_signals(2) = [character(len=112) :: &
      & "Ctrl-C (SIGINT, SIGTERM, SIGUSR1, SIGHUP) finishes the blocks under way; nothing finished is lost, and", &
      & "--resume goes on, with any number of threads, ranks or slices."]

   type(word_type), parameter :: statuses(5) = [ &
      & word_type("0", "", "all cases fine"), &
      & word_type("1", "", "some failed, or the run was stopped"), &
      & word_type("2", "", "bad command line or deck"), &
      & word_type("3", "", "a file cannot be read or written"), &
      & word_type("4", "", "a fault of reedvalve itself")]

contains

   !> Does a command take an option?
   pure logical function takes(command, option)
      type(command_type), intent(in) :: command
      character(len=*), intent(in) :: option

      takes = index(" "//trim(command%options)//" ", " "//trim(option)//" ") > 0
   end function takes

end module rv_cli_table
