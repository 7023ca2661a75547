#!/usr/bin/env bash
# Builds the report's 3-D view from web/ into src/ofm/report/assets/, where it is committed, so that
# building ofm-slam needs neither npm nor a connection. Needs npm (Debian: nodejs, npm).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../web"
npm ci --ignore-scripts --no-audit --no-fund
npm test
npm run build
# Licences ask to be kept: the notices go first, in the one file that a report carries.
assets=../src/ofm/report/assets
{
  printf '/*! The 3-D view of ofm-slam. Copyright the ofm-slam authors, Apache-2.0.\n'
  printf 'Holds three.js %s (https://threejs.org):\n\n' "$(node -p 'JSON.parse(fs.readFileSync("node_modules/three/package.json")).version')"
  cat node_modules/three/LICENSE
  printf '*/\n'
  cat "$assets/viewer.js"
} >"$assets/viewer.js.new"
mv "$assets/viewer.js.new" "$assets/viewer.js"
