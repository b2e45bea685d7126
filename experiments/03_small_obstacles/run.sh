#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# What three segments, and edges without faces, miss among small obstacles: runs the trials, writes tables and plots.
#
#   experiments/03_small_obstacles/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--no-build] [--threads N]
#
# The options are explained in experiments/common/run_options.sh. --quick: seconds; otherwise about 6 minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
name=small_obstacles
targets=small_obstacles
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

options=(--threads "$threads")
if $quick; then options+=(--quick); fi
if ! $counts; then
  if $quick; then options+=(--rounds 1); else options+=(--rounds 7); fi
fi
"$build/experiments/03_small_obstacles/small_obstacles" --out "$out" --commit "$commit" "${options[@]}"
python3 experiments/03_small_obstacles/summarize.py "$out" || [ $? -eq 3 ]
echo "small obstacles: $out/tables.md"
