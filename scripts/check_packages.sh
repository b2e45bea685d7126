#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs Debian packages of Cellwalk into a clean Debian 12 of their own, made by debootstrap, and uses them there: the program, the
# Python module, the examples compiled with CMake, one with pkg-config. Needs root and a mirror (CELLWALK_DEBIAN_MIRROR).
#
#   scripts/check_packages.sh FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
packages=${1:-out/packages}
ls "$packages"/*.deb >/dev/null

if [ "$(id -u)" -ne 0 ]; then
  echo "check_packages.sh: needs root, for a clean Debian of its own" >&2
  exit 1
fi
root=$(mktemp -d)
log=$(mktemp)
clean() {
  if mountpoint -q "$root/proc"; then umount "$root/proc"; fi
  rm -rf --one-file-system "$root" "$log"
}
trap clean EXIT
mirror=${CELLWALK_DEBIAN_MIRROR:-http://deb.debian.org/debian}
echo "packages: making a clean Debian in $root"
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$log" 2>&1 || { tail -20 "$log" >&2; exit 1; }
mount -t proc proc "$root/proc"  # Java, on which libvtk9-dev depends, is not configured without it
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
mkdir "$root/packages" "$root/examples"
cp "$packages"/*.deb "$root/packages/"
cp -r examples data "$root/examples/"

# inside NAME COMMAND...: a step in the clean root.
inside() {
  local name=$1
  shift
  echo "packages: $name"
  chroot "$root" env DEBIAN_FRONTEND=noninteractive HOME=/tmp "$@" >"$log" 2>&1 || { tail -30 "$log" >&2; exit 1; }
}
inside "lists of packages" apt-get update
inside "the program and the Python module are installed" \
  sh -c "apt-get install -y --no-install-recommends /packages/cellwalk_*.deb /packages/python3-cellwalk_*.deb"
inside "the program runs" cellwalk --version
cat "$log"
inside "it imports a surface" cellwalk import /examples/data/torus.off -o /tmp/torus.ovm
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
echo "packages: everything installs and runs in a clean root"
