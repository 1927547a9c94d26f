#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# A batch job of SLURM that meshes a volume on several nodes, one process a node.
#   sbatch --nodes 16 configs/slurm.sh VOLUME OUT.vtkhdf [OPTION OF mwmesh mesh...]
# The work folder is beside the output unless MESH_WORKDIR names another; all nodes must see both.
# Before the time is up the job is told, saves, ends, and is queued again; it then goes on from
# there, MESH_RESTARTS times at most (20).  MESH_PROGRAM names mwmesh-mpi where it is not
# installed; MESH_LAUNCHER=mpirun is for machines whose srun starts no MPI.  (MW_... would be
# options of the program.)
#SBATCH --job-name=mwmesh
#SBATCH --nodes=4
#SBATCH --ntasks-per-node=1
#SBATCH --exclusive
#SBATCH --mem=0
#SBATCH --time=12:00:00
#SBATCH --signal=B:USR1@300
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=mwmesh-%j.log
set -euo pipefail

die() {
  echo "slurm: $*" >&2
  exit 2
}

# What a process may use of its node's memory: nine tenths, the rest is for the system and MPI.
node_memory() {
  if [[ "${SLURM_MEM_PER_NODE:-0}" -gt 0 ]]; then
    echo "$((SLURM_MEM_PER_NODE * 9 / 10))M"
  else
    awk '/^MemTotal:/ { print int($2 * 0.9 / 1024) "M" }' /proc/meminfo
  fi
}

cores() {
  echo "${SLURM_CPUS_ON_NODE:-$(nproc)}"
}

# One process a node, with all cores of it.
launch() {
  local cores
  cores="$(cores)"
  if [[ "${MESH_LAUNCHER:-srun}" == mpirun ]]; then
    exec mpirun --map-by "ppr:1:node:PE=$cores" "$@"
  fi
  exec srun --ntasks-per-node=1 --cpus-per-task="$cores" --kill-on-bad-exit=1 "$@"
}

# Asks for an epoch; the program ends with 75 when it counts.
warned=0
warn() {
  warned=1
  [[ -n "${job:-}" ]] && kill -USR1 "$job" 2>/dev/null
  return 0
}

# Waits on although signals end a wait early.
wait_for() {
  local code=0
  while true; do
    code=0
    wait "$1" || code=$?
    kill -0 "$1" 2>/dev/null || return "$code"
  done
}

# Whether another attempt may come further.  75: interrupted, saved work is there; 137: killed, as
# by a node that failed; whatever came of a warning.  Others would fail again.
may_go_on() {
  [[ -s "$workdir/epochs" ]] || return 1
  ((warned)) || [[ "$1" == 75 || "$1" == 137 || "$1" == 143 ]]
}

main() {
  (($# >= 2)) || die "give VOLUME and OUT.vtkhdf"
  [[ -n "${SLURM_JOB_ID:-}" ]] || die "start it by sbatch"
  local volume="$1" output="$2" code=0 resume=() work=()
  shift 2
  workdir="${MESH_WORKDIR:-$output.work}"
  [[ -s "$workdir/epochs" ]] && resume=(--resume)
  # What --keep or --from names has all the work, and the program then refuses a work folder.
  [[ " $*" == *" --keep"[\ =]* || " $*" == *" --from"[\ =]* ]] || work=(--workdir "$workdir")
  trap warn USR1 TERM
  launch "${MESH_PROGRAM:-mwmesh-mpi}" mesh "$volume" -o "$output" "${work[@]}" \
    --memory "$(node_memory)" --threads "$(cores)" "${resume[@]}" --progress none \
    --report "$output.json" "$@" &
  job=$!
  wait_for "$job" || code=$?
  ((code == 0)) && return 0
  if may_go_on "$code" && ((${SLURM_RESTART_COUNT:-0} < ${MESH_RESTARTS:-20})); then
    echo "slurm: exit code $code, queued again to go on from $workdir" >&2
    scontrol requeue "$SLURM_JOB_ID"
  fi
  return "$code"
}

main "$@"
