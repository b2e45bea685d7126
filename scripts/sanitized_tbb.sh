#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Builds TBB under the thread sanitizer, in build/tsan-tbb, from the source of Debian's package, and prints the folder of the library as its
# last line. As Debian compiles it, it hands work over by means that the sanitizer does not see. Safe to repeat; needs no root.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$PWD/build/tsan-tbb
library=$(find "$folder" -name 'libtbb.so.12' -printf '%h' -quit 2>/dev/null || true)
if [ -z "$library" ]; then
  # shellcheck source=/dev/null
  . /etc/os-release
  if [ "${ID:-}" != debian ]; then
    echo "sanitized_tbb.sh: this is ${PRETTY_NAME:-no Debian}: build oneTBB with -DTBB_SANITIZE=thread, and set LD_LIBRARY_PATH" >&2
    exit 1
  fi
  rm -rf "$folder"
  mkdir -p "$folder/lists/partial" "$folder/archives/partial"
  echo "deb-src http://deb.debian.org/debian $VERSION_CODENAME main" >"$folder/sources.list"
  options=(-qq -o "Dir::Etc::sourcelist=$folder/sources.list" -o Dir::Etc::sourceparts=/dev/null -o "Dir::State::Lists=$folder/lists"
    -o "Dir::Cache=$folder" -o APT::Sandbox::User="$(id -un)")
  echo "sanitized_tbb.sh: downloads and builds TBB"
  apt-get "${options[@]}" update
  (cd "$folder" && apt-get "${options[@]}" source onetbb)
  cmake -S "$folder"/onetbb-* -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_SANITIZE=thread -DTBB_TEST=OFF \
    -DTBB_STRICT=OFF -DCMAKE_CXX_FLAGS=-Wno-tsan >/dev/null
  cmake --build "$folder/build" --parallel --target tbb
  library=$(find "$folder/build" -name 'libtbb.so.12' -printf '%h' -quit)
fi
[ -n "$library" ] || { echo "sanitized_tbb.sh: no libtbb.so.12 was built in $folder" >&2; exit 1; }
echo "$library"
