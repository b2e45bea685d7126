#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs what is missing, builds the program and pushes a catheter into a branching vessel that the program
# generates; ends with a summary and a picture. Safe to repeat: a new run replaces the last one.
#
#   scripts/demo.sh [--short]      --short: a few steps only
set -euo pipefail
cd "$(dirname "$0")/.."

steps=()
case "${1:-}" in
  "") ;;
  --short) steps=(--steps 20) ;;
  *) echo "demo.sh: unknown argument $1; use --short or nothing" >&2; exit 2 ;;
esac

scripts/setup.sh --for demo

echo "demo: building build/demo/cellwalk (a few minutes the first time)"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --preset demo >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
cmake --build --preset demo --parallel

mkdir -p out
echo "demo: build/demo/cellwalk run data/vessel.json -o out/vessel --force ${steps[*]}"
build/demo/cellwalk run data/vessel.json -o out/vessel --force "${steps[@]}"
echo "demo: the picture is out/vessel/picture.png; ParaView opens out/vessel/run.pvd"
