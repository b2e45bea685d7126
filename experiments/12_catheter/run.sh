#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# A search for a policy that steers a catheter, a million judged steps, and times of steps; writes tables and a plot.
#
#   experiments/12_catheter/run.sh [--learn] [--quick] [--counts] [--out DIR] [--build DIR] [--no-build] [--threads N]
#
#   --learn   the search and its plot only: minutes after the build
#
# The options are explained in experiments/common/run_options.sh; --threads: processes of the search. --quick: a minute; otherwise
# hours on one core. What is judged goes on where an earlier run ended. With CELLWALK_TEST_DATA, a folder of public meshes, the policy
# that was learned is tried in three of its vessels, too.
set -euo pipefail
cd "$(dirname "$0")/../.."
name=catheter
targets=cellwalk_python
learn=false
if [ "${1:-}" = --learn ]; then
  learn=true
  shift
fi
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
# vessel FILE CAP RADIUS: the policy in a vessel in which it has not learned.
vessel() {
  "$python" examples/python/learn_catheter.py --processes "$threads" --policy "$out/learning.csv" \
    --vessel "$CELLWALK_TEST_DATA/lumens/$1" --start "$2" --radius "$3" --out "$out/${1%.*}"
}
if ! $learn && ! $quick && [ -n "${CELLWALK_TEST_DATA:-}" ]; then
  vessel carotids.stl cap_1 0.3
  vessel aorta_open_ends.stl cap_1 0.7
  vessel phantom.obj cap_1 0.25
fi
if ! $learn; then
  "$python" experiments/12_catheter/judged_steps.py --steps "$steps" --out "$out"
  if ! $counts; then "$python" experiments/12_catheter/times.py --out "$out"; fi
fi
"$python" experiments/12_catheter/summarize.py "$out" || [ $? -eq 3 ]
echo "catheter: $out/tables.md"
