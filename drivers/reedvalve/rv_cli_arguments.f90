!> The command line, taken apart and checked.
module rv_cli_arguments
   use rv_cli_table, only : command_type, commands, takes
   use rv_error, only : error_type, fail, rv_bad_input
   use rv_suggest, only : closest
   use rv_text, only : text_type
   implicit none
   private
   public :: arguments_type, read_arguments

   type :: arguments_type
      character(len=:), allocatable :: command   !! "run", ..., "help" or "version"
      character(len=:), allocatable :: operand   !! the deck, folder or model; empty: none
      character(len=:), allocatable :: folder    !! -o; empty: none
      integer :: threads = 0                     !! 0: not given
      integer :: fmi = 3                         !! version of FMI
      integer :: slice = 1                       !! --slice I/N
      integer :: slices = 0                      !! 0: not given
      logical :: resume = .false.
      logical :: force = .false.
      logical :: quiet = .false.
   end type arguments_type

   integer, parameter :: most_threads = 1024
   integer, parameter :: most_slices = 1000000

contains

   !> Read the command line of this program.
   subroutine read_arguments(arguments, error)
      type(arguments_type), intent(out) :: arguments
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: word
      integer :: place, command

      arguments%operand = ""
      arguments%folder = ""
      call find_command(arguments%command, command, error)
      place = 2
      do while (place <= command_argument_count() .and. .not. allocated(error))
         word = argument(place)
         if (word == "--help" .or. word == "-h") then
            arguments%command = "help"
            return
         else if (word(1:min(1, len(word))) == "-" .and. len(word) > 1) then
            call take_option(arguments, commands(command), place, error)
         else if (commands(command)%operand == "") then
            call bad(error, "'"//trim(commands(command)%name)//"' takes nothing more; what is '"//word//"'?")
         else if (arguments%operand /= "") then
            call bad(error, "one "//trim(commands(command)%operand)//" at a time: '"//arguments%operand &
               & //"' and '"//word//"' are two")
         else
            arguments%operand = word
         end if
         place = place + 1
      end do
      if (allocated(error) .or. arguments%operand /= "" .or. .not. commands(command)%needs_operand) return
      call bad(error, "which "//trim(commands(command)%operand)//"? The command is: reedvalve " &
         & //trim(commands(command)%name)//" "//trim(commands(command)%operand))
   end subroutine read_arguments

   !> The first word: a command, or --help or --version.
   subroutine find_command(name, command, error)
      character(len=:), allocatable, intent(out) :: name
      integer, intent(out) :: command
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: meant

      name = argument(1)
      if (name == "--help" .or. name == "-h") name = "help"
      if (name == "--version" .or. name == "-V") name = "version"
      do command = 1, size(commands)
         if (commands(command)%name == name) return
      end do
      command = 1
      if (name == "") then
         call bad(error, "which command? For example: reedvalve run DECK")
      else if (index(name, ".nml") > 0) then
         call bad(error, "say what to do with '"//name//"': reedvalve run "//name)
      else
         meant = closest(name, word_list(names_of_commands()))
         if (meant == "") call bad(error, "'"//name//"' is not a command; they are "//names_of_commands())
         if (meant /= "") call bad(error, "'"//name//"' is not a command; did you mean '"//meant//"'?")
      end if
   end subroutine find_command

   !> Take the option at `place`, and its value, which stands behind a '=' or comes next.
   subroutine take_option(arguments, command, place, error)
      type(arguments_type), intent(inout) :: arguments
      type(command_type), intent(in) :: command
      integer, intent(inout) :: place
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: option, value, meant
      logical :: has_value

      option = argument(place)
      if (index(option, "-o") == 1 .and. len(option) > 2 .and. index(option, "=") == 0) option = "-o="//option(3:)
      has_value = index(option, "=") > 0
      value = option(index(option//"=", "=") + 1:)
      if (has_value) option = option(:index(option, "=") - 1)
      if (.not. takes(command, option)) then
         meant = closest(option, word_list(trim(command%options)))
         if (meant /= "") meant = "; did you mean '"//meant//"'?"
         call bad(error, "'"//trim(command%name)//"' has no option '"//option//"'"//meant)
         return
      end if
      if (option == "-o" .or. option == "--fmi" .or. option == "--threads" .or. option == "--slice") then
         if (.not. has_value) then
            place = place + 1
            value = argument(place)
         end if
         if (value == "") then
            call bad(error, "'"//option//"' needs a value behind it")
            return
         end if
      else if (has_value) then
         call bad(error, "'"//option//"' takes no value")
         return
      end if
      select case (option)
      case ("-o")
         arguments%folder = value
      case ("--fmi")
         if (value /= "2" .and. value /= "3") call bad(error, "--fmi takes 2 or 3, not '"//value//"'")
         arguments%fmi = merge(2, 3, value == "2")
      case ("--threads")
         if (.not. is_count(value, most_threads, arguments%threads)) call bad(error, "--threads takes a whole number " &
            & //"from 1 to 1024, not '"//value//"'")
      case ("--slice")
         call read_slice(value, arguments, error)
      case ("--resume")
         arguments%resume = .true.
      case ("--force")
         arguments%force = .true.
      case default
         arguments%quiet = .true.
      end select
      if (allocated(error) .or. .not. arguments%force) return
      if (arguments%resume) call bad(error, "--resume goes on with an unfinished run, --force drops it: choose one")
      if (arguments%slices > 0) call bad(error, "--slice adds to a run in pieces, --force drops what others finished: " &
         & //"choose one")
   end subroutine take_option

   !> "2/7"
   subroutine read_slice(value, arguments, error)
      character(len=*), intent(in) :: value
      type(arguments_type), intent(inout) :: arguments
      type(error_type), allocatable, intent(out) :: error
      integer :: bar
      logical :: good

      bar = index(value, "/")
      good = .false.
      if (bar > 0) good = is_count(value(bar + 1:), most_slices, arguments%slices)
      if (good) good = is_count(value(:bar - 1), arguments%slices, arguments%slice)
      if (.not. good) call bad(error, "--slice takes I/N, slice I of N, with whole numbers 1 <= I <= N, not '"//value//"'")
   end subroutine read_slice

   !> Is `text` a whole number from 1 to `most`? Then it is in `number`.
   logical function is_count(text, most, number)
      character(len=*), intent(in) :: text
      integer, intent(in) :: most
      integer, intent(out) :: number
      integer :: status

      number = 0
      status = 1
      if (len(text) > 0 .and. verify(text, "0123456789") == 0) read(text, *, iostat=status) number
      is_count = status == 0 .and. number >= 1 .and. number <= most
   end function is_count

   subroutine bad(error, message)
      type(error_type), allocatable, intent(out) :: error
      character(len=*), intent(in) :: message

      call fail(error, rv_bad_input, message)
   end subroutine bad

   !> An argument of the program; empty if there is none.
   function argument(place) result(text)
      integer, intent(in) :: place
      character(len=:), allocatable :: text
      integer :: length

      text = ""
      if (place > command_argument_count()) return
      call get_command_argument(place, length=length)
      deallocate(text)
      allocate(character(len=length) :: text)
      if (length > 0) call get_command_argument(place, text)
   end function argument

   !> "run merge check ..."
   pure function names_of_commands() result(names)
      character(len=:), allocatable :: names
      integer :: i

      names = ""
      do i = 1, size(commands)
         names = names//trim(commands(i)%name)//" "
      end do
      names = trim(names)
   end function names_of_commands

   pure function word_list(text) result(list)
      character(len=*), intent(in) :: text        !! words with single blanks between them
      type(text_type), allocatable :: list(:)
      integer :: i, first, blank

      allocate(list(count([(text(i:i) == " ", i=1, len(text))]) + 1))
      first = 1
      do i = 1, size(list)
         blank = index(text(first:)//" ", " ")
         list(i)%s = text(first:first + blank - 2)
         first = first + blank
      end do
   end function word_list

end module rv_cli_arguments
