#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# What the forecast and each certificate are worth, what moving the ends of an edge in turn means, and what three segments miss along a
# catheter: records motions, runs all parts, writes tables and plots.
#
#   experiments/09_ablation/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--no-build] [--threads N]
#
# With CELLWALK_TEST_DATA, a folder of public meshes, also those in both forms.
# The options are explained in experiments/common/run_options.sh. --quick: seconds; otherwise about 15 minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
name=ablation
targets="ablation cellwalk"
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

options=(--threads "$threads") making=()
if $quick; then options+=(--quick) making+=(--quick); fi
if ! $counts; then
  if $quick; then options+=(--rounds 1); else options+=(--rounds 3); fi
fi
if ! $quick && [ -n "${CELLWALK_TEST_DATA:-}" ]; then options+=(--data "$CELLWALK_TEST_DATA"); fi
python3 experiments/09_ablation/make_scenes.py "$build" "$out/scenes" "${making[@]}"
"$build/experiments/09_ablation/ablation" "$out/scenes/scenes.json" --out "$out" --commit "$commit" "${options[@]}"
python3 experiments/09_ablation/summarize.py "$out" || [ $? -eq 3 ]
echo "ablation: $out/tables.md"
