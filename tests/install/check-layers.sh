#!/bin/bash
# check-layers.sh LIBS COMPONENT...: components from the ground floor up. Each includes and links only itself
# and those before it, private headers are its own, libs/README.md describes it, and it is small enough to be
# known by one person.
set -euo pipefail
libs=$1
shift
most_lines=6000
allowed=""
failed=0
# complain TEXT, when something stands on standard input.
complain() {
  local found
  found=$(cat)
  [[ -z $found ]] || { printf '%s\n%s\n' "$found" "$1"; failed=1; }
}
for component in "$@"; do
  allowed+="${allowed:+|}$component"
  complain "$component may use only: ${allowed//|/ }" < <(
    grep -rnE '#include [<"]quadmap/' "$libs/$component" | grep -vE "#include \"quadmap/($allowed)/" || true
    grep -noE 'quadmap::[a-z]+' "$libs/$component/CMakeLists.txt" | grep -vE "quadmap::($allowed)\$" || true)
  complain "$component: a private header is named by its path below $component/src" < <(
    grep -rnoE '#include "[^"]+"' "$libs/$component" | grep -v '"quadmap/' |
      while IFS=: read -r file line include; do
        name=${include#*\"}
        name=${name%\"}
        [[ -e $libs/$component/src/$name || ($name != */* && -e $(dirname "$file")/$name) ]] || echo "$file:$line: $name"
      done)
  complain "a library above $most_lines lines is two" < <(
    find "$libs/$component" -name '*.h' -o -name '*.cpp' | xargs cat | wc -l |
      awk -v most="$most_lines" -v name="$component" '$1 > most {print name ": " $1 " lines"}')
  complain "libs/README.md does not describe it" < <(grep -q "^| \`$component\` |" "$libs/README.md" || echo "$component")
done
exit $failed
