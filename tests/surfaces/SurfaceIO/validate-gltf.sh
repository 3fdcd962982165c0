#!/usr/bin/env bash
# validate-gltf.sh TESTS RHOMBIC PHANTOM FOLDER: fetches Khronos' glTF-Validator from npm into FOLDER, once. Runs the test in the program
# TESTS that needs it, and validates surfaces and labels of the phantom. Exits with 77, which CTest takes for skipped, where there is no
# node, npm or network.
set -euo pipefail

tests=$1
rhombic=$2
phantom=$3
folder=$4
here=$(cd "$(dirname "$0")" && pwd)
package=gltf-validator@2.0.0-dev.3.10

command -v node >/dev/null && command -v npm >/dev/null || { echo "skipped: node or npm is not installed"; exit 77; }
if [ ! -d "$folder/node_modules/gltf-validator" ]; then
  mkdir -p "$folder"
  timeout 300 npm install --prefix "$folder" --ignore-scripts --no-audit --no-fund "$package" ||
    { echo "skipped: npm cannot fetch $package"; exit 77; }
fi
export RHOMBIC_GLTF_VALIDATOR="$folder/node_modules/gltf-validator"
"$tests" --gtest_filter='*.GLTFValidatorFindsNothing'
"$rhombic" -q mesh "$phantom/dicom" --preset ct-bone-skin -o "$folder/surfaces.glb"
"$rhombic" -q mesh "$phantom/phantom.nii.gz" --labels "$phantom/phantom-labels.nii.gz" -o "$folder/labels.glb"
for file in surfaces labels; do
  node "$here/validate-gltf.js" "$RHOMBIC_GLTF_VALIDATOR" "$folder/$file.glb"
done
