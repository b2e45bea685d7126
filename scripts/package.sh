#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Builds the Debian packages into out/packages. Safe to repeat: only what changed is built again.
#
#   scripts/package.sh [--check]
#
#   --check  also installs and uses them in a clean Debian of their own (scripts/check_packages.sh)
#
# CELLWALK_PACKAGE_CONTACT='NAME <ADDRESS>' is who maintains them.
set -euo pipefail
cd "$(dirname "$0")/.."

check=false
case "${1:-}" in
  "") ;;
  --check) check=true ;;
  *) echo "package.sh: unknown argument $1; use --check or nothing" >&2; exit 2 ;;
esac

scripts/setup.sh --for package

echo "package: building build/package"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
contact=()
[ -z "${CELLWALK_PACKAGE_CONTACT:-}" ] || contact=(-DCELLWALK_PACKAGE_CONTACT="$CELLWALK_PACKAGE_CONTACT")
cmake --preset package "${contact[@]}" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
cmake --build --preset package --parallel
rm -rf out/packages
cpack --config build/package/CPackConfig.cmake -B "$PWD/out/packages" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
rm -rf out/packages/_CPack_Packages
ls -l out/packages
if $check; then scripts/check_packages.sh out/packages; fi
