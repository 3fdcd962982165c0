#!/usr/bin/env bash
# Writes the manual's pages, of the program and of each of its commands, from what --help says of them.
# make-manual.sh PROGRAM VERSION FOLDER
set -euo pipefail
program=$(realpath "$1")
version=$2
folder=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

write_page() { # NAME [COMMAND]
  printf '#!/bin/sh\nexec "%s" %s "$@"\n' "$program" "${2-}" > "$scratch/$1" # help2man takes the page's name from it
  chmod +x "$scratch/$1"
  local title
  title=$("$scratch/$1" --help | sed -n '1 { s/^Rhombic: //; p }')
  help2man --no-info --version-string "$version" --source "Rhombic $version" --name "${title,}" "$scratch/$1" |
    gzip -9n > "$folder/$1.1.gz"
}

mkdir -p "$folder"
rm -f "$folder"/*.gz
write_page rhombic
for command in $("$program" --help | sed -n '/^Subcommands:/,/^$/ s/^  \([a-z-]\+\) .*/\1/p'); do
  write_page "rhombic-$command" "$command"
done
