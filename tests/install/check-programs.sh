#!/bin/bash
# check-programs.sh BIN: the installed programs start (they find their libraries), tell their version,
# and know a wrong call.
set -uo pipefail
bin=$(cd "$1" && pwd)
failed=0
for program in "$bin"/quadmap-*; do
  name=$(basename "$program")
  version=$(cd / && "$program" --version) || { echo "$name --version: status $?"; failed=1; }
  [[ $version == "$name "[0-9]* ]] || { echo "$name --version says: $version"; failed=1; }
  "$program" --help >/dev/null || { echo "$name --help: status $?"; failed=1; }
  message=$("$program" --no-such-option 2>&1 >/dev/null)
  status=$?
  [[ $status == 2 && $(wc -l <<<"$message") == 1 ]] ||
    { echo "$name --no-such-option: status $status, says: $message"; failed=1; }
done
exit $failed
