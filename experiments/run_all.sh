#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# All experiments, one after the other, each into a folder of its own.
#
#   experiments/run_all.sh [--quick] [--out DIR] [--build DIR] [--no-build]
#
#   --quick      about a minute each; otherwise some hours in all
#   --out DIR    default: build/experiments_all
#   --build DIR  a build folder of CMake; default: build/release
#   --no-build   the programs in the build folder are up to date
#
# An experiment that fails does not keep the others from running; the exit code is then 1.
set -uo pipefail
cd "$(dirname "$0")/.." || exit

out=build/experiments_all
options=()
while [ $# -gt 0 ]; do
  case "$1" in
    --quick | --no-build) options+=("$1") ;;
    --build) options+=(--build "${2:?run_all.sh: --build needs a folder}"); shift ;;
    --out) out=${2:?run_all.sh: --out needs a folder}; shift ;;
    *) echo "run_all.sh: unknown argument $1; use --quick, --out DIR, --build DIR or --no-build" >&2; exit 2 ;;
  esac
  shift
done

failed=()
for run in experiments/[0-9][0-9]_*/run.sh; do
  name=$(basename "$(dirname "$run")")
  echo "== $name"
  "$run" "${options[@]}" --out "$out/$name" || failed+=("$name")
done
if [ ${#failed[@]} -gt 0 ]; then
  echo "run_all.sh: failed: ${failed[*]}" >&2
  exit 1
fi
echo "all experiments: $out"
