#!/usr/bin/env bash
# check-workflows.sh SOURCE PROGRAMS FOLDER: one collection as one run, as a job array, and by Snakemake gives the same files.
set -euo pipefail
source=$1
export PATH="$2:$PATH"
folder=$3
command -v snakemake >/dev/null || { echo "skipped: snakemake is not installed"; exit 77; }

rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
rhombic -q phantom --spacing 8 -o phantom
"$source/tests/BatchPipelines/make-variants.py" scans 20 phantom/phantom.nii.gz
rm scans/variant-00?.nii.gz scans/variant-010.nii.gz
printf 'outputs: [{mesh: bone.stl, threshold: 250.5}]\n' > pipeline.yaml
rhombic -q batch scans -o whole --pipeline pipeline.yaml --names-from-paths --dry-run > cases.tsv
rhombic -q batch cases.tsv -o whole --pipeline pipeline.yaml && exit 1 || [ $? -eq 12 ]

for task in $(seq $(($(wc -l < cases.tsv) - 1))); do
  SLURM_ARRAY_TASK_ID=$task "$source/pipelines/batch/job-array.sh" cases.tsv array --pipeline pipeline.yaml -q || [ $? -eq 12 ]
done
rhombic -q batch cases.tsv -o array --pipeline pipeline.yaml --tables

snakemake -s "$source/pipelines/batch/Snakefile" --cores 4 --keep-going --quiet \
  --config manifest=cases.tsv output=snake pipeline=pipeline.yaml && exit 1 || true # one case is broken

contents() { # OUT: hashes of what depends on no times
  (cd "$1" && find . -type f ! -name journal.jsonl ! -name index.html ! -name 'results.*' -exec md5sum {} + | sort -k 2)
}
[ "$(contents whole | wc -l)" -ge 32 ]
for other in array snake; do
  diff <(contents whole) <(contents $other)
  diff <(cut -f 1-3,7- whole/results.tsv) <(cut -f 1-3,7- $other/results.tsv)
done
[ "$(ls snake.ran | wc -l)" -eq 8 ]
