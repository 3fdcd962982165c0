#!/usr/bin/env bash
# Installs what is needed, builds everything with warnings as errors, and runs every test. The log of the tests is
# build/dev/test.log. Real scans are tested when RHOMBIC_SCANS names their folder. Arguments go to ctest.
set -euo pipefail
cd "$(dirname "$0")/.."

echo "1 of 3: packages of the build and of the tests"
./pipelines/install-packages.sh tests
echo "2 of 3: the program, its tests, examples, benchmarks and documentation"
./pipelines/build.sh dev
log=build/dev/test.log
echo "3 of 3: tests (log: $log)"
status=0
ctest --preset dev --parallel "$(nproc)" "$@" 2>&1 | tee "$log" || status=$?
./tests/list-skipped.sh "$log" build/dev/Testing/Temporary/LastTest.log
grep -E '^[0-9]+% tests passed' "$log" # after the lists of tests that were skipped or failed
exit $status
