#!/usr/bin/env bash
# check-demo.sh SOURCE RHOMBIC FOLDER: runs pipelines/demo.sh on the small phantom in a tree of links in FOLDER, where
# packages are there and building takes the program RHOMBIC, and looks for what it promises.
set -euo pipefail
source=$1
rhombic=$2
folder=$3

rm -rf "$folder"
mkdir -p "$folder/pipelines"
cp "$source/pipelines/demo.sh" "$folder/pipelines"
printf '#!/bin/sh\n' > "$folder/pipelines/install-packages.sh"
cat > "$folder/pipelines/build.sh" <<END
#!/bin/sh
[ "\$*" = "release rhombic" ] && mkdir -p build/release/bin && ln -s "$rhombic" build/release/bin/rhombic
END
chmod +x "$folder"/pipelines/*.sh

output=$("$folder/pipelines/demo.sh" "$source/testdata/phantom/dicom")
echo "$output"
for picture in phantom-anterior phantom-left phantom-lungs scan; do
  [ -s "$folder/build/demo/$picture.png" ] || { echo "There is no $picture.png" >&2; exit 1; }
done
path=$(sed -n 's/^ *export PATH="\(.*\):\$PATH"$/\1/p' <<<"$output")
"$path/rhombic" --version

for script in "$source"/pipelines/*.sh "$source/tests/run.sh"; do
  bash -n "$script"
done
