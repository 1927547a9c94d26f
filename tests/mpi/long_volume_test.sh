#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Four processes, each with the labels of its own windows, write the file that one process writes.
#
#   tests/mpi/long_volume_test.sh MWMESH MWMESH_MPI [X,Y,Z]     default: 96,96,512
set -euo pipefail

mwmesh="$(realpath "$1")"
shared="$(realpath "$2")"
shape="${3:-96,96,512}"
if ! command -v mpirun >/dev/null; then
  echo "long_volume_test: no mpirun here"
  exit 77
fi
# Root may be all that there is, as in a container.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$mwmesh" synth spheres --shape "$shape" --labels 40 --seed 3 -o volume.npy
for order in raster colour; do
  "$mwmesh" mesh volume.npy --order "$order" --log-level off --progress none -o one.vtu
  mpirun --oversubscribe -n 4 "$shared" mesh volume.npy --order "$order" --log-level off \
    --progress none -o four.vtu
  cmp one.vtu four.vtu
  rm one.vtu four.vtu
done
