// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "scheduler/transport.h"

// A cluster that is not there: SimGrid runs every rank in this process and keeps the time.
namespace tessera::simulation {

/// Nodes with one rank each around a switch that is never busy. A message of n bytes arrives after
/// latency + n / bandwidth, later where others share a node's cable, which carries both directions at once.
/// units:   seconds from rank to rank; bytes per second
struct Network {
  double latency_s = 0;
  double bandwidth = 0;
};

/// Runs `program` as each rank, with its way to the others, until the last one returns. They begin at the same moment
/// and take turns where they wait for messages or spend time; all memory is common. Once per process.
/// throws:  std::invalid_argument where there are no ranks or the network is none; what `program` throws ends the
///          process
void run_cluster(std::uint32_t ranks, const Network& network,
                 const std::function<void(scheduler::Transport&)>& program);

/// Lets time pass on the calling rank, as if it computed.
void spend(double seconds);

/// Simulated time since the cluster began.
std::uint64_t simulated_ns() noexcept;

}  // namespace tessera::simulation
