!> --help and --version.
module rv_cli_help
   use rv_cli_output, only : say
   use rv_version, only : code_version, compiler_text, library_text
   implicit none
   private
   public :: print_help, print_version

contains

   subroutine print_help()
      call say("reedvalve "//code_version//": how a cantilever reed valve opens and closes in oil.")
      call say("")
      call say("  reedvalve template [MODEL] > my.nml    start a deck: every key with its unit, default and meaning")
      call say("  reedvalve check DECK                   tell all that is wrong with a deck; run nothing")
      call say("  reedvalve cases DECK                   tell what would run, and about how long")
      call say("  reedvalve run DECK [options]           run all cases of a deck")
      call say("  mpirun -n N reedvalve_mpi run DECK [options]    the same on MPI ranks")
      call say("  reedvalve modes DECK                   plate modes in vacuum and oil; k_a and k_s that match the film")
      call say("  reedvalve merge DIR                    write the results of a run whose cases are all finished")
      call say("")
      call say("Options of run (merge takes --threads and --quiet):")
      call say("  -o DIR         folder for the results (default: the deck's name without .nml, here)")
      call say("  --threads N    threads to use (default: all processors; of an MPI rank: 1)")
      call say("  --slice I/N    run slice I of N only; slices may run at once, on many hosts; then: reedvalve merge DIR")
      call say("  --resume       go on with a run that was stopped or killed")
      call say("  --force        replace results that are there")
      call say("  --quiet        print errors only")
      call say("")
      call say("Results: DIR/summary.csv (one row a case), DIR/results.nc (everything), DIR/run.log (when and where).")
      call say("Ctrl-C (SIGINT, SIGTERM, SIGUSR1, SIGHUP) finishes the blocks under way; nothing finished is lost, and")
      call say("--resume goes on, with any number of threads, ranks or slices.")
      call say("")
      call say("Exit status: 0 all cases fine; 1 some failed, or the run was stopped; 2 bad command line or deck;")
      call say("             3 a file cannot be read or written; 4 a fault of reedvalve itself.")
   end subroutine print_help

   subroutine print_version()
      call say("reedvalve "//code_version)
      call say(compiler_text())
      call say(library_text())
   end subroutine print_version

end module rv_cli_help
