#!/bin/bash
# check-links.sh BIN LIB: no program and no library of ours names one that opens windows, and none of
# MRPT's comes in through another one.
set -euo pipefail
named='libmrpt-(gui|nanogui|hwdrivers|apps|detectors|graphslam|hmtslam|slam|vision)|libwx|libQt|libopencv_(highgui|viz)|libvtk'
loaded='libmrpt-(gui|nanogui|hwdrivers|apps|detectors)|libwx'

checked=0
failed=0
for file in "$1"/quadmap-* "$2"/libquadmap-*.so; do
  [[ -e $file ]] || continue
  checked=$((checked + 1))
  if readelf -d "$file" | grep NEEDED | grep -E "$named"; then echo "$file: names the above"; failed=1; fi
  closure=$(ldd "$file")
  if grep -E "$loaded|not found" <<<"$closure"; then echo "$file: loads the above"; failed=1; fi
done
echo "checked $checked files"
((checked > 0 && failed == 0))
