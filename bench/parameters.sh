#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# What each dial does, one at a time, the others at their defaults: meshes every volume once a row.
# Usage: bench/parameters.sh VOLUME...   (bench/parameters.md holds a run of it)
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
program="${MW_PROGRAM:-$root/build/release/mwmesh}"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

(($#)) || {
  echo "usage: bench/parameters.sh VOLUME..." >&2
  exit 2
}

rows=(
  "" "--surface voxel" "--start octree" "--start dense" "--order colour" "--topology interfaces"
  "--window 16" "--window 24" "--window 48" "--window 64"
  "--marches 1" "--marches 3"
  "--quality-floor 0.1" "--quality-floor 0.3"
  "--max-distance 1" "--max-distance 2" "--max-distance 3" "--max-distance none"
  "--edge-variance 0.1" "--optimizer none"
)

header="| dial |" line="|---|"
for volume in "$@"; do
  header+=" $(basename "$volume"): share of corners | RR min / mean | CPU seconds |"
  line+="---|---|---|"
done
printf '%s\n%s\n' "$header" "$line"
for row in "${rows[@]}"; do
  out="| ${row:-defaults} |"
  for volume in "$@"; do
    # shellcheck disable=SC2086  # a row is a list of flags
    "$program" mesh "$volume" --threads 1 -o "$work/m.vtu" --report "$work/r.json" $row >/dev/null
    out+="$(jq -r '
      def digits($n): . * pow(10; $n) | round / pow(10; $n) | tostring;
      " \(.output.vertex_fraction * 100 | digits(3)) % | \(.quality.radius_ratio_min | digits(2)) / "
      + "\(.quality.radius_ratio_mean | digits(3)) | \(.performance.cpu_s | digits(1)) |"' \
      "$work/r.json")"
  done
  echo "$out"
done
