// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/cluster.h"

#include <array>
#include <cmath>
#include <simgrid/s4u.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulation/simulated_transport.h"

namespace tessera::simulation {
namespace {

namespace s4u = simgrid::s4u;

constexpr double kFlopsPerSecond = 1e9;

// SimGrid's own rules for long cables and crossing messages are fitted to some cluster; here a message costs what
// Network says.
constexpr std::array kSettings{
    "network/model:CM02",       "network/TCP-gamma:0",        "network/crosstraffic:0",
    "network/latency-factor:1", "network/bandwidth-factor:1", "network/weight-S:0",
};

std::vector<s4u::Host*> make_nodes(std::uint32_t count, const Network& network) {
  auto* zone = s4u::create_star_zone("cluster");
  std::vector<s4u::Host*> nodes;
  for (std::uint32_t i = 0; i != count; ++i) {
    const std::string number = std::to_string(i);
    s4u::Host* node = zone->create_host("node" + number, kFlopsPerSecond)->seal();
    // On its way a message takes two cables, the sender's and the receiver's.
    auto* cable = zone->create_split_duplex_link("cable" + number, network.bandwidth);
    cable->set_latency(network.latency_s / 2)->seal();
    zone->add_route(node->get_netpoint(), nullptr, nullptr, nullptr,
                    {s4u::LinkInRoute(cable, s4u::LinkInRoute::Direction::UP)}, true);
    nodes.push_back(node);
  }
  zone->seal();
  return nodes;
}

}  // namespace

void run_cluster(std::uint32_t ranks, const Network& network,
                 const std::function<void(scheduler::Transport&)>& program) {
  if (ranks == 0) throw std::invalid_argument("a cluster needs ranks (there are none)");
  if (!(network.latency_s >= 0) || !(network.bandwidth > 0)) {
    throw std::invalid_argument("a network needs a latency >= 0 and a bandwidth > 0");
  }
  std::string name = "tessera_simulate";
  std::array<char*, 2> arguments{name.data(), nullptr};
  int count = 1;
  s4u::Engine engine(&count, arguments.data());
  xbt_log_control_set("root.thres:warning");
  for (const char* setting : kSettings) s4u::Engine::set_config(setting);

  const std::vector<s4u::Host*> nodes = make_nodes(ranks, network);
  for (std::uint32_t rank = 0; rank != ranks; ++rank) {
    s4u::Actor::create("rank" + std::to_string(rank), nodes[rank], [&program, rank, ranks] {
      SimulatedTransport transport(rank, ranks);
      program(transport);
    });
  }
  engine.run();
}

void spend(double seconds) {
  s4u::this_actor::execute(seconds * kFlopsPerSecond);
}

std::uint64_t simulated_ns() noexcept {
  return static_cast<std::uint64_t>(std::llround(s4u::Engine::get_clock() * 1e9));
}

}  // namespace tessera::simulation
