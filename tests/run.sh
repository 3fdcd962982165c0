#!/usr/bin/env bash
# Installs what is needed, builds everything with warnings as errors, and runs every test.
# Real scans are tested when RHOMBIC_SCANS names their folder. Arguments go to ctest.
set -euo pipefail
cd "$(dirname "$0")/.."

./pipelines/install-packages.sh
./pipelines/build.sh dev
log=build/dev/test.log
status=0
ctest --preset dev --parallel "$(nproc)" "$@" 2>&1 | tee "$log" || status=$?
grep -E '^[0-9]+% tests passed' "$log" # after the lists of tests that were skipped or failed
exit $status
