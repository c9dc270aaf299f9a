!> Completion of the command line for bash, zsh and fish.
module rv_cli_completion
   use rv_cli_output, only : say
   use rv_cli_table, only : command_type, commands, options, takes, word_type
   use rv_keys, only : choice_count, choice_name, key_run_model
   implicit none
   private
   public :: print_bash, print_fish, print_zsh

   character(len=*), parameter :: other_words = "--help --version"
   character(len=*), parameter :: fmi_versions = "2 3"

contains

   subroutine print_bash()
      integer :: i

      call say("# bash completion for reedvalve")
      call say("_reedvalve() {")
      call say("    local word=${COMP_WORDS[COMP_CWORD]} options= operand=COMMAND")
      call say("    local commands='"//names()//" "//other_words//"' models='"//models()//"'")
      call say("    if ((COMP_CWORD > 1)); then")
      call say("        case ${COMP_WORDS[1]} in")
      do i = 1, size(commands)
         call say("        "//trim(commands(i)%name)//") operand="//trim(commands(i)%operand) &
            & //" options='"//trim(commands(i)%options)//"' ;;")
      end do
      call say("        *) return ;;")
      call say("        esac")
      call say("        case ${COMP_WORDS[COMP_CWORD - 1]} in")
      do i = 1, size(options)
         if (options(i)%value /= "") call say("        "//trim(options(i)%name)//") operand="//trim(options(i)%value)//" ;;")
      end do
      call say("        *) [[ $word != -* ]] || operand=OPTION ;;")
      call say("        esac")
      call say("    fi")
      call say("    case $operand in")
      call say("    COMMAND) mapfile -t COMPREPLY < <(compgen -W ""$commands"" -- ""$word"") ;;")
      call say("    OPTION) mapfile -t COMPREPLY < <(compgen -W ""$options --help"" -- ""$word"") ;;")
      call say("    MODEL) mapfile -t COMPREPLY < <(compgen -W ""$models"" -- ""$word"") ;;")
      call say("    V) mapfile -t COMPREPLY < <(compgen -W """//fmi_versions//""" -- ""$word"") ;;")
      call say("    DECK)")
      call say("        mapfile -t COMPREPLY < <(compgen -f -X '!*.nml' -- ""$word"")")
      call say("        compopt -o filenames -o plusdirs")
      call say("        ;;")
      call say("    DIR)")
      call say("        mapfile -t COMPREPLY < <(compgen -d -- ""$word"")")
      call say("        compopt -o filenames")
      call say("        ;;")
      call say("    esac")
      call say("}")
      call say("complete -F _reedvalve reedvalve")
   end subroutine print_bash

   subroutine print_zsh()
      integer :: i, j

      call say("#compdef reedvalve")
      call say("local command=$words[2]")
      call say("if ((CURRENT == 2)); then")
      call say("    local -a commands=(")
      do i = 1, size(commands)
         call say("        "//quoted(trim(commands(i)%name)//":"//commands(i)%help))
      end do
      call say("    )")
      call say("    _describe -t commands command commands")
      call say("    compadd -- "//other_words)
      call say("    return")
      call say("fi")
      call say("shift words")
      call say("((CURRENT--))")
      call say("case $command in")
      do i = 1, size(commands)
         call say(trim(commands(i)%name)//")")
         call say("    _arguments \")
         do j = 1, size(options)
            if (takes(commands(i), options(j)%name)) call say("        "//zsh_option(options(j))//" \")
         end do
         call say("        "//quoted("1:"//trim(commands(i)%operand)//":"//zsh_action(commands(i)%operand)))
         call say("    ;;")
      end do
      call say("esac")
   end subroutine print_zsh

   function zsh_option(option) result(line)
      type(word_type), intent(in) :: option
      character(len=:), allocatable :: line

      line = trim(option%name)//"["//trim(option%help)//"]"
      if (option%value /= "") line = line//":"//trim(option%value)//":"//zsh_action(option%value)
      line = quoted(line)
   end function zsh_option

   !> What zsh offers for an operand or a value.
   function zsh_action(operand) result(action)
      character(len=*), intent(in) :: operand
      character(len=:), allocatable :: action

      select case (operand)
      case ("DECK")
         action = "_files -g ""*.nml"""
      case ("DIR")
         action = "_directories"
      case ("MODEL")
         action = "("//models()//")"
      case ("V")
         action = "("//fmi_versions//")"
      case ("COMMAND")
         action = "("//names()//")"
      case default
         action = " "
      end select
   end function zsh_action

   subroutine print_fish()
      integer :: i, j

      call say("complete -c reedvalve -f")
      do i = 1, size(commands)
         call say("complete -c reedvalve -n __fish_use_subcommand -a "//trim(commands(i)%name)//" -d "//quoted(commands(i)%help))
         call say(fish_rule(commands(i))//fish_action(commands(i)%operand))
         do j = 1, size(options)
            if (takes(commands(i), options(j)%name)) call say(fish_rule(commands(i))//fish_option(options(j)))
         end do
      end do
   end subroutine print_fish

   function fish_rule(command) result(line)
      type(command_type), intent(in) :: command
      character(len=:), allocatable :: line

      line = "complete -c reedvalve -n '__fish_seen_subcommand_from "//trim(command%name)//"' "
   end function fish_rule

   function fish_option(option) result(line)
      type(word_type), intent(in) :: option
      character(len=:), allocatable :: line

      line = "-s "//trim(option%name(2:))
      if (option%name(2:2) == "-") line = "-l "//trim(option%name(3:))
      if (option%value /= "") line = line//merge(" -r ", " -x ", option%value == "DIR")//fish_action(option%value)
      line = line//" -d "//quoted(option%help)
   end function fish_option

   !> What fish offers for an operand or a value.
   function fish_action(operand) result(action)
      character(len=*), intent(in) :: operand
      character(len=:), allocatable :: action

      select case (operand)
      case ("DECK")
         action = "-k -a '(__fish_complete_suffix .nml)'"
      case ("DIR")
         action = "-a '(__fish_complete_directories)'"
      case ("MODEL")
         action = "-a '"//models()//"'"
      case ("V")
         action = "-a '"//fmi_versions//"'"
      case ("COMMAND")
         action = "-a '"//names()//"'"
      case default
         action = ""
      end select
   end function fish_action

   !> "template check ..."
   function names() result(line)
      character(len=:), allocatable :: line
      integer :: i

      line = trim(commands(1)%name)
      do i = 2, size(commands)
         line = line//" "//trim(commands(i)%name)
      end do
   end function names

   !> "traditional squeeze ..."
   function models() result(line)
      character(len=:), allocatable :: line
      integer :: i

      line = choice_name(key_run_model, 1)
      do i = 2, choice_count(key_run_model)
         line = line//" "//choice_name(key_run_model, i)
      end do
   end function models

   !> A text as one word of a shell.
   function quoted(text) result(word)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: word
      integer :: i

      word = "'"
      do i = 1, len_trim(text)
         if (text(i:i) == "'") word = word//"'\'"
         word = word//text(i:i)
      end do
      word = word//"'"
   end function quoted

end module rv_cli_completion
