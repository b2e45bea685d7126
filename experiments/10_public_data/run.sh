#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# What public meshes are like, and how far the import gets with them: judges and imports all that are there, and writes tables.
#
#   experiments/10_public_data/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--no-build]
#
# Meshes are looked for in DIR/data and in the folder CELLWALK_TEST_DATA; download.py DIR/data gets most of them from where they are published.
# The options are explained in experiments/common/run_options.sh. --quick: meshes with faults that the test makes, seconds; otherwise some minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
name=public_data
targets=cellwalk
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

python=$(sed -n 's/^Python3_EXECUTABLE:[A-Z]*=//p' "$build/CMakeCache.txt")  # one that has NumPy, if the module was built
python=${python:-python3}
mkdir -p "$out/data"
folders=("$out/data")
options=()
if $quick; then
  "$python" experiments/10_public_data/make_faulty.py "$out/data"
  options+=(--sources "$out/data/sources.json")
elif [ -n "${CELLWALK_TEST_DATA:-}" ]; then
  folders+=("$CELLWALK_TEST_DATA")
fi
"$python" experiments/10_public_data/end_states.py "$build/cellwalk" "$out" "${folders[@]}" "${options[@]}"
if ! $counts; then options+=(--times); fi
"$python" experiments/10_public_data/audit.py "$build/cellwalk" "$out" "${folders[@]}" "${options[@]}"
"$python" experiments/10_public_data/summarize.py "$out"
echo "public data: $out/tables.md"
