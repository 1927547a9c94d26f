#!/usr/bin/env bash
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Two network namespaces as two hosts, with a slow link between them: the bytes of one process; and
# with the link cut, an end within a minute.  As root, with iproute2 and Open MPI.
#
#   tests/mpi/two_hosts.sh BUILD [RATE]     RATE of the link as tc has it, default 20mbit
set -euo pipefail

build="$(cd "${1:?the build folder}" && pwd)"
rate="${2:-20mbit}"
folder="$(mktemp -d)"
readonly here="mwmesh-a-$$" there="mwmesh-b-$$"

fail() {
  echo "two_hosts: FAILED: $*" >&2
  exit 1
}

clean_up() {
  ip netns delete "$here" 2>/dev/null || true
  ip netns delete "$there" 2>/dev/null || true
  rm -rf "$folder"
}

if ((EUID != 0)) || ! command -v ip >/dev/null || ! command -v mpirun >/dev/null; then
  echo "two_hosts: skipped: needs root, iproute2 and mpirun" >&2
  exit 77
fi
trap clean_up EXIT

ip netns add "$here" || {
  echo "two_hosts: skipped: no network namespaces here" >&2
  exit 77
}
ip netns add "$there"
ip link add veth0 netns "$here" type veth peer name veth0 netns "$there"
for end in "$here 1" "$there 2"; do
  read -r space number <<<"$end"
  ip -n "$space" address add "10.77.0.$number/24" dev veth0
  ip -n "$space" link set lo up
  ip -n "$space" link set veth0 up
  tc -n "$space" qdisc add dev veth0 root tbf rate "$rate" burst 64kb latency 400ms 2>/dev/null ||
    echo "two_hosts: no tbf here, the link is not slowed down" >&2
done

# mpirun asks this for a shell on a host.
cat >"$folder/agent" <<END
#!/bin/sh
shift
exec ip netns exec $there unshare --uts sh -c "hostname there; \$*"
END
chmod +x "$folder/agent"

export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

shared() {
  ip netns exec "$here" mpirun \
    --mca plm_rsh_agent "$folder/agent" --mca btl tcp,self --mca pml ob1 \
    --mca btl_tcp_if_include 10.77.0.0/24 --mca oob_tcp_if_include 10.77.0.0/24 \
    --bind-to none --host 10.77.0.1:2,10.77.0.2:2 -n 4 "$build/mwmesh-mpi" "$@"
}

processes() {
  { ip netns pids "$here"; ip netns pids "$there"; } | wc -l
}

cd "$folder"
"$build/mwmesh" synth voronoi --shape 96,96,128 --labels 90 --seed 3 -o v.npy >/dev/null
"$build/mwmesh" mesh v.npy -o alone.vtkhdf --certify off >/dev/null
SECONDS=0
shared mesh v.npy -o shared.vtkhdf --certify off >out 2>err || fail "$(cat err)"
cmp alone.vtkhdf shared.vtkhdf || fail "the file is another one"
echo "two_hosts: same bytes over $rate in $SECONDS s"

shared mesh v.npy -o cut.vtkhdf --certify off --save-every 0.5 >out 2>err &
run=$!
sleep 4
ip -n "$here" link set veth0 down
SECONDS=0
code=0
wait "$run" || code=$?
while (($(processes) > 0 && SECONDS < 90)); do sleep 0.2; done
(($(processes) == 0)) || fail "processes are left $SECONDS s after the cut"
((SECONDS <= 60)) || fail "it took $SECONDS s to end"
((code != 0)) || fail "exit code 0"
[[ ! -e cut.vtkhdf ]] || fail "there is a file"
echo "two_hosts: the cut ended all processes in $SECONDS s, exit code $code"
ip -n "$here" link set veth0 up
if [[ -e cut.vtkhdf.work/epochs ]]; then
  shared mesh v.npy -o cut.vtkhdf --certify off --resume >out 2>err || fail "$(cat err)"
  cmp alone.vtkhdf cut.vtkhdf || fail "the file after the cut is another one"
  echo "two_hosts: gone on to the same bytes"
fi
