#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Random volumes, settings, threads, budgets, kills and signals against every promise of the README.
#
#   tests/campaign.sh [MINUTES [SEED]] [--jobs N]     default: 1 1, one case at a time
#   tests/campaign.sh --case NUMBER                   one case again, its files kept
#
# Each case follows from its number alone.  `mwmesh verify` judges its mesh; so does an independent
# judge of meshes, built from $MW_JUDGE (default ../shared/judge) where there is one; the mesh must
# have the same digest in another format, and the same bytes with other threads and budgets and
# after kills and signals.  MW_PROGRAM is the program (default build/release/mwmesh).
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
program="$(realpath "${MW_PROGRAM:-$root/build/release/mwmesh}")"
source="${MW_JUDGE:-$root/../shared/judge}"
unset MW_JUDGE # or the program would ask what option that is
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

judge=()
if [[ ! -f "$source/judge.cpp" ]]; then
  echo "campaign: no judge in $source: verify alone looks at the meshes"
elif cp "$source/judge.cpp" "$source/Makefile" "$folder" &&
  make --silent -C "$folder" judge >"$folder/log" 2>&1; then
  judge=(--judge "$folder/judge")
else
  echo "campaign: the judge in $source cannot be built: verify alone looks at the meshes"
  tail -5 "$folder/log"
fi
/usr/bin/python3 -B "$root/tests/campaign/campaign.py" --program "$program" "${judge[@]}" "$@"
