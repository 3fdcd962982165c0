#!/usr/bin/env bash
# receive-study.sh ARRIVED STUDIES OUT [OPTIONS]: a page of each series of a study that has arrived, for DCMTK's storescp:
#
#   mkdir -p incoming studies results
#   storescp -aet RHOMBIC -od incoming -su study --eostudy-timeout 10 \
#       --exec-on-eostudy "receive-study.sh '#p' studies results --pipeline page.yaml" 11112
#
# Moves the files to STUDIES/STUDY, and runs `rhombic batch` on them with these options, into OUT/STUDY. STUDY is made
# from a hash of the study's UID. When more files of a study come later, they join the first ones, and what has changed
# is made again. Exit code 12: some series failed; OUT/STUDY/results.tsv tells why.
set -euo pipefail
arrived=$1
name=study-$(basename "$1" | md5sum | cut -c 1-12)
study=$2/$name
mkdir -p "$study"
exec 9> "$2/.$name.lock"
flock 9 # another part of the study may be at work
find "$arrived" -type f -exec mv -t "$study" {} +
rmdir --ignore-fail-on-non-empty "$arrived" # more may be arriving
exec rhombic batch "$study" -o "$3/$name" "${@:4}"
