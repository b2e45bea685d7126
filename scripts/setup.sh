#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs what a task needs from Debian's packages, and only what is missing. Safe to repeat.
#
#   scripts/setup.sh [--for demo|test|ci|dev|package|peers|paper|docs] [--print]
#
#   demo  build and run the program            test   also VTK, Gmsh (as a writer), MPI, Python, Node.js, Chromium, the test tools and clang-format (default)
#   dev   as ci                                peers  demo, the libraries that experiments compare with, gnuplot, and what animate.py needs
#   paper peers and LaTeX                      docs   Doxygen and Graphviz, for scripts/docs.sh
#   ci    test, docs, clang, clang-tidy, ccache, valgrind   package  build the Debian packages, and a clean root to try them in
#   --print  only name the packages
set -euo pipefail

core=(g++ cmake ninja-build libcgal-dev libeigen3-dev libboost-dev libtbb-dev libfmt-dev nlohmann-json3-dev libcli11-dev
      zlib1g-dev libxxhash-dev)
meshing=(libtet1.5-dev)
io=(libvtk9-dev)
mpi=(libboost-mpi-dev libopenmpi-dev openmpi-bin) # runs shared among processes
python=(pybind11-dev python3-dev python3-numpy python3-pip python3-setuptools python3-wheel patchelf)
cluster=(python3-distributed) # for the example of Dask
python_tests=(mypy python3-meshio python3-vtk9) # the stubs, and arrays to and from other programs
tests=(libgmsh-dev libgtest-dev librapidcheck-dev libbenchmark-dev python3 pkg-config dpkg-dev file clang-format chromium
       python3-matplotlib)
node=(nodejs npm) # for the page of cellwalk view; any Node.js from 18 on will do, from wherever it is
fuzzing=(clang libclang-rt-dev) # the sanitizers' libraries are a package of their own
documentation=(doxygen graphviz)
peers=(libbullet-dev libembree-dev libfcl-dev gnuplot-nox python3)
pictures=(python3-pil python3-numpy fonts-dejavu-core) # for scripts/animate.py
latex=(texlive-latex-recommended texlive-fonts-recommended texlive-pictures lmodern)

purpose=test
only_print=false
while [ $# -gt 0 ]; do
  case "$1" in
    --for) purpose=${2:-}; shift ;;
    --for=*) purpose=${1#--for=} ;;
    --print) only_print=true ;;
    *) echo "setup.sh: unknown argument $1; use --for demo|test|ci|dev|package|peers|paper|docs or --print" >&2; exit 2 ;;
  esac
  shift
done

packages=("${core[@]}" "${meshing[@]}")
case "$purpose" in
  demo) ;;
  test) packages+=("${io[@]}" "${mpi[@]}" "${python[@]}" "${cluster[@]}" "${python_tests[@]}" "${tests[@]}") ;;
  ci | dev) packages+=("${io[@]}" "${mpi[@]}" "${python[@]}" "${cluster[@]}" "${python_tests[@]}" "${tests[@]}" "${fuzzing[@]}" "${documentation[@]}" clang-tidy ccache valgrind) ;;
  package) packages+=("${io[@]}" "${mpi[@]}" "${python[@]}" dpkg-dev file debootstrap) ;;
  peers) packages+=("${peers[@]}" "${pictures[@]}") ;;
  paper) packages+=("${peers[@]}" "${latex[@]}") ;;
  docs) packages=("${documentation[@]}") ;;
  *) echo "setup.sh: --for takes demo, test, ci, dev, package, peers, paper or docs, not '$purpose'" >&2; exit 2 ;;
esac

if [ "$purpose" = test ] || [ "$purpose" = ci ] || [ "$purpose" = dev ]; then
  command -v npm >/dev/null || packages+=("${node[@]}")
fi

if $only_print; then
  printf '%s\n' "${packages[@]}"
  exit 0
fi

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "setup.sh: this is not Debian or a relative of it. Install what these Debian packages hold, then go on:" >&2
  echo "  ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
  [ "$state" = "install ok installed" ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all ${#packages[@]} packages for '$purpose' are installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: installing needs root or sudo. As root: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
echo "setup: done"
