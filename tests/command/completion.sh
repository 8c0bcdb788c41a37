#!/usr/bin/env bash
# completion.sh HBMCHECK SOURCE - what the bash completion offers: every command, options of a command, fields of a case, formats.
set -eu
PATH="$(dirname "$1"):$PATH"
compopt() { :; } # readline is not there to be told
source "$2/interfaces/command/completion.bash"

# offers WORD... -- EXPECTED...: complete the last word, and see each expected answer among the replies
offers() {
  COMP_WORDS=(hbmcheck)
  while [ "$1" != -- ]; do COMP_WORDS+=("$1"); shift; done
  shift
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _hbmcheck
  for want in "$@"; do
    case " ${COMPREPLY[*]} " in *" $want "*) ;; *) echo "after '${COMP_WORDS[*]}': no $want in '${COMPREPLY[*]}'"; exit 1 ;; esac
  done
}

for command in $(hbmcheck --help | awk '/^  [a-z]/ {print $1}'); do offers "${command%?}" -- "$command"; done
offers co -- compare contact # not derived from the help, as above: the list may not be empty
offers compare --ta -- --tables
offers frf --set hbm.ha -- hbm.harmonics=
offers frf --set contacts -- 'contacts[0].gap=' 'contacts[0].friction='
offers frf --format c -- csv
echo "completion: ok"
