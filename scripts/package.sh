#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Builds the Debian packages into out/packages. Safe to repeat: only what changed is built again.
#
#   scripts/package.sh [--check]
#
#   --check  also installs them into a clean Debian of their own, made by debootstrap (needs root and a mirror), and uses them there:
#            the program, the Python module, and a program compiled with CMake and with pkg-config
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
cmake --preset package >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
cmake --build --preset package --parallel
rm -rf out/packages
cpack --config build/package/CPackConfig.cmake -B "$PWD/out/packages" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
rm -rf out/packages/_CPack_Packages
ls -l out/packages
$check || exit 0

if [ "$(id -u)" -ne 0 ]; then
  echo "package.sh: --check needs root, for a clean Debian of its own" >&2
  exit 1
fi
root=$(mktemp -d)
trap 'rm -rf "$root" "$log"' EXIT
# As the machine fetches packages, so does the clean root.
mirror=${CELLWALK_DEBIAN_MIRROR:-http://deb.debian.org/debian}
echo "package: making a clean Debian in $root"
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$log" 2>&1 || { tail -20 "$log" >&2; exit 1; }
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
mkdir "$root/packages" "$root/examples"
cp out/packages/*.deb "$root/packages/"
cp -r examples data/torus.off "$root/examples/"

# inside NAME COMMAND...: a step in the clean root.
inside() {
  local name=$1
  shift
  echo "package: $name"
  chroot "$root" env DEBIAN_FRONTEND=noninteractive HOME=/tmp "$@" >"$log" 2>&1 || { tail -30 "$log" >&2; exit 1; }
}
inside "lists of packages" apt-get update
inside "the program and the Python module are installed" \
  sh -c "apt-get install -y --no-install-recommends /packages/cellwalk_*.deb /packages/python3-cellwalk_*.deb"
inside "the program runs" cellwalk --version
cat "$log"
inside "it imports a surface" cellwalk import /examples/torus.off -o /tmp/torus.ovm
inside "the Python module runs" python3 /examples/examples/python/first_steps.py
diff "$log" examples/expected/first_steps.out
inside "the libraries are installed" \
  sh -c "apt-get install -y --no-install-recommends g++ cmake make pkg-config /packages/libcellwalk-dev_*.deb /packages/libcellwalk-meshing-dev_*.deb"
inside "CMake finds them" cmake -S /examples/examples -B /tmp/build
inside "the examples compile" cmake --build /tmp/build
inside "the examples run" ctest --test-dir /tmp/build --no-tests=error
inside "pkg-config finds them" \
  sh -c 'g++ -std=c++20 /examples/examples/first_walk.cpp -o /tmp/first_walk $(pkg-config --cflags --libs cellwalk)'
inside "what was linked runs" /tmp/first_walk
diff "$log" examples/expected/first_walk.out
echo "package: everything installs and runs in a clean root"
