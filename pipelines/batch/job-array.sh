#!/usr/bin/env bash
# job-array.sh MANIFEST OUT [OPTIONS]: one case of a manifest, as a task of a job array:
#
#   rhombic batch SCANS -o OUT --dry-run > cases.tsv
#   sbatch --array=1-$(($(wc -l < cases.tsv) - 1)) --cpus-per-task=2 --mem=4G --time=30 job-array.sh cases.tsv OUT --threads 2 --max-memory 4G
#   rhombic batch cases.tsv -o OUT --tables       # when all have ended
#
# Takes the number of the task from Slurm, Grid Engine or PBS. Exit code 12: the case failed, and the journal tells why.
set -euo pipefail
task=${SLURM_ARRAY_TASK_ID:-${SGE_TASK_ID:-${PBS_ARRAY_INDEX:?there is no number of a task}}}
name=$(sed -n "$((task + 1))p" "$1" | cut -f 1)
exec rhombic batch "$1" -o "$2" --case "$name" --jobs 1 "${@:3}"
