// SPDX-License-Identifier: BSD-3-Clause
#include "io/stats.h"

#include <toml++/toml.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "io/error.h"
#include "io/output_file.h"

namespace tessera::io {
namespace {

std::int64_t count(std::uint64_t n) {
  if (!std::in_range<std::int64_t>(n)) throw std::out_of_range("a count in the statistics is too large");
  return static_cast<std::int64_t>(n);
}

// The shortest text that reads back as the same double.
std::string shortest(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return error == std::errc{} ? std::string(text, end) : std::string("nan");
}

toml::table to_table(const Stats::Scene& scene) {
  return toml::table{{"spheres", count(scene.spheres)},
                     {"planes", count(scene.planes)},
                     {"lights", count(scene.lights)},
                     {"materials", count(scene.materials)}};
}

toml::table to_table(const Stats::Image& image) {
  return toml::table{
      {"width", image.width}, {"height", image.height}, {"samples", image.samples}, {"max_bounces", image.max_bounces}};
}

toml::table to_table(const Stats::Mpi& mpi) {
  return toml::table{{"size", mpi.size}, {"nodes", mpi.nodes}, {"library", mpi.library}};
}

toml::table to_table(const Stats::Schedule& schedule) {
  return toml::table{{"policy", schedule.policy},
                     {"tile_width", schedule.tile_width},
                     {"tile_height", schedule.tile_height},
                     {"tiles", count(schedule.tiles)},
                     {"prefetch", schedule.prefetch},
                     {"master", schedule.master},
                     {"prefetch_mean", schedule.prefetch_mean},
                     {"prefetch_most", schedule.prefetch_most}};
}

toml::table to_table(const Stats::Memory& memory) {
  return toml::table{{"bytes_per_sphere", memory.bytes_per_sphere},
                     {"node_bytes", count(memory.node_bytes)},
                     {"rank_bytes", count(memory.rank_bytes)}};
}

toml::table to_table(const Stats::Times& time) {
  return toml::table{{"read", time.read},     {"broadcast", time.broadcast}, {"build", time.build},
                     {"render", time.render}, {"write", time.write},         {"total", time.total}};
}

toml::table to_table(const Stats::Rays& rays) {
  return toml::table{{"primary", count(rays.primary)}, {"shadow", count(rays.shadow)}, {"mirror", count(rays.mirror)}};
}

toml::table to_table(const Stats::Rank& rank) {
  return toml::table{
      {"rank", rank.rank},        {"host", rank.host},     {"tiles", count(rank.tiles)}, {"pixels", count(rank.pixels)},
      {"rays", count(rank.rays)}, {"busy_s", rank.busy_s}, {"wait_s", rank.wait_s}};
}

toml::table to_table(const Stats::Balance& balance) {
  return toml::table{{"imbalance", balance.imbalance},           {"load_balance", balance.load_balance},
                     {"efficiency", balance.efficiency},         {"tail_s", balance.tail_s},
                     {"graham_bound_s", balance.graham_bound_s}, {"makespan_s", balance.makespan_s}};
}

toml::table to_table(const Stats::Messages& messages) {
  return toml::table{{"count", count(messages.count)},
                     {"bytes", count(messages.bytes)},
                     {"per_tile", messages.per_tile},
                     {"bytes_per_tile", messages.bytes_per_tile},
                     {"master_s_per_tile", messages.master_s_per_tile}};
}

toml::table to_table(const Stats::Faults& faults) {
  toml::array lost;
  for (const std::uint32_t rank : faults.lost) lost.push_back(rank);
  return toml::table{{"silences", count(faults.silences)},
                     {"reissued", count(faults.reissued)},
                     {"damaged", count(faults.damaged)},
                     {"late", count(faults.late)},
                     {"returned", count(faults.returned)},
                     {"wasted_s", faults.wasted_s},
                     {"lost", std::move(lost)}};
}

toml::table to_table(const Stats::Resumed& resumed) {
  return toml::table{{"tiles", count(resumed.tiles)}, {"pixels", count(resumed.pixels)}, {"rays", count(resumed.rays)}};
}

toml::table to_table(const Stats::Error& error) {
  return toml::table{{"largest", error.largest}, {"uncertified", count(error.uncertified)}};
}

}  // namespace

std::string to_json(const Stats& stats) {
  toml::table skipped;
  for (const auto& [technique, n] : stats.skipped) skipped.insert(technique, count(n));
  toml::array ranks;
  for (const Stats::Rank& rank : stats.ranks) ranks.push_back(to_table(rank));

  toml::table all{{"schema", stats.schema},
                  {"version", stats.version},
                  {"command", stats.command},
                  {"scene", to_table(stats.scene)},
                  {"image", to_table(stats.image)},
                  {"mpi", to_table(stats.mpi)},
                  {"schedule", to_table(stats.schedule)},
                  {"memory", to_table(stats.memory)},
                  {"time_s", to_table(stats.time_s)},
                  {"rays", to_table(stats.rays)},
                  {"skipped", std::move(skipped)},
                  {"ranks", std::move(ranks)},
                  {"balance", to_table(stats.balance)},
                  {"messages", to_table(stats.messages)},
                  {"faults", to_table(stats.faults)}};
  if (stats.resumed) all.insert("resumed", to_table(*stats.resumed));
  if (stats.error) all.insert("error", to_table(*stats.error));
  std::ostringstream json;
  json << toml::json_formatter(all) << "\n";
  return json.str();
}

std::string tile_stats_csv(std::span<const TileRow> rows) {
  std::string csv = "tile,x,y,width,height,rank,start_s,end_s,rays,bytes\n";
  for (const TileRow& row : rows) {
    for (const std::uint64_t n : {row.tile, std::uint64_t{row.x}, std::uint64_t{row.y}, std::uint64_t{row.width},
                                  std::uint64_t{row.height}, std::uint64_t{row.rank}}) {
      csv += std::to_string(n) + ",";
    }
    csv += shortest(row.start_s) + "," + shortest(row.end_s) + ",";
    csv += std::to_string(row.rays) + "," + std::to_string(row.bytes) + "\n";
  }
  return csv;
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  if (path == "-") {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
      throw Error(ErrorKind::io_failure, std::string("standard output: cannot write (") + std::strerror(errno) + ")");
    }
    return;
  }
  OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace tessera::io
