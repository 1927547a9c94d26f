#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# The binary interface, engine/mwmesh_c.h, may grow within a minor version by functions, and by nothing
# else: what abidw says of it is held against tests/consumer/interface.abi.  Releases have no debug
# information, which abidw goes by, so what is looked at are the declarations, compiled as definitions;
# tests/consumer.sh holds them against the symbols of the library.  Exit code 77: abidiff is missing.
#
#   bash tests/interface.sh [--renew]   --renew: for a new minor version, or a function that came
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
stored="$root/tests/consumer/interface.abi"
command -v abidiff >/dev/null || {
  echo "interface: SKIPPED: needs abidiff: apt-get install abigail-tools"
  exit 77
}
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
header="$root/engine/mwmesh_c.h"
minor="$(sed -nE 's/^project\(mwmesh VERSION ([0-9]+\.[0-9]+)\..*/\1/p' "$root/CMakeLists.txt")"

describe() { # HEADER ; writes found.abi
  {
    echo "#include \"$1\""
    gcc -E -P "$1" | tr '\n' ' ' | sed 's/;/;\n/g' |
      sed -nE 's/^(.*[ *]mw_[a-z_]+\(.*\));$/\1 { __builtin_trap(); }/p'
  } >"$folder/interface.c"
  gcc -std=c11 -g -fPIC -shared "$folder/interface.c" -o "$folder/interface.so" \
    -Wl,-soname,"libmwmesh.so.$minor" || return
  abidw --exported-interfaces-only --no-corpus-path --no-comp-dir-path --no-show-locs \
    --no-parameter-names --no-elf-needed --no-architecture --type-id-style hash "$folder/interface.so" |
    sed "s|path='[^']*'|path='mwmesh_c.h'|" >"$folder/found.abi"
}

fits() { # HEADER
  describe "$1" && abidiff --no-added-syms "$stored" "$folder/found.abi" >"$folder/log"
}

# The check sees what it is for.
try() { # COMMAND-OF-SED
  sed -E "$1" "$header" >"$folder/changed.h"
  fits "$folder/changed.h"
}

if [[ "${1:-}" == --renew ]]; then
  describe "$header"
  cp "$folder/found.abi" "$stored"
  exit
fi
fits "$header" || {
  cat "$folder/log" >&2
  echo "interface: FAILED: what was built against libmwmesh.so.$minor would not fit any more" >&2
  exit 1
}
for change in 's/MW_CALLBACK = 7/MW_CALLBACK = 8/' 's/size_t\* bytes/int* bytes/' 's/colour\[4\]/colour[3]/' \
  's/\bmw_mesh_digest\(/mw_mesh_hash(/'; do
  ! try "$change" || { echo "interface: FAILED: $change was not seen" >&2; exit 1; }
done
try 's/^MW_PUBLIC void mw_free\(/MW_PUBLIC int mw_new(void);\n&/' || {
  echo "interface: FAILED: a new function was refused" >&2
  exit 1
}
echo "interface: all $(grep -c '<elf-symbol' "$stored") functions of $minor are there"
