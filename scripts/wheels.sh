#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Builds both wheels into out/wheels: the one under the LGPL, and the one with meshing, under the GPL. Safe to repeat.
#
#   scripts/wheels.sh [--check]
#
#   --check  also installs and uses them in a clean Debian of their own (scripts/check_wheels.sh)
#
# They are for the Python, and for the release of Debian or later, that this is: scripts/clean_root.sh trixie scripts/wheels.sh builds
# those of Debian 13.
set -euo pipefail
cd "$(dirname "$0")/.."

check=false
case "${1:-}" in
  "") ;;
  --check) check=true ;;
  *) echo "wheels.sh: unknown argument $1; use --check or nothing" >&2; exit 2 ;;
esac

scripts/setup.sh --for package

rm -rf out/wheels
log=$(mktemp)
trap 'rm -f "$log"' EXIT
for meshing in OFF ON; do
  echo "wheels: building one with CELLWALK_WITH_MESHING=$meshing"
  CMAKE_ARGS="${CMAKE_ARGS:-} -DCELLWALK_WITH_MESHING=$meshing" \
    /usr/bin/python3 -m pip wheel --no-build-isolation --no-deps --wheel-dir out/wheels . >"$log" 2>&1 || { tail -40 "$log" >&2; exit 1; }
done
ls -l out/wheels
if $check; then scripts/check_wheels.sh out/wheels; fi
