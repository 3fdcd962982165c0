#!/usr/bin/env bash
# check-receive.sh SOURCE PROGRAMS FOLDER: studies sent to storescp on this machine become pages and DICOM files.
set -euo pipefail
source=$1
export PATH="$2:$PATH"
folder=$3
command -v storescp dcmsend >/dev/null || { echo "skipped: dcmtk is not installed"; exit 77; }

rm -rf "$folder"
mkdir -p "$folder"/{incoming,studies,results}
cd "$folder"
rhombic -q phantom --spacing 8 -o a
rhombic -q phantom --spacing 10 -o b
printf 'outputs: [{page: page.png, preset: auto, dpi: 50, dicom-sc: true}]\n' > pipeline.yaml
for scan in a b; do # the same pages by the command itself
  rhombic -q render $scan/dicom --sheet --preset ct-bone-skin --dpi 50 --dicom-sc -o $scan.png
done
hook="$source/pipelines/batch/receive-study.sh '#p' $PWD/studies $PWD/results --pipeline $PWD/pipeline.yaml -q"
receiver=
for port in $(shuf -i 20000-32000 -n 20); do
  storescp -od incoming -su study --eostudy-timeout 1 --exec-on-eostudy "$hook" "$port" > storescp.log 2>&1 &
  receiver=$!
  until echoscu 127.0.0.1 "$port" 2>/dev/null || ! kill -0 $receiver 2>/dev/null; do
    sleep 0.1
  done
  ! kill -0 $receiver 2>/dev/null || break # the port was free
done
trap 'kill $receiver; wait $receiver || true' EXIT

# Half of a study, another study, and the other half.
slices=(a/dicom/*.dcm)
half=$((${#slices[@]} / 2))
dcmsend 127.0.0.1 "$port" "${slices[@]:0:half}"
dcmsend 127.0.0.1 "$port" b/dicom/*.dcm
dcmsend 127.0.0.1 "$port" "${slices[@]:half}"

until [ "$(find studies -type f ! -name '.*' | wc -l)" -eq "$(ls a/dicom b/dicom | grep -c dcm)" ]; do
  sleep 0.2 # CTest ends what hangs
done
for lock in studies/.*.lock; do
  flock "$lock" true # the runs of batch have ended
done
for scan in a b; do
  [ -n "$(find results -name page.dcm -exec cmp -s $scan.dcm {} \; -print)" ]
done
[ "$(find results -name page.png | wc -l)" -eq 2 ]
[ "$(ls results | wc -l)" -eq 2 ]
[ "$(ls studies | wc -l)" -eq 2 ]
[ -z "$(find incoming -type f)" ]
