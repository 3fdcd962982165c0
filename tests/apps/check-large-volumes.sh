#!/bin/bash
# check-large-volumes.sh PROGRAM WORK: rhombic mesh in slabs of a scan in a temporary file, and of a surface in temporary
# files, keeps private memory small, is killed at random moments, and meets full disks: nothing half-written, no file left over but hidden ones of
# killed processes, and the next run makes the same bytes. Full disks need root, who can mount small ones. rhombic render draws the same pictures of
# a volume in slabs, and of labels in temporary files, as in memory.
set -eu
program=$1 work=$2
rm -rf "$work"
mkdir -p "$work/out" "$work/tmp" "$work/disk"
export TMPDIR=$work/tmp

fail() {
    echo "$*" >&2
    exit 1
}

mesh() { # OUTPUT [MEMORY]: in place of a subshell
    exec "$program" -q mesh "$work/phantom/dicom" -t 1100.5 --max-memory "${2:-4500K}" --no-sidecar -o "$1"
}

"$program" -q phantom --spacing 3 -o "$work/phantom"

(mesh "$work/expected.ply")
(mesh "$work/whole.ply" 1G)
cmp "$work/expected.ply" "$work/whole.ply"

seq 150000 | gzip -9n | head -c 216000 > "$work/noise.raw" # of which surfaces have 0.7 million triangles
cat > "$work/noise.mhd" << END
ObjectType = Image
NDims = 3
DimSize = 60 60 60
ElementType = MET_UCHAR
ElementDataFile = noise.raw
END
noise() { # OUTPUT [MEMORY]: in place of a subshell
    exec "$program" mesh "$work/noise.mhd" -t 127.5 --max-memory "${2:-10M}" --temporary "$work/tmp" --no-sidecar -o "$1"
}
(noise "$work/expected-noise.ply") 2> "$work/notes"
grep -q "million triangles, are put into temporary files" "$work/notes" || fail "in memory: $(cat "$work/notes")"
(noise "$work/whole.ply" 1G) 2> "$work/notes"
cmp "$work/expected-noise.ply" "$work/whole.ply"

# Finished surfaces, too, with the same bytes and notes; private memory (RLIMIT_DATA) does not grow with them.
finished() { # MEMORY OUTPUT OPTIONS: in place of a subshell
    exec "$program" mesh "$work/noise.mhd" -t 127.5 --threads 2 --max-memory $1 --temporary "$work/tmp" --no-sidecar -o "$2" "${@:3}"
}
for run in "80000 --smooth 0.3" "140000 --max-triangles 85%"; do # kB
    data=${run%% *} finish=${run#* }
    (finished 1G "$work/whole.ply" $finish) 2> "$work/notes-whole"
    (ulimit -d $data; finished 10M "$work/files.ply" $finish) 2> "$work/notes" || fail "$finish: $(cat "$work/notes")"
    cmp "$work/whole.ply" "$work/files.ply"
    grep -q "are put into temporary files" "$work/notes" || fail "$finish: in memory: $(cat "$work/notes")"
    code=0
    (ulimit -d $data; finished 1G "$work/files.ply" $finish) 2> "$work/notes" || code=$?
    [ $code = 9 ] || fail "$finish: as little private memory without temporary files: $code, $(cat "$work/notes")"
done

# Pictures of labels, too.
for memory in 340M 2G; do
    "$program" render "$work/phantom/phantom-labels.nii.gz" --size 200 --max-memory $memory --temporary "$work/tmp" --no-sidecar \
        -o "$work/labels-$memory.png" 2> "$work/notes-$memory"
done
grep -q "labels and their surfaces, .* are put into temporary files" "$work/notes-340M" || fail "in memory: $(cat "$work/notes-340M")"
! grep -q "temporary files" "$work/notes-2G" || fail "in temporary files: $(cat "$work/notes-2G")"
cmp "$work/labels-340M.png" "$work/labels-2G.png"

RANDOM=7
kill_at_random() { # COMMAND EXPECTED RUNS MILLISECONDS
    for run in $(seq "$3"); do
        "$1" "$work/out/mesh.ply" 2> "$work/notes" &
        process=$!
        sleep "$(printf '%d.%03d' $((RANDOM % $4 / 1000)) $((RANDOM % 1000)))"
        kill -9 $process 2> /dev/null || true
        wait $process || true
        if [ -e "$work/out/mesh.ply" ]; then
            cmp "$2" "$work/out/mesh.ply" || fail "run $run left another mesh"
            rm "$work/out/mesh.ply"
        fi
        [ -z "$(ls "$work/out")" ] || fail "run $run left $(ls "$work/out")"
        [ -z "$(ls -A "$work/tmp")" ] || fail "run $run left $(ls -A "$work/tmp") for temporary files"
    done
    ("$1" "$work/out/mesh.ply") 2> "$work/notes"
    cmp "$2" "$work/out/mesh.ply"
    rm "$work/out/mesh.ply"
}
kill_at_random mesh "$work/expected.ply" 30 700
kill_at_random noise "$work/expected-noise.ply" 10 2000

code=0 # a disk that is full in the middle of the work: files of 4 MiB at most
(trap '' XFSZ; ulimit -f 4096; noise "$work/out/mesh.ply") 2> "$work/sentence" || code=$?
[ $code = 9 ] && grep -q "can't be put into temporary files" "$work/sentence" || fail "no room: $code, $(cat "$work/sentence")"
[ -z "$(ls -A "$work/out" "$work/tmp" | grep -v ":$" | tr -d '\n')" ] || fail "no room left $(ls -A "$work/out" "$work/tmp")"

truncate -s $((2 * 512 * 512 * 512)) "$work/plate.raw" # a hole but for a thin plate
head -c 102400 /dev/zero | tr '\0' '\47' |
    dd of="$work/plate.raw" conv=notrunc bs=1024 seek=$((256 * 512 + 200)) 2> "$work/written"
cat > "$work/plate.mhd" << END
ObjectType = Image
NDims = 3
DimSize = 512 512 512
ElementType = MET_SHORT
ElementDataFile = plate.raw
END
for memory in 160M 2G; do
    "$program" render "$work/plate.mhd" --surface plate=5000.5 --size 300 --view 30,40 --max-memory $memory \
        --no-sidecar -o "$work/plate-$memory.png" 2> "$work/notes-$memory"
done
grep -q "slabs, again for each pass" "$work/notes-160M" || fail "not in slabs: $(cat "$work/notes-160M")"
! grep -q "slabs" "$work/notes-2G" || fail "in slabs: $(cat "$work/notes-2G")"
cmp "$work/plate-160M.png" "$work/plate-2G.png"
rm "$work/plate.raw"

truncate -s 1M "$work/disk.img"
mkfs.ext2 -q "$work/disk.img" 2> /dev/null && mount -o loop "$work/disk.img" "$work/disk" 2> /dev/null || exit 77
trap 'umount "$work/disk"' EXIT

code=0
(TMPDIR=$work/disk mesh "$work/out/other.ply") 2> "$work/sentence" || code=$?
[ $code = 9 ] && grep -q "are free" "$work/sentence" || fail "a full folder of temporary files: $code, $(cat "$work/sentence")"
[ ! -e "$work/out/other.ply" ] || fail "a mesh without room for its scan"
code=0
"$program" mesh "$work/noise.mhd" -t 127.5 --max-memory 10M --temporary "$work/disk" -o "$work/out/other.ply" 2> "$work/sentence" || code=$?
[ $code = 9 ] && grep -q "their arrays are too large" "$work/sentence" || fail "a full folder for arrays: $code, $(cat "$work/sentence")"
[ ! -e "$work/out/other.ply" ] || fail "a mesh without room for its arrays"
dd if=/dev/zero of="$work/disk/filler" bs=1k 2> "$work/full" || true
code=0
(mesh "$work/disk/mesh.ply") 2> "$work/sentence" || code=$?
[ $code = 7 ] || fail "a full disk: $code, $(cat "$work/sentence")"
[ "$(ls -A "$work/disk" | grep -v lost+found)" = filler ] || fail "a full disk holds $(ls -A "$work/disk")"
