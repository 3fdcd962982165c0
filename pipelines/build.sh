#!/usr/bin/env bash
# build.sh PRESET [TARGET...]
#
# Configures and builds a preset of CMakePresets.json, or only some of its targets, and shows how far it is: each step on
# a terminal, each tenth step elsewhere. On failure it shows the compiler's output.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
build=(cmake --build --preset "$preset" ${1:+--target} "$@")

mkdir -p "build/$preset"
log="build/$preset/build.log"
echo "Building ${*:-everything} in build/$preset (log of what is not shown: $log)"
fail() {
  grep -E -A 12 'error|FAILED|CMake Error' "$log" >&2 || tail -n 50 "$log" >&2
  echo "The build failed; the whole log is in $log" >&2
  exit 1
}
cmake --preset "$preset" >"$log" 2>&1 || fail
if [ -t 1 ]; then
  exec "${build[@]}" # ninja counts its steps on one line, and shows the compiler's output itself
fi
"${build[@]}" 2>&1 | tee -a "$log" | { grep -E --line-buffered '^\[([0-9]*0|1)/' || true; } || fail
