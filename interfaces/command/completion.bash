# Bash completion of hbmcheck: commands, their options and the fields of --set (all asked of hbmcheck itself), case files.
_hbmcheck_fields()
{
  hbmcheck describe 2>/dev/null | awk '/^[a-z]+:/ {section = $1; sub(/:.*/, "", section); if (section == "contacts") section = "contacts[0]"}
                                       /^  [a-z_0-9]+/ {field = $1; sub(/:.*/, "", field); print section "." field "="}'
}

_hbmcheck()
{
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$(hbmcheck --help 2>/dev/null | awk '/^  [a-z]/ {print $1}') --help --version" -- "$word")
    return
  fi
  case $before in
  --format | --export)
    mapfile -t COMPREPLY < <(compgen -W "table csv json" -- "$word")
    return
    ;;
  --set)
    mapfile -t COMPREPLY < <(compgen -W "$(_hbmcheck_fields)" -- "$word")
    compopt -o nospace
    return
    ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(hbmcheck "$command" --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]*' | sort -u)" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    compopt -o filenames
  fi
}
complete -F _hbmcheck hbmcheck
