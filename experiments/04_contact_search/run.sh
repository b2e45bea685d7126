#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Dichotomic, exhaustive and exact searches for a contact: runs them, writes tables and plots.
#
#   experiments/04_contact_search/run.sh [--quick] [--counts] [--out DIR] [--build DIR] [--no-build] [--threads N]
#
# The options are explained in experiments/common/run_options.sh. --quick: seconds; otherwise about 3 minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
name=contact_search
targets=contact_search
# shellcheck source=experiments/common/run_options.sh
. experiments/common/run_options.sh

options=(--threads "$threads")
if $quick; then options+=(--quick); fi
if ! $counts; then
  if $quick; then options+=(--rounds 1); else options+=(--rounds 5); fi
fi
"$build/experiments/04_contact_search/contact_search" --out "$out" --commit "$commit" "${options[@]}"
python3 experiments/04_contact_search/summarize.py "$out" || [ $? -eq 3 ]
echo "contact search: $out/tables.md"
