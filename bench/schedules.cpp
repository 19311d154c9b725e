// SPDX-License-Identifier: BSD-3-Clause
// Prints what each schedule reaches in simulation, on pictures of known costs and clusters of 2 to 1024 ranks: the part
// of all ranks' time that goes into rendering, rank 0 counted. The same input gives the same table on every machine.
#include <cstdio>
#include <cstdlib>

#include "app/schedule_simulation.h"

using namespace tessera;
using namespace tessera::app::test;
using scheduler::test::Spread;

namespace {

constexpr struct {
  Spread spread;
  const char* name;
} kSpreads[] = {{Spread::flake, "flake"}, {Spread::cloud, "cloud"}, {Spread::even, "even"}};

void print_row(const char* name, const CostField& field, std::uint32_t ranks) {
  const SimulatedRender render(field, ranks);
  const SimulatedRun known = render.by_known_costs();
  const auto tiled = [&](Policy policy) { return 100 * render.by_tiles({32, 32}, policy).efficiency; };
  std::printf("%-6s %5u %6u %9.1f  %6.1f %6.1f  %6.1f %6.1f %6.1f %6.1f  %6.1f  %6.1f %6.1f%% %8.3f ms\n", name,
              field.side(), ranks, render.work_ratio(), 100 * render.by_bands().efficiency,
              100 * render.by_rows().efficiency, tiled(Policy::self_scheduling), tiled(Policy::guided),
              tiled(Policy::factoring), tiled(Policy::trapezoid), 100 * render.by_itself().efficiency,
              100 * known.efficiency, 100 * known.imbalance, 1e3 * known.tail_s);
}

}  // namespace

int main(int argc, char** argv) {
  const double pixel_us = argc > 1 ? std::atof(argv[1]) : 0.6;
  if (!(pixel_us > 0)) {
    std::fprintf(stderr, "usage: bench_schedules [MICROSECONDS PER PIXEL, 0.6]\n");
    return 64;
  }
  std::printf("efficiency in %%, a mean pixel of %g us, 3 us of rank 0 a message, 1 us on the wire, slices of 0.1 ms\n",
              pixel_us);
  std::printf("chunked policies with tiles of 32x32; costs: cut to what an earlier run found; x = W / (P^2 3 us)\n\n");
  std::printf(
      "field   side  ranks         x   bands   rows    self guided  fact.  trap.    auto   costs  imbal.       tail\n");
  for (const auto& [spread, name] : kSpreads) {
    for (const std::uint32_t side : {512U, 1024U, 4096U, 16384U}) {
      const CostField field(spread, side, 1e-6 * pixel_us);
      // A picture of that size keeps few ranks busy for minutes, and simulating them takes as many seconds.
      for (std::uint32_t ranks = side < 16384 ? 2 : 256; ranks <= 1024; ranks *= ranks < 4 ? 2 : 4)
        print_row(name, field, ranks);
    }
  }
  return 0;
}
