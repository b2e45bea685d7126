#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Exact versus float: walks, sweeps and long simulations under exact and rounded kernels, judged by the oracles of the tests. Writes
# walks.csv, sweeps.csv, flights.csv, failures/, manifest.json, tables.md and plots; times.csv too, unless --counts is given.
#
#   experiments/02_exact_versus_float/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--threads N] [--no-build]
#                                               [--long] [--resume]
#
# With CELLWALK_TEST_DATA, a folder of public meshes, the full run walks in two of them, too. What the options do is said in
# experiments/common/run_options.sh. --quick takes half a minute, the full run about ten on one core. --long: 10^8 walks and 10^7 sweeps,
# of the default kernel alone. --resume: goes on where a run with the same options was stopped.
set -euo pipefail
cd "$(dirname "$0")/../.."

long=false
resume=()
others=()
for argument in "$@"; do
  case "$argument" in
    --long) long=true ;;
    --resume) resume=(--resume) ;;
    *) others+=("$argument") ;;
  esac
done
set -- "${others[@]}"

name=exact_versus_float
if $long; then name+=_long; fi
# shellcheck disable=SC2034
targets=exact_versus_float
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

parts=(--part walks --part sweeps --part flights --part failures)
if ! $counts; then parts+=(--part times); fi
if $quick; then
  sizes=(--motions 300 --sweeps 200 --moves 3000 --timed 5000)
elif $long; then
  parts=(--part walks --part sweeps)
  sizes=(--kernel exact --motions 1000000 --sweeps 420000)
else
  sizes=(--motions 20000 --sweeps 8400 --moves 100000 --timed 5000)
  if [ -n "${CELLWALK_TEST_DATA:-}" ]; then
    sizes+=(--mesh "$CELLWALK_TEST_DATA/tet/liver.msh" --mesh "$CELLWALK_TEST_DATA/tet/rod.msh")
  fi
fi
"$build/experiments/02_exact_versus_float/exact_versus_float" "${parts[@]}" "${sizes[@]}" "${resume[@]}" --out "$out" \
  --threads "$threads" --commit "$commit"
if $long; then exit; fi # the tables compare kernels
python3 experiments/02_exact_versus_float/summarize.py "$out" || [ $? -eq 3 ]
echo "exact versus float: $out/tables.md"
