#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Shows what each setting does: meshes every volume once a row, with one setting changed.
# Usage: bench/parameters.sh VOLUME...   (bench/parameters.md has the tables of a run)
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
  "" "--surface voxel" "--start octree" "--start dense" "--order raster" "--topology interfaces"
  "--window 16" "--window 24" "--window 48" "--window 64"
  "--marches 1" "--marches 3"
  "--quality-floor 0.1" "--quality-floor 0.3"
  "--max-distance 1" "--max-distance 2" "--max-distance 3" "--max-distance none"
  "--inner-quality 0.38" "--edge-variance 0.1" "--optimizer none"
)

# Prints what a report says of one mesh, as the end of a row.
figures() {
  jq -r '
    def digits($n): . * pow(10; $n) | round / pow(10; $n) | tostring;
    def percent($n): . * 100 | digits($n) + " %";
    "\(.output.vertex_fraction | percent(2)) | \(.quality.radius_ratio_min | digits(2)) / "
    + "\(.quality.radius_ratio_mean | digits(3)) | \(.shape.volume_error_mean_abs | percent(2)) / "
    + "\(.shape.volume_error_max_abs | percent(1)) | \(.shape.sharp_share | percent(1)) | "
    + "\(.performance.cpu_s | digits(1)) |"' "$1"
}

for volume in "$@"; do
  echo "| $(basename "$volume") | share of corners | radius ratio, least / mean |" \
    "volume error, mean / largest | sharp | CPU s |"
  echo "|---|---|---|---|---|---|"
  for row in "${rows[@]}"; do
    # shellcheck disable=SC2086  # a row is a list of flags
    "$program" mesh "$volume" --threads 1 -o "$work/m.vtu" --report "$work/r.json" $row >/dev/null
    echo "| ${row:-defaults} | $(figures "$work/r.json")"
  done
  echo
done
