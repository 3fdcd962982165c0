#!/usr/bin/env bash
# Installs what is needed, builds everything with warnings as errors, and runs every test.
# Real scans are tested when RHOMBIC_SCANS names their folder. Arguments go to ctest.
set -euo pipefail
cd "$(dirname "$0")/.."

./pipelines/install-packages.sh
./pipelines/build.sh dev
exec ctest --preset dev --parallel "$(nproc)" "$@"
