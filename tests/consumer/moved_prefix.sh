#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Meshes a surface by a program whose prefix lies elsewhere than when it was installed.
#
# usage: moved_prefix.sh PREFIX BIN SURFACE
set -euo pipefail
prefix=$1 bin=$2 surface=$3

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/moved"
for part in "$bin" libexec lib; do cp -r "$prefix/$part" "$folder/moved/"; done
for mesher in tetgen mesh3; do
  "$folder/moved/$bin/cellwalk" import "$surface" --mesher "$mesher" -o "$folder/$mesher.ovm" >/dev/null
done
# Without them it says so.
rm -r "$folder/moved/libexec"
status=0
"$folder/moved/$bin/cellwalk" import "$surface" -o "$folder/none.ovm" 2>"$folder/said" || status=$?
[ $status -eq 2 ] && grep -q "this build has no TetGen: the program cellwalk-tetgen is not there" "$folder/said" ||
  { cat "$folder/said" >&2; exit 1; }
echo "the helpers move with the prefix"
