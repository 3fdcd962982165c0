#!/usr/bin/env bash
# check-xvfb.sh PROGRAM WORK: draws the scenes of rhombic-stock-scenes without a display, under Xvfb in VTK's own window, and there
# again beside a headless window. Fails unless all bytes of colours and depths are the same. Returns 77 where xvfb-run is not installed.
set -euo pipefail
program=$1
work=$2
command -v xvfb-run >/dev/null || { echo "skipped: xvfb-run is not installed"; exit 77; }
rm -rf "$work"
mkdir -p "$work/headless" "$work/x" "$work/x-beside-headless"
env -u DISPLAY "$program" headless "$work/headless" | tee "$work/headless.txt"
for mode in x x-beside-headless; do
  xvfb-run -a -s '-screen 0 640x480x24 -noreset' "$program" $mode "$work/$mode" | tee "$work/$mode.txt"
  [ "$(grep -c ': vtkXOpenGLRenderWindow$' "$work/$mode.txt")" = 6 ]
done
[ "$(grep -c ': vtkRhombicHeadlessRenderWindow$' "$work/headless.txt")" = 6 ]
diff -rq "$work/headless" "$work/x" # also finds files that only one folder has
diff -rq "$work/x-beside-headless" "$work/x"
