#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Fails if clang-format would change a source file; with --fix, changes it.
#
# Each version of clang-format has a style of its own: sources follow that of 14, Debian 12's. Where there is another one only, nothing
# is checked, and it says so. CLANG_FORMAT=PROGRAM is the one to take.
set -euo pipefail
cd "$(dirname "$0")/.."

version_wanted=14
mode=(--dry-run --Werror)
[ "${1:-}" = --fix ] && mode=(-i)

program=${CLANG_FORMAT:-}
if [ -z "$program" ]; then
  program=$(command -v "clang-format-$version_wanted" || command -v clang-format || true)
fi
version=$("${program:-false}" --version 2>/dev/null | sed -nE 's/.*clang-format version ([0-9]+)\..*/\1/p' || true)
if [ "$version" != "$version_wanted" ]; then
  echo "format: skipped, not checked: needs clang-format $version_wanted, here is ${version:-none} (Debian 12 has it; or set CLANG_FORMAT)"
  [ "${1:-}" != --fix ] || exit 1
  exit 0
fi
mapfile -t files < <(find examples experiments include python src tests -name '*.h' -o -name '*.cpp')
"$program" "${mode[@]}" "${files[@]}"
echo "format: ${#files[@]} files follow .clang-format"
