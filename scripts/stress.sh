#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the stress matrix and prints it as a table: case, pass or FAIL, criterion, what was measured; then what other
# renderers make of some of its cases, where they are installed.
#   scripts/stress.sh [SCALE]      SCALE times as many rays in the cases that count decisions, and SCALE times as many
#                                  spheres in case 40 (default 1); see also ctest --preset release -L long
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh test
cmake --preset release >/dev/null
cmake --build --preset release --target test_stress tessera >/dev/null
table=$(mktemp)
trap 'rm -f "$table"' EXIT
export TESSERA_STRESS_TABLE=$table
status=0
TESSERA_STRESS_SCALE=${1:-1} build/release/tests/stress/test_stress --log_level=nothing --report_level=no || status=$?
python3 tests/stress/refusal_cases_test.py --tessera "$PWD/build/release/tessera" >/dev/null 2>&1 || status=$?
sort -n "$table" | awk -F'\t' '{ printf "%4s  %-4s  %s\n            %s\n", $1, $4, $2, $3 } $4 == "pass" { ++passed }
  END { printf "%d of %d cases pass\n", passed, NR }'
echo
scripts/stress_peers.py
exit $status
