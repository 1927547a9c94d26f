#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Tries the filter of mwmesh.paraview_plugin in ParaView, in a new Debian that has ParaView and the
# wheel of configs/package.sh: ParaView's package and the VTK of the other tests exclude each other.
# As root; needs debootstrap, the package mirror of this machine and 3 GB; takes twenty minutes.
#
#   bash tests/paraview.sh [SYSTEM [PICTURE]]      default: bookworm; PICTURE.png: what ParaView drew

# shellcheck source=tests/new_system.sh
source "$(dirname "${BASH_SOURCE[0]}")/new_system.sh"
release="${1:-bookworm}"
system="$folder/system"

try_in() { # COMMAND
  run_in "$system" "$1" || fail "$(tail -n 40 "$folder/log")"
}

if ((EUID != 0)) || ! command -v debootstrap >/dev/null; then
  echo "paraview: skipped: needs root and debootstrap"
  exit 77
fi
require_packages '*manylinux*.whl'
new_system "$release" "$system" python3-numpy,python3-pip
cp "$packages"/*manylinux*.whl "$root/tests/engine/python/paraview_test.py" "$system/root"
try_in 'apt-get install --yes --no-install-recommends python3-paraview xauth xvfb'
try_in 'pip3 install --no-deps --break-system-packages ./*.whl'
# A server that starts anew when ParaView closes its first window would lose the next one.
try_in "xvfb-run -a -s '-noreset -screen 0 800x600x24' \
  pvpython --force-offscreen-rendering paraview_test.py picture.png"
! grep -q skipped "$folder/log" || fail "$(grep skipped "$folder/log")"
[[ -z "${2:-}" ]] || cp "$system/root/picture.png" "$2"
echo "paraview: $release: $(tail -n 1 "$folder/log")"
