#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Traces rays through tetrahedra, judges the lengths in integers, and times them beside peers in floating point; writes tables.
#
#   experiments/11_track_lengths/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--no-build] [--threads N]
#
# With CELLWALK_TEST_DATA, a folder of public meshes, the full run traces rays through one of them, too.
# The options are explained in experiments/common/run_options.sh. --quick: seconds; otherwise about 15 minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
name=track_lengths
targets=track_lengths
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

options=(--threads "$threads")
if $quick; then options+=(--quick); fi
if ! $counts; then
  if $quick; then options+=(--rounds 3); else options+=(--rounds 7); fi
fi
if ! $quick && [ -n "${CELLWALK_TEST_DATA:-}" ]; then options+=(--mesh "$CELLWALK_TEST_DATA/tet/hammer.msh"); fi
"$build/experiments/11_track_lengths/track_lengths" --out "$out" --commit "$commit" "${options[@]}"
python3 experiments/11_track_lengths/summarize.py "$out"
echo "track_lengths: $out/tables.md"
