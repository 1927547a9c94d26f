#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# configs/slurm.sh with stand-ins for SLURM's programs: what it starts, and when it is queued again.
# Usage: slurm_test.sh MWMESH
set -euo pipefail

script="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/configs/slurm.sh"
mwmesh="$1"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# Programs that note how they are called.
stand_in() {
  printf '#!/bin/bash\n%s\n' "$2" >"bin/$1"
  chmod +x "bin/$1"
}
mkdir bin
# shellcheck disable=SC2016  # for the stand-ins
{
  stand_in srun 'echo "$@" >>srun.calls; shift 3; exec "$@"'
  stand_in scontrol 'echo "$@" >>scontrol.calls'
  stand_in ends 'exit "$CODE"'
  stand_in waits 'sleep 60 & trap "kill $!; exit 75" USR1; touch running; wait $!'
}
export PATH="$folder/bin:$PATH" SLURM_JOB_ID=7

failures=0
expect() {
  [[ "$2" == "$3" ]] && return 0
  echo "$1: '$2' instead of '$3'" >&2
  failures=$((failures + 1))
}

# Runs the script; afterwards `code`, and in `queued` how often it was queued again.
run() {
  rm -f ./*.calls
  code=0
  "$script" v.npy o.vtkhdf "$@" 2>log || code=$?
  queued="$(cat scontrol.calls 2>/dev/null || true)"
}

saved_work() {
  mkdir -p o.vtkhdf.work
  echo "epochs = 1" >o.vtkhdf.work/epochs
}

try_exit_codes() {
  for CODE in 0 1 3 4 75 137; do
    export CODE
    rm -rf o.vtkhdf.work
    MESH_PROGRAM=ends run
    expect "code $CODE" "$code" "$CODE"
    expect "code $CODE without saved work" "$queued" ""
    expect "code $CODE, resume" "$(grep -c -- --resume srun.calls || true)" 0
    saved_work
    MESH_PROGRAM=ends run
    local again=""
    ((CODE == 75 || CODE == 137)) && again="requeue 7"
    expect "code $CODE with saved work" "$queued" "$again"
    expect "code $CODE, resume" "$(grep -c -- --resume srun.calls || true)" 1
  done
  CODE=75 SLURM_RESTART_COUNT=20 MESH_PROGRAM=ends run
  expect "queued too often" "$queued" ""
}

try_warning() {
  saved_work
  rm -f running ./*.calls
  MESH_PROGRAM=waits "$script" v.npy o.vtkhdf 2>log &
  local job=$!
  while [[ ! -e running ]]; do sleep 0.05; done
  kill -USR1 "$job"
  wait "$job" || true
  expect "warned" "$(cat scontrol.calls)" "requeue 7"
}

# The program refuses names of the environment that begin like its options.
try_real_program() {
  rm -rf o.vtkhdf.work
  "$mwmesh" synth voronoi --shape 24,24,24 --labels 3 --seed 1 -o v.npy >log
  MESH_LAUNCHER=srun MESH_WORKDIR=work MESH_RESTARTS=1 MESH_PROGRAM="$mwmesh" run --order colour
  expect "a mesh" "$code $(ls o.vtkhdf o.vtkhdf.json)" "0 o.vtkhdf
o.vtkhdf.json"
  # A folder of --keep stands in for the work folder.
  MESH_PROGRAM="$mwmesh" run --keep kept
  expect "--keep" "$code $(ls kept/windows)" "0 kept/windows"
  MESH_PROGRAM="$mwmesh" run --from=kept
  expect "--from" "$code" 0
}

try_exit_codes
try_warning
unset CODE
try_real_program
((failures == 0))
