#!/usr/bin/env bash
# Installs the Debian (12 or newer) packages that the project needs and that are missing.
# Usage: tools/install-dependencies.sh [--development]
#   --development  also what .ci/run and contributors need: clang, its tools, coverage reports
set -euo pipefail

packages=(
  # tools
  build-essential ccache cmake git ninja-build pkg-config python3
  # libraries
  libboost-dev libceres-dev libcli11-dev libcurl4-openssl-dev libeigen3-dev libfmt-dev liboctomap-dev
  libopencv-dev libpugixml-dev librsvg2-dev libspdlog-dev libsqlite3-dev libssl-dev libyaml-cpp-dev
  nlohmann-json3-dev
  # tests and benchmarks
  libbenchmark-dev libgmock-dev libgtest-dev
)
case "${1:-}" in
  "") ;;
  --development) packages+=(clang clang-format clang-tidy gcovr libomp-dev) ;;
  *)
    echo "usage: $0 [--development]" >&2
    exit 2
    ;;
esac

if ! command -v apt-get >/dev/null; then
  echo "This is no Debian or Ubuntu; install what these packages hold yourself:" >&2
  printf '  %s\n' "${packages[@]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "Run this once as root: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing: ${missing[*]}"
"${as_root[@]}" apt-get update --quiet
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install --quiet --yes --no-install-recommends "${missing[@]}"
