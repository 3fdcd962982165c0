#!/usr/bin/env bash
# check-browser.sh RHOMBIC PHANTOM FOLDER: makes interactive pages of the phantom in FOLDER, and of real scans where RHOMBIC_SCANS
# names their folder, and opens them in Chromium and, without graphics and without scripts, in Firefox. Exits with 77, which CTest takes
# for skipped, where there is no node, npm, Chromium or pdftotext, or no network to fetch the packages of package-lock.json from, once.
set -euo pipefail

rhombic=$1
phantom=$2
folder=$3
here=$(cd "$(dirname "$0")" && pwd)

for program in node npm chromium pdftotext; do
  command -v "$program" >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
mkdir -p "$folder"
cp "$here"/package.json "$here"/package-lock.json "$here"/check-browser.mjs "$here"/check-firefox.mjs "$here"/make-scans.mjs "$folder"
if [ ! -d "$folder/node_modules/playwright-core" ] || [ ! -d "$folder/node_modules/ws" ]; then
  (cd "$folder" && timeout 300 npm ci --ignore-scripts --no-audit --no-fund) || { echo "skipped: npm can't fetch packages"; exit 77; }
  "$here"/../../../modules/pictures/InteractivePage/web/vendor/update.sh # the vendored files are those of their package
fi
cd "$folder"
labels=(--labels "$phantom/phantom-labels.nii.gz" --label heart --label liver --label marker --label "right lung")
"$rhombic" -q render "$phantom/dicom" "${labels[@]}" -o organs.html
"$rhombic" -q render "$phantom/dicom" "${labels[@]}" --size 700x700 --pixel-size 0.6 --annotate none -o own.png
"$rhombic" -q render "$phantom/dicom" --preset ct-bone-skin -o shell.html
"$rhombic" -q mesh "$phantom/dicom" "${labels[@]}" -o organs.vtp
"$rhombic" -q render organs.vtp -o surfaces.html
node make-scans.mjs
for scan in oblique tilted; do
  "$rhombic" -q render $scan.nii --surface ball=520,#ff8800 --surface body=-300,#88aaff,0.3 -o $scan.html
done
"$rhombic" -q render slice.nii --surface body=-300 -o slice.html
"$rhombic" -q render named.nii --label-table named.tsv -o named.html
"$rhombic" -q render unnamed.nii -o unnamed.html
"$rhombic" -q render overlap --draw 'body=#ff0000,1' --draw 'apex=#00ff00,1' -o overlap.html
rm -f real-*.html
if [ -d "${RHOMBIC_SCANS-}" ]; then
  body=$RHOMBIC_SCANS/ct_body_totalseg_nifti
  "$rhombic" -q render "$body/example_ct.nii.gz" --labels "$body/example_seg_fast_force_split.nii.gz" \
    --label liver --label spleen -o real-organs.html
  "$rhombic" -q render "$RHOMBIC_SCANS/ct_head_tilt_varspacing_dicom_rle" --surface skin=-300 --largest --spacing 4 -o real-tilted.html
else
  echo "skipped: pages of real scans, as RHOMBIC_SCANS names no folder"
fi
node check-browser.mjs
if command -v firefox-esr >/dev/null; then node check-firefox.mjs; else echo "skipped: firefox-esr is not installed"; fi
