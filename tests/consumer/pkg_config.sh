#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# A program built with nothing but the compiler and what pkg-config says of an installed Cellwalk.
#
# usage: pkg_config.sh COMPILER PREFIX SOURCE PACKAGE OUTPUT [ARGUMENTS OF THE PROGRAM]
set -euo pipefail
compiler=$1 prefix=$2 source=$3 package=$4 output=$5
shift 5

file=$(find "$prefix" -name "$package.pc")
[ -n "$file" ] || { echo "pkg_config.sh: no $package.pc under $prefix" >&2; exit 1; }
PKG_CONFIG_PATH=$(dirname "$file")
export PKG_CONFIG_PATH
read -ra flags <<<"$(pkg-config --cflags --libs "$package")"
"$compiler" -std=c++20 -O1 "$source" -o "$output" "${flags[@]}"
"$output" "$@"
