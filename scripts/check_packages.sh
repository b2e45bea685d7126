#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs Debian packages of Cellwalk into a clean Debian of their own, made by debootstrap, and uses them there: the program, the
# Python module, the examples compiled with CMake, two with pkg-config; first those of the core, then those that read files. Needs root
# and a mirror.
#
#   scripts/check_packages.sh FOLDER
#
# It is the release that the packages were built on: this one. CELLWALK_DEBIAN_MIRROR=URL is the mirror, otherwise apt's;
# CELLWALK_DEBIAN_ROOT=FOLDER is a clean Debian made before, of which a copy is taken.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/debian_root.sh
packages=${1:-out/packages}
ls "$packages"/*.deb >/dev/null

make_disposable_root check_packages.sh "$(debian_release)"  # /proc: Java, on which libvtk9-dev depends, is not configured without it
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
# package NAME: its file, as the clean root sees it.
package() { echo "/packages/$(basename "$packages/$1"_*.deb)"; }
# install NAME PACKAGE...: from files and from the mirror; says how much that is.
install() {
  local name=$1
  shift
  inside "$name" apt-get install -y --no-install-recommends "$@"
  grep -E "newly installed|additional disk space" "$log" | sed 's/^/  /'
}
# same_output EXAMPLE: what was run last printed what the example prints.
same_output() { diff "$log" "examples/expected/$1.out"; }

inside "lists of packages" apt-get update
install "the program is installed" "$(package cellwalk)" "$(package cellwalk-readers)" "$(package cellwalk-meshers)"
inside "the program runs" cellwalk --version
cat "$log"
for part in vtk; do
  if grep -q "$part *no" "$log"; then echo "packages: the program does not find its reader for $part" >&2; exit 1; fi
done
if [ -e "$root$(package cellwalk-mpi)" ]; then
  install "the module of MPI is installed" "$(package cellwalk-mpi)"
  inside "two processes share a query" env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_plm=isolated \
    sh -c 'cellwalk generate vessel -o /tmp/vessel.ovm && mpirun --oversubscribe -n 2 cellwalk query /tmp/vessel.ovm \
           /examples/data/moves.csv -o /tmp/two.csv && cellwalk query /tmp/vessel.ovm /examples/data/moves.csv -o /tmp/one.csv &&
           cmp /tmp/one.csv /tmp/two.csv'
fi
inside "it imports a surface" cellwalk import /examples/data/torus.off -o /tmp/torus.ovm
inside "it runs a scene" cellwalk run /examples/data/rooms.json -o /tmp/rooms --steps 20
if [ -e "$root$(package python3-cellwalk)" ]; then
  install "the Python module is installed" "$(package python3-cellwalk)"
  inside "the Python module runs" python3 /examples/examples/python/first_steps.py
  same_output first_steps
  inside "the Python module moves walls" python3 /examples/examples/python/moving_walls.py
  same_output moving_walls
else
  echo "packages: there is no Python module among them"
fi

install "compilers are installed" g++ cmake make pkg-config
install "the core is installed" "$(package libcellwalk-dev)"
inside "CMake finds the core" cmake -S /examples/examples -B /tmp/core
inside "the examples compile" cmake --build /tmp/core
inside "the examples run" ctest --test-dir /tmp/core --no-tests=error
inside "pkg-config finds the core" \
  sh -c 'g++ -std=c++20 /examples/examples/first_walk.cpp -o /tmp/first_walk $(pkg-config --cflags --libs cellwalk)'
inside "what was linked runs" /tmp/first_walk
same_output first_walk

install "readers and meshers are installed" "$(package libcellwalk-io-dev)" "$(package libcellwalk-meshing-dev)"
inside "CMake finds all" cmake -S /examples/examples -B /tmp/all
inside "the example that loads a file compiles" cmake --build /tmp/all --target example_import_and_query
inside "it runs" ctest --test-dir /tmp/all --no-tests=error -R import_and_query
inside "pkg-config finds all" \
  sh -c 'g++ -std=c++20 /examples/examples/import_and_query.cpp -o /tmp/import_and_query $(pkg-config --cflags --libs cellwalk-loading)'
inside "what was linked runs" /tmp/import_and_query /examples/data/torus.off
same_output import_and_query
if chroot "$root" dpkg-query -W libvtk9-dev >/dev/null 2>&1; then
  echo "packages: something needs the development package of VTK, which is loaded at run time" >&2
  exit 1
fi
echo "packages: everything installs and runs in a clean root"
