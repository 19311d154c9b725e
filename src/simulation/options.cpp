// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <string>
#include <vector>

#include "app/exit_code.h"
#include "io/suggest.h"

namespace tessera::simulation {
namespace {

using scheduler::MasterRole;
using scheduler::Policy;

/// "640x480", or "16" for a square.
app::Size size_of(const std::string& option, const std::string& text) {
  app::Size size;
  const char* const end = text.data() + text.size();
  auto read = std::from_chars(text.data(), end, size.width);
  size.height = size.width;
  if (read.ec == std::errc() && read.ptr != end && *read.ptr == 'x') {
    read = std::from_chars(read.ptr + 1, end, size.height);
  }
  if (read.ec != std::errc() || read.ptr != end || size.width == 0 || size.height == 0) {
    throw app::UsageError(option + ": \"" + text + "\" is not WIDTHxHEIGHT, for example 1280x720");
  }
  return size;
}

/// The value with this name.
template <class Value>
Value named(const std::string& option, const std::string& name, const std::vector<Value>& values) {
  std::vector<std::string> names;
  for (const Value value : values) {
    if (name == name_of(value)) return value;
    names.emplace_back(name_of(value));
  }
  throw app::UsageError(option + ": unknown value \"" + name + "\"" + io::did_you_mean(name, names));
}

void add_cluster_options(CLI::App& app, SimulationOptions& options) {
  const auto group = app.add_option_group("Cluster", "times in seconds");
  group->add_option("--ranks", options.ranks, "ranks, one a node [2]")->check(CLI::Range(1U, 1U << 20));
  group->add_option("--latency", options.network.latency_s, "from rank to rank [1e-6]")->check(CLI::NonNegativeNumber);
  group->add_option("--bandwidth", options.network.bandwidth, "bytes per second of a node's cable [12.5e9]")
      ->check(CLI::PositiveNumber);
  group->add_option("--master-cost", options.master_cost.per_message_s, "rank 0's own time for a message [3e-6]")
      ->check(CLI::NonNegativeNumber);
  group->add_option("--master-byte-cost", options.master_cost.per_byte_s, "and for each of its bytes [0]")
      ->check(CLI::NonNegativeNumber);
  group
      ->add_option("--master-slice", options.master_slice_s, "how long a rank 0 that renders lets messages wait [1e-4]")
      ->check(CLI::PositiveNumber);
  group
      ->add_option("--worker-slice", options.worker_slice_s,
                   "how long a worker that renders lets messages wait; less takes longer to simulate [1e-3]")
      ->check(CLI::PositiveNumber);
}

void add_work_options(CLI::App& app, SimulationOptions& options) {
  const auto group = app.add_option_group("Work", "recorded, or even");
  CLI::Option* const costs =
      group->add_option("--costs", options.costs, "what tiles took: a file of tessera render --tile-stats");
  const auto resolution = [&](const std::string& text) { options.resolution = size_of("--resolution", text); };
  group->add_option_function<std::string>("-r,--resolution", resolution, "of the picture [that of the work]")
      ->type_name("WxH");
  group->add_option("--tiles", options.even.tiles, "or this many tiles of 32x32 pixels")->excludes(costs);
  group->add_option("--tile-time", options.even.mean_s, "that take this long")->excludes(costs);
  group->add_option("--tile-spread", options.even.spread, "up to this share more or less, 0 ... 1 [0]")
      ->excludes(costs);
  group->add_option("--tile-bytes", options.even.bytes, "and deliver so many bytes [3088]")->excludes(costs);
}

void add_schedule_options(CLI::App& app, SimulationOptions& options) {
  const auto group = app.add_option_group("Schedule", "as for tessera render");
  const auto tile = [&](const std::string& text) { options.tile = size_of("--tile-size", text); };
  group->add_option_function<std::string>("--tile-size", tile, "tile side in pixels, or width and height [32]")
      ->type_name("N|WxH");
  const auto policy = [&](const std::string& name) {
    options.policy = named<Policy>(
        "--schedule", name,
        {Policy::dynamic, Policy::static_bands, Policy::cyclic_rows, Policy::self_scheduling, Policy::guided});
  };
  group->add_option_function<std::string>("--schedule", policy, "who renders which tiles [dynamic]");
  const auto role = [&](const std::string& name) {
    options.master =
        named<MasterRole>("--master", name, {MasterRole::automatic, MasterRole::dedicated, MasterRole::rendering});
  };
  group->add_option_function<std::string>("--master", role, "whether rank 0 renders too [auto]");
  const auto prefetch = [&](unsigned tasks) { options.prefetch = tasks; };
  group->add_option_function<unsigned>("--prefetch", prefetch, "tiles that a worker holds");
  group->add_flag("--known-costs", options.costs_are_known, "tell the scheduler beforehand what the tiles will take");
}

}  // namespace

std::variant<SimulationOptions, app::TextRequest> parse_simulation(int argc, const char* const* argv) {
  SimulationOptions options;
  CLI::App app{"Simulates how tessera's ranks share work on a cluster. Prints the statistics of the run as JSON.",
               "tessera_simulate"};
  app.get_formatter()->column_width(30);
  add_cluster_options(app, options);
  add_work_options(app, options);
  add_schedule_options(app, options);
  app.add_option("--tile-stats", options.tile_stats, "write each tile's rank and simulated times as CSV")
      ->type_name("FILE");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return app::TextRequest{app.help()};
  } catch (const CLI::ParseError& error) {
    throw app::UsageError(error.what());
  }
  if (!options.costs && options.even.tiles == 0) {
    throw app::UsageError("there is no work: --costs FILE, or --tiles N --tile-time SECONDS");
  }
  return options;
}

}  // namespace tessera::simulation
