#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the packages, builds a release and renders a few scenes with mpirun on all cores.
#   scripts/demo.sh [FOLDER]     pictures go there; default: out/demo
set -euo pipefail
cd "$(dirname "$0")/.."

out=${1:-out/demo}
scripts/install_packages.sh
cmake --preset demo >/dev/null
cmake --build --preset demo

# mpirun refuses root unless told that this is meant.
[ "$(id -u)" -ne 0 ] || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
cores=$(nproc)
mkdir -p "$out"

render() {  # scene name
  local log="$out/$2.log"
  mpirun -n "$cores" --oversubscribe build/demo/tessera render "$1" --tile-size 16 -o "$out/$2.png" 2>"$log" || {
    cat "$log" >&2
    exit 1
  }
  grep '^note:' "$log" || true
  printf '%-44s %s\n' "$out/$2.png" "$(grep '^load balance:' "$log")"
}

for scene in scenes/*.toml; do
  render "$scene" "$(basename "$scene" .toml)"
done

# Other people's scenes, where Debian's tachyon-doc package is at hand; slim systems leave its files out at install.
balls=$(scripts/tachyon_scenes.sh 2>/dev/null)/balls.dat || true
if [ -f "$balls" ]; then
  render "$balls" tachyon_balls
else
  echo "Tachyon's own scenes are not here (package tachyon-doc); drawn without them"
fi
echo "pictures are in $out"
