#!/usr/bin/env bash
# demo.sh [SCAN [render options...]]
#
# Installs what is needed, builds the program, and renders the analytic phantom. With a scan (a DICOM folder or a volume
# file) it renders that, too: CT in HU as bone inside translucent skin, anything else at Otsu's threshold, or as the
# render options say. The pictures go to build/demo.
set -euo pipefail
start=$PWD
cd "$(dirname "$0")/.."

echo "1 of 3: packages"
./pipelines/install-packages.sh
echo "2 of 3: the program (the first time 4 minutes on two cores, later seconds)"
./pipelines/build.sh release rhombic
programs="$PWD/build/release/bin"
rhombic="$programs/rhombic"
pictures="$PWD/build/demo"
echo "3 of 3: pictures (a few seconds each)"
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
echo "The program is $rhombic. To call it as rhombic, in this shell or for everybody:"
echo "  export PATH=\"$programs:\$PATH\""
echo "  sudo cmake --install build/release --component program    # to /usr/local, from $PWD"
