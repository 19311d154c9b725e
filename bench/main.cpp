// SPDX-License-Identifier: BSD-3-Clause
// Main of every benchmark program: says first what was built, by what, and which kernel this machine would take.
#include <benchmark/benchmark.h>

#include "workload.h"

int main(int argc, char** argv) {
  benchmark::AddCustomContext("commit", TESSERA_COMMIT);
  benchmark::AddCustomContext("compiler", TESSERA_COMPILER);
  benchmark::AddCustomContext("kernel", tessera::bench::name_of(tessera::render::runnable({})));
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
