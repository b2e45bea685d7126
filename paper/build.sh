#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Builds the report from the outputs of the experiments: the full ones where they are in build/, else quick ones, which are made where
# they are missing. Needs LaTeX and gnuplot (scripts/setup.sh --for paper).
#
#   paper/build.sh [--quick] [--from DIR] [--out DIR] [--build DIR]
#
#   --quick      quick outputs only, even where full ones are
#   --from DIR   takes outputs from that of a full experiments/run_all.sh first
#   --out DIR    default: build/paper; receives report.pdf
#   --build DIR  a build folder of CMake, for experiments that have to be run; default: build/release
set -euo pipefail
cd "$(dirname "$0")/.."

only_quick=false from="" out=build/paper build=build/release
while [ $# -gt 0 ]; do
  case "$1" in
    --quick) only_quick=true ;;
    --from) from=${2:?build.sh: --from needs a folder}; shift ;;
    --out) out=${2:?build.sh: --out needs a folder}; shift ;;
    --build) build=${2:?build.sh: --build needs a folder}; shift ;;
    *) echo "build.sh: unknown argument $1; use --quick, --from DIR, --out DIR or --build DIR" >&2; exit 2 ;;
  esac
  shift
done
for program in pdflatex bibtex gnuplot; do
  if ! command -v $program >/dev/null; then
    echo "build.sh: $program not found: run scripts/setup.sh --for paper" >&2
    exit 1
  fi
done

runs=()
# experiment NAME FOLDER: its output, full or quick; NAME is that of the folders in build/.
experiment() {
  if [ -n "$from" ] && [ -f "$from/$2/manifest.json" ]; then
    runs+=("$1=full:$from/$2")
    return
  fi
  if ! $only_quick && [ -f "build/$1/manifest.json" ]; then
    runs+=("$1=full:build/$1")
    return
  fi
  if [ ! -f "build/$1_quick/manifest.json" ]; then
    echo "paper: quick run of $2"
    "experiments/$2/run.sh" --quick --out "build/$1_quick" --build "$build" >"build/$1_quick.log"
  fi
  runs+=("$1=quick:build/$1_quick")
}
mkdir -p build
experiment figure_8 01_figure_8
experiment exact_versus_float 02_exact_versus_float
experiment small_obstacles 03_small_obstacles
experiment contact_search 04_contact_search
experiment degenerate_worlds 05_degenerate_worlds
experiment real_scenes 06_real_scenes
experiment moving_walls 07_moving_walls
experiment scaling 08_scaling
experiment ablation 09_ablation

mkdir -p "$out"
python3 paper/collect_numbers.py "$out" "${runs[@]}"
cp paper/*.tex paper/references.bib docs/images/face_3d.png "$out"
cd "$out"
# latex COMMAND...: what it says is shown only where it fails.
latex() {
  if ! "$@" >step.log 2>&1; then
    tail -n 40 step.log >&2
    exit 1
  fi
}
latex pdflatex -interaction=nonstopmode -halt-on-error report
latex bibtex report
latex pdflatex -interaction=nonstopmode -halt-on-error report
latex pdflatex -interaction=nonstopmode -halt-on-error report
if grep -E "undefined (references|citations)|Citation .* undefined|Reference .* undefined" report.log; then
  echo "build.sh: the report refers to what is not there" >&2
  exit 1
fi
page=$(sed -n 's/^\\newlabel{endoftext}{{[^}]*}{\([0-9]*\)}.*/\1/p' report.aux)
echo "paper: $out/report.pdf, the text without references and appendix ends on page $page"
