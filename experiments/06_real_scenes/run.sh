#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Recorded motions of real scenes, answered by Cellwalk and by peers: builds what is needed, makes and records the scenes, replays
# them, and writes real_scenes.csv, answers.csv, manifest.json, tables.md and the plots. For figures to keep, nothing else should run.
#
#   experiments/06_real_scenes/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--no-build]
#
# The options are explained in experiments/common/run_options.sh. --quick: seconds; otherwise about an hour, 4 GB of files, processes of up to 5 GB.
# With CELLWALK_TEST_DATA, a folder of public meshes, also the scenes in an aneurysm. Scenes in OUT/scenes are not made again.
set -euo pipefail
cd "$(dirname "$0")/../.."
name=real_scenes
targets="real_scenes cellwalk"
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh
if $make && cmake --build "$build" --target help | grep -q finer_cells; then
  cmake --build "$build" --target finer_cells
fi

making=() measuring=()
if $quick; then
  making+=(--quick)
elif [ -n "${CELLWALK_TEST_DATA:-}" ]; then
  making+=(--data "$CELLWALK_TEST_DATA")
fi
if $counts; then
  measuring+=(--rounds 0)
elif $quick; then
  measuring+=(--rounds 1)
fi
python3 experiments/06_real_scenes/make_scenes.py "$build" "$out/scenes" "${making[@]}"
"$build/experiments/06_real_scenes/real_scenes" "$out/scenes/scenes.json" --out "$out" --commit "$commit" "${measuring[@]}"
python3 experiments/06_real_scenes/summarize.py "$out" || [ $? -eq 3 ]
echo "real scenes: $out/tables.md"
