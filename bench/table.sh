#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# One row of figures a volume, whole program, file to mesh: meshes and verifies each with the
# default settings (or what MW_... variables say).  Usage: bench/table.sh VOLUME...
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
program="${MW_PROGRAM:-$root/build/release/mwmesh}"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

(($#)) || {
  echo "usage: bench/table.sh VOLUME..." >&2
  exit 2
}

echo "| volume | voxels | labels | vertices | share of corners | RR min / mean | labels changed | seconds | voxels/s | peak MiB |"
echo "|---|---|---|---|---|---|---|---|---|---|"
for volume in "$@"; do
  "$program" mesh "$volume" --threads 1 -o "$work/m.vtu" --report "$work/run.json" >/dev/null
  "$program" verify "$volume" "$work/m.vtu" --report "$work/check.json" >/dev/null || true
  jq -rs --arg name "$(basename "$volume")" '
    def digits($n): . * pow(10; $n) | round / pow(10; $n) | tostring;
    .[0] as $run | .[1] as $check |
    [$name, $run.input.voxels, $run.input.labels, $run.output.vertices,
     (($run.output.vertex_fraction * 100 | digits(3)) + " %"),
     (($run.quality.radius_ratio_min | digits(2)) + " / "
      + ($run.quality.radius_ratio_mean | digits(3))),
     $check.topology.labels_changed, ($run.performance.wall_s | digits(1)),
     ($run.performance.voxels_per_s | round), ($run.performance.peak_rss_bytes / 1048576 | round)]
    | map(tostring) | "| " + join(" | ") + " |"' "$work/run.json" "$work/check.json"
done
