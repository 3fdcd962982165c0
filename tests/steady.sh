#!/usr/bin/env bash
# steady.sh: runs the built tests of the preset dev on one core, and beside four busy processes, and prints those that fail. Runs them
# in parts: started again, it goes on with the part at which it was stopped; after a build, it begins anew. The logs of the parts are
# in build/dev/steady.
set -euo pipefail
cd "$(dirname "$0")/.."
logs=build/dev/steady
tests=$(ctest --test-dir build/dev -N | sed -n 's/^Total Tests: //p')
mkdir -p "$logs"

run_parts() { # NAME COMMAND...: runs the command, with the numbers of the tests of each part that has no log
  local first part
  for ((first = 1; first <= tests; first += 50)); do
    part=$1-$first
    if [ ! "$logs/$part.log" -nt build/dev/bin ]; then
      echo "$part of $tests"
      "${@:2}" -I "$first,$((first + 49))" > "$logs/$part" 2>&1 || [ $? -eq 8 ] # tests failed
      mv "$logs/$part" "$logs/$part.log"
    fi
  done
}

ctest=(ctest --preset dev --no-tests=ignore)
run_parts one-core taskset -c 0 "${ctest[@]}"
busy=()
trap 'kill "${busy[@]}"' EXIT
for n in 1 2 3 4; do
  while :; do :; done &
  busy+=($!)
done
run_parts busy "${ctest[@]}" --parallel "$(nproc)"

failures=$(for log in "$logs"/*.log; do
  sed -n "/The following tests FAILED/,/^\$/s/^[\t ]*[0-9]* - /$(basename "$log" .log)  /p" "$log"
done)
echo "${failures:-all tests passed}"
[ -z "$failures" ]
