#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# What ranks would hand to each other if each had a part of the environment: counts them on scenes, writes tables.
#
#   experiments/08_scaling/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--no-build] [--threads N]
#
# The options are explained in experiments/common/run_options.sh. --quick: seconds; otherwise some minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
name=scaling
targets=scaling
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

options=(--threads "$threads")
if $quick; then options+=(--quick); fi
if ! $counts; then options+=(--rounds 1); fi
"$build/experiments/08_scaling/scaling" --out "$out" --commit "$commit" "${options[@]}"
python3 experiments/08_scaling/summarize.py "$out"
echo "scaling: $out/tables.md"
