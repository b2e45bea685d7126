#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Makes the Debian packages of the program and of the Python module, unpacks them beside the system, and runs what they hold.
#
# usage: debian_packages.sh CPACK CPACK_CONFIG FOLDER PYTHON COMPONENTS
set -euo pipefail
cpack=$1 config=$2 folder=$3 python=$4 components=$5

rm -rf "$folder"
mkdir -p "$folder/root"
"$cpack" --config "$config" -B "$folder/made" -D CPACK_COMPONENTS_ALL="$components" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip >"$folder/log" ||
  { cat "$folder/log" >&2; exit 1; }
for package in "$folder"/made/*.deb; do
  dpkg-deb --info "$package" >"$folder/info"
  grep -E "^ (Package|Depends)" "$folder/info"
  # What is linked is found by dpkg-shlibdeps.
  case "$package" in
    */cellwalk-readers_*) needed="libvtk9" ;;
    */cellwalk-meshers_*) needed="libgmp10.*libtet1" ;;
    */cellwalk-mpi_*) needed="openmpi-bin.*libboost-mpi.*libopenmpi3" ;;
    *) needed="libgmp10.*libtbb12" ;;
  esac
  grep -q "Depends:.*$needed" <(tr '\n' ' ' <"$folder/info") || { echo "$package misses dependencies" >&2; exit 1; }
  dpkg-deb --extract "$package" "$folder/root"
done
"$folder/root/usr/bin/cellwalk" --version | head -1
"$folder/root/usr/bin/cellwalk" generate hexes --cells 4 -o "$folder/grid.ovm" | sed "s|$folder/||"
case "$components" in
  *readers*) "$folder/root/usr/bin/cellwalk" check "$(dirname "$0")/project/tetrahedron.msh" | grep cells ;;
esac
case "$components" in
  *meshers*) "$folder/root/usr/bin/cellwalk" import "$(dirname "$0")/project/tetrahedron.off" -o "$folder/filled.ovm" | grep TetGen ;;
esac
case "$components" in
  *python*)
    dist=$(dirname "$(find "$folder/root/usr" -type d -name cellwalk -path '*dist-packages*')")
    cd "$folder"
    PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$dist "$python" -c "
import cellwalk
print('python:', cellwalk.Environment.load('grid.ovm'))
assert cellwalk.__file__.startswith('$dist')"
    ;;
esac
for package in "$folder"/root/usr/share/doc/*; do
  [ -s "$package/copyright" ] || { echo "$package has no copyright" >&2; exit 1; }
done
echo "packages unpack and run"
