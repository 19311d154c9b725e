// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <variant>

#include "app/options.h"
#include "scheduler/plan.h"
#include "simulation/charged_transport.h"
#include "simulation/cluster.h"
#include "simulation/workload.h"

// What the command line of the simulator says, as data.
namespace tessera::simulation {

struct SimulationOptions {
  std::uint32_t ranks = 2;
  Network network{1e-6, 12.5e9};
  MessageCost master_cost{3e-6, 0};
  double master_slice_s = 1e-4;
  double worker_slice_s = 1e-3;

  std::optional<std::filesystem::path> costs;  ///< recorded tiles; without them, even work
  EvenWork even;
  std::optional<app::Size> resolution;  ///< of the picture, where it is not the recorded one's
  app::Size tile{32, 32};
  scheduler::Policy policy = scheduler::Policy::dynamic;
  scheduler::MasterRole master = scheduler::MasterRole::automatic;
  std::optional<unsigned> prefetch;
  bool costs_are_known = false;  ///< whether the scheduler is told what the tiles will cost

  std::optional<std::filesystem::path> tile_stats;  ///< "-" is stdout
};

/// The options, or the text that --help asks for.
/// throws:  app::UsageError
std::variant<SimulationOptions, app::TextRequest> parse_simulation(int argc, const char* const* argv);

}  // namespace tessera::simulation
