#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Tries the filter of mwmesh.paraview_plugin in ParaView, in a new Debian 12 that has ParaView and the
# wheel of configs/package.sh, without a display: ParaView's package and the VTK of the other tests
# exclude each other.  As root; needs debootstrap, the package mirror of this machine, and 3 GB; takes
# about ten minutes.
#
#   bash tests/paraview.sh [PICTURE]      PICTURE (.png) keeps what ParaView drew
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
folder="$(mktemp -d)"
trap 'rm -rf --one-file-system "$folder"' EXIT
system="$folder/system"

fail() {
  echo "paraview: FAILED: $*" >&2
  exit 1
}

mirror() {
  apt-cache policy | sed -n 's/^ *[0-9]* \(http[^ ]*\) bookworm\/main.*/\1/p' | head -n 1
}

if ((EUID != 0)) || ! command -v debootstrap >/dev/null; then
  echo "paraview: skipped: needs root and debootstrap"
  exit 77
fi
ls "$root"/build/packages/*manylinux*.whl >/dev/null 2>&1 || fail "no wheel; run configs/package.sh"
debootstrap --variant=minbase --include=python3-numpy,python3-pip bookworm "$system" "$(mirror)" \
  >"$folder/log" 2>&1 || fail "debootstrap: $(tail -n 5 "$folder/log")"
cp "$root"/build/packages/*manylinux*.whl "$root/tests/engine/python/paraview_test.py" "$system/root"
try_in() {
  DEBIAN_FRONTEND=noninteractive chroot "$system" sh -c "cd /root && $1" >"$folder/log" 2>&1 ||
    fail "$(tail -n 40 "$folder/log")"
}
try_in 'apt-get install --yes --no-install-recommends python3-paraview'
try_in 'pip3 install --no-deps --break-system-packages ./*.whl'
try_in 'pvpython --force-offscreen-rendering paraview_test.py picture.png'
! grep -q skipped "$folder/log" || fail "$(grep skipped "$folder/log")"
[[ -z "${1:-}" ]] || cp "$system/root/picture.png" "$1"
echo "paraview: $(tail -n 1 "$folder/log")"
