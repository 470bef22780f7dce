#!/bin/bash
# check-docs.sh ROOT SHARE: every file that a page of the documentation in ROOT points to exists, and every
# page that a file in SHARE names.
set -euo pipefail
share=$(cd "$2" && pwd)
cd "$1"
failed=0
missing() { echo "$1 points to $2"; failed=1; }
for page in README.md CHANGELOG.md doc/*.md doc/guide/*.md rawlogs/README.md; do
  while read -r target; do
    [[ -e $(dirname "$page")/${target%%#*} ]] || missing "$page" "$target"
  done < <(grep -oE '\]\([^)]+\)' "$page" | sed 's/^](//; s/)$//' | grep -vE '^(https?:|#)')
done
while IFS=: read -r file target; do
  [[ -e $target ]] || missing "$file" "$target"
done < <(grep -roE '\bdoc/[a-z/-]+\.md' "$share")
exit $failed
