// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// What a run reports for other programs: JSON about the whole, CSV about each tile. Scripts rely on these names.
namespace tessera::io {

/// The keys of the JSON object are the names of the members. Times are in seconds of wall clock.
struct Stats {
  struct Scene {
    std::uint64_t spheres = 0;
    std::uint64_t planes = 0;
    std::uint64_t lights = 0;
    std::uint64_t materials = 0;
  };
  struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t samples = 0;
    std::uint32_t max_bounces = 0;
  };
  struct Mpi {
    std::uint32_t size = 1;
    std::uint32_t nodes = 1;
    std::string library;
  };
  struct Schedule {
    std::string policy;
    std::uint32_t tile_width = 0;  ///< of the widest tile, as tile_height is of the highest
    std::uint32_t tile_height = 0;
    std::uint64_t tiles = 0;
    std::uint32_t prefetch = 0;  ///< tiles that a worker holds, 0: as the policy finds right
    std::string master;
    double prefetch_mean = 0;         ///< tiles that a worker really had and had not delivered, while it had any
    std::uint32_t prefetch_most = 0;  ///< the same at most
  };
  struct Memory {
    double bytes_per_sphere = 0;   ///< of spheres, materials and tree; 0 without spheres
    std::uint64_t node_bytes = 0;  ///< the same in bytes, all copies on rank 0's node
    std::uint64_t rank_bytes = 0;  ///< what rank 0 has in memory for itself besides, its program's code apart
  };
  struct Times {
    double read = 0;
    double broadcast = 0;
    double build = 0;
    double render = 0;
    double write = 0;
    double total = 0;
  };
  struct Rays {
    std::uint64_t primary = 0;
    std::uint64_t shadow = 0;
    std::uint64_t mirror = 0;
  };
  struct Rank {
    std::uint32_t rank = 0;
    std::string host;
    std::uint64_t tiles = 0;
    std::uint64_t pixels = 0;
    std::uint64_t rays = 0;
    double busy_s = 0;
    double wait_s = 0;
  };
  struct Balance {
    double imbalance = 0;     ///< max busy / mean busy - 1
    double load_balance = 0;  ///< mean busy / max busy
    double efficiency = 0;    ///< sum of busy / (ranks x makespan)
    double tail_s = 0;
    double graham_bound_s = 0;
    double makespan_s = 0;
  };
  struct Messages {
    std::uint64_t count = 0;
    std::uint64_t bytes = 0;
    double per_tile = 0;
    double bytes_per_tile = 0;
    double master_s_per_tile = 0;  ///< rank 0's time for a result that another rank sent
  };
  /// What went wrong between ranks and was made good.
  struct Faults {
    std::uint64_t silences = 0;            ///< times that a rank with tiles was not heard of for a lease
    std::uint64_t reissued = 0;            ///< tiles handed out again because of that, or because they arrived broken
    std::uint64_t damaged = 0;             ///< tiles that arrived broken
    std::uint64_t late = 0;                ///< tiles that another rank had delivered before
    std::uint64_t returned = 0;            ///< tiles that a rank gave back for an idle one
    double wasted_s = 0;                   ///< spent on late tiles
    std::vector<std::uint32_t> lost = {};  ///< ranks that did not come to the end
  };
  struct Resumed {
    std::uint64_t tiles = 0;   ///< not rendered, because the journal had all of their pixels
    std::uint64_t pixels = 0;  ///< of these tiles
    std::uint64_t rays = 0;    ///< traced by earlier runs for what is in the journal
  };
  struct Error {
    double largest = 0;             ///< bound on a linear channel's error, over all certified pixels
    std::uint64_t uncertified = 0;  ///< pixels with a decision that rounding might have flipped
  };

  std::uint32_t schema = 1;
  std::string version;
  std::string command;
  Scene scene;
  Image image;
  Mpi mpi;
  Schedule schedule;
  Memory memory;
  Times time_s;
  Rays rays;
  std::map<std::string, std::uint64_t> skipped;  ///< work-skipping technique: how often it saved work
  std::vector<Rank> ranks;
  Balance balance;
  Messages messages;
  Faults faults;
  std::optional<Resumed> resumed;  ///< left out where no journal was resumed; all other counts are of this run alone
  std::optional<Error> error;      ///< left out where it was not asked for
};

/// One JSON object, keys in alphabetical order, ending in a newline. A double that isn't finite becomes the string
/// "Infinity", "-Infinity" or "NaN", as JSON has no such number.
/// throws:  std::out_of_range for a count of 2^63 or more
std::string to_json(const Stats& stats);

/// A row of the tile statistics; start_s and end_s count from the beginning of the render phase.
struct TileRow {
  std::uint64_t tile = 0;
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t rank = 0;
  double start_s = 0;
  double end_s = 0;
  std::uint64_t rays = 0;
  std::uint64_t bytes = 0;
};

/// A header line and a line for each row, in the order given.
std::string tile_stats_csv(std::span<const TileRow> rows);

/// Writes text to a file, or to standard output if the path is "-".
/// throws:  Error(cannot_create / io_failure)
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace tessera::io
