#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Kills the program at random instants and resumes it, until the mesh is there; its digest must be
# that of a run that nobody disturbed.  Promises 5 and 7, on the program as a user runs it.
#
#   bash tests/kill_resume.sh [PROGRAM [KILLS [SEED]]]      default: build/release/mwmesh 50 1
#
# Each attempt draws its signal (three in four are SIGKILL, the others SIGTERM or SIGINT, which must
# end in 75 or with a whole mesh), 1 to 8 threads, and a budget between the least that works and
# plenty; each chain of attempts draws its volume, order, start mesh and window.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
program="$(realpath "${1:-$root/build/release/mwmesh}")"
kills="${2:-50}"
RANDOM="${3:-1}"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
  echo "kill_resume: FAILED: $*" >&2
  cat log >&2 || true
  exit 1
}

below() { # NUMBER
  echo $(((RANDOM * 32768 + RANDOM) % $1))
}

digest_of() { # MESH
  "$program" digest "$1" || fail "no digest of $1"
}

min_memory() { # OPTION... ; the budget that a run asks for when it has too little, in MiB
  local mib=1 code
  while true; do
    code=0
    "$program" mesh v.npy -o least.vtu --report r.json --memory "${mib}MiB" "$@" >log 2>&1 || code=$?
    rm -rf least.vtu least.vtu.work r.json
    ((code == 0)) && break
    ((code == 4)) || fail "exit code $code under ${mib} MiB"
    mib="$(sed -n 's/.*--memory \([0-9]*\)MiB.*/\1/p' log)"
    [[ -n "$mib" ]] || fail "no advice"
  done
  echo "$mib"
}

# One attempt; killed after a random share of the time that a whole run takes.
attempt() { # SIGNAL OPTION...
  local signal="$1" code=0
  shift
  local instant=$(($(below 1100) * milliseconds / 1000 + 1))
  "$program" mesh v.npy -o m.vtu --resume "$@" >log 2>&1 &
  local pid=$!
  sleep "$((instant / 1000)).$(printf %03d $((instant % 1000)))"
  kill -s "$signal" "$pid" 2>/dev/null || true
  wait "$pid" 2>/dev/null || code=$?
  case "$signal.$code" in
    *.0) return 0 ;;
    KILL.137 | TERM.75 | INT.75) ;;
    TERM.143 | TERM.130 | INT.130) ;; # before the program watches for signals, or has any work
    *) fail "signal $signal gave exit code $code" ;;
  esac
  stopped=$((stopped + 1))
  [[ ! -e m.vtu ]] || [[ "$(digest_of m.vtu)" == "$expected" ]] || fail "half a mesh has a name"
}

finish() { # OPTION...
  local code=0
  "$program" mesh v.npy -o m.vtu --resume --report r.json "$@" >log 2>&1 || code=$?
  ((code == 0)) || fail "the resumed run ended in $code"
  [[ "$(digest_of m.vtu)" == "$expected" ]] || fail "another mesh after: $*"
  [[ ! -e m.vtu.work ]] || fail "the work folder stayed"
  if (($(sed -n 's/.*"windows_resumed": \([0-9]*\).*/\1/p' r.json) > 0)); then
    resumed=$((resumed + 1))
  fi
  [[ -z "$(find . -name '.*partial*')" ]] || rm -f .*partial*
  rm -f m.vtu r.json
}

stopped=0
resumed=0
chains=0
while ((stopped < kills)); do
  kinds=(noise voronoi tubes spheres)
  kind="${kinds[$(below 4)]}"
  edge=32
  [[ "$kind" == noise ]] && edge=20
  "$program" synth "$kind" --shape $((edge + $(below 16))),$edge,$((edge - 4)) --labels 12 \
    --seed "$(below 1000)" -o v.npy
  orders=(raster colour)
  starts=(coarse octree dense)
  windows=(8 12 16)
  settings=(--order "${orders[$(below 2)]}" --start "${starts[$(below 3)]}"
    --window "${windows[$(below 3)]}")
  least="$(min_memory --threads 8 "${settings[@]}")"
  start="$(date +%s%3N)"
  "$program" mesh v.npy -o whole.vtu --threads 1 "${settings[@]}" >log 2>&1 || fail "the whole run"
  milliseconds=$(($(date +%s%3N) - start))
  expected="$(digest_of whole.vtu)"
  draw() {
    choice=(--threads $((1 + $(below 8))) --save-every "0.0$(below 6)" --memory "$((least + $(below 3) * $(below 100)))MiB")
  }
  chains=$((chains + 1))
  for ((tries = 1 + $(below 4); tries > 0 && stopped < kills; --tries)); do
    signals=(KILL KILL KILL KILL KILL KILL TERM INT)
    draw
    attempt "${signals[$(below 8)]}" "${settings[@]}" "${choice[@]}"
    if [[ -e m.vtu && ! -e m.vtu.work ]]; then
      [[ "$(digest_of m.vtu)" == "$expected" ]] || fail "another mesh"
      rm -f m.vtu
    fi
  done
  draw
  finish "${settings[@]}" "${choice[@]}"
  rm -f whole.vtu v.npy
done
echo "kill_resume: $stopped runs stopped in $chains chains, $resumed chains resumed saved work;" \
  "every digest is that of the undisturbed run"
