#!/usr/bin/env bash
# check-variants.sh PROGRAMS FOLDER COUNT: a batch of COUNT variants of the phantom, 5 % of them broken, with the rhombic in the folder
# PROGRAMS: its table is right, and one job, two jobs, and a run that was killed ten times leave the same files and nothing else.
# Prints the seconds of each.
set -euo pipefail
export PATH="$1:$PATH"
folder=$2
count=$3
scripts=$(cd "$(dirname "$0")" && pwd)
command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }

rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
for spacing in 4 5 6 7 8; do
  rhombic -q phantom --spacing $spacing -o phantom-$spacing
done
python3 "$scripts/make-variants.py" scans "$count" phantom-*/phantom.nii.gz
cat > pipeline.yaml <<'END'
outputs:
  - mesh: bone.stl
    threshold: 250.5
  - volume: scan.fcc.nrrd
END
batch=(rhombic -q batch scans --names-from-paths --pipeline pipeline.yaml)

run() { # OUT JOBS: runs to the end
  local code=0 start=$EPOCHREALTIME
  "${batch[@]}" -o "$1" --jobs "$2" 2> "$1.log" || code=$?
  [ $code -eq 12 ] || { cat "$1.log" >&2; echo "$1 ended with exit code $code" >&2; exit 1; }
  seconds=$(awk "BEGIN { print $EPOCHREALTIME - $start }")
  echo "$1: $seconds s"
}

contents() { # OUT: hashes of what depends on no times
  (cd "$1" && find . -type f ! -name journal.jsonl ! -name index.html ! -name 'results.*' -exec md5sum {} + | sort -k 2)
}

run one 1
run two 2
RANDOM=7
for kill in 1 2 3 4 5 6 7 8 9 10; do
  "${batch[@]}" -o killed --jobs 2 2> killed.log &
  until [ "$(find killed -maxdepth 1 -name 'v*' 2>/dev/null | wc -l)" -ge $((count * kill / 12)) ]; do
    sleep 0.05
  done
  sleep "$(awk "BEGIN { print 4 * $seconds / $count * $RANDOM / 32768 }")" # up to four cases' time
  kill -KILL $!
  wait $! 2>/dev/null || true
  echo "killed with $(find killed -maxdepth 1 -name 'v*' | wc -l) cases done"
done
run killed 2

broken=$((count / 20))
awk -F '\t' -v broken=$broken -v count="$count" '
  NR > 1 && $1 ~ /^broken/ && $2 == "failed" && $3 == 4 && length($8) > 20 { ++failed }
  NR > 1 && $1 ~ /^variant/ && $2 == "done" && $3 == 0 && $8 == "" { ++done }
  END { print done " done, " failed " failed"; exit !(failed == broken && done == count - broken && NR == count + 1) }' one/results.tsv
for other in two killed; do
  diff <(contents one) <(contents $other)
  diff <(cut -f 1-3,7- one/results.tsv) <(cut -f 1-3,7- $other/results.tsv)
  [ -z "$(find $other -name '.*' ! -path $other)" ]
done
echo "the same $(contents one | wc -l) files in all"
