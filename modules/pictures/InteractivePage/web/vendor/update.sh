#!/usr/bin/env bash
# update.sh [write]: compares this folder's files with those of the npm package that they are from; with `write`, replaces
# them. For another version, change the two lines below first.
set -euo pipefail

package=meshoptimizer@1.0.1
checksum=b924093d1a961f10652ac28f02a927af250f2c1be5ef8555db4ef7688af31cad

here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$work" && npm pack --silent "$package" >/dev/null)
echo "$checksum  $(ls "$work"/*.tgz)" | sha256sum --check --quiet
tar -xzf "$work"/*.tgz -C "$work"
for file in meshopt_decoder_reference.js LICENSE.md; do
  [ "${1-}" = write ] && cp "$work/package/$file" "$here"
  cmp "$work/package/$file" "$here/$file"
done
