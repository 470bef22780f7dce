#!/bin/bash
# check-layers.sh LIBS COMPONENT...: components from the ground floor up; each includes only from
# itself and those before it.
set -euo pipefail
libs=$1
shift
allowed=""
failed=0
for component in "$@"; do
  allowed+="${allowed:+|}$component"
  if grep -rnE '#include "quadmap/' "$libs/$component" | grep -vE "#include \"quadmap/($allowed)/"; then
    echo "$component may include only from: ${allowed//|/ }"
    failed=1
  fi
done
exit $failed
