#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Builds the fuzzers with clang-14 (preset fuzz) and runs them, one after the other.
# Usage: fuzz.sh [SECONDS [TARGET...]]: so long each (60); all targets when none is named.
#
# What libFuzzer learns stays in build/fuzz/corpus for the next run, what it finds in
# build/fuzz/finds; the exit code is 1 when there is a find.  A find becomes a test by being put into
# tests/fuzz/seeds/TARGET: test_fuzz runs all of them.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
seconds="${1:-60}"
shift || true
cd "$root"

[[ "$seconds" =~ ^[0-9]+$ ]] || {
  echo "usage: fuzz.sh [SECONDS [TARGET...]]" >&2
  exit 2
}
command -v clang++-14 >/dev/null || {
  echo "fuzz: needs clang-14 and libclang-rt-14-dev: apt-get install clang-14 libclang-rt-14-dev" >&2
  exit 2
}
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
program="$root/build/fuzz/mwmesh-fuzz"
logs="$root/build/fuzz/logs"
finds="$root/build/fuzz/finds"
mkdir -p "$logs" "$finds"

# Targets write small files; a disk would be what they wait for.
[[ -d /dev/shm ]] && export TMPDIR=/dev/shm

# Runs one target; prints runs and coverage.
fuzz() {
  local target="$1" verdict="" status=0
  mkdir -p "$root/build/fuzz/corpus/$target"
  MW_FUZZ_TARGET="$target" "$program" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=2048 \
    -max_len=8192 -print_final_stats=1 -artifact_prefix="$finds/$target-" \
    "$root/build/fuzz/corpus/$target" "$root/tests/fuzz/seeds/$target" \
    >"$logs/$target.txt" 2>&1 || status=$?
  ((status == 0)) || verdict="FOUND: see $logs/$target.txt"
  printf '%-14s %9s runs, %5s edges, %5s inputs kept  %s\n' "$target" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' "$logs/$target.txt")" \
    "$(grep -oP ' cov: \K[0-9]+' "$logs/$target.txt" | tail -n 1)" \
    "$(find "$root/build/fuzz/corpus/$target" -type f | wc -l)" "$verdict"
  return "$status"
}

targets=("$@")
((${#targets[@]})) || mapfile -t targets < <(find tests/fuzz/seeds -mindepth 1 -maxdepth 1 -type d -printf '%f\n' | sort)
verdict=0
for target in "${targets[@]}"; do
  fuzz "$target" || verdict=1
done
exit "$verdict"
