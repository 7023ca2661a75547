#!/usr/bin/env bash
# From a fresh Debian 12 to a result: installs what is missing, builds the program, and runs the
# demonstration, which needs no data, no network weights and no connection.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/install-dependencies.sh
cmake --preset release
cmake --build --preset release --parallel "$(tools/jobs.sh)" --target ofm-slam
build/release/bin/ofm-slam demo --output out/demo
