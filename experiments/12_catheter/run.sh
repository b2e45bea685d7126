#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# A search for a policy that steers a catheter, a million judged steps, and times of steps; writes tables and a plot.
#
#   experiments/12_catheter/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--no-build] [--threads N]
#
# The options are explained in experiments/common/run_options.sh; --threads: processes of the search. --quick: a minute; otherwise
# about an hour on one core. What is judged goes on where an earlier run ended.
set -euo pipefail
cd "$(dirname "$0")/../.."
name=catheter
targets=cellwalk_python
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh
python=$(sed -n 's/^Python3_EXECUTABLE:[A-Z]*=//p' "$build/CMakeCache.txt")  # for which the module was built
PYTHONPATH=$(realpath "$build")/python
export PYTHONPATH PYTHONDONTWRITEBYTECODE=1

if $quick; then
  search=(--rounds 4 --forks 1 --vertices 25 --trials 16) steps=1000
else
  search=() steps=1000000
fi
"$python" examples/python/learn_catheter.py --processes "$threads" --out "$out" "${search[@]}"
"$python" experiments/12_catheter/judged_steps.py --steps "$steps" --out "$out"
if ! $counts; then "$python" experiments/12_catheter/times.py --out "$out"; fi
"$python" experiments/12_catheter/summarize.py "$out" || [ $? -eq 3 ]
echo "catheter: $out/tables.md"
