#!/usr/bin/env bash
# Builds the 3-D views of the report and of the live page from web/ into the modules' assets/, where
# they are committed, so that building ofm-slam needs neither npm nor a connection. Needs npm
# (Debian: nodejs, npm).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../web"
npm ci --ignore-scripts --no-audit --no-fund
npm test
npm run build
version=$(node -p 'JSON.parse(fs.readFileSync("node_modules/three/package.json")).version')
# Licences ask to be kept: the notices go first, in the one file that a page carries.
for script in ../src/ofm/report/assets/viewer.js ../src/ofm/view/assets/live.js; do
  {
    printf '/*! A 3-D view of ofm-slam. Copyright the ofm-slam authors, Apache-2.0.\n'
    printf 'Holds three.js %s (https://threejs.org):\n\n' "$version"
    cat node_modules/three/LICENSE
    printf '*/\n'
    cat "$script"
  } >"$script.new"
  mv "$script.new" "$script"
done
