# words.sh PREFIX: manual page and completion of an installed tree know what the program takes.
set -u
prefix=$1
program=$prefix/bin/reedvalve
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failed=0
checks=0

# same TEXT FILE FILE: two lists of words are equal, and there are some
same() {
   checks=$((checks + 1))
   if [ -s "$2" ] && diff "$2" "$3"; then echo "  ok    $1"; else echo "  WRONG $1"; failed=1; fi
}

"$program" --help | grep -oE '^  --?[a-z]+' | tr -d ' ' | sort >options.txt
"$program" --help | sed -n 's/^  reedvalve \([a-z]*\) .*/\1/p' | sort >commands.txt

tr -d '\\' <"$prefix/share/man/man1/reedvalve.1" >manual.txt
sed -n '/^.SH OPTIONS/,/^.SH SIGNALS/s/^\.B \(-[-a-z]*\).*/\1/p' manual.txt | sort >found.txt
same "the manual has all options" options.txt found.txt
sed -n '/^.SH COMMANDS/,/^.SH OPTIONS/s/^\.B reedvalve \([a-z]*\) .*/\1/p' manual.txt | sort >found.txt
same "the manual has all commands" commands.txt found.txt
if command -v groff >/dev/null; then
   groff -man -Tutf8 -ww "$prefix/share/man/man1/reedvalve.1" >/dev/null 2>found.txt
   : >none.txt
   echo "end" | tee -a found.txt >>none.txt
   same "groff has no complaint" none.txt found.txt
fi

# bash_offers WORD...: what bash would offer for the last word
cat >offers.bash <<'END_OF_BASH'
compopt() { :; }
. "$1"
shift
COMP_WORDS=(reedvalve "$@")
COMP_CWORD=$#
_reedvalve
printf '%s\n' "${COMPREPLY[@]}"
END_OF_BASH
bash_offers() { bash offers.bash "$prefix/share/bash-completion/completions/reedvalve" "$@" | sort; }

bash_offers '' | grep -v '^-' | grep -vxE 'help|version' >found.txt
same "bash offers the commands" commands.txt found.txt
grep -vx -- --fmi options.txt >run.txt
bash_offers run my.nml - | grep -vx -- --help >found.txt
same "bash offers the options of run" run.txt found.txt
printf '%s\n' --fmi --force --quiet -o | sort >expected.txt
bash_offers fmu my.nml - | grep -vx -- --help >found.txt
same "bash offers the options of fmu" expected.txt found.txt
touch my.nml other.txt
mkdir my
echo my.nml >expected.txt
bash_offers run m >found.txt
same "bash offers decks" expected.txt found.txt
echo my >expected.txt
bash_offers run my.nml -o '' >found.txt
same "bash offers folders for -o" expected.txt found.txt
echo squeeze >expected.txt
bash_offers template s >found.txt
same "bash offers models" expected.txt found.txt
printf '%s\n' 2 3 >versions.txt
bash_offers fmu my.nml --fmi '' >found.txt
same "bash offers the versions of FMI" versions.txt found.txt

if command -v fish >/dev/null; then
   # one letter or long: fish offers what begins as the word does
   HOME=$work fish -c "source $prefix/share/fish/vendor_completions.d/reedvalve.fish
      complete -C 'reedvalve run my.nml --'; complete -C 'reedvalve run my.nml -'" |
      cut -f 1 | grep -vx -- -h | sort -u >found.txt
   same "fish offers the options of run" run.txt found.txt
   HOME=$work fish -c "source $prefix/share/fish/vendor_completions.d/reedvalve.fish
      complete -C 'reedvalve fmu my.nml --fmi '" | cut -f 1 | sort >found.txt
   same "fish offers the versions of FMI" versions.txt found.txt
fi
if command -v zsh >/dev/null; then
   zsh -n "$prefix/share/zsh/site-functions/_reedvalve" || failed=1
   grep -q "'--fmi\[.*:V:(2 3)'" "$prefix/share/zsh/site-functions/_reedvalve" || { echo "  WRONG zsh's --fmi"; failed=1; }
fi
[ $failed = 0 ] && [ $checks -ge 8 ]
