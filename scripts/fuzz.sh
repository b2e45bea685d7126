#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Builds the fuzz targets of tests/fuzz with clang and runs them, one after the other. Safe to repeat: what was found new is kept.
#
#   scripts/fuzz.sh [--seconds N] [--list] [TARGET ...]      60 seconds each; all targets
#
# A line for each target says how many inputs were run. A finding ends its target and, in the end, the script with 1: the input lies
# in build/fuzz/TARGET, the whole report in build/fuzz/TARGET/log.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=60
list=false
targets=()
while [ $# -gt 0 ]; do
  case "$1" in
    --seconds) seconds=${2:-}; shift ;;
    --seconds=*) seconds=${1#--seconds=} ;;
    --list) list=true ;;
    -*) echo "fuzz.sh: unknown option $1; use --seconds N, --list or names of targets" >&2; exit 2 ;;
    *) targets+=("$1") ;;
  esac
  shift
done
[[ $seconds =~ ^[1-9][0-9]*$ ]] || { echo "fuzz.sh: --seconds takes a whole number from 1 on, not '$seconds'" >&2; exit 2; }

mapfile -t all < <(sed -n 's/^set(fuzz_targets \(.*\))$/\1/p' tests/fuzz/CMakeLists.txt | tr ' ' '\n')
if $list; then printf '%s\n' "${all[@]}"; exit 0; fi
[ ${#targets[@]} -gt 0 ] || targets=("${all[@]}")
for target in "${targets[@]}"; do
  [[ " ${all[*]} " == *" $target "* ]] || { echo "fuzz.sh: there is no target $target; there are ${all[*]}" >&2; exit 2; }
done

if ! command -v clang++ >/dev/null; then
  echo "fuzz.sh: clang is missing; scripts/setup.sh --for dev installs it" >&2
  exit 1
fi
echo "fuzz: building with $(nproc) processes"
cmake --preset fuzz >build-fuzz.log 2>&1 || { cat build-fuzz.log >&2; rm -f build-fuzz.log; exit 1; }
rm -f build-fuzz.log
cmake --build --preset fuzz --parallel --target "${targets[@]/#/fuzz_}"

# How long an input may be (bytes), how much memory it may ask for at once, and all it may hold (MB). What a reader asks for follows
# from the length of its input; a gzip stream may hold a thousand times what it takes.
limits() {
  case "$1" in
    build | nonconforming | edits | moves | surface | repair) echo "-max_len=400 -malloc_limit_mb=64 -rss_limit_mb=2048" ;;
    gzip) echo "-max_len=4096 -malloc_limit_mb=16 -rss_limit_mb=2048" ;;
    *) echo "-max_len=4096 -malloc_limit_mb=4 -rss_limit_mb=2048" ;;
  esac
}

# The longest that an input may take: seconds, under sanitizers, on a busy machine.
timeout=10

export UBSAN_OPTIONS=print_stacktrace=1
export ASAN_OPTIONS=quarantine_size_mb=64 # of freed memory, which counts as held
findings=0
for target in "${targets[@]}"; do
  folder=build/fuzz/$target
  mkdir -p "$folder/corpus"
  dictionary=()
  [ ! -e "tests/fuzz/dictionaries/$target" ] || dictionary=("-dict=tests/fuzz/dictionaries/$target")
  status=0
  # shellcheck disable=SC2046
  build/fuzz/tests/fuzz/fuzz_"$target" -max_total_time="$seconds" -timeout=$timeout -print_final_stats=1 -reload=0 \
    $(limits "$target") "${dictionary[@]}" -artifact_prefix="$folder/" "$folder/corpus" "tests/fuzz/corpus/$target" \
    >"$folder/log" 2>&1 || status=$?
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$folder/log" | tail -1)
  coverage=$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' "$folder/log" | tail -1)
  if [ $status -eq 0 ]; then
    echo "fuzz: $target: ${runs:-0} inputs in $seconds s, ${coverage:-0} edges, no finding"
  else
    findings=$((findings + 1))
    input=$(sed -n 's/.*Test unit written to //p' "$folder/log" | tail -1)
    reason=$(grep -a -m1 -E 'ERROR: |runtime error: |finding: |what\(\): ' "$folder/log" || tail -1 "$folder/log")
    echo "fuzz: $target: ${runs:-0} inputs, FINDING: $reason"
    echo "fuzz:   input ${input:-none}, report $folder/log"
  fi
done
[ $findings -eq 0 ] || { echo "fuzz: $findings of ${#targets[@]} targets have a finding" >&2; exit 1; }
