#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Builds and tests in a clean Debian of its own, made by debootstrap: copies the working tree into it and runs a command there.
#
#   scripts/clean_root.sh bookworm|trixie [COMMAND...]       without a command: scripts/test.sh
#
# The root is kept in build/root/RELEASE, what was built in it too, so that the next run does only what is new; to begin anew remove it.
# CELLWALK_ROOTS=FOLDER keeps roots there. CELLWALK_DEBIAN_MIRROR=URL is the mirror, otherwise apt's. CELLWALK_TEST_DATA and
# CELLWALK_LONG_TESTS are as for scripts/test.sh. Needs root and debootstrap (scripts/setup.sh --for package).
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/debian_root.sh

release=${1:-}
case "$release" in
  bookworm | trixie) shift ;;
  *) echo "clean_root.sh: give the release, bookworm or trixie, not '$release'" >&2; exit 2 ;;
esac
[ $# -gt 0 ] || set -- scripts/test.sh
if [ "$(id -u)" -ne 0 ]; then
  echo "clean_root.sh: needs root, for a clean Debian of its own" >&2
  exit 1
fi

root=$(realpath -m "${CELLWALK_ROOTS:-build/root}")/$release
mkdir -p "$(dirname "$root")"
exec 9>"$root.lock"
flock --nonblock 9 || { echo "clean_root.sh: another run uses $root" >&2; exit 1; }
if [ ! -e "$root" ]; then
  echo "clean root: making $root"
  rm -rf "$root.part"
  make_debian_root "$release" "$root.part"
  mv "$root.part" "$root"
fi
connect_debian_root "$root"

echo "clean root: copying the working tree"
mkdir -p "$root/cellwalk"
find "$root/cellwalk" -mindepth 1 -maxdepth 1 ! -name build ! -name out -exec rm -rf {} +
git ls-files -z --cached --others --exclude-standard | tar --create --null --ignore-failed-read --files-from=- 2>/dev/null |
  tar --extract --no-same-owner --directory "$root/cellwalk"

variables=(PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 "CELLWALK_LONG_TESTS=${CELLWALK_LONG_TESTS:-OFF}")
data=
if [ -n "${CELLWALK_TEST_DATA:-}" ]; then
  data=$(realpath "$CELLWALK_TEST_DATA")
  mkdir -p "$root/test-data"
  variables+=(CELLWALK_TEST_DATA=/test-data)
fi
# What is trusted here is trusted there, by npm too, and proxies are the same.
if [ -e /etc/ssl/certs/ca-certificates.crt ]; then
  cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/trusted-outside.crt"
  variables+=(NODE_EXTRA_CA_CERTS=/etc/trusted-outside.crt)
fi
for name in http_proxy https_proxy no_proxy; do
  [ -z "${!name:-}" ] || variables+=("$name=${!name}")
done

echo "clean root: $release: $*"
# Mounts and processes end with the command.
exec unshare --mount --pid --fork --kill-child --mount-proc="$root/proc" bash -euc '
  root=$1 data=$2
  shift 2
  mount --rbind /dev "$root/dev"
  [ -z "$data" ] || mount --bind -o ro "$data" "$root/test-data"
  exec chroot "$root" "$@"' bash "$root" "$data" \
  env -i "${variables[@]}" bash -c 'cd /cellwalk && exec "$@"' bash "$@"
