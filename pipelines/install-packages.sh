#!/usr/bin/env bash
# Installs the Debian 12 packages that building and testing Rhombic needs. Says and does nothing when all are there.
set -euo pipefail

packages=(
  ca-certificates ccache cmake g++ git ninja-build pkg-config
  libinsighttoolkit5-dev libvtk9-dev
  libopenimageio-dev openimageio-tools
  libegl-dev libegl1 libgl1-mesa-dri libx11-dev
  libcli11-dev libyaml-cpp-dev nlohmann-json3-dev libspdlog-dev zlib1g-dev libhwy-dev libmeshoptimizer-dev
  libgtest-dev dcm2niix f3d doxygen dpkg-dev file help2man
)

missing=()
for package in "${packages[@]}"; do
  if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" != installed ]; then
    missing+=("$package")
  fi
done
[ ${#missing[@]} -eq 0 ] && exit 0

run=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "These packages are missing; install them as root: ${missing[*]}" >&2
    exit 1
  fi
  run=(sudo)
fi
echo "Installing ${#missing[@]} packages: ${missing[*]}"
log=$(mktemp)
if ! { "${run[@]}" apt-get update -qq &&
       "${run[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  cat "$log" >&2
  exit 1
fi
rm -f "$log"
