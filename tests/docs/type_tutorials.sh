#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# What a reader of the tutorials types: the build of the first one, then the commands of all. For a clean Debian:
#
#   scripts/clean_root.sh bookworm|trixie tests/docs/type_tutorials.sh
set -euo pipefail
cd "$(dirname "$0")/../.."

build=$(sed -n '/^<!-- not run -->/,/^```$/s/^\$ //p' docs/tutorials/solver.md)
[ -n "$build" ] || { echo "type_tutorials.sh: docs/tutorials/solver.md has no commands that build the library" >&2; exit 1; }
while read -r command; do
  echo "$ $command"
  $command
done <<<"$build"
echo "tutorials: built in $SECONDS s"
python3 tests/docs/test_pages.py . build/release/cellwalk --tutorials
echo "tutorials: typed, $SECONDS s with the build"
