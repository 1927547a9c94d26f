#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Tries the wheel of configs/package.sh in a new Debian 12 that has Python and numpy, and none of the
# libraries: it meshes, verifies, saves and reads back.  As root; needs debootstrap and the package
# mirror of this machine; takes some minutes.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
folder="$(mktemp -d)"
trap 'rm -rf --one-file-system "$folder"' EXIT
system="$folder/system"

fail() {
  echo "wheel: FAILED: $*" >&2
  exit 1
}

mirror() {
  apt-cache policy | sed -n 's/^ *[0-9]* \(http[^ ]*\) bookworm\/main.*/\1/p' | head -n 1
}

((EUID == 0)) || fail "needs root"
ls "$root"/build/packages/*manylinux*.whl >/dev/null 2>&1 || fail "no wheel; run configs/package.sh"
debootstrap --variant=minbase --include=python3,python3-numpy,python3-pip bookworm "$system" \
  "$(mirror)" >"$folder/log" 2>&1 || fail "debootstrap: $(tail -n 5 "$folder/log")"
cp "$root"/build/packages/*manylinux*.whl "$system/root"
cat >"$system/root/smoke.py" <<'END'
import mwmesh
import numpy

voxels = mwmesh.synth("voronoi", (24, 20, 16), labels=5, seed=1)
mesh = mwmesh.mesh(voxels)
assert sorted(mesh.volumes()) == numpy.unique(voxels).tolist() and mesh.verify(voxels)
for name in ("m.vtu", "m.vtkhdf", "m.msh"):
    mesh.save(name)
    assert mwmesh.read(name).digest == mesh.digest, name
print(mesh.digest)
END
chroot "$system" sh -c \
  'cd /root && pip3 install --no-deps --break-system-packages ./*.whl && python3 -B smoke.py' \
  >"$folder/log" 2>&1 || fail "$(tail -n 5 "$folder/log")"
echo "wheel: $(tail -n 1 "$folder/log")"
