#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs what is missing, builds the program and pushes a catheter into a branching vessel that the program
# generates; ends with a summary and a picture, and adds the meshers, which import of surfaces needs. Safe to
# repeat: a new run replaces the last one.
#
#   scripts/demo.sh [--short]      --short: a few steps only, and no meshers
set -euo pipefail
cd "$(dirname "$0")/.."

steps=() short=false
case "${1:-}" in
  "") ;;
  --short) steps=(--steps 20) short=true ;;
  *) echo "demo.sh: unknown argument $1; use --short or nothing" >&2; exit 2 ;;
esac

scripts/setup.sh --for demo

log=$(mktemp)
trap 'rm -f "$log"' EXIT

# build ON|OFF: with or without the meshers.
build() {
  cmake --preset demo -DCELLWALK_WITH_MESHING="$1" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
  cmake --build --preset demo --parallel
}

# The picture needs no meshers, which take a quarter of the time: they come afterwards.
meshers=OFF
if grep -qs "^CELLWALK_WITH_MESHING:BOOL=ON" build/demo/CMakeCache.txt; then meshers=ON; fi
echo "demo: building build/demo/cellwalk (a few minutes the first time)"
build $meshers

mkdir -p out
echo "demo: build/demo/cellwalk run data/vessel.json -o out/vessel --force ${steps[*]}"
build/demo/cellwalk run data/vessel.json -o out/vessel --force "${steps[@]}"
echo "demo: the picture is out/vessel/picture.png; ParaView opens out/vessel/run.pvd"

if [ $meshers = OFF ] && ! $short; then
  echo "demo: adding the meshers, by which build/demo/cellwalk imports surfaces"
  build ON
  echo "demo: done"
fi
