// SPDX-License-Identifier: BSD-3-Clause
#include "io/tile_times.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include "io/place.h"
#include "io/read_file.h"

namespace tessera::io {
namespace {

enum Column : std::size_t { x, y, width, height, start_s, end_s };
constexpr std::array<std::string_view, 6> kColumnNames{"x", "y", "width", "height", "start_s", "end_s"};

/// Whole numbers up to here are exact in a double, and so are their sums and products of two.
constexpr double kMostPixels = 1U << 24U;

struct Field {
  std::string_view text;
  std::size_t column = 1;  ///< where it begins in its line
};

std::vector<Field> fields_of(std::string_view line) {
  std::vector<Field> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back({line.substr(begin, end - begin), begin + 1});
    if (end == line.size()) return fields;
    begin = end + 1;
  }
}

/// Goes through a file line by line.
class Lines {
 public:
  Lines(std::string_view text, const std::string& file) : rest_(text), place_{file, 0, 1} {}

  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    ++place_.line;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return true;
  }

  [[noreturn]] void refuse_here(std::size_t column, const std::string& problem) const {
    refuse({place_.file, place_.line, column}, problem);
  }

 private:
  std::string_view rest_;
  Place place_;
};

/// For each column that is used, its position in a line.
std::array<std::size_t, 6> positions_of(std::string_view header, const Lines& lines) {
  const std::vector<Field> names = fields_of(header);
  std::array<std::size_t, 6> positions{};
  for (std::size_t i = 0; i != positions.size(); ++i) {
    const auto found =
        std::find_if(names.begin(), names.end(), [&](const Field& name) { return name.text == kColumnNames[i]; });
    if (found == names.end()) {
      lines.refuse_here(1, "no column \"" + std::string(kColumnNames[i]) +
                               "\" (tile statistics begin with the names of their columns) use a file that "
                               "--tile-stats wrote");
    }
    positions[i] = static_cast<std::size_t>(found - names.begin());
  }
  return positions;
}

double number_in(const Field& field, const Lines& lines) {
  double number = 0;
  const char* const end = field.text.data() + field.text.size();
  const auto [stopped, error] = std::from_chars(field.text.data(), end, number);
  if (error != std::errc() || stopped != end || !std::isfinite(number)) {
    lines.refuse_here(field.column, in_quotes(field.text) + " is not a number");
  }
  return number;
}

std::uint32_t pixels_in(const Field& field, double least, const Lines& lines) {
  const double number = number_in(field, lines);
  if (number != std::floor(number) || number < least || number > kMostPixels) {
    lines.refuse_here(field.column, in_quotes(field.text) + " is not a number of pixels");
  }
  return static_cast<std::uint32_t>(number);
}

void require_rectangle(const std::vector<TileTime>& tiles, const std::string& file) {
  const std::size_t pixels =
      std::accumulate(tiles.begin(), tiles.end(), std::size_t{0},
                      [](std::size_t sum, const TileTime& tile) { return sum + tile.rect.pixels(); });
  if (pixels != bounds_of(tiles).pixels()) {
    refuse({file, 1, 1},
           "the tiles do not fill a rectangle (some are missing or there twice) use the file of a whole run");
  }
}

}  // namespace

std::vector<TileTime> parse_tile_times(std::string_view text, const std::string& file) {
  Lines lines(text, file);
  std::string_view line;
  if (!lines.next(line)) refuse({file, 1, 1}, "the file is empty");
  const std::size_t names = fields_of(line).size();
  const auto positions = positions_of(line, lines);

  std::vector<TileTime> tiles;
  while (lines.next(line)) {
    const std::vector<Field> fields = fields_of(line);
    if (fields.size() != names) {
      lines.refuse_here(1, std::to_string(fields.size()) + " values (there are " + std::to_string(names) + " columns)");
    }
    const auto field = [&](Column column) { return fields[positions[column]]; };
    TileTime& tile = tiles.emplace_back();
    tile.rect = {pixels_in(field(x), 0, lines), pixels_in(field(y), 0, lines), pixels_in(field(width), 1, lines),
                 pixels_in(field(height), 1, lines)};
    tile.seconds = number_in(field(end_s), lines) - number_in(field(start_s), lines);
    if (!(tile.seconds >= 0) || !std::isfinite(tile.seconds)) {
      lines.refuse_here(field(end_s).column, "the time from start_s to end_s is not a number >= 0");
    }
  }
  if (tiles.empty()) refuse({file, 1, 1}, "there are no tiles in the file");
  require_rectangle(tiles, file);
  return tiles;
}

std::vector<TileTime> read_tile_times(const std::filesystem::path& path) {
  return parse_tile_times(read_file(path), path.string());
}

render::Rect bounds_of(const std::vector<TileTime>& tiles) {
  constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t left = kFar, top = kFar, right = 0, bottom = 0;
  for (const TileTime& tile : tiles) {
    left = std::min(left, tile.rect.x);
    top = std::min(top, tile.rect.y);
    right = std::max(right, tile.rect.x + tile.rect.width);
    bottom = std::max(bottom, tile.rect.y + tile.rect.height);
  }
  return {left, top, right - left, bottom - top};
}

}  // namespace tessera::io
