#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Endurance: 10^9 walks and 10^8 complete sweeps of edges, 10^7 of them with a radius, judged by integer arithmetic. Writes a table and a
# manifest of each part, and tables.md. A run that was stopped goes on where it was; so does one with other numbers.
#
#   experiments/13_endurance/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--no-build] [--threads N]
#                                   [--walks N] [--sweeps N] [--membrane-sweeps N] [--thick-sweeps N]
#
# The options are explained in experiments/common/run_options.sh. --quick: seconds; otherwise about an hour on one core. --walks N and the
# others: so many of them instead; 0 for none.
set -euo pipefail
cd "$(dirname "$0")/../.."

walks=1000000000 sweeps=45000000 membrane_sweeps=45000000 thick_sweeps=10000000
others=()
while [ $# -gt 0 ]; do
  case "$1" in
    --walks) walks=${2:?run.sh: --walks needs a number}; shift ;;
    --sweeps) sweeps=${2:?run.sh: --sweeps needs a number}; shift ;;
    --membrane-sweeps) membrane_sweeps=${2:?run.sh: --membrane-sweeps needs a number}; shift ;;
    --thick-sweeps) thick_sweeps=${2:?run.sh: --thick-sweeps needs a number}; shift ;;
    --quick) walks=400000 sweeps=100000 membrane_sweeps=100000 thick_sweeps=40000; others+=("$1") ;;
    *) others+=("$1") ;;
  esac
  shift
done
set -- "${others[@]}"

name=endurance
# shellcheck disable=SC2034
targets=endurance
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

judge() {
  if [ "$2" -eq 0 ]; then return; fi
  "$build/experiments/13_endurance/endurance" --out "$out" --part "$1" --motions "$2" --threads "$threads" --commit "$commit"
}
judge walks "$walks"
judge sweeps "$sweeps"
judge membrane_sweeps "$membrane_sweeps"
judge thick_sweeps "$thick_sweeps"
python3 experiments/13_endurance/summarize.py "$out"
echo "endurance: $out/tables.md"
