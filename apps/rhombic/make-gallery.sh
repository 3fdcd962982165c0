#!/usr/bin/env bash
# make-gallery.sh [FOLDER]
#
# Draws the pictures of the guide's gallery from the phantom, into testdata/pictures or FOLDER. Each command stands under
# its picture in GUIDE.md. The program is the `rhombic` on the PATH.
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=${1-testdata/pictures}
fine=$(mktemp -d)
trap 'rm -rf "$fine"' EXIT
rhombic -q phantom --spacing 2 -o "$fine/phantom"
scan=$fine/phantom/dicom
labels=$fine/phantom/phantom-labels.nii.gz

draw() {
  rhombic -q render "$@" --no-sidecar
}
draw "$scan" --preset ct-bone-skin --size 360x480 -o "$folder/gallery-bone-skin.png"
draw "$scan" --labels "$labels" --preset ct-organs --view 25,10 --style paper --size 0x480 -o "$folder/gallery-organs.png"
draw "$scan" --labels "$labels" --preset ct-organs --cut coronal=liver --uncut 'group:bones' --annotate letters,scale --size 0x480 -o "$folder/gallery-cut.png"
draw "$scan" --preset ct-bone --slice axial --lightbox 6 --window bone -o "$folder/gallery-lightbox.jpg"
draw "$scan" --labels "$labels" --preset ct-organs --sheet --dpi 75 -o "$folder/gallery-page.png"
