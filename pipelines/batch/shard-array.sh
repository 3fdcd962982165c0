#!/usr/bin/env bash
# shard-array.sh MANIFEST OUT CASES [OPTIONS]: CASES cases of a manifest, with a folder of outputs of their own, OUT/0001 for the first
# ones, as a task of a job array; for collections of more than some thousand cases:
#
#   rhombic batch SCANS -o OUT --dry-run > cases.tsv
#   sbatch --array=1-$((($(wc -l < cases.tsv) + 998) / 1000)) --cpus-per-task=2 --mem=4G --time=600 shard-array.sh cases.tsv OUT 1000 --jobs 1
#   shard-array.sh --join OUT                     # when all have ended: OUT/results.tsv, measures.tsv, outputs.tsv of all cases, index.html of the parts
#
# The paths in the manifest must be absolute, as --dry-run writes them. A task that is started again goes on where it was stopped. Takes the
# number of the task from Slurm, Grid Engine or PBS. Exit code 12: cases failed, and OUT/0001/results.tsv tells why.
set -euo pipefail
if [ "$1" = --join ]; then
  cd "$2"
  for table in results measures outputs; do
    find . -mindepth 2 -maxdepth 2 -path "./[0-9]*/$table.tsv" -print0 | sort -z | xargs -0r awk -F '\t' -v OFS='\t' -v table="$table" '
      FNR == 1 && begun++ { next }
      FNR > 1 && table == "outputs" { $2 = substr(FILENAME, 3, index(substr(FILENAME, 3), "/")) $2 } # the path below this folder
      { print }' >".$table.tsv"
    mv ".$table.tsv" "$table.tsv"
  done
  {
    printf '<!DOCTYPE html>\n<meta charset="utf-8">\n<title>Rhombic: results of a batch in parts</title>\n<ul>\n'
    for results in [0-9]*/results.tsv; do
      awk -F '\t' -v part="${results%/*}" 'FNR > 1 { ++cases; done += $2 == "done" }
        END { printf "<li><a href=\"%s/index.html\">%s</a>: %d cases, %d not done\n", part, part, cases, cases - done }' "$results"
    done
    echo '</ul>'
  } >.index.html
  mv .index.html index.html
  exit
fi
task=${SLURM_ARRAY_TASK_ID:-${SGE_TASK_ID:-${PBS_ARRAY_INDEX:?there is no number of a task}}}
manifest=$1 cases=$3 out=$2/$(printf %04d "$task")
mkdir -p "$2"
awk -v first=$((2 + (task - 1) * cases)) -v last=$((1 + task * cases)) 'NR == 1 || (NR >= first && NR <= last); NR > last { exit }' \
  "$manifest" >"$out.tsv"
exec rhombic batch "$out.tsv" -o "$out" "${@:4}"
