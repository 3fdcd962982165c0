#!/usr/bin/env bash
# check-bids.sh TESTS FOLDER: fetches the BIDS validator from npm into FOLDER, once, and validates the dataset with its derivative that
# a test in the program TESTS makes. Exits with 77, which CTest takes for skipped, where there is no node, npm or network.
set -euo pipefail
tests=$1
folder=$2
package=bids-validator@1.15.0 # the last one that npm has whole

command -v node >/dev/null && command -v npm >/dev/null || { echo "skipped: node or npm is not installed"; exit 77; }
if [ ! -x "$folder/node_modules/.bin/bids-validator" ]; then
  mkdir -p "$folder"
  timeout 300 npm install --prefix "$folder" --ignore-scripts --no-audit --no-fund "$package" || { echo "skipped: npm cannot fetch $package"; exit 77; }
fi
rm -rf "$folder/data"
RHOMBIC_BIDS_COPY="$folder/data" "$tests" --gtest_filter='*.ABIDSDatasetBecomesADerivative'
"$folder/node_modules/.bin/bids-validator" "$folder/data"
