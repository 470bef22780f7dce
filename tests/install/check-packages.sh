#!/bin/bash
# check-packages.sh LIST DOC: every Debian package that quickstart.sh installs is explained.
set -euo pipefail
failed=0
while read -r group package; do
  [[ $group == \#* ]] && continue
  grep -qF "\`$package\`" "$2" || { echo "$2 does not explain \`$package\`"; failed=1; }
done <"$1"
exit $failed
