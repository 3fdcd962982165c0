#!/usr/bin/env bash
# list-skipped.sh LOG LASTTEST: counts the tests that CTest lists as skipped in its output LOG, by the reasons in its file LASTTEST.
set -euo pipefail
awk '
  FNR == 1 { ++file }
  file == 1 && sub(/ \((Skipped|Disabled)\)$/, "") { skipped[$NF]; ++total }
  file == 1 { next }
  / Testing: / { test = $NF }
  test in skipped && said && !(test in reason) { reason[test] = $0 }
  { said = / Skipped$/ }
  test in skipped && sub(/^skipped: /, "") && !(test in reason) { reason[test] = $0 }
  END {
    for (test in skipped) {
      ++count[test in reason ? reason[test] : "no reason is told"]
    }
    printf "%d tests were skipped\n", total
    for (why in count) {
      printf "%5d  %s\n", count[why], why
    }
  }' "$1" "$2"
