#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Three hosts on one machine: network namespaces on a bridge, each with a name of its own, and tessera-run across them
# over TCP. Checks the picture, kills and stops ranks, kills a host's daemon, and checks again. Needs root and iproute2;
# exits with 77 where a namespace cannot be made.
#   scripts/test_multihost.sh PROGRAM        the tessera to test, for example build/release/tessera
set -euo pipefail
tessera=$(realpath "${1:?which program to test, for example build/release/tessera}")
cd "$(dirname "$0")/.."

skip() {
  echo "skipped: $1"
  exit 77
}
command -v ip >/dev/null || skip "ip is missing (install iproute2)"
[ "$(id -u)" -eq 0 ] || skip "network namespaces need root"

folder=$(mktemp -d)
bridge=tessera0
subnet=10.231.77
hosts="1 2 3"
remove_hosts() {
  for host in $hosts; do ip netns del tessera-$host 2>/dev/null || true; done
  ip link del $bridge 2>/dev/null || true
}
trap 'remove_hosts; rm -rf "$folder"' EXIT
remove_hosts

# Lay the cable.
ip link add $bridge type bridge 2>/dev/null || skip "this system makes no bridges"
ip link set $bridge up
for host in $hosts; do
  ip netns add tessera-$host 2>/dev/null || skip "this system makes no network namespaces"
  ip link add veth$host type veth peer name eth0 netns tessera-$host
  ip link set veth$host master $bridge up
  ip -n tessera-$host address add $subnet.$host/24 dev eth0
  ip -n tessera-$host link set eth0 up
  ip -n tessera-$host link set lo up
done

# What mpirun starts its daemons with, instead of ssh.
cat >"$folder/on_host" <<'AGENT'
#!/usr/bin/env bash
host=tessera-${1##*.}
shift
exec ip netns exec "$host" unshare --uts bash -c "hostname $host; $*"
AGENT
chmod +x "$folder/on_host"

cat >"$folder/mpirun_on_hosts" <<LAUNCHER
#!/usr/bin/env bash
exec ip netns exec tessera-1 unshare --uts bash -c 'hostname tessera-1; exec mpirun "\$@"' mpirun \\
  --mca plm_rsh_agent $folder/on_host --mca btl tcp,self --mca btl_tcp_if_include $subnet.0/24 \\
  --mca oob_tcp_if_include $subnet.0/24 --host $subnet.1:1,$subnet.2:2,$subnet.3:1 "\$@"
LAUNCHER
chmod +x "$folder/mpirun_on_hosts"

python3 tests/app/multihost_test.py --tessera "$tessera" --mpirun "$folder/mpirun_on_hosts"
