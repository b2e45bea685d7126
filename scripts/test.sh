#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs what is missing, builds everything and runs all tests. Safe to repeat: only what changed is built again.
#
#   scripts/test.sh [ARGUMENTS OF CTEST]       e.g. scripts/test.sh -R walk
#
# CELLWALK_TEST_DATA=FOLDER adds the tests on public meshes; CELLWALK_LONG_TESTS=ON adds those of nightly length.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --for test

echo "test: configuring build/release"
cmake --preset release -DCELLWALK_BUILD_TESTS=ON -DCELLWALK_BUILD_EXPERIMENTS=ON -DCELLWALK_LONG_TESTS="${CELLWALK_LONG_TESTS:-OFF}" \
  -DCELLWALK_TEST_DATA="${CELLWALK_TEST_DATA:-}" >build-release.log 2>&1 ||
  { cat build-release.log >&2; exit 1; }
rm -f build-release.log

echo "test: building with $(nproc) processes"
cmake --build --preset release --parallel

echo "test: running all tests"
ctest --preset release --parallel "$(nproc)" --no-label-summary "$@"
