#!/usr/bin/env bash
# Builds and tests with ONNX Runtime in a fresh Debian 13 (trixie), where it is packaged.
# Usage: tools/test_debian13.sh FOLDER [TARGET...]
#   FOLDER  holds the Debian root: made with debootstrap the first time, used again afterwards
#   TARGET  what is built and tested; default: ofm_perception_test ofm-slam ofm_app_test
#           ("all" for everything)
# Run as root. The checkout is copied into the root, so nothing is written beside it here.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

if [ $# -lt 1 ] || [ "${1#-}" != "$1" ]; then
  sed -n '2,6s/^# //p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
if [ "$(id -u)" -ne 0 ]; then
  echo "$0: chroot needs root; run it with sudo" >&2
  exit 1
fi
command -v debootstrap >/dev/null || { echo "$0: install debootstrap first" >&2; exit 1; }

root=$(realpath -m "$1")
shift
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(ofm_perception_test ofm-slam ofm_app_test)
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}
step() { printf '\n=== %s (%d s)\n' "$1" "$SECONDS"; }

step "Debian 13 in $root"
# debootstrap removes its own folder at the end, so a half-made root is not taken for a whole one.
if [ ! -e "$root/etc/debian_version" ] || [ -e "$root/debootstrap" ]; then
  debootstrap --variant=minbase trixie "$root" "$mirror"
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
cat "$root/etc/debian_version"

in_root() { # COMMAND...: in the root, with /proc and /dev of this machine
  unshare --mount --fork bash -c '
    root=$1; shift
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    exec chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 "$@"
  ' in_root "$root" "$@"
}

step "Sources"
mkdir -p "$root/src/ofm-slam"
# What git knows of, and what is new and not ignored; files that are gone here go there too.
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
(cd "$source_dir" && git ls-files -z --cached --others --exclude-standard |
  while IFS= read -r -d '' file; do [ ! -e "$file" ] || printf '%s\0' "$file"; done |
  tar --null --files-from=- -cf -) | tar -xf - -C "$tree"
find "$root/src/ofm-slam" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
cp -a "$tree/." "$root/src/ofm-slam/"

step "Packages"
in_root bash -c 'cd /src/ofm-slam && tools/install-dependencies.sh'
in_root env DEBIAN_FRONTEND=noninteractive apt-get install --quiet --yes --no-install-recommends libonnxruntime-dev

step "Build of ${targets[*]}, ONNX Runtime required"
in_root bash -c '
  cd /src/ofm-slam && cmake --preset ci -DOFM_WITH_ONNXRUNTIME=ON -DOFM_BUILD_BENCHMARKS=OFF &&
    cmake --build --preset ci --parallel "$(tools/jobs.sh)" --target "$@"
' build "${targets[@]}"

step "Tests"
in_root bash -c '
  cd /src/ofm-slam/build/ci && status=0
  for target in "$@"; do
    case $target in
      all) ctest --output-on-failure || status=1 ;;
      *_test) "bin/$target" || status=1 ;;
    esac
  done
  exit $status
' test "${targets[@]}"
step "Passed"
