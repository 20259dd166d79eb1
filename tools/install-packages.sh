#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# install-packages.sh [LIST]: installs what LIST (packages.txt) names and this machine lacks.
set -euo pipefail
cd "$(dirname "$0")/.."

list=${1:-packages.txt}
if [ ! -f "$list" ]; then
  echo "install-packages: $list: no such list" >&2
  exit 2
fi
mapfile -t wanted < <(sed 's/#.*//; s/[[:space:]]//g; /^$/d' "$list")
if ! command -v dpkg-query >/dev/null; then
  echo "install-packages: no dpkg here; please install the equivalents of $list yourself" >&2
  exit 0
fi
# What another package provides is there too: some nodejs bring npm along and conflict with its own.
installed=$(dpkg-query -W -f '${db:Status-Abbrev}${Package}, ${Provides}\n' 2>/dev/null |
            sed -n 's/^ii //p' | sed 's/ *([^)]*)//g; s/, */\n/g' || true)
missing=()
for package in "${wanted[@]}"; do
  grep -qx "$package" <<<"$installed" || missing+=("$package")
done
[ "${#missing[@]}" -eq 0 ] && exit 0

if ! command -v apt-get >/dev/null; then
  echo "install-packages: no apt-get; install by hand: ${missing[*]}" >&2
  exit 1
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install-packages: run as root (no sudo here): apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "Installing ${#missing[@]} packages: ${missing[*]}"
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -q "$@" >>"$log" 2>&1 </dev/null
}
# The index may be fresh enough; refresh it only if the first try fails.
if ! apt install --no-install-recommends "${missing[@]}"; then
  if ! { apt update && apt install --no-install-recommends "${missing[@]}"; }; then
    tail -n 15 "$log" >&2
    echo "install-packages: apt-get failed, see above; missing: ${missing[*]}" >&2
    exit 1
  fi
fi
echo "Installed."
