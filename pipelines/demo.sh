#!/usr/bin/env bash
# demo.sh [SCAN [render options...]]
#
# Installs what is needed, builds the program, and renders the analytic phantom. With a scan (a DICOM folder or a volume
# file) it renders that, too: CT in HU as bone inside translucent skin, anything else at Otsu's threshold, or as the
# render options say. The pictures go to build/demo.
set -euo pipefail
start=$PWD
cd "$(dirname "$0")/.."

./pipelines/install-packages.sh
./pipelines/build.sh release
rhombic="$PWD/build/release/bin/rhombic"
pictures="$PWD/build/demo"
rm -rf "$pictures"
mkdir -p "$pictures"
"$rhombic" phantom -o "$pictures/phantom"
"$rhombic" render "$pictures/phantom/dicom" --preset ct-bone-skin --view anterior --view left -o "$pictures/phantom.png"
"$rhombic" render "$pictures/phantom/dicom" --preset ct-lung -o "$pictures/phantom-lungs.png"

if [ $# -gt 0 ]; then
  scan=$(cd "$start" && realpath "$1")
  shift
  if [ $# -eq 0 ]; then
    # info suggests a threshold for bone when the values are Hounsfield units.
    case "$("$rhombic" info "$scan")" in
      *bone*) set -- --preset ct-bone-skin ;;
      *) set -- --surface surface=otsu ;;
    esac
  fi
  "$rhombic" render "$scan" "$@" -o "$pictures/scan.png"
fi

echo "The pictures are in $pictures:"
ls "$pictures"/*.png
