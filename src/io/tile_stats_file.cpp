// SPDX-License-Identifier: BSD-3-Clause
#include "io/tile_stats_file.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/place.h"
#include "io/read_file.h"

namespace tessera::io {
namespace {

constexpr std::array<std::string_view, 10> kColumns{"tile", "x",       "y",     "width", "height",
                                                    "rank", "start_s", "end_s", "rays",  "bytes"};

/// Fields of one line, each with its place.
class Fields {
 public:
  Fields(std::string_view line, Place place) : line_(line), place_(std::move(place)) {}

  std::string_view next() {
    if (ended_) refuse(place_, "the line ends too early (there is a field for each name in the first line)");
    const std::size_t end = line_.find(',');
    const std::string_view field = line_.substr(0, end);
    ended_ = end == std::string_view::npos;
    if (!ended_) line_.remove_prefix(end + 1);
    begin_ = place_.column;
    place_.column += field.size() + 1;
    return field;
  }

  template <class Number>
  Number next_number(std::string_view name) {
    const std::string_view field = next();
    Number value{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size()) {
      refuse_field(in_quotes(field) + " is no " + std::string(name));
    }
    return value;
  }

  bool has_ended() const noexcept { return ended_; }

  /// throws:  Error(bad_scene), always: about the field that was read last
  [[noreturn]] void refuse_field(const std::string& problem) const {
    Place field = place_;
    field.column = begin_;
    refuse(field, problem);
  }

 private:
  std::string_view line_;
  Place place_;
  std::size_t begin_ = 1;
  bool ended_ = false;
};

void check_header(Fields& fields) {
  for (const std::string_view name : kColumns) {
    if (const std::string_view word = fields.next(); word != name) {
      fields.refuse_field(in_quotes(word) + " stands where the column " + in_quotes(name) +
                          " belongs (is this a file of --tile-stats?)");
    }
  }
  if (!fields.has_ended()) fields.refuse_field("there are more columns than a file of --tile-stats has");
}

TileRow row_of(Fields& fields) {
  TileRow row;
  row.tile = fields.next_number<std::uint64_t>("tile number");
  row.x = fields.next_number<std::uint32_t>("position");
  row.y = fields.next_number<std::uint32_t>("position");
  constexpr std::uint32_t kEnd = std::numeric_limits<std::uint32_t>::max();
  row.width = fields.next_number<std::uint32_t>("width");
  if (row.width == 0 || row.width > kEnd - row.x) fields.refuse_field("the tile has no width or no room for it");
  row.height = fields.next_number<std::uint32_t>("height");
  if (row.height == 0 || row.height > kEnd - row.y) fields.refuse_field("the tile has no height or no room for it");
  row.rank = fields.next_number<std::uint32_t>("rank");
  row.start_s = fields.next_number<double>("time in seconds");
  row.end_s = fields.next_number<double>("time in seconds");
  if (!std::isfinite(row.end_s - row.start_s) || row.end_s < row.start_s) {
    fields.refuse_field("the tile ends before it begins");
  }
  row.rays = fields.next_number<std::uint64_t>("count of rays");
  row.bytes = fields.next_number<std::uint64_t>("count of bytes");
  if (!fields.has_ended()) fields.refuse_field("the line has more fields than the first one has names");
  return row;
}

}  // namespace

std::vector<TileRow> parse_tile_stats(std::string_view text, const std::string& file) {
  std::vector<TileRow> rows;
  Place place{file};
  for (; !text.empty(); ++place.line) {
    const std::size_t end = text.find('\n');
    Fields fields(text.substr(0, end), place);
    if (place.line == 1) {
      check_header(fields);
    } else {
      rows.push_back(row_of(fields));
    }
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  if (rows.empty()) refuse(place, "there are no tiles");
  return rows;
}

std::vector<TileRow> read_tile_stats(const std::filesystem::path& path) {
  return parse_tile_stats(read_file(path), path.string());
}

}  // namespace tessera::io
