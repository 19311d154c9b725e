#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what Tessera is built from on Debian 12, as root or through sudo. Does nothing where all of it is there.
#   scripts/install_packages.sh          to build and render
#   scripts/install_packages.sh test     to run the tests too
#   scripts/install_packages.sh bench    to build the benchmark programs too
#   scripts/install_packages.sh simulate to build and run the simulator of clusters too
#   scripts/install_packages.sh peers    to measure other ray tracers beside it (scripts/compare_peers.py)
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config      # the build
  libopenmpi-dev openmpi-bin            # messages between ranks, mpirun
  libpng-dev                            # pictures
  libcli11-dev                          # the command line
  libtomlplusplus-dev                   # scene files
  liblz4-dev                            # tiles packed for the way between nodes
  libgmp-dev                            # integers of any size, for exact decisions
  libxxhash-dev                         # checksums
)
if [ "${1:-}" = bench ]; then
  packages+=(libbenchmark-dev)          # benchmark programs
fi
if [ "${1:-}" = peers ]; then
  packages+=(
    libembree-dev tachyon povray        # other ray tracers
    python3-matplotlib                  # the chart, and its arrays
  )
fi
if [ "${1:-}" = simulate ]; then
  packages+=(
    libsimgrid-dev                      # ranks and networks that are not there
    libboost-test-dev python3           # the tests of the same build
    python3-matplotlib                  # the plot
  )
fi
if [ "${1:-}" = test ]; then
  packages+=(
    libboost-test-dev                   # unit tests
    python3                             # command line tests, comparison scripts
    iproute2                            # several hosts on one machine
    tachyon-doc                         # other people's scenes
  )
fi

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "install as root: apt-get install ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "installing: ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
