#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Oracles and scenes over and over, each round with new seeds, for hours. Safe to repeat.
#
#   scripts/soak.sh [--hours H] [--seed S] [--out DIR]      1 hour, seed 1, build/soak; fractions of hours are fine
#
# A round runs every oracle test with seeds of its own (CELLWALK_TEST_SEED), and every scene of data/ with its seeds changed, by one thread
# and by two, which must give the same bytes. Once it runs a scene for long, whose memory must stay flat. Time and memory of all that runs
# go to DIR/rounds.csv. A finding (a failure, other bytes, memory that grows) is kept in DIR/finding-N with the command that shows it
# again; the script goes on, and ends with 1.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --for test
cmake --preset release >/dev/null
mapfile -t targets < <(scripts/soak.py --print-targets)
cmake --build --preset release --parallel --target cellwalk_cli "${targets[@]}"
exec scripts/soak.py "$@"
