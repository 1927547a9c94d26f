#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Installs a build into a folder and uses it from there as others would: by CMake (shared and static),
# by pkg-config, from C, from Python and as a program, all of which must make one mesh.  What was in
# the interface of an earlier build of this version (tests/consumer/interface.abi) must be there.
#
#   bash tests/consumer.sh [BUILD]      default: build/release, all of it built
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="$(realpath "${1:-$root/build/release}")"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
prefix="$folder/prefix"
# What is found must be in the prefix.
unset MW_CODT_WORKER PYTHONPATH LD_LIBRARY_PATH CMAKE_PREFIX_PATH

fail() {
  echo "consumer: FAILED: $*" >&2
  exit 1
}

expect() { # WHAT DIGEST ; the same as the program's
  [[ "$2" == "$wanted" ]] || fail "$1 made $2, the program $wanted"
  echo "consumer: $1: the program's mesh"
}

# Just what mwmesh_c.h declares leaves the library.
check_symbols() { # LIBRARY
  local declared defined
  declared="$("${CC:-gcc}" -E -P "$prefix/include/mwmesh_c.h" | grep -oE '\bmw_[a-z_]+ ?\(' | tr -d ' (' | sort -u)"
  defined="$(nm -D --defined-only "$1" | awk '$3 !~ /^MWMESH_/ {sub(/@.*/, "", $3); print $3}' | sort)"
  [[ "$declared" == "$defined" ]] || fail "$1: declared (<) and defined (>) differ: $(diff <(echo "$declared") <(echo "$defined") || true)"
}

by_program() {
  "$prefix/bin/mwmesh" mesh "$folder/v.raw" --shape 24,20,16 --dtype u8 --optimizer "$1" -o "$folder/m.vtu" >/dev/null
  "$prefix/bin/mwmesh" digest "$folder/m.vtu"
}

by_python() {
  PYTHONPATH="$python" /usr/bin/python3 -B - "$folder/v.raw" "$1" <<'END'
import sys
import mwmesh
import numpy as np
voxels = np.fromfile(sys.argv[1], dtype=np.uint8).reshape(16, 20, 24)
print(mwmesh.mesh(voxels, optimizer=sys.argv[2]).digest)
END
}

# One allocation that fails, whichever it is, is an error of the function that was called, or does no
# harm; the program in C then says so or goes on.
fail_allocations() { # TIMES
  local preload="$build/libfailing_malloc.so" all n code
  [[ -e "$preload" ]] || return 0
  # An output's folder is listed: 2,000 files in it make thousands of allocations there.
  for ((n = 0; n < 2000; ++n)); do : >"$folder/a neighbour of the output $n"; done
  local run=(env LD_LIBRARY_PATH="$library" LD_PRELOAD="$preload")
  "${run[@]}" FAILING_MALLOC_COUNT="$folder/count" "$folder/in_c" "$folder/v.raw" "$folder/c.vtu" local >/dev/null
  all="$(cat "$folder/count")"
  ((all > 1000)) || fail "the module that fails allocations is not there"
  for ((n = 7; n < all; n += all / $1)); do
    code=0
    "${run[@]}" FAILING_MALLOC_AT="$n" "$folder/in_c" "$folder/v.raw" "$folder/c.vtu" local \
      >/dev/null 2>"$folder/log" || code=$?
    ((code == 0)) || { ((code == 1)) && grep -qE 'memory|NULL' "$folder/log"; } ||
      fail "allocation $n: exit $code: $(cat "$folder/log")"
  done
}

cmake --install "$build" --prefix "$prefix" >"$folder/log" || fail "cmake --install: $(tail -n 3 "$folder/log")"
library="$(find "$prefix" -name libmwmesh.so -printf '%h\n')"
python="$(find "$prefix" -path '*/mwmesh/__init__.py' -printf '%h\n' | xargs -r dirname)"
check_symbols "$library/libmwmesh.so"
for note in LICENSE THIRD_PARTY.md CHANGELOG.md; do
  [[ -s "$prefix/share/doc/mwmesh/$note" ]] || fail "no $note"
done

cmake -S "$root/tests/consumer" -B "$folder/cmake" -DCMAKE_PREFIX_PATH="$prefix" >"$folder/log" 2>&1 ||
  fail "find_package: $(cat "$folder/log")"
cmake --build "$folder/cmake" >"$folder/log" 2>&1 || fail "the build by CMake: $(cat "$folder/log")"
export PKG_CONFIG_PATH="$library/pkgconfig"
read -ra flags <<<"$(pkg-config --cflags --libs mwmesh)"
"${CXX:-g++}" -std=c++20 "$root/tests/consumer/main.cpp" "${flags[@]}" -o "$folder/by_pkg_config"
"${CC:-gcc}" -std=c11 -pedantic -Wall -Wextra -Werror "$root/tests/consumer/main.c" "${flags[@]}" -o "$folder/in_c"

"$folder/cmake/consumer_shared" "$folder/v.raw" local >/dev/null
optimizers=(local)
[[ ! -x "$prefix/bin/mwmesh-codt" ]] || optimizers+=(tetgen)
for optimizer in "${optimizers[@]}"; do
  wanted="$(by_program "$optimizer")"
  [[ "$wanted" == sha256:* ]] || fail "the program has no digest: $wanted"
  expect "shared, $optimizer" "$("$folder/cmake/consumer_shared" "$folder/v.raw" "$optimizer")"
  expect "by pkg-config, $optimizer" "$(LD_LIBRARY_PATH="$library" "$folder/by_pkg_config" "$folder/v.raw" "$optimizer")"
  expect "C, $optimizer" "$(LD_LIBRARY_PATH="$library" "$folder/in_c" "$folder/v.raw" "$folder/c.vtu" "$optimizer")"
  [[ -z "$python" ]] || expect "Python, $optimizer" "$(by_python "$optimizer")"
done
wanted="$(by_program local)"
expect "static" "$("$folder/cmake/consumer_static" "$folder/v.raw" local)"
fail_allocations 25
echo "consumer: allocations that fail are errors in C"
