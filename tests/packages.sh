#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Tries the packages of configs/package.sh: programs, worker, Python, and the texts about them.
#
#   bash tests/packages.sh           unpacked into a folder; libraries are those of this machine
#   bash tests/packages.sh --fresh   installed with apt into a new Debian 12 (as root; debootstrap, and
#                                    the package mirror of this machine; some minutes)
#   bash tests/packages.sh --lint    no error that lintian knows, but that nobody is their maintainer and that --help is the manual

# shellcheck source=tests/new_system.sh
source "$(dirname "${BASH_SOURCE[0]}")/new_system.sh"
system="$folder/system"

unpack() {
  local package
  for package in "$packages"/*.deb; do
    dpkg-deb -x "$package" "$system"
  done
  cp "$folder/smoke.sh" "$system/smoke.sh"
  run=(env "PATH=$system/usr/bin:$PATH" "PYTHONPATH=$system/usr/lib/python3/dist-packages"
    bash "$system/smoke.sh")
}

has() {
  dpkg-deb --fsys-tarfile "$packages/$1"_*.deb | tar --list | grep -x "./usr/$2" >/dev/null || fail "$1 has no $2"
}

needs() {
  dpkg-deb --field "$packages/$1"_*.deb Depends | tr ',' '\n' | grep "^ *$2\b" >/dev/null
}

# What is in which package, and that only mwmesh-mpi brings MPI.
look_inside() {
  local program
  for program in mwmesh mwmesh-mpi mwmesh-codt; do
    has "$program" "bin/$program"
    has "$program" "share/doc/$program/copyright"
  done
  for program in mwmesh mwmesh-codt libmwmesh0.1 libmwmesh-dev python3-mwmesh; do
    needs "$program" libopenmpi3 && fail "$program needs MPI"
    needs "$program" openmpi-bin && fail "$program needs mpirun"
  done
  needs mwmesh-mpi libopenmpi3 || fail "mwmesh-mpi does not need MPI"
  needs mwmesh-mpi openmpi-bin || fail "mwmesh-mpi does not need mpirun"
  needs mwmesh-codt libtet1.5 || fail "mwmesh-codt does not need TetGen"
}

lint() {
  local found
  found="$(lintian --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog,no-manual-page \
    --fail-on error,warning "$packages"/*.deb 2>&1)" || fail "lintian: $found"
  echo "packages: lintian has nothing to say"
}

install_fresh() {
  ((EUID == 0)) || fail "--fresh needs root"
  new_system bookworm "$system"
  mkdir "$system/packages"
  cp "$packages"/*.deb "$system/packages"
  cp "$folder/smoke.sh" "$system/smoke.sh"
  chroot "$system" sh -c 'apt-get update && apt-get install --yes --no-install-recommends /packages/*.deb' \
    >"$folder/log" 2>&1 || fail "apt-get install: $(tail -n 5 "$folder/log")"
  run=(chroot "$system" bash /smoke.sh)
}

# What runs where the packages are.
cat >"$folder/smoke.sh" <<'END'
set -euo pipefail
cd "$(mktemp -d)"
trap 'rm -rf "$PWD"' EXIT
mwmesh synth voronoi --shape 24,20,16 --labels 5 --seed 1 -o v.npy >/dev/null
for optimizer in local tetgen; do
  mwmesh mesh v.npy -o "$optimizer.vtu" --optimizer "$optimizer" >/dev/null
  mwmesh verify v.npy "$optimizer.vtu" >/dev/null
  mwmesh digest "$optimizer.vtu"
done
/usr/bin/python3 -B - <<'PYTHON'
import mwmesh, numpy
voxels = numpy.load("v.npy")
mesh = mwmesh.mesh(voxels)
assert sorted(mesh.volumes()) == numpy.unique(voxels).tolist() and mesh.verify(voxels)
print(mesh.digest)
print(mwmesh.mesh("v.npy", optimizer="tetgen").digest)
PYTHON
mpirun --oversubscribe --bind-to none -n 2 mwmesh-mpi mesh v.npy -o shared.vtu >/dev/null
mwmesh digest shared.vtu
END

require_packages '*.deb'
look_inside
if [[ "${1:-}" == --lint ]]; then
  lint
  exit
fi
mkdir "$system"
if [[ "${1:-}" == --fresh ]]; then install_fresh; else unpack; fi
unset MW_CODT_WORKER
# Open MPI asks before it starts as root, which one is in a container.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
mapfile -t digests < <("${run[@]}" || echo failed)
((${#digests[@]} == 5)) || fail "the smoke test: ${digests[*]}"
[[ "${digests[0]}" == "${digests[2]}" ]] || fail "Python made another mesh: ${digests[*]}"
[[ "${digests[1]}" == "${digests[3]}" ]] || fail "Python made another mesh with TetGen: ${digests[*]}"
[[ "${digests[0]}" == "${digests[4]}" ]] || fail "mwmesh-mpi made another mesh: ${digests[*]}"
echo "packages: ${digests[0]}"
