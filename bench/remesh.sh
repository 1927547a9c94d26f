#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# What it costs to keep what a run did, and to mesh a volume again after an edit: processor seconds,
# windows visited in each march, and bytes of the folder, beside a run that begins afresh.
#
#   bench/remesh.sh [EDGE [COUNT [EDIT]]]    default: 128 47 6: tubes, about 3,000 in 512^3; a brush
#   bench/remesh.sh VOLUME.npy [EDIT]        the same of a volume of one's own
#
# MW_PROGRAM is the program (default build/release/mwmesh).  Runs have one thread and make no
# certificate.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
program="$(realpath "${MW_PROGRAM:-$root/build/release/mwmesh}")"
unset MW_PROGRAM
if [[ "${1:-}" == *.npy ]]; then
  volume="$(realpath "$1")"
  edit="${2:-6}"
else
  edge="${1:-128}"
  count="${2:-47}"
  edit="${3:-6}"
fi
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"
if [[ -n "${volume:-}" ]]; then
  cp "$volume" v.npy
else
  "$program" synth tubes --shape "$edge,$edge,$edge" --count "$count" --seed 1 -o v.npy
fi

run() { # NAME OPTION... ; prints processor seconds
  local name="$1"
  shift
  "$program" mesh v.npy -o "$name.vtu" --threads 1 --certify off --report "$name.json" "$@" >/dev/null
  jq .performance.cpu_s "$name.json"
}

echo "| run | CPU s | windows visited | folder, bytes a voxel |"
echo "|---|---|---|---|"
row() { # NAME OPTION...
  local seconds
  seconds="$(run "$@")"
  jq -r --arg name "$1" --arg seconds "$seconds" '
    def short: . * 100 | round / 100;
    .engine.remesh as $r | .input.voxels as $n |
    [$name, ($seconds | tonumber | short),
     (if $r then ([$r.marches[].visited | tostring] | join(" + ")) else .engine.windows end),
     (if $r then $r.folder_bytes / $n | short else "" end)]
    | map(tostring) | "| " + join(" | ") + " |"' "$1.json"
}
row fresh
row keep --keep kept
box="$(/usr/bin/python3 - "$edit" <<'PYTHON'
import sys

import numpy as np

edge = int(sys.argv[1])
volume = np.load("v.npy")
z, y, x = (n // 2 for n in volume.shape)
while x + 1 < volume.shape[2] and volume[z, y, x] == volume[z, y, x + 1]:
    x += 1  # to where two labels meet
lo = [max(0, v - edge // 2) for v in (z, y, x)]
box = tuple(slice(v, v + edge) for v in lo)
volume[box] = volume[z, y, x]
np.save("v.npy", volume)
print(",".join(str(v) for v in lo[::-1] + [v + edge for v in lo[::-1]]))
PYTHON
)"
row again --from kept --changed "$box"
run edited >edited.s
echo "a fresh run of the edited volume: $(cat edited.s) CPU s"
cmp again.vtu edited.vtu
