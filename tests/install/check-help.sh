#!/bin/bash
# check-help.sh BIN SHARE: what --help, the manual page and the completion for bash say of each installed program
# agrees, is complete (options in groups, an example for each program and command), and can be used.
set -euo pipefail
bin=$(cd "$1" && pwd)
share=$(cd "$2" && pwd)
failed=0
wrong() { echo "$*"; failed=1; }

# completions NAME WORD...: what the shell offers after these words, the last of which is being typed.
completions() {
  local name=$1
  (
    shift
    set +e # as in the shell of a person
    # shellcheck disable=SC1090
    source "$share/bash-completion/completions/$name"
    COMP_WORDS=("$name" "$@") COMP_CWORD=$#
    "_${name//-/_}"
    printf '%s\n' "${COMPREPLY[@]}"
  )
}

# grep reads to the end here: with -q it would leave at the first match, and what still writes would fail.

# check NAME [COMMAND]: one program, or one of its commands.
check() {
  local name=$1 help manual options
  help=$("$bin/$@" --help) || wrong "$*: --help fails"
  manual=$(gzip -dc "$share/man/man1/$name.1.gz" | sed 's/\\-/-/g')
  grep -q '^Examples:' <<<"$help" || wrong "$*: --help has no example"
  grep -q 'Default: info\.' <<<"$help" || wrong "$*: --help tells no default"
  options=$(grep -oE '^  (-[a-z], )?--[a-z][a-z-]*' <<<"$help" | grep -oE -- '--[a-z-]+')
  (($(wc -l <<<"$options") >= 3)) || wrong "$*: --help lists no options"
  while read -r option; do
    grep -q -- "$option" <<<"$manual" || wrong "$name.1 lacks $option of $*"
  done <<<"$options"
  diff <(sort <<<"$options") <(completions "$@" -- | grep -E -- '^--[a-z]' | sort) ||
    wrong "$*: --help (<) and completion (>) differ"
}

for program in "$bin"/quadmap-*; do
  name=$(basename "$program")
  if command -v man >/dev/null && man --version >/dev/null 2>&1; then
    warnings=$(man --warnings -E UTF-8 -l -Tutf8 -Z <(gzip -dc "$share/man/man1/$name.1.gz") 2>&1 >/dev/null)
    [[ -z $warnings ]] || wrong "$name.1: $warnings"
  fi
  gzip -dc "$share/man/man1/$name.1.gz" | grep -E "^$name \\\\- [a-z].{20,}" >/dev/null || wrong "$name.1: no line for whatis"
  commands=$("$program" --help | sed -n '/^Arguments:/,/^$/s/^  \([a-z|]*\)$/\1/p' | tr '|' ' ')
  if [[ -n $commands ]] && "$program" "${commands%% *}" --help >/dev/null 2>&1 &&
    [[ $("$program" "${commands%% *}" --help) == "Usage: $name ${commands%% *}"* ]]; then
    for command in $commands; do
      check "$name" "$command"
      completions "$name" "" | grep -x "$command" >/dev/null || wrong "$name: completion does not offer $command"
    done
  else
    check "$name"
  fi
done

completions quadmap-slam --method "" | grep -x quadric >/dev/null || wrong "no values of --method"
completions quadmap-import "" | grep -x tum >/dev/null || wrong "no formats of quadmap-import"
folder=$(mktemp -d)
touch "$folder/a room.rawlog"
(cd "$folder" && completions quadmap-slam "a") | grep -x 'a room.rawlog' >/dev/null || wrong "no files"
[[ -z $(cd "$folder" && completions quadmap-slam --every "") ]] || wrong "files where a number is expected"
(cd "$folder" && completions quadmap-slam --objects "") | grep -x 'a room.rawlog' >/dev/null || wrong "no files of an option"
rm -r "$folder"
exit $failed
