#!/usr/bin/env bash
# Fails where clang-format would change a file. With --fix it changes it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mode=(--dry-run --Werror)
[ "${1:-}" != --fix ] || mode=(-i)
shopt -s globstar nullglob
clang-format "${mode[@]}" {src,apps,benchmark,tests}/**/*.{h,cc}
