# SPDX-License-Identifier: LGPL-3.0-or-later
# The command line of run.sh of an experiment; to be sourced with its arguments, in the root of the sources, after `name` was
# set to the name of the experiment and `targets` to what it builds.
#
#   --quick       what the test compares: about a minute
#   --out DIR     default: build/NAME (build/NAME_quick)
#   --build DIR   a build folder of CMake; default: build/release
#   --no-build    the programs in the build folder are up to date
#   --counts      nothing that is timed
#   --threads N   of programs that take it; answers do not depend on it; default 1
#
# Sets quick, counts (true or false), out, build, threads and commit; builds; makes the folder.
quick=false counts=false build=build/release out="" make=true threads=1
while [ $# -gt 0 ]; do
  case "$1" in
    --quick) quick=true ;;
    --counts) counts=true ;;
    --out) out=${2:?run.sh: --out needs a folder}; shift ;;
    --build) build=${2:?run.sh: --build needs a folder}; shift ;;
    --threads) threads=${2:?run.sh: --threads needs a number}; shift ;;
    --no-build) make=false ;;
    *) echo "run.sh: unknown argument $1; use --quick, --counts, --out DIR, --build DIR, --threads N or --no-build" >&2; exit 2 ;;
  esac
  shift
done
if [ -z "$out" ]; then
  out=build/$name
  if $quick; then out=${out}_quick; fi
fi
if $make; then
  [ -f "$build/build.ninja" ] || cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON >/dev/null
  # shellcheck disable=SC2086
  cmake --build "$build" --target $targets
fi
mkdir -p "$out"
commit=$(git describe --always --dirty --abbrev=40 --match '' 2>/dev/null || echo unknown)
