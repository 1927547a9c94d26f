#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Builds the Debian packages, a wheel and an archive into build/packages; tests/packages.sh and
# tests/wheel.sh try them.  Needs what configs/setup.sh installs, and the tools below.
#   mwmesh  libmwmesh0.1  libmwmesh-dev  python3-mwmesh  mwmesh-codt (AGPL: linked with TetGen)
#   mwmesh-mpi, where MPI is found
# The wheel, for every Python, and the archive, for every Linux, have their libraries inside
# (bundle.py); the oldest glibc that they run with is that of the newest symbol that they ask for.
# DEBFULLNAME and DEBEMAIL say who made them.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
tree="$root/build/packaging"
out="$root/build/packages"
cd "$root"

for tool in dpkg-shlibdeps file patchelf pip3; do
  command -v "$tool" >/dev/null || {
    echo "package: needs $tool: apt-get install dpkg-dev file patchelf python3-pip python3-wheel" >&2
    exit 2
  }
done
# Packages of one commit are of one date.
SOURCE_DATE_EPOCH="${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}"
export SOURCE_DATE_EPOCH
link="-Wl,-z,relro,-z,now"
cmake --preset release -B "$tree" -DCMAKE_INSTALL_PREFIX=/usr -DMW_PACKAGING=ON \
  -DMW_BUILD_TESTS=OFF -DMW_BUILD_BENCH=OFF -DCMAKE_EXE_LINKER_FLAGS="$link" \
  -DCMAKE_SHARED_LINKER_FLAGS="$link" -DCMAKE_MODULE_LINKER_FLAGS="$link" >/dev/null
cmake --build "$tree" --parallel "${JOBS:-2}"
umask 022
rm -rf "$out"
(cd "$tree" && cpack -B "$out" >"$tree/cpack.log") || {
  tail -n 20 "$tree/cpack.log" >&2
  exit 1
}
rm -rf "$out/_CPack_Packages"

plain="$root/build/wheel/plain"
rm -rf "$plain"
/usr/bin/python3 -m pip wheel --quiet --no-build-isolation --no-deps --wheel-dir "$plain" \
  "$root/engine/python"
/usr/bin/python3 "$root/configs/bundle.py" "$plain"/mwmesh-*.whl "$out" >/dev/null

# The program, the shared library with its headers, and the Python package, which takes that library.
name="mwmesh-$(sed -n 's/^project(mwmesh VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)-linux-$(uname -m)"
stage="$root/build/archive/$name"
rm -rf "$root/build/archive"
for component in program library development; do
  cmake --install "$tree" --prefix "$stage" --component "$component" --strip >/dev/null
done
find "$stage" \( -name '*.a' -o -name 'mwmeshStaticTargets*' \) -delete
mkdir -p "$stage/python"
cp -r "$tree/python/mwmesh" "$stage/python/mwmesh"
rm -rf "$stage"/python/mwmesh/{libmwmesh.so*,bin,__pycache__}
library="$(find "$stage/lib" -name 'libmwmesh.so.*.*.*')"
ln -s "../../${library#"$stage/"}" "$stage/python/mwmesh/libmwmesh.so"
/usr/bin/python3 "$root/configs/bundle.py" "$stage"
tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" \
  -C "$root/build/archive" -cJf "$out/$name.tar.xz" "$name"
ls "$out"
