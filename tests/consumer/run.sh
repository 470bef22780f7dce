#!/bin/bash
# run.sh CMAKE CXX PREFIX WORK: configures, builds and runs the project here against the package
# installed in PREFIX, and checks that its libraries ask for no more than they need.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cmake=$1 cxx=$2 prefix=$3 work=$4

rm -rf "$work"
"$cmake" -S "$source" -B "$work" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_BUILD_TYPE=Release
if grep -E '^(Ceres|OpenCV|OpenNI2)_DIR' "$work/CMakeCache.txt"; then
  echo "the libraries looked for the above, which their users do not need"
  exit 1
fi
"$cmake" --build "$work"
cd "$work"
./consumer consumer.quadmap
