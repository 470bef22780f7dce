#!/bin/bash
# check-docs.sh ROOT: every file that a page of the documentation points to exists.
set -euo pipefail
cd "$1"
failed=0
for page in README.md doc/*.md doc/guide/*.md rawlogs/README.md; do
  while read -r target; do
    [[ -e $(dirname "$page")/${target%%#*} ]] || { echo "$page points to $target"; failed=1; }
  done < <(grep -oE '\]\([^)]+\)' "$page" | sed 's/^](//; s/)$//' | grep -vE '^(https?:|#)')
done
exit $failed
