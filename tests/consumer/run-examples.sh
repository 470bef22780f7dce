#!/bin/bash
# run-examples.sh CMAKE CXX PREFIX WORK RAWLOG: builds the examples that are installed in PREFIX as a reader does,
# against the package there, runs them on the recording, and looks at what they make.
set -euo pipefail
cmake=$1 cxx=$2 prefix=$3 work=$4 rawlog=$5
examples=$prefix/share/quadmap/examples/embed

fail() { echo "$*"; exit 1; }
rm -rf "$work"
"$cmake" -S "$examples" -B "$work" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_BUILD_TYPE=Release
"$cmake" --build "$work"
cd "$work"

lines=$(wc -l <"$examples/your-own-loop.cpp")
((lines <= 60)) || fail "your-own-loop.cpp has $lines lines; the guide says 60"
awk '/^```cpp/ {inside = 1; next} /^```/ && inside {exit} inside' "$prefix/share/doc/quadmap/doc/guide/your-own-loop.md" |
  diff - "$examples/your-own-loop.cpp" || fail "the guide shows another loop"
./your-own-loop "$rawlog" loop.quadmap >loop.txt
grep -q '^the nearest tv is at ' loop.txt || fail "the loop finds no tv"
"$prefix/bin/quadmap-map" query loop.quadmap tv

./grid-and-objects "$examples/grid-and-objects.ini" "$rawlog" home
"$prefix/bin/quadmap-map" query home.quadmap "nearest chair to the bed"

[[ -e go-to ]] || { echo "go-to is not built: mrpt-nav is missing"; exit 0; }
./go-to home.quadmap home.gridmap tv 2.3 -0.6 to-the-tv.png | tee to-the-tv.txt
grep -q 'points lead there' to-the-tv.txt || fail "no way to the tv"
[[ $(stat -c %s to-the-tv.png) -gt 10000 ]] || fail "the picture is empty"
if ./go-to home.quadmap home.gridmap unicorn 2.3 -0.6 none.png 2>error.txt; then fail "there is no unicorn"; fi
[[ $(wc -l <error.txt) == 1 && ! -e none.png ]] || fail "an error is one line, and no picture"
