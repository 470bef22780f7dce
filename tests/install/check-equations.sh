#!/bin/bash
# check-equations.sh MATHEMATICS LIBS: each numbered equation has its own number and is cited, as (11.16), where the
# code computes it; what the code cites is there. "(13.1) to (13.5)" cites all of them.
set -euo pipefail
numbered=$(grep -oP '(?<=  )\(\d+\.\d+\)(?=\s*$)' "$1" | sort)
cited=$(cat $(find "$2" -name '*.h' -o -name '*.cpp') | perl -0777 -ne '
  while (/(?<!\w)\((\d+)\.(\d+)\)(?:\s*(?:\*\s*|\/\/\s*)?to\s+(?:\*\s*|\/\/\s*)?\(\1\.(\d+)\))?/g) {
    print "($1.$_)\n" for $2 .. $3 // $2;
  }' | sort -u)
failed=0
complain() {
  [[ -z $1 ]] || { printf '%s\n%s\n' "$2:" "$1"; failed=1; }
}
complain "$(uniq -d <<<"$numbered")" "two equations have one number"
complain "$(comm -23 <(sort -u <<<"$numbered") <(echo "$cited"))" "no code names these equations"
complain "$(comm -13 <(sort -u <<<"$numbered") <(echo "$cited"))" "the code names equations that are not there"
exit $failed
