#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Tries the packages of configs/package.sh: program, manual page, worker, and Python.
#
#   bash tests/packages.sh           unpacked into a folder; libraries are those of this machine
#   bash tests/packages.sh --fresh   installed with apt into a new Debian 12 (as root; debootstrap, and
#                                    the package mirror of this machine; some minutes)
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
packages="$root/build/packages"
folder="$(mktemp -d)"
trap 'rm -rf --one-file-system "$folder"' EXIT
system="$folder/system"

fail() {
  echo "packages: FAILED: $*" >&2
  exit 1
}

unpack() {
  local package
  for package in "$packages"/*.deb; do
    dpkg-deb -x "$package" "$system"
  done
  cp "$folder/smoke.sh" "$system/smoke.sh"
  run=(env "PATH=$system/usr/bin:$PATH" "PYTHONPATH=$system/usr/lib/python3/dist-packages"
    "ROOT=$system" bash "$system/smoke.sh")
}

mirror() {
  apt-cache policy | sed -n 's/^ *[0-9]* \(http[^ ]*\) bookworm\/main.*/\1/p' | head -n 1
}

install_fresh() {
  ((EUID == 0)) || fail "--fresh needs root"
  debootstrap --variant=minbase bookworm "$system" "$(mirror)" >"$folder/log" 2>&1 || fail "debootstrap: $(tail -n 5 "$folder/log")"
  mkdir "$system/packages"
  cp "$packages"/*.deb "$system/packages"
  cp "$folder/smoke.sh" "$system/smoke.sh"
  chroot "$system" sh -c 'apt-get update && apt-get install --yes --no-install-recommends /packages/*.deb' \
    >"$folder/log" 2>&1 || fail "apt-get install: $(tail -n 5 "$folder/log")"
  run=(chroot "$system" env ROOT= bash /smoke.sh)
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
gzip -cd "$ROOT/usr/share/man/man1/mwmesh.1.gz" | grep -q '^\.TH'
for file in bash-completion/completions/mwmesh doc/mwmesh/copyright doc/mwmesh-codt/copyright; do
  [[ -s "$ROOT/usr/share/$file" ]]
done
END

ls "$packages"/*.deb >/dev/null 2>&1 || fail "no packages; run configs/package.sh"
mkdir "$system"
if [[ "${1:-}" == --fresh ]]; then install_fresh; else unpack; fi
unset MW_CODT_WORKER
mapfile -t digests < <("${run[@]}" || echo failed)
((${#digests[@]} == 4)) || fail "the smoke test: ${digests[*]}"
[[ "${digests[0]}" == "${digests[2]}" ]] || fail "Python made another mesh: ${digests[*]}"
[[ "${digests[1]}" == "${digests[3]}" ]] || fail "Python made another mesh with TetGen: ${digests[*]}"
echo "packages: ${digests[0]}"
