#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the packages, builds and runs every test but the long ones.
#   scripts/test.sh [preset] [ctest arguments...]     preset: release (default), debug, asan
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${1:-release}
shift || true
scripts/install_packages.sh test
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset"
ctest --preset "$preset" -LE long "$@"
