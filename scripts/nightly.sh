#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# What is too long for every commit: hours, where .ci/run takes a part of one. Safe to repeat; what was built is used again.
#
#   scripts/nightly.sh [--fuzz-seconds N] [PART ...]      600 seconds for each fuzz target; all parts, in this order
#
#   sources   each source compiled by itself
#   tidy      clang-tidy over src
#   long      the tests at their nightly length
#   asan      all tests under the address and undefined-behaviour sanitizers, a twentieth of the usual length
#   tsan      all tests under the thread sanitizer, of the same length
#   fuzz      every fuzz target
#   tutorials typed in a clean Debian 12 and a clean Debian 13
#   soak      oracles and scenes with new seeds, for an hour
#
# A part that fails does not keep the others from running. The last line names the parts that failed; then the script ends with 1.
set -euo pipefail
cd "$(dirname "$0")/.."

parts=(sources tidy long asan tsan fuzz tutorials soak)
wanted=()
seconds=600
while [ $# -gt 0 ]; do
  case "$1" in
    --fuzz-seconds) seconds=${2:-}; shift ;;
    --fuzz-seconds=*) seconds=${1#--fuzz-seconds=} ;;
    -*) echo "nightly.sh: unknown option $1; use --fuzz-seconds N, or names of parts" >&2; exit 2 ;;
    *)
      [[ " ${parts[*]} " == *" $1 "* ]] || { echo "nightly.sh: there is no part $1; there are ${parts[*]}" >&2; exit 2; }
      wanted+=("$1")
      ;;
  esac
  shift
done
[[ $seconds =~ ^[1-9][0-9]*$ ]] || { echo "nightly.sh: --fuzz-seconds takes a whole number from 1 on, not '$seconds'" >&2; exit 2; }
[ ${#wanted[@]} -gt 0 ] || wanted=("${parts[@]}")

sources() { cmake --preset release >/dev/null && scripts/check_sources.py src; }
tidy() { cmake --preset release >/dev/null && scripts/check_tidy.py; }
long() { CELLWALK_LONG_TESTS=ON scripts/test.sh -L long; }
asan() {
  cmake --preset asan -DCELLWALK_TEST_DATA= >/dev/null && cmake --build --preset asan --parallel &&
    CELLWALK_TEST_LENGTH=0.05 ctest --preset asan --no-tests=error --parallel "$(nproc)" --timeout 3600 -LE long
}
# All of them, since whatever is large enough is shared out by TBB, which is built with the sanitizer, too.
tsan() {
  local tbb
  tbb=$(scripts/sanitized_tbb.sh | tail -1) &&
    cmake --preset tsan -DCELLWALK_TEST_DATA= >/dev/null && cmake --build --preset tsan --parallel &&
    LD_LIBRARY_PATH=$tbb CELLWALK_TEST_LENGTH=0.05 ctest --preset tsan --no-tests=error --timeout 3600 -LE long
}
fuzz() { scripts/fuzz.sh --seconds "$seconds"; }
tutorials() {
  scripts/setup.sh --for package &&
    for release in bookworm trixie; do scripts/clean_root.sh $release tests/docs/type_tutorials.sh || return 1; done
}
soak() { scripts/soak.sh --hours 1 --seed "$(date +%Y%m%d)"; }

scripts/setup.sh --for ci
failed=()
for part in "${wanted[@]}"; do
  start=$SECONDS
  echo "nightly: $part"
  "$part" || failed+=("$part")
  echo "nightly: $part took $((SECONDS - start)) s"
done
if [ ${#failed[@]} -gt 0 ]; then
  echo "nightly: failed: ${failed[*]}"
  exit 1
fi
echo "nightly: ${#wanted[@]} parts passed: ${wanted[*]}"
