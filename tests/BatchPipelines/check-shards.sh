#!/usr/bin/env bash
# check-shards.sh SOURCE PROGRAMS FOLDER: a collection in shards of three cases, joined, gives the tables of a run of all cases.
set -euo pipefail
source=$1
export PATH="$2:$PATH"
folder=$3
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
rhombic -q phantom --spacing 8 -o phantom
printf 'outputs: [{mesh: bone.stl, threshold: 250.5}]\n' >pipeline.yaml
printf 'case\tscan\toptions\n' >cases.tsv
for n in 1 2 3 4 5 6 7; do
  printf 'c%s\t%s\t--density 0.%s\n' $n "$PWD/phantom/phantom.nii.gz" $((n + 2)) >>cases.tsv
done
rhombic -q batch cases.tsv -o whole --pipeline pipeline.yaml
for task in 1 2 3; do
  SLURM_ARRAY_TASK_ID=$task "$source/pipelines/batch/shard-array.sh" cases.tsv shards 3 --pipeline pipeline.yaml -q
done
"$source/pipelines/batch/shard-array.sh" --join shards
diff whole/measures.tsv shards/measures.tsv
diff <(cut -f 1,3- whole/outputs.tsv) <(cut -f 1,3- shards/outputs.tsv)
diff <(cut -f 1-3,7- whole/results.tsv) <(cut -f 1-3,7- shards/results.tsv)
tail -n +2 shards/outputs.tsv | while IFS=$'\t' read -r _ file _ _ _ md5 _; do
  [ "$(md5sum <"shards/$file")" = "$md5  -" ]
done
rhombic -q batch -o shards --stats >statistics.txt
