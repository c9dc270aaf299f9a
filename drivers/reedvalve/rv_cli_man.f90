!> The manual page, in the macros of man(7).
module rv_cli_man
   use rv_cli_output, only : say
   use rv_cli_table, only : about, commands, files, mpi_help, mpi_usage, on_signals, options, statuses, word_type
   use rv_version, only : code_version
   implicit none
   private
   public :: print_manual

contains

   subroutine print_manual()
      call say('.TH REEDVALVE 1 "" "reedvalve '//code_version//'" "User Commands"')
      call say(".SH NAME")
      call say("reedvalve, reedvalve_mpi \- "//about)
      call say(".SH SYNOPSIS")
      call print_usages(.false.)
      call say(".SH DESCRIPTION")
      call say("A deck, a file of Fortran namelist groups, describes a valve, the pressures around it and what to vary.")
      call say("The program integrates the motion of each case and writes how far the reed opens and how fast it closes.")
      call say("Every key of a deck ends in its unit, and what is left out has a default.")
      call say(".SH COMMANDS")
      call print_usages(.true.)
      call say(".SH OPTIONS")
      call print_words(options)
      call say(".SH SIGNALS")
      call print_plain(on_signals(1))
      call print_plain(on_signals(2))
      call say(".SH EXIT STATUS")
      call print_words(statuses)
      call say(".SH ENVIRONMENT")
      call print_words([word_type("OMP_NUM_THREADS", "", "how many threads there are where --threads is not given")])
      call say(".SH FILES")
      call print_words(files)
      call say(".SH EXAMPLES")
      call print_example("reedvalve template squeeze > my.nml")
      call print_example("reedvalve run my.nml")
      call say(".SH SEE ALSO")
      call say("Beside the folder of the program: share/doc/reedvalve/docs (guide, all keys, theory, interfaces) and")
      call say("share/reedvalve/inputs (decks).")
   end subroutine print_manual

   !> How the commands are used: a line each, or with what they do and the options they take.
   subroutine print_usages(in_full)
      logical, intent(in) :: in_full
      integer :: i

      do i = 1, size(commands)
         if (commands(i)%help == "") cycle
         call print_usage("reedvalve "//commands(i)%usage, commands(i)%help, in_full)
         if (in_full .and. commands(i)%options /= "") then
            call say(".br")
            call print_plain("Options: "//commands(i)%options)
         end if
         if (commands(i)%name == "run") call print_usage(mpi_usage, mpi_help, in_full)
      end do
      call print_usage("reedvalve --help", "tell what there is", in_full)
      call print_usage("reedvalve --version", "tell the versions of the program and its libraries", in_full)
   end subroutine print_usages

   subroutine print_usage(usage, help, in_full)
      character(len=*), intent(in) :: usage, help
      logical, intent(in) :: in_full

      if (in_full) call say(".TP")
      call print_plain(".B "//usage)
      if (in_full) call print_plain(help)
      if (.not. in_full) call say(".br")
   end subroutine print_usage

   subroutine print_words(words)
      type(word_type), intent(in) :: words(:)
      integer :: i

      do i = 1, size(words)
         call say(".TP")
         call print_plain(".B "//trim(words(i)%name)//" "//words(i)%value)
         call print_plain(words(i)%help)
      end do
   end subroutine print_words

   subroutine print_example(command)
      character(len=*), intent(in) :: command

      call say(".PP")
      call say(".RS")
      call print_plain("$ "//command)
      call say(".RE")
   end subroutine print_example

   !> A line of text, with hyphens that can be copied from a terminal; nothing for an empty one.
   subroutine print_plain(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: line
      integer :: i

      line = ""
      do i = 1, len_trim(text)
         if (text(i:i) == "-") line = line//"\"
         line = line//text(i:i)
      end do
      if (line /= "") call say(line)
   end subroutine print_plain

end module rv_cli_man
