#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs wheels of Cellwalk into a clean Debian of their own, made by debootstrap, in which there are Python, NumPy and pip, but neither
# a compiler nor the libraries that Cellwalk is built with, and uses them there. Needs root and a mirror.
#
#   scripts/check_wheels.sh FOLDER [bookworm|trixie]      the release that the wheels were built on: without it, this one
#
# CELLWALK_DEBIAN_MIRROR=URL is the mirror, otherwise apt's; CELLWALK_DEBIAN_ROOT=FOLDER is a clean Debian made before, of which a copy is
# taken.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/debian_root.sh
wheels=${1:-out/wheels}
release=${2:-$(debian_release)}
ls "$wheels"/*.whl >/dev/null

make_disposable_root check_wheels.sh "$release"  # /proc: the check reads which libraries are loaded
mkdir "$root/wheels" "$root/examples"
cp "$wheels"/*.whl "$root/wheels/"
cp examples/python/*.py examples/python/notebooks/*.ipynb python/tests/use_wheel.py python/tests/run_notebook.py "$root/examples/"

# inside NAME COMMAND...: a step in the clean root.
inside() {
  local name=$1
  shift
  echo "wheels: $name"
  chroot "$root" env DEBIAN_FRONTEND=noninteractive HOME=/tmp "$@" >"$log" 2>&1 </dev/null || { tail -30 "$log" >&2; exit 1; }
}

inside "lists of packages" apt-get update
inside "Python, NumPy and pip are installed" apt-get install -y --no-install-recommends python3 python3-numpy python3-pip
for package in libgmp10 libmpfr6 libtbb12 libfmt9 libfmt10 libtet1.5 g++ cmake; do
  if chroot "$root" dpkg-query -W "$package" >/dev/null 2>&1; then echo "  $package is there, for another package"; fi
done
for wheel in "$root"/wheels/*.whl; do
  file=$(basename "$wheel")
  kind=plain
  [[ $file != *+meshing* ]] || kind=meshing
  inside "$file is installed" python3 -m pip install --no-index --no-cache-dir --break-system-packages --force-reinstall --no-deps "/wheels/$file"
  inside "its requirements are met" python3 -m pip check
  inside "it is used" python3 /examples/use_wheel.py $kind
  for example in first_steps traces moving_walls; do
    inside "examples/python/$example.py" python3 "/examples/$example.py"
    diff "$log" "examples/expected/$example.out"
  done
  inside "the program" cellwalk --version
  cat "$log"
done
for notebook in porous_medium catheter; do
  inside "the notebook $notebook" python3 /examples/run_notebook.py "/examples/$notebook.ipynb"
done
echo "wheels: all install and run in a clean root"
