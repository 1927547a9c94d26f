#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Meshes a labelled volume (without FILE: the AAL brain atlas of mricron-data), verifies the mesh
# against it and prints what came out.  Writes to ./demo.  Usage: demo.sh [FILE]
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
program="$root/build/release/mwmesh"

die() {
  echo "demo: $*" >&2
  exit 1
}

find_atlas() {
  local file
  file="$(dpkg -L mricron-data 2>/dev/null | grep '/aal\.nii\(\.gz\)\?$' | head -n 1 || true)"
  [[ -r "$file" ]] || die "mricron-data has no aal.nii.gz here; give a FILE"
  echo "$file"
}

# The name of a file without folder and extensions.
stem() {
  local name="${1##*/}"
  name="${name%.gz}"
  echo "${name%.*}"
}

print_table() {
  jq -rs '
    def percent: . * 10000 | round / 100 | tostring + " %";
    # Of labels with 1000 voxels or more.
    def measured: if . == null then "no large label" else percent end;
    def digits3: . * 1000 | round / 1000 | tostring;
    .[0] as $run | .[1] as $check |
    ["input", ($run.input.shape_xyz | map(tostring) | join(" x ")) + " voxels, "
              + ($run.input.labels | tostring) + " labels"],
    ["vertices", $run.output.vertices],
    ["share of voxel corners", ($run.output.vertex_fraction | percent)],
    ["tets", $run.output.tets],
    ["radius ratio, least", ($run.quality.radius_ratio_min | digits3)],
    ["radius ratio, mean", ($run.quality.radius_ratio_mean | digits3)],
    ["slivers (below 0.1)", ($run.quality.sliver_fraction | percent)],
    ["labels changed", ($check.topology.labels_changed // "not known")],
    ["distance, voxels at most", ($check.distance.max_voxels | digits3)],
    ["volume error, mean", ($run.shape.volume_error_mean_abs | measured)],
    ["volume error, at most", ($run.shape.volume_error_max_abs | measured)],
    ["edges sharper than 60 deg", ($run.shape.sharp_share | percent)],
    ["all checks hold", (if $check.passed then "yes" else "NO" end)],
    ["seconds", ($run.performance.wall_s * 10 | round / 10)],
    ["voxels/s", ($run.performance.voxels_per_s | round)],
    ["peak memory, MiB", ($run.performance.peak_rss_bytes / 1048576 | round)]
    | map(tostring) | @tsv' "$1" "$2" | awk -F '\t' '{ printf "%-26s %s\n", $1, $2 }'
}

# Shows three commands to go on with.  usage: try_next VOLUME NAME
try_next() {
  local mwmesh="build/release/mwmesh" volume mesh
  volume="$(printf '%q' "$1")" mesh="$(printf '%q' "$2")"
  echo
  echo "Try next, in $PWD:"
  echo "  $mwmesh surface $mesh.vtu -o 'demo/{label}.stl'   # the closed surface of each label"
  echo "  $mwmesh mesh $volume --size 4 -o $mesh.inp   # edges of 4 voxels, for CalculiX"
  echo "  $mwmesh mesh YOUR_VOLUME -o yours.vtu --background 0   # yours, without its label 0"
}

main() {
  local input name verdict=0 names=()
  bash "$root/configs/setup.sh" program
  input="${1:-$(find_atlas)}"
  name="demo/$(stem "$input")"
  mkdir -p demo
  echo "demo: meshing $input (half a minute for the atlas)"
  # Names of labels, where they lie beside the volume as those of the atlas do.
  [[ -f "${input%.gz}.txt" ]] && names=(--names "${input%.gz}.txt")
  "$program" mesh "$input" "${names[@]}" -o "$name.vtu" --report "$name.run.json" \
    --html "$name.html" >"$name.log"
  echo "demo: verifying $name.vtu (some seconds)"
  "$program" verify "$input" "$name.vtu" "${names[@]}" --report "$name.verify.json" \
    >>"$name.log" || verdict=$?
  [[ -s "$name.verify.json" ]] || die "verify gave no result (exit $verdict)"
  "$program" picture "$name.vtu" -o "$name.png" >>"$name.log"
  echo
  print_table "$name.run.json" "$name.verify.json"
  echo
  echo "mesh      $PWD/$name.vtu"
  echo "reports   $PWD/$name.run.json, $PWD/$name.verify.json"
  echo "picture   $PWD/$name.png"
  echo "page      $PWD/$name.html"
  try_next "$input" "$name"
  ((verdict == 0)) || grep '^FAIL' "$name.log" >&2
  return "$verdict"
}

main "$@"
