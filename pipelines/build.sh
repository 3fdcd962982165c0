#!/usr/bin/env bash
# build.sh PRESET: configures and builds one preset of CMakePresets.json, quietly; shows the compiler's output on failure.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1

mkdir -p "build/$preset"
log="build/$preset/build.log"
echo "Building build/$preset (log: $log)"
if ! { cmake --preset "$preset" && cmake --build --preset "$preset"; } >"$log" 2>&1; then
  grep -E -A 12 'error|FAILED|CMake Error' "$log" >&2 || tail -n 50 "$log" >&2
  echo "The build failed; the whole log is in $log" >&2
  exit 1
fi
