#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the program in several ways and checks that all of them render the same bytes: other compilers, optimisation
# levels and instruction sets. Needs clang++ besides what scripts/install_packages.sh installs; takes some minutes.
#   scripts/compare_builds.sh [SCENE...]       default: the scenes of scenes/
set -euo pipefail
cd "$(dirname "$0")/.."

scenes=("$@")
[ ${#scenes[@]} -gt 0 ] || scenes=(scenes/*.toml)
declare -A flags=(
  [gcc-O3]="g++ -O3"
  [gcc-O1]="g++ -O1"
  [gcc-O3-v3]="g++ -O3 -march=x86-64-v3"
)
command -v clang++ >/dev/null && flags[clang-O3]="clang++ -O3" && flags[clang-O1]="clang++ -O1" ||
  echo "clang++ is not installed (apt-get install clang): its builds are left out"

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
failed=0
reference=gcc-O3
for name in $reference $(printf '%s\n' "${!flags[@]}" | grep -vx $reference | sort); do
  build=build/compare/$name
  read -r compiler options <<<"${flags[$name]}"
  cmake -S . -B "$build" -G Ninja -DTESSERA_BUILD_TESTS=OFF -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$options" >/dev/null
  cmake --build "$build" --target tessera >/dev/null
  mkdir "$out/$name"
  result="same bytes"
  for scene in "${scenes[@]}"; do
    picture=$(basename "${scene%.*}").pfm
    "$build/tessera" render "$scene" -q -r 320x180 -o "$out/$name/$picture"
    cmp -s "$out/$reference/$picture" "$out/$name/$picture" || { result="$scene DIFFERS"; failed=1; }
  done
  echo "$name: ${#scenes[@]} scenes, $result"
done
exit $failed
