#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Degenerate worlds: what each kernel says of motions along edges, in facets and through vertices. Writes degenerate.csv,
# touches.csv, manifest.json, tables.md and plots.
#
#   experiments/05_degenerate_worlds/run.sh [--quick] [--out DIR] [--build DIR] [--threads N] [--no-build]
#
# What the options do is said in experiments/common/run_options.sh. --quick takes some seconds, the full run about five minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."

name=degenerate_worlds
# shellcheck disable=SC2034
targets=degenerate_worlds
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

if $quick; then motions=50; else motions=2500; fi
"$build/experiments/05_degenerate_worlds/degenerate_worlds" --motions $motions --out "$out" --threads "$threads" \
  --commit "$commit"
python3 experiments/05_degenerate_worlds/summarize.py "$out" || [ $? -eq 3 ]
echo "degenerate worlds: $out/tables.md"
