// SPDX-License-Identifier: BSD-3-Clause
#include "app/open_tiles.h"

#include <stdexcept>
#include <string>

#include "app/coverage.h"

namespace tessera::app {
namespace {

constexpr std::size_t kBits = 8;

std::size_t bytes_for(std::size_t tiles) {
  return (tiles + kBits - 1) / kBits;
}

}  // namespace

scheduler::Bytes mark_open(std::span<const render::Rect> tiles, const Coverage& coverage) {
  scheduler::Bytes marks(bytes_for(tiles.size()));
  for (std::size_t i = 0; i != tiles.size(); ++i) {
    if (!coverage.covers(tiles[i])) marks[i / kBits] |= std::byte{1} << (i % kBits);
  }
  return marks;
}

std::vector<render::Rect> open_tiles(std::vector<render::Rect> tiles, std::span<const std::byte> marks) {
  if (marks.empty()) return tiles;
  if (marks.size() != bytes_for(tiles.size())) {
    throw std::runtime_error("rank 0 marked tiles in " + std::to_string(marks.size()) + " bytes (there are " +
                             std::to_string(tiles.size()) + " tiles)");
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i != tiles.size(); ++i) {
    if ((marks[i / kBits] >> (i % kBits) & std::byte{1}) == std::byte{1}) tiles[kept++] = tiles[i];
  }
  tiles.resize(kept);
  return tiles;
}

}  // namespace tessera::app
