#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the stress matrix and prints it as a table: case, criterion, what was measured, pass or FAIL.
#   scripts/stress.sh [SCALE]      SCALE times as many rays in the cases that count decisions (default 1)
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh test
cmake --preset release >/dev/null
cmake --build --preset release --target test_stress >/dev/null
table=$(mktemp)
trap 'rm -f "$table"' EXIT
status=0
TESSERA_STRESS_SCALE=${1:-1} TESSERA_STRESS_TABLE=$table build/release/tests/stress/test_stress --log_level=nothing \
  --report_level=no || status=$?
sort -n "$table" | awk -F'\t' '{ printf "%4s  %-4s  %s\n            %s\n", $1, $4, $2, $3 } $4 == "pass" { ++passed }
  END { printf "%d of %d cases pass\n", passed, NR }'
exit $status
