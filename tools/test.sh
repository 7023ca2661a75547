#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests; ctest's summary comes last.
# Usage: tools/test.sh [PRESET]    (default: release)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}
jobs=$(tools/jobs.sh)

tools/install-dependencies.sh
cmake --preset "$preset"
cmake --build --preset "$preset" --parallel "$jobs"
ctest --preset "$preset" --parallel "$jobs"
