#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# The paper's figure 8 again, all methods in one process: builds what is needed, records the traces, replays them, and writes
# figure_8.csv, manifest.json, tables.md and figure_8.png/.svg/.pdf. For figures to keep, nothing else should run.
#
# Traces of the motion of the paper (bodies deform and bounce) are n_* and side_*, those of rigid bodies rigid_*.
#
#   experiments/01_figure_8/run.sh [--quick] [--out DIR] [--build DIR] [--steps N] [--rounds N]
#
#   --quick       small grids, few steps, one round: what the test compares; 1 minute with the build. Otherwise about an hour
#   --counts      no times at all, counts and wrong answers only
#   --out DIR     default: build/figure_8 (build/figure_8_quick)
#   --build DIR   a build folder of CMake; default: build/release
#   --steps N     steps of each trace; default 1000, of rigid bodies 200 (quick: 10)
#   --rounds N    timed rounds, after one to warm up; default 7 (quick: 1)
#   --no-build    the programs in the build folder are up to date
set -euo pipefail
cd "$(dirname "$0")/../.."

quick=false build=build/release out="" steps="" rigid_steps="" make=true rounds=""
while [ $# -gt 0 ]; do
  case "$1" in
    --quick) quick=true ;;
    --counts) rounds=0 ;;
    --out) out=${2:?run.sh: --out needs a folder}; shift ;;
    --build) build=${2:?run.sh: --build needs a folder}; shift ;;
    --steps) steps=${2:?run.sh: --steps needs a number}; shift ;;
    --rounds) rounds=${2:?run.sh: --rounds needs a number}; shift ;;
    --no-build) make=false ;;
    *) echo "run.sh: unknown argument $1; use --quick, --counts, --out DIR, --build DIR, --steps N, --rounds N or --no-build" >&2; exit 2 ;;
  esac
  shift
done
if $quick; then
  : "${out:=build/figure_8_quick}" "${rigid_steps:=${steps:=10}}" "${rounds:=1}"
else
  : "${out:=build/figure_8}" "${rigid_steps:=${steps:-200}}" "${steps:=1000}" "${rounds:=7}"
fi

if $make; then
  cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
  cmake --build "$build" --target figure_8 make_traces
fi
programs=$build/experiments/01_figure_8

mkdir -p "$out/traces"
traces=()
# trace NAME OPTION...: records one.
trace() {
  local file=$out/traces/$1.bin
  shift
  "$programs/make_traces" "$file" "$@"
  traces+=("$file")
}
grid=(--cells 40 50 50)
if $quick; then grid=(--cells 20 20 25); fi
# motion PREFIX OPTION...: records a motion in grids of all sizes, and with bodies of other sides in one of them.
motion() {
  local prefix=$1 side
  shift
  trace "${prefix}n_1e3" "$@" --cells 10 10 10
  trace "${prefix}n_1e4" "$@" --cells 20 20 25
  if ! $quick; then
    trace "${prefix}n_1e5" "$@" --cells 40 50 50
    trace "${prefix}n_1e6" "$@" --cells 100 100 100
  fi
  for side in 0.1 1 3; do trace "${prefix}side_$side" "$@" "${grid[@]}" --side $side; done
}
motion "" --motion deforming --steps "$steps"
rigid=(--motion rigid --steps "$rigid_steps")
motion rigid_ "${rigid[@]}"
# Other shares of solid cells.
trace rigid_solid_01 "${rigid[@]}" "${grid[@]}" --solid 0.01
trace rigid_solid_30 "${rigid[@]}" "${grid[@]}" --solid 0.3

commit=$(git describe --always --dirty --abbrev=40 --match '' 2>/dev/null || echo unknown)
"$programs/figure_8" "${traces[@]}" --out "$out" --rounds "$rounds" --commit "$commit"
python3 experiments/01_figure_8/summarize.py "$out" || [ $? -eq 3 ]
echo "figure 8: $out/tables.md"
