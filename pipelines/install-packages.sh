#!/usr/bin/env bash
# install-packages.sh [tests]
#
# Installs the Debian 12 packages that building and running Rhombic needs; with `tests`, those that its tests need, too.
# Says and does nothing when all are there.
set -euo pipefail

packages=(
  ca-certificates ccache cmake g++ git ninja-build pkg-config
  libinsighttoolkit5-dev libvtk9-dev
  libopenimageio-dev openimageio-tools # the CMake package of the first looks for the programs of the second
  libgif-dev libjpeg62-turbo-dev
  libegl-dev libegl1 libgl1-mesa-dri
  libpango1.0-dev fonts-dejavu-core
  libcli11-dev libyaml-cpp-dev nlohmann-json3-dev libspdlog-dev zlib1g-dev libblosc-dev libzstd-dev libexpat1-dev libhwy-dev libmeshoptimizer-dev
)
if [ "${1-}" = tests ]; then
  packages+=(chromium firefox-esr libgtest-dev lib3mf-dev dcm2niix dcmtk dicom3tools f3d doxygen dpkg-dev file help2man poppler-utils strace
             xauth xvfb)
  command -v npm >/dev/null || packages+=(nodejs npm) # Debian's do not install beside others
fi

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

# Prints how far apt is, in steps of 20 % of its packages, from the lines that it writes for each of them.
show_progress() {
  local line stage percent total=0 count=0 next=0 last=
  while IFS= read -r line; do
    case $line in
      *' newly installed, '*)
        total=${line#*upgraded, }
        total=${total%% *}
        continue
        ;;
      Get:*) stage=downloaded ;;
      Unpacking*) stage=unpacked ;;
      'Setting up'*) stage=installed ;;
      *) continue ;;
    esac
    [ "$total" -gt 0 ] || continue
    if [ "$stage" != "$last" ]; then
      count=0
      next=20
      last=$stage
    fi
    count=$((count + 1))
    percent=$((100 * count / total))
    if [ "$percent" -ge "$next" ]; then
      echo "  $stage: $percent %"
      next=$((percent / 20 * 20 + 20))
    fi
  done
}

echo "Installing ${#missing[@]} packages and what they need (2 to 3 minutes and 700 MB of downloads if none are there):"
echo "  ${missing[*]}"
log=$(mktemp)
if ! { "${run[@]}" apt-get update -qq &&
       "${run[@]}" env DEBIAN_FRONTEND=noninteractive \
         apt-get install -y -q -o Dpkg::Use-Pty=0 --no-install-recommends "${missing[@]}"; } 2>&1 | tee "$log" | show_progress; then
  tail -n 40 "$log" >&2
  echo "The packages could not be installed; the whole log is in $log" >&2
  exit 1
fi
rm -f "$log"
