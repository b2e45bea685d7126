#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Walls that move among bodies, answered by Cellwalk and by hierarchies of peers: builds what is needed, moves the walls, and
# writes moving_walls.csv, answers.csv, manifest.json, tables.md and the plots. For figures to keep, nothing else should run.
#
#   experiments/07_moving_walls/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--no-build]
#
# The options are explained in experiments/common/run_options.sh. --quick: seconds; otherwise some minutes, and 2 GB of memory.
set -euo pipefail
cd "$(dirname "$0")/../.."
name=moving_walls
targets=moving_walls
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

options=()
if $quick; then options+=(--quick); fi
if $counts; then options+=(--counts); fi
"$build/experiments/07_moving_walls/moving_walls" --out "$out" --commit "$commit" "${options[@]}"
python3 experiments/07_moving_walls/summarize.py "$out" || [ $? -eq 3 ]
echo "moving walls: $out/tables.md"
