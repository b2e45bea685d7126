#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Fails if clang-format would change a source file; with --fix, changes it.
set -euo pipefail
cd "$(dirname "$0")/.."

mode=(--dry-run --Werror)
[ "${1:-}" = --fix ] && mode=(-i)
mapfile -t files < <(git ls-files '*.h' '*.cpp')
clang-format "${mode[@]}" "${files[@]}"
echo "format: ${#files[@]} files follow .clang-format"
