# shellcheck shell=bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# For scripts that work in a clean Debian of their own: what is here is sourced by them.

# The name of the release that this is, as bookworm.
debian_release() { (. /etc/os-release && echo "${VERSION_CODENAME:-}"); }

# CELLWALK_DEBIAN_MIRROR, else where apt takes Debian's packages from here; nothing if neither says.
debian_mirror() {
  if [ -n "${CELLWALK_DEBIAN_MIRROR:-}" ]; then
    echo "$CELLWALK_DEBIAN_MIRROR"
  else
    apt-get indextargets --format '$(ORIGIN) $(CODENAME) $(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
      awk '$1 == "Debian" && $2 !~ /-/ { print $3; exit }'
  fi
}

# make_debian_root RELEASE FOLDER: the smallest Debian that apt runs in.
make_debian_root() {
  local release=$1 folder=$2 log mirror proxy
  command -v debootstrap >/dev/null || { echo "debootstrap is not installed: scripts/setup.sh --for package" >&2; return 1; }
  log=$(mktemp)
  mirror=$(debian_mirror)
  eval "$(apt-config shell proxy Acquire::http::Proxy)"
  # Without a mirror debootstrap has one of its own.
  if ! http_proxy=${http_proxy:-${proxy:-}} debootstrap --variant=minbase "$release" "$folder" ${mirror:+"$mirror"} >"$log" 2>&1; then
    tail -20 "$log" >&2
    rm -f "$log"
    return 1
  fi
  rm -f "$log"
  echo force-unsafe-io >"$folder/etc/dpkg/dpkg.cfg.d/thrown-away"  # what is removed in the end need not reach the disk
}

# connect_debian_root FOLDER: it reaches the network as this system does.
connect_debian_root() {
  local folder=$1 file
  apt-config dump | grep -E '^Acquire::(https?|Retries|Check-[A-Za-z-]+)(::| )' >"$folder/etc/apt/apt.conf.d/99as-outside" || true
  for file in resolv.conf hosts; do
    if [ -e "/etc/$file" ]; then cp -L "/etc/$file" "$folder/etc/$file"; fi
  done
}

# make_disposable_root SCRIPT RELEASE: a clean Debian in $root, of its own or a copy of CELLWALK_DEBIAN_ROOT, with /proc, and a file $log;
# both are removed when the script ends.
make_disposable_root() {
  local script=$1 release=$2
  if [ "$(id -u)" -ne 0 ]; then
    echo "$script: needs root, for a clean Debian of its own" >&2
    exit 1
  fi
  root=$(mktemp -d)
  log=$(mktemp)
  trap 'if mountpoint -q "$root/proc"; then umount "$root/proc"; fi; rm -rf --one-file-system "$root" "$log"' EXIT
  echo "$script: making a clean Debian ($release) in $root"
  if [ -n "${CELLWALK_DEBIAN_ROOT:-}" ]; then
    cp -a "$CELLWALK_DEBIAN_ROOT/." "$root"
  else
    make_debian_root "$release" "$root"
  fi
  connect_debian_root "$root"
  mount -t proc proc "$root/proc"
}
