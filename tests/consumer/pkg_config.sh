#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# A program built with nothing but the compiler and what pkg-config says of an installed Cellwalk.
#
# usage: [CXXFLAGS=...] pkg_config.sh COMPILER FOLDER_OF_PC_FILES SOURCE PACKAGE OUTPUT [ARGUMENTS OF THE PROGRAM]
set -euo pipefail
compiler=$1 folder=$2 source=$3 package=$4 output=$5
shift 5

export PKG_CONFIG_PATH=$folder
read -ra flags <<<"$(pkg-config --cflags --libs "$package")"
# shellcheck disable=SC2086
"$compiler" -std=c++20 ${CXXFLAGS:-} "$source" -o "$output" "${flags[@]}"
"$output" "$@"
