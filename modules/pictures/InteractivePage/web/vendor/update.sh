#!/usr/bin/env bash
# update.sh [write]: compares this folder's files with those of the npm package in package-lock.json, which has its
# checksum; with `write`, replaces them. For another version, change package.json and run npm install --package-lock-only.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here"/package.json "$here"/package-lock.json "$work"
(cd "$work" && npm ci --ignore-scripts --no-audit --no-fund --silent)
for file in meshopt_decoder_reference.js LICENSE.md; do
  [ "${1-}" = write ] && cp "$work/node_modules/meshoptimizer/$file" "$here"
  cmp "$work/node_modules/meshoptimizer/$file" "$here/$file"
done
