#!/usr/bin/env bash
# same-bytes.sh OLD NEW [-j N] [PART...]: runs the same checks with two builds of the program, paths of rhombic, and compares all
# files, standard output, standard error and exit codes. Prints a line for each check, with the files that differ; exits with 1 if
# anything does. PART... runs the checks with one of these words in their names; -j runs N at the same time (default: 2).
# RHOMBIC_SCANS names a folder of real scans, without which their checks are left out. KEEP=FOLDER keeps all outputs there.
# Times, memory and recorded command lines are not compared: see same-bytes.py.
set -u
here=$(cd "$(dirname "$0")" && pwd)
parts=() jobs=2 programs=()
while [ $# -gt 0 ]; do
  case $1 in
    -j) jobs=$2 && shift ;;
    *) if [ ${#programs[@]} -lt 2 ]; then programs+=("$(realpath "$1")"); else parts+=("$1"); fi ;;
  esac
  shift
done
[ ${#parts[@]} -gt 0 ] || parts=("")
[ ${#programs[@]} -eq 2 ] || { echo "usage: same-bytes.sh OLD NEW [-j N] [PART...]" >&2 && exit 2; }
if [ -n "${KEEP:-}" ]; then
  mkdir "$KEEP" || exit 2
  work=$(realpath "$KEEP")
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
scans=${RHOMBIC_SCANS:+$(realpath "$RHOMBIC_SCANS")}

# ---- running ----

rhombic() { # the program of this side; notes its exit code
  local code=0
  "$program" "$@" || code=$?
  echo "$code rhombic $*" >> "$side/codes"
  return $code
}

run_side() { # NAME SIDE PROGRAM CODE: both sides run in a folder of the same path
  local folder=$work/$1 side=$work/$1/$2 program=$3
  mkdir -p "$side" "$folder/here"
  (cd "$folder/here" && eval "$4") > "$side/stdout" 2> "$side/stderr"
  mv "$folder/here" "$side/files"
  python3 "$here/same-bytes.py" "$side"
}

compare_sides() { # NAME CODE
  local folder=$work/$1 result
  if ! run_side "$1" old "${programs[0]}" "$2" || ! run_side "$1" new "${programs[1]}" "$2" || [ ! -s "$folder/old/codes" ]; then
    result="DIFFERS $1"$'\n'"          it ran nothing, or its outputs can't be read"
  elif result=$(diff -rq "$folder/old" "$folder/new" 2>&1); then
    result="same    $1 ($(wc -l < "$folder/new/codes") commands, $(find "$folder/new/files" -type f | wc -l) files)"
  else
    result="DIFFERS $1"$'\n'"$(sed "s#$folder/##g; s/^/          /" <<< "$result" | head -8)"
  fi
  echo "$result" | tee -a "$work/results"
  [ -n "${KEEP:-}" ] || rm -rf "$folder"
}

running=0
check() { # NAME CODE: compares what the shell code writes, if the name is asked for
  local part isAsked=""
  for part in "${parts[@]}"; do [[ $1 != *"$part"* ]] || isAsked=yes; done
  [ -n "$isAsked" ] || return 0
  if [ $running -ge "$jobs" ]; then
    wait -n
    running=$((running - 1))
  fi
  compare_sides "$1" "$2" &
  running=$((running + 1))
}

check_scan() { # as check, for code that reads real scans
  [ -z "$scans" ] || check "$@"
}

check_malformed() { # as check, for code that reads malformed files
  [ ! -d "$malformed" ] || check "$@"
}

# ---- inputs ----

phantom=$(realpath "$here/../testdata/phantom")
ct=$phantom/dicom labels=$phantom/phantom-labels.nii.gz malformed=$scans/../malformed
ge=$scans/ct_head_ge8800_dicom body=$scans/ct_body_totalseg_nifti mr=$scans/mr_head_t1_defaced_dicom_j2k
tilt=$scans/ct_head_tilt_varspacing_dicom_rle pet=$scans/pet_slope_per_slice_dicom_rle seg=$scans/dicom_seg_dcmqi/segmentations
heads=$scans/ct_mr_dicom2stl_nifti brains=$scans/nifti_orientations_48
small="$body/example_ct_sm.nii.gz --labels $body/example_seg.nii.gz"

inputs=$work/inputs # made by the old program, for both
mkdir -p "$inputs/bids/sub-01/anat" "$inputs/bids/sub-02/anat" "$inputs/bids/derivatives/organs/sub-02/anat"
(
  cd "$inputs" && cp "$phantom/phantom.nii.gz" bids/sub-01/anat/sub-01_T1w.nii.gz
  cp "$phantom/phantom.nii.gz" bids/sub-02/anat/sub-02_ct.nii.gz
  cp "$labels" bids/derivatives/organs/sub-02/anat/sub-02_dseg.nii.gz
  cp "$phantom/phantom-labels.tsv" bids/derivatives/organs/dseg.tsv
  echo '{ "Name": "phantoms", "BIDSVersion": "1.8.0" }' > bids/dataset_description.json
  echo '{ "Name": "organs", "BIDSVersion": "1.8.0" }' > bids/derivatives/organs/dataset_description.json
  "${programs[0]}" phantom --spacing 10 -o ten > log 2>&1
  "${programs[0]}" -q render "$ct" --preset ct-bone --view left --view 20,10 --size 150 --style paper -o picture.png >> log 2>&1
  "${programs[0]}" -q mesh "$ct" --preset ct-bone-skin -o scene.glb >> log 2>&1
  "${programs[0]}" -q mesh "$ct" -t 375.5 -o bone.stl >> log 2>&1
  "${programs[0]}" -q resample "$ct" -o scan.fcc.nrrd >> log 2>&1
  head -c 30000 bone.stl > cut.stl
  cat > pipeline.yaml << END
options:
  min-volume: 0.5
outputs:
  - picture: front.png
    size: 120
    view: [anterior, left]
    labels: false
    surface: [bone=375.5]
  - mesh: bone.stl
    labels: false
    threshold: 375.5
  - mesh: organ-{name}.ply
    label: [heart, liver]
  - volume: scan.fcc.nrrd
    kernel: linear
  - page: page.png
    dpi: 40
END
  cat > short.yaml << END
outputs:
  - picture: front.png
    size: 80
    surface: [bone=375.5]
    labels: false
  - mesh: all.glb
    surface: [skin=-300.5]
    max-triangles: 20%
    labels: false
END
  {
    printf 'case\tscan\tlabels\toptions\n'
    printf 'plain\t%s\t\t\ndicom\t%s\t\t\nwith-labels\t%s\t%s\t\n' "$phantom/phantom.nii.gz" "$ct" "$ct" "$labels"
    printf 'ten\t%s\t\t\nten-dicom\t%s\t\t\n' "$PWD"/ten/{phantom.nii.gz,dicom}
    printf 'ten-labels\t%s\t%s\t\n' "$PWD"/ten/{phantom,phantom-labels}.nii.gz
    printf 'dense\t%s\t\t--density=1\nfine\t%s\t\t--denoise=gaussian:2 --min-volume=1\n' "$ct" "$ct"
    printf 'absent\t%s\t\t\nno-volume\t%s\t\t\n' "$PWD/absent.nii.gz" "$PWD/bone.stl"
  } > ten.tsv
  "${programs[0]}" -q batch ten.tsv -o begun --pipeline short.yaml --case plain >> log 2>&1
)

# ---- meshes ----

check mesh-formats '
  for f in stl ply obj vtp glb; do
    rhombic mesh "$ct" -t 375.5 --audit --measures a-$f.csv -o a.$f
  done'
check mesh-measures '
  rhombic mesh "$ct" --preset ct-bone-skin --measures a.csv -o a.glb
  rhombic mesh "$ct" --surface skin=-300.5 --measures b.json -o a.ply'
check mesh-space '
  rhombic mesh "$ct" -t 375.5 --space ras -o a.stl
  rhombic mesh "$ct" -t "<-500.5" --space ras -o a.vtp
  rhombic mesh "$ct" -t otsu -o b.obj'
check mesh-lattice '
  rhombic mesh "$inputs/scan.fcc.nrrd" -t -300.5 --mode fine -o a.ply
  rhombic mesh "$ct" -t 375.5 --spacing 9,9,8 --kernel lanczos -o b.ply'
check mesh-table '
  rhombic mesh "$ct" --surface skin=-300.5 --remove-table -o a.stl
  rhombic mesh "$ct" --preset ct-lung --keep-table --largest -o b.stl'
check_scan mesh-lean '
  rhombic mesh "$ge" -t 500.5 --mode lean -o a.stl
  rhombic mesh "$ge" -t 1150.5 -o b.ply'
check_scan mesh-fine '
  rhombic mesh "$ge" -t 1150.5 --mode fine -o a.ply
  rhombic mesh "$ge" -t 500.5 --mode fine --density 0.4 -o b.glb'
check_scan mesh-tetrahedra '
  rhombic mesh "$ge" -t 500.5 --mode tetrahedra -o a.vtp'
check_scan mesh-octahedra '
  rhombic mesh "$ge" -t 500.5 --mode octahedra -o a.obj'
check_scan mesh-parallelepipeds '
  rhombic mesh "$ge" -t 500.5 --mode parallelepipeds -o a.glb'
check_scan mesh-nested '
  rhombic mesh "$body/example_ct_sm.nii.gz" -t -300.5 --nested -o a.stl
  rhombic mesh "$ge" -t 500.5 --nested --mode fine -o b.ply'
check_scan mesh-denoise '
  rhombic mesh "$ge" -t 500.5 --denoise gaussian:2 -o a.stl
  rhombic mesh "$body/example_ct_sm.nii.gz" -t 150.5 --denoise edges:3,60 -o b.stl'
check_scan mesh-simplify '
  rhombic mesh "$ge" -t 500.5 --smooth 0.3 --max-triangles 20% -o a.stl
  rhombic mesh "$ge" -t 1150.5 --max-triangles 9000 -o b.stl'
check_scan mesh-finish '
  rhombic mesh "$ge" -t 500.5 --min-volume 1 --fill --max-error 1 --audit --require-watertight -o a.ply
  rhombic mesh "$ge" -t 1150.5 --largest -o b.ply'
check_scan mesh-tilt '
  rhombic mesh "$tilt" -t 300.5 --density 0.2 -o a.stl
  rhombic mesh "$tilt" -t 300.5 --on-irregular=error -o b.stl'
check_scan mesh-mr '
  rhombic mesh "$mr" -t 60.5 --mode fine --density 0.3 -o a.ply'
check_scan mesh-auto '
  rhombic mesh "$body/ct_aorta_cropped.nii.gz" --preset auto -o a.glb
  rhombic mesh "$ge" --preset auto -o b.glb'

# ---- labels ----

check labels-names '
  rhombic mesh "$ct" --labels "$labels" --audit --measures a.csv -o a-{name}.stl
  rhombic mesh "$labels" --smooth 0.3 --max-error 2 -o b-{name}.ply'
check labels-walls '
  rhombic mesh "$labels" --only "group:organs,group:lungs" -o a.vtp
  rhombic audit a.vtp
  rhombic audit a.vtp --json'
check labels-scene '
  rhombic mesh "$ct" --preset ct-organs --labels "$labels" --label "liver=#994736,0.5" --label "*lung" --label 20 --max-triangles 30% -o a.glb'
check labels-probabilities '
  rhombic render "$inputs/ten/phantom.nii.gz" --probabilities "$inputs/ten/phantom.nii.gz" -o refused.png
  python3 "$here/same-bytes.py" --probabilities "$labels" 10 15 17
  rhombic mesh "$ct" --probabilities 10.nii.gz --probabilities 15.nii.gz --probabilities 17.nii.gz -o a.glb
  rhombic render "$ct" --probabilities 17.nii.gz --probabilities 15.nii.gz --size 150 -o a.png'
check_scan labels-body '
  rhombic mesh $small --min-volume 1 -o a-{name}.stl
  rhombic mesh $small --nested -o b.vtp'
check_scan labels-overlap '
  rhombic mesh "$seg/ct-3slice" --labels "$seg/partial_overlaps.dcm" --density 0.2 --audit -o a.glb
  rhombic mesh "$seg/24x38x3/image" --labels "$seg/partial_overlaps.dcm" -o refused.glb
  rhombic mesh "$seg/partial_overlaps.dcm" -o b-{name}.ply
  rhombic info "$seg/partial_overlaps.dcm"
  rhombic render "$seg/partial_overlaps.dcm" --size 200 -o a.png'
check_scan labels-masks '
  mkdir masks && cp "$seg"/{liver,heart,spine}_seg.nrrd masks
  rhombic mesh masks --density 0.2 -o a-{name}.stl
  rhombic info "$seg/ct-3slice" --labels masks --json
  rhombic mesh masks/liver_seg.nrrd --density 0.2 -o b.stl
  rhombic mesh --labels "$seg/liver.dcm" "$seg/ct-3slice" --density 0.2 -o c.glb'
check_scan labels-frog '
  rhombic mesh "$scans/frog_labels_metaimage/frogtissue.mhd" --only "label 1*" --density 0.05 -o a.vtp'
check_scan labels-other '
  rhombic info "$body/example_ct.nii.gz" --labels "$body/example_seg.nii.gz"
  rhombic mesh "$ge" --labels "$body/example_seg.nii.gz" -o a.glb
  rhombic mesh "$brains/AIL.nii.gz" --probabilities "$brains/AIL.nii.gz" -o b.stl'

# ---- pictures ----

check picture-views '
  rhombic render "$ct" --preset ct-bone-skin --view all --same-scale --size 150 -o a.png
  rhombic render "$ct" --preset ct-bone --view 30,15 --view left --size 150x200 -o b.png'
check picture-styles '
  for s in clinic paper transparent; do
    rhombic render "$ct" --preset ct-bone-skin --style $s --size 150 -o $s.png
  done
  rhombic render "$ct" --preset ct-bone --background "#335" --no-shadows --no-silhouettes --size 150 -o a.png'
check picture-annotate '
  rhombic render "$ct" --preset ct-bone-skin --annotate letters,scale,legend,figure,footnote --title "A title" --size 400 -o a.png
  rhombic render "$ct" --preset ct-bone --annotate none --size 150 -o b.png
  rhombic render "$ct" --preset ct-bone --no-letters --size 150 -o c.png'
check picture-camera '
  rhombic render "$ct" --preset ct-bone --perspective --size 150 -o a.png
  rhombic render "$labels" --focus "*kidney*" --zoom 1.2 --size 200 -o b.png
  rhombic render "$ct" --preset ct-bone --pixel-size 4 -o c.png'
check picture-names '
  rhombic render "$labels" --only "liver,*lung*,group:bones" --hide "*right*" --draw "*lung*=,0.4" --draw "liver=#994736,,glossy" --size 200 -o a.png
  rhombic render "$labels" --colours safe --style paper --size 200 -o b.png
  rhombic render "$labels" --colours file --size 200 -o c.png'
check picture-cuts '
  rhombic render "$ct" --labels "$labels" --preset ct-organs --cut coronal=liver --uncut group:bones --size 200 -o a.png
  rhombic render "$ct" --preset ct-bone --cut "z>300" --cut sagittal --show-slice axial=100 --window bone --view 30,30 --size 200 -o b.png'
check picture-formats '
  for f in jpg tif exr png; do
    rhombic render "$ct" --preset ct-bone-skin --size 150 -o a.$f
  done
  rhombic render "$ct" --preset ct-bone --style transparent --size 150 -o b.exr
  rhombic render "$ct" --preset ct-bone --style transparent --size 150 -o b.jpg'
check picture-turntable '
  rhombic render "$ct" --preset ct-bone --turntable 4 --size 120 -o a.gif
  rhombic render "$ct" --preset ct-bone --turntable 3 --size 120 -o b.png'
check picture-files '
  rhombic render "$inputs/scene.glb" --draw skin=steelblue,0.3 --size 200 -o a.png
  rhombic render "$inputs/bone.stl" "$inputs/scene.glb" --cut axial --size 200 -o b.png
  rhombic render "$inputs/cut.stl" -o c.png'
check picture-dicom-sc '
  rhombic render "$ct" --preset ct-bone --size 150 --dicom-sc -o a.png
  rhombic render "$ct" --preset ct-bone --turntable 2 --size 100 --dicom-sc -o b.gif
  rhombic render "$ct" --preset ct-bone --sheet --dpi 40 --dicom-sc -o c.png
  rhombic render "$labels" --dicom-sc -o d.png'
check picture-from '
  rhombic render "$ct" --from "$inputs/picture-left.png.json" -o a.png
  rhombic render "$inputs/ten/dicom" --from "$inputs/picture-left.png.json" --view superior -o b.png
  rhombic render "$ct" --labels "$labels" --preset ct-organs --slice axial=liver --window abdomen --size 150 -o c.png
  rhombic render "$ct" --labels "$labels" --from c.png.json -o d.png
  rhombic render "$inputs/ten/phantom.nii.gz" --labels "$inputs/ten/phantom-labels.nii.gz" --from c.png.json -o e.png
  rhombic render "$ct" --labels "$labels" --from c.png.json --size 100 -o f.png
  rhombic compare-pictures c.png d.png
  rhombic render "$ct" --from "$inputs/scene.glb.json" -o g.png'
check picture-compare '
  rhombic render "$ct" --preset ct-bone --size 100 -o a.png
  rhombic render "$ct" --preset ct-skin --size 100 -o b.tif
  rhombic compare-pictures a.png b.tif
  rhombic compare-pictures a.png b.tif --json --tolerance 20
  rhombic compare-pictures a.png a.png --json
  rhombic compare-pictures a.png "$inputs/picture-left.png"
  rhombic compare-pictures a.png a.png.json
  rhombic compare-pictures a.png nothing.png'
check picture-preset '
  rhombic render --list-presets
  cp "$here/../pipelines/presets/ct-bone-skin.yaml" own.yaml
  rhombic render "$ct" --preset own.yaml --size 150 -o a.png
  for p in ct-skin ct-lung ct-vessels outline mr-head mr-brain pet-hot-spots uncalibrated-ct auto; do
    rhombic render "$ct" --preset $p --size 100 -o $p.png
  done'
check_scan picture-auto-ct '
  rhombic render "$body/example_ct_sm.nii.gz" --preset auto --size 200 -o a.png
  rhombic render $small --preset auto --size 300 -o b.png
  rhombic render "$ge" --preset auto --size 200 -o c.png
  rhombic render "$scans/ct_body_totalseg_dicom_j2k" --preset auto --density 0.05 --size 200 -o d.png'
check_scan picture-auto-mr '
  rhombic render "$heads/mri_t1_example.nii.gz" --preset auto --density 0.3 --size 200 -o a.png
  rhombic render "$mr" --preset auto --density 0.05 --size 200 -o b.png
  rhombic render "$brains/ALS.nii.gz" --preset mr-brain --size 200 -o c.png'
check_scan picture-auto-pet '
  rhombic render "$pet" --preset auto --density 0.3 --size 200x0 -o a.png'
check_scan picture-head '
  rhombic render "$ge" --surface "bone=1150,#f1d691" --surface "skin=500,#d9a58c,0.3" --view all --size 300 -o a.png
  rhombic render "$ge" --surface bone=1150,ivory --cut sagittal --size 0x300 -o b.png'
check_scan picture-organs '
  rhombic render $small --size 400 -o a.png
  rhombic render $small --preset ct-organs --view posterior --style paper --size 300 -o b.png'

# ---- slices and pages ----

check slices '
  rhombic render "$ct" --labels "$labels" --slice axial=liver --slice coronal --slice "sagittal=#20" --window abdomen --size 200 -o a.png
  rhombic render "$labels" --slice axial=heart --neurological --size 200 -o b.png
  rhombic render "$ct" --preset ct-bone --slice axial=12.5 --no-outlines --window 350/50 --annotate scale --size 200 -o c.png'
check lightbox '
  rhombic render "$ct" --preset ct-bone --slice axial --lightbox 12 --window bone --size 600 -o a.png
  rhombic render "$ct" --labels "$labels" --preset ct-organs --slice coronal --lightbox 4 --size 300 -o b.jpg'
check_scan slices-scan '
  rhombic render "$ge" --surface bone=1150 --slice axial --slice sagittal=nowhere --size 200 -o a.png
  rhombic render $small --slice "axial=#12" --slice coronal=liver --size 300 -o b.png
  rhombic render "$tilt" --surface bone=300.5 --density 0.1 --slice axial --size 200 -o c.png'
check page '
  rhombic render "$ct" --labels "$labels" --preset ct-organs --sheet --dpi 50 -o a.png
  rhombic render "$ct" --preset ct-bone-skin --sheet --dpi 50 -o b.tif
  rhombic render "$labels" --sheet --landscape --style clinic --title Phantom --dpi 60 -o c.png'
check page-pdf '
  rhombic render "$ct" --labels "$labels" --preset ct-organs --sheet --dpi 50 -o a.pdf
  rhombic render "$ct" --preset ct-bone --sheet --landscape --dpi 50 -o b.pdf'
check_scan page-scan '
  rhombic render $small --sheet --dpi 60 -o a.png
  rhombic render "$ge" --preset auto --sheet --dpi 60 -o b.pdf'

# ---- many scans ----

check pipeline '
  rhombic render "$ct" --labels "$labels" --pipeline "$inputs/pipeline.yaml" -o pictures
  rhombic mesh "$ct" --labels "$labels" --pipeline "$inputs/pipeline.yaml" -o meshes
  rhombic mesh "$ct" --pipeline "$inputs/pipeline.yaml" -o without-labels
  rhombic render "$ct" --pipeline "$inputs/pipeline.yaml" --size 100 -o refused'
check batch-ten '
  rhombic batch "$inputs/ten.tsv" -o out --pipeline "$inputs/short.yaml" --jobs 2
  rhombic batch "$inputs/ten.tsv" -o out --pipeline "$inputs/short.yaml" --dry-run
  rhombic batch -o out --stats
  rhombic batch "$inputs/ten.tsv" -o out --pipeline "$inputs/short.yaml" --tables'
check batch-folder '
  rhombic batch "$inputs/ten" -o out --jobs 2
  rhombic batch "$inputs/ten" -o other --names-from-paths --no-cases-table --dry-run
  rhombic batch "$inputs/ten" -o out'
check batch-pipeline '
  rhombic batch "$inputs/ten.tsv" -o out --pipeline "$inputs/pipeline.yaml" --jobs 2 --case "*-labels"
  rhombic batch "$inputs/ten.tsv" -o out --pipeline "$inputs/pipeline.yaml" --tables --no-cases-table'
check batch-begun '
  cp -r "$inputs/begun" .
  rhombic batch "$inputs/ten.tsv" -o begun --pipeline "$inputs/short.yaml" --case plain --case ten >log 2>&1 && rm log
  rhombic batch "$inputs/ten.tsv" -o begun --pipeline "$inputs/short.yaml" --tables'
check batch-refused '
  for output in "picture: a.bmp" "picture: [a.png" "mesh: a.stl, size: 100" "volume: a.fcc.nrrd, density: much" "nothing: a.png" \
      "page: a.png, sheet: true" "picture: a.png, surface: [a=1=2]" "picture: ../a.png" "picture: a.png, desity: 1"; do
    printf "outputs:\n  - { %s }\n" "$output" > pipeline.yaml
    rhombic batch "$inputs/ten" -o out --pipeline pipeline.yaml
    rhombic render "$ct" -o out --pipeline pipeline.yaml
  done
  printf "case\tscan\n../a\tb\n" > bad.tsv
  rhombic batch bad.tsv -o out
  rhombic batch nothing -o out
  rhombic batch -o out --stats
  rhombic batch "$inputs/ten"'
check bids '
  rhombic bids "$inputs/bids" out participant --pipeline "$inputs/short.yaml"
  rhombic bids "$inputs/bids" part participant --participant-label 02 --pipeline "$inputs/short.yaml"
  rhombic bids "$inputs/bids" part group --pipeline "$inputs/short.yaml"
  rhombic bids "$inputs/bids" other participant --dry-run
  rhombic bids "$inputs" out participant'

# ---- lattice volumes ----

check resample '
  for k in cubic linear lanczos; do
    rhombic resample "$ct" --kernel $k -o $k.fcc.nrrd
  done
  rhombic resample "$ct" --nested -o nested.fcc.nrrd
  rhombic resample "$ct" --denoise gaussian:4 --density 1 -o a.fcc.nrrd
  for f in nrrd nii nii.gz mha; do
    rhombic resample "$inputs/scan.fcc.nrrd" -o back.$f
  done'
check_scan resample-scan '
  for k in cubic linear lanczos; do
    rhombic resample "$ge" --kernel $k -o $k.fcc.nrrd
    rhombic resample $k.fcc.nrrd -o $k.nii
  done
  rhombic resample "$ge" --nested -o nested.fcc.nrrd
  rhombic resample "$brains/PSL.nii.gz" --spacing 3 -o a.fcc.nrrd
  rhombic resample "$seg/24x38x3/image" --series 1 -o b.fcc.nrrd'

# ---- looking and judging ----

inspect() { # SCAN...: text and JSON
  local scan
  for scan in "$@"; do echo "== $scan" | tee -a /dev/stderr && rhombic info "$scan" && rhombic info "$scan" --json; done
}
check info '
  inspect "$ct" "$phantom" "$labels" "$inputs/scan.fcc.nrrd" "$inputs/bone.stl" "$inputs/nothing"
  rhombic info "$ct" --labels "$labels"
  rhombic info "$ct" --labels "$labels" --label-table "$phantom/phantom-labels.tsv" --json'
check_scan info-scans '
  for folder in "$scans"/{ct,mr,pet,frog}*; do
    inspect "$folder" $(find "$folder" -name "*.nii.gz" -o -name "*.mhd" | sort)
  done'
check_scan info-orientations '
  for brain in "$brains"/*.nii.gz; do
    rhombic info "$brain"
  done'
check_scan info-nifti '
  for file in "$scans"/nifti_awkward/*; do
    inspect "$file"
    rhombic info "$file" --frame 0 --analyze
  done'
check_scan info-dicom '
  inspect "$scans/dicom_awkward_pydicom"/*
  inspect $(find "$scans/dicom_awkward_dicom2nifti" "$seg" -type d | sort)'
check_scan info-segmentations '
  inspect "$seg"/*.dcm "$seg"/*.nrrd
  rhombic info "$body/example_ct.nii.gz" --labels "$body/example_seg_fast_force_split.nii.gz" --json'
check audit '
  rhombic audit "$inputs/bone.stl" "$inputs/scene.glb"
  rhombic audit "$inputs/scene.glb" --json
  rhombic audit "$inputs/cut.stl"
  rhombic audit "$ct"
  rhombic audit nothing.stl
  rhombic mesh "$ct" -t 375.5 -o a.vtp
  rhombic audit a.vtp --max-tested 0
  head -c 9000 a.vtp > b.vtp
  rhombic audit b.vtp
  echo "v 0 0 0" > a.obj
  rhombic audit a.obj
  printf "solid a\nfacet\n" > c.stl
  rhombic audit c.stl'
check phantom '
  rhombic phantom --spacing 10 -o a
  rhombic phantom --spacing 20 -o b
  rhombic phantom -o a
  rhombic phantom'
check doctor '
  rhombic doctor
  rhombic --version'
check help '
  rhombic --help
  for command in info render mesh batch bids compare-labels compare-pictures audit resample compare phantom doctor; do
    rhombic $command --help
  done'

# ---- sentences ----

check usage '
  rhombic
  rhombic draw
  rhombic --nothing
  rhombic mesh
  rhombic mesh "$ct"
  rhombic mesh "$ct" -o a.stl
  rhombic mesh "$ct" -t 375.5 -o a.xyz
  rhombic mesh "$ct" -t much -o a.stl
  rhombic mesh "$ct" -t 375.5 --desity 1 -o a.stl
  rhombic mesh "$ct" -t 375.5 --density 1 --nested -o a.stl
  rhombic mesh "$ct" -t 375.5 --density -1 -o a.stl
  rhombic mesh "$ct" -t 99999 -o a.stl
  rhombic mesh "$ct" -t 375.5 --mode leen -o a.stl
  rhombic mesh "$ct" -t 375.5 --max-triangles many -o a.stl
  rhombic mesh "$ct" -t 375.5 --denoise edges:1 -o a.stl
  rhombic mesh "$ct" -t 375.5 --space xyz -o a.stl
  rhombic mesh "$ct" --surface a=1,nocolour -o a.glb
  rhombic mesh "$ct" --surface a=1,red,2 -o a.glb
  rhombic mesh "$ct" --surface a=1 --surface a=2 -o a.glb
  rhombic mesh "$ct" --surface a=1 --surface b=2 -o a.stl
  rhombic mesh "$labels" --label kidny -o a.glb
  rhombic mesh "$ct" --label liver -o a.glb
  rhombic mesh "$ct" --preset ct-bonn -o a.glb
  rhombic mesh "$ct" -t 1 --series 9 -o a.stl
  rhombic mesh "$ct" -t 1 --frame 2 -o a.stl
  rhombic mesh "$ct" -t 375.5 --max-memory 1k -o a.stl
  rhombic mesh "$ct" -t 375.5 -o nowhere/a.stl
  rhombic mesh "$ct" -t 375.5 --measures a.txt -o a.stl
  rhombic -q -v info "$ct"
  rhombic --threads 0 info "$ct"'
check usage-render '
  rhombic render "$ct" -o a.png
  rhombic render "$ct" --preset ct-bone
  rhombic render "$ct" --preset ct-bone -o a.gif
  rhombic render "$ct" --preset ct-bone --turntable 1 -o a.gif
  rhombic render "$ct" --preset ct-bone --size 10 -o a.png
  rhombic render "$ct" --preset ct-bone --view up -o a.png
  rhombic render "$ct" --preset ct-bone --slice axial=nothing -o a.png
  rhombic render "$ct" --preset ct-bone --cut "w>1" -o a.png
  rhombic render "$ct" --preset ct-bone --window nothing -o a.png
  rhombic render "$ct" --preset ct-bone --style dark -o a.png
  rhombic render "$ct" --preset ct-bone --background nocolour -o a.png
  rhombic render "$ct" --preset ct-bone --annotate names -o a.png
  rhombic render "$ct" --preset ct-bone --focus liver -o a.png
  rhombic render "$ct" --preset ct-bone --draw "liver" -o a.png
  rhombic render "$ct" --preset ct-bone --draw "bone=,,shiny" -o a.png
  rhombic render "$ct" --preset ct-bone --only "group:feet" -o a.png
  rhombic render "$ct" --preset ct-bone --hide bone -o a.png
  rhombic render "$ct" --preset ct-bone --sheet --size 100 -o a.png
  rhombic render "$ct" --preset ct-bone --lightbox 3 -o a.png
  rhombic render "$ct" --preset ct-bone --uncut bone -o a.png
  rhombic render "$ct" --preset ct-bone --pixel-size 1 --zoom 2 -o a.png
  rhombic render "$ct" --from nothing.json -o a.png
  rhombic render "$inputs/scene.glb" --slice axial -o a.png
  rhombic render "$inputs/scene.glb" "$ct" -o a.png
  rhombic render "$ct" --preset ct-bone --colours red -o a.png
  rhombic compare nothing.yaml -o a
  rhombic compare-pictures a.png
  rhombic resample "$ct"
  rhombic resample "$ct" -o a.png
  rhombic resample "$ct" --kernel sinc -o a.fcc.nrrd
  rhombic bids a b c
  rhombic doctor now
  rhombic audit
  rhombic info'
check_malformed malformed-dicom '
  for file in "$malformed"/d_*.dcm; do # beside a sound slice, which is moved by 1 mm
    sound=$malformed/d_$(basename "$file" .dcm | cut -d _ -f 2)_ok.dcm
    [ -f "$sound" ] || sound=$malformed/d_ok.dcm
    rm -rf series
    mkdir series
    cp "$file" series/bad.dcm
    LC_ALL=C sed "s/-103\.79415804148/-102.79415804148/; s/0.0.58\.5/0\\\\0\\\\59.5/" "$sound" > series/sound.dcm
    echo "== $file" | tee -a /dev/stderr
    rhombic info series
    rhombic resample series -o "$(basename "$file").fcc.nrrd"
  done
  rhombic info "$malformed"'
check_malformed malformed-nifti '
  for file in "$malformed"/n_*; do
    echo "== $file" | tee -a /dev/stderr
    rhombic info "$file"
    rhombic resample "$file" -o "$(basename "$file").fcc.nrrd"
  done'
check_scan malformed-series '
  mkdir gap
  cp "$ge"/CTHead{20,21,22,23,25,26,27}.dcm gap
  rhombic info gap
  rhombic mesh gap -t 500.5 -o a.stl
  rhombic mesh gap -t 500.5 --on-gap=interpolate -o b.stl
  rhombic mesh "$scans/dicom_awkward_dicom2nifti/failing/notavolume/001" -t 100 -o c.stl'

while [ $running -gt 0 ]; do
  wait -n
  running=$((running - 1))
done
echo "$(grep -c '^same' "$work/results") same, $(grep -c '^DIFFERS' "$work/results") differ"
[ -s "$work/results" ] && ! grep -q '^DIFFERS' "$work/results"
