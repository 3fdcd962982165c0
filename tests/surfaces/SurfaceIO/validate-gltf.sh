#!/usr/bin/env bash
# validate-gltf.sh TESTS FOLDER: fetches Khronos' glTF-Validator from npm into FOLDER, once, and runs the test in the
# program TESTS that needs it. Exits with 77, which CTest takes for skipped, where there is no node, npm or network.
set -euo pipefail

tests=$1
folder=$2
package=gltf-validator@2.0.0-dev.3.10

command -v node >/dev/null && command -v npm >/dev/null || { echo "node or npm is not installed"; exit 77; }
if [ ! -d "$folder/node_modules/gltf-validator" ]; then
  mkdir -p "$folder"
  timeout 300 npm install --prefix "$folder" --ignore-scripts --no-audit --no-fund "$package" || exit 77
fi
RHOMBIC_GLTF_VALIDATOR="$folder/node_modules/gltf-validator" "$tests" --gtest_filter='*.GLTFValidatorFindsNothing'
