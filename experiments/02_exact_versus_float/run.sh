#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Exact versus float: walks, sweeps and long simulations under exact and rounded kernels, judged by the oracles of the tests. Writes
# walks.csv, sweeps.csv, flights.csv, failures/, manifest.json, tables.md and plots; times.csv too, unless --counts is given.
#
#   experiments/02_exact_versus_float/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--threads N] [--no-build]
#
# What the options do is said in experiments/common/run_options.sh. --quick takes half a minute, the full run about 40.
set -euo pipefail
cd "$(dirname "$0")/../.."

name=exact_versus_float
# shellcheck disable=SC2034
targets=exact_versus_float
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

parts=(--part walks --part sweeps --part flights --part failures)
if ! $counts; then parts+=(--part times); fi
if $quick; then
  sizes=(--motions 300 --sweeps 200 --moves 3000 --timed 5000)
else
  sizes=(--motions 100000 --sweeps 42000 --moves 100000 --timed 5000)
fi
"$build/experiments/02_exact_versus_float/exact_versus_float" "${parts[@]}" "${sizes[@]}" --out "$out" --threads "$threads" \
  --commit "$commit"
python3 experiments/02_exact_versus_float/summarize.py "$out" || [ $? -eq 3 ]
echo "exact versus float: $out/tables.md"
