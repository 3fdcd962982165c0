#!/usr/bin/env bash
# check-xvfb.sh PROGRAM WORK: draws the scenes of rhombic-stock-scenes without a display, and under Xvfb in VTK's own window, and fails
# unless all bytes of colours and depths are the same. Returns 77 where xvfb-run is not installed.
set -euo pipefail
program=$1
work=$2
command -v xvfb-run >/dev/null || exit 77
rm -rf "$work"
mkdir -p "$work/headless" "$work/x"
env -u DISPLAY "$program" headless "$work/headless" | tee "$work/headless.txt"
xvfb-run -a -s '-screen 0 640x480x24 -noreset' "$program" x "$work/x" | tee "$work/x.txt"
[ "$(grep -c ': vtkRhombicHeadlessRenderWindow$' "$work/headless.txt")" = 6 ]
[ "$(grep -c ': vtkXOpenGLRenderWindow$' "$work/x.txt")" = 6 ]
for scene in "$work"/x/*.raw; do
  cmp "$scene" "$work/headless/${scene##*/}"
done
diff -rq "$work/headless" "$work/x"
