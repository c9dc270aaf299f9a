!> --help and --version.
module rv_cli_help
   use rv_cli_output, only : say
   use rv_cli_table, only : about, commands, files, mpi_help, mpi_usage, on_signals, options, statuses, word_type
   use rv_version, only : code_version, compiler_text, library_text
   implicit none
   private
   public :: print_help, print_version

contains

   subroutine print_help()
      character(len=38) :: usage_column     ! so wide that meanings stand below each other
      character(len=14) :: option_column
      integer :: i

      call say("reedvalve "//code_version//": "//about//".")
      call say("")
      do i = 1, size(commands)
         if (commands(i)%help == "") cycle
         usage_column = "reedvalve "//trim(commands(i)%usage)
         call say("  "//usage_column//" "//trim(commands(i)%help))
         if (commands(i)%name == "run") call say("  "//mpi_usage//"    "//mpi_help)
      end do
      call say("")
      call say("Options (run takes all but --fmi, merge --threads and --quiet, fmu -o, --fmi, --force and --quiet):")
      do i = 1, size(options)
         option_column = trim(options(i)%name)//" "//options(i)%value
         call say("  "//option_column//" "//trim(options(i)%help))
      end do
      call say("")
      call print_listed("Results: ", files, " (", "), ", ").")
      call say(trim(on_signals(1)))
      call say(trim(on_signals(2)))
      call say("")
      call print_listed("Exit status: ", statuses(:3), " ", "; ", ";")
      call print_listed("             ", statuses(4:), " ", "; ", ".")
   end subroutine print_help

   !> One line: the words and what they mean, with what stands between and at the end.
   subroutine print_listed(start, words, between, next, end)
      character(len=*), intent(in) :: start, between, next, end
      type(word_type), intent(in) :: words(:)
      character(len=:), allocatable :: line
      integer :: i

      line = start
      do i = 1, size(words)
         if (i > 1) line = line//next
         line = line//trim(words(i)%name)//between//trim(words(i)%help)
      end do
      call say(line//end)
   end subroutine print_listed

   subroutine print_version()
      call say("reedvalve "//code_version)
      call say(compiler_text())
      call say(library_text())
   end subroutine print_version

end module rv_cli_help
