#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Tries the wheel and the archive of configs/package.sh in new systems that have Python and numpy, and
# none of our packages: they mesh, verify, save, draw and read back, and the digest is the same on all.
# As root; needs debootstrap and the package mirror of this machine; takes some minutes a system.
#
#   bash tests/wheel.sh [SYSTEM ...]      default: bookworm trixie (Debian 12 and 13)

# shellcheck source=tests/new_system.sh
source "$(dirname "${BASH_SOURCE[0]}")/new_system.sh"
(($#)) || set -- bookworm trixie

((EUID == 0)) || fail "needs root"
require_packages '*manylinux*.whl'
require_packages '*.tar.xz'

cat >"$folder/smoke.py" <<'END'
import subprocess
import sys

import mwmesh
import numpy

voxels = mwmesh.synth("voronoi", (24, 20, 16), labels=5, seed=1)
mesh = mwmesh.mesh(voxels)
assert sorted(mesh.volumes()) == numpy.unique(voxels).tolist() and mesh.verify(voxels)
for name in ("m.vtu", "m.vtkhdf", "m.msh"):
    mesh.save(name)
    assert mwmesh.read(name).digest == mesh.digest, name
assert mesh.picture(200, 200).startswith(b"\x89PNG")
program = sys.argv[1]
numpy.save("v.npy", voxels)
subprocess.run([program, "mesh", "v.npy", "-o", "p.vtkhdf"], check=True, stdout=subprocess.DEVNULL)
subprocess.run([program, "verify", "v.npy", "p.vtkhdf"], check=True, stdout=subprocess.DEVNULL)
assert mwmesh.read("p.vtkhdf").digest == mesh.digest
print(mesh.digest)
END

# Prints the digest that a way to install has.
try_in() { # SYSTEM COMMAND WHAT
  run_in "$1" "$2" || fail "$3: $(tail -n 5 "$folder/log")"
  tail -n 1 "$folder/log"
}

digests=()
for release in "$@"; do
  system="$folder/$release"
  new_system "$release" "$system" python3,python3-numpy,python3-pip,xz-utils
  cp "$packages"/*manylinux*.whl "$packages"/*.tar.xz "$folder/smoke.py" "$system/root"
  by_wheel="$(try_in "$system" "pip3 install --no-deps --break-system-packages ./*.whl &&
    python3 -B smoke.py mwmesh && pip3 uninstall --yes --break-system-packages mwmesh >/dev/null 2>&1" "the wheel on $release")"
  by_archive="$(try_in "$system" "tar xf ./*.tar.xz && cd mwmesh-*/ &&
    PYTHONPATH=python python3 -B ../smoke.py bin/mwmesh" "the archive on $release")"
  echo "wheel: $release: $by_wheel, archive: $by_archive"
  digests+=("$by_wheel" "$by_archive")
  rm -rf --one-file-system "$system"
done
(($(printf '%s\n' "${digests[@]}" | sort -u | wc -l) == 1)) || fail "the digests differ"
