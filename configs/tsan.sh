#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Runs the tests of the engine, the only part with threads, under ThreadSanitizer.  Arguments go to
# ctest, for instance: bash configs/tsan.sh -R March
#
# Debian's oneTBB is not built for ThreadSanitizer, which then takes whatever one thread hands to
# another through the library for a race.  So the same version is built from Debian's source
# package, instrumented, and the tests load that one: no suppressions are needed.  The machine's
# package lists are left alone.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
tbb="$root/build/tsan-tbb"

fetch_source() {
  mkdir -p "$tbb"/apt/{lists,archives}/partial
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]" \
    "http://deb.debian.org/debian bookworm main" >"$tbb/apt/sources.list"
  local own=(-o "Dir::State::lists=$tbb/apt/lists" -o "Dir::Cache=$tbb/apt"
    -o "Dir::Etc::sourcelist=$tbb/apt/sources.list" -o "Dir::Etc::sourceparts=-")
  (cd "$tbb" && apt-get "${own[@]}" update && apt-get "${own[@]}" source onetbb)
}

build_tbb() {
  cmake -S "$tbb"/onetbb-*/ -B "$tbb/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF -DTBB_STRICT=OFF \
    -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_INSTALL_PREFIX="$tbb"
  cmake --build "$tbb/build" --parallel 2
  cmake --install "$tbb/build"
}

if [[ ! -e "$tbb/lib/libtbb.so.12" ]]; then
  fetch_source
  build_tbb
fi
cd "$root"
cmake --preset tsan
cmake --build --preset tsan --target test_engine
ctest --preset tsan -L test_engine "$@"
