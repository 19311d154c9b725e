// SPDX-License-Identifier: BSD-3-Clause
#include "render/light_cells.h"

#include <algorithm>

namespace tessera::render {
namespace {

/// Rays that wait for a cell before it is made: it costs as much as some fifty through the tree.
constexpr std::uint16_t kRaysToMake = 12;
/// Rays to one light that are worth a root.
constexpr std::uint64_t kRaysToBegin = 1024;
/// Rays that cells of a width are judged by, and one in how many tries again what was judged useless.
constexpr std::uint64_t kRaysToJudge = 1024;
/// When of so many rays two in three were looked up in vain, some times as many are not looked up at all.
constexpr std::size_t kTrial = 4096;
constexpr std::size_t kAside = 8 * kTrial;

/// A cell is divided into 2^kDivisionBits by as many.
constexpr unsigned kDivisionBits = 2;
constexpr std::uint32_t kDivision = 1U << kDivisionBits;

}  // namespace

LightCells::LightCells(const Scene& scene, std::size_t light, std::size_t most_bytes)
    : scene_(scene), light_(light), most_bytes_(most_bytes) {
  if (scene.kernel() == Kernel::avx2) grid_ = LightGrid::of(scene.bvh().space(), scene.data().lights[light]);
}

void LightCells::occlusions(std::span<const RayInRegion> to_light, std::span<std::uint8_t> occluded) {
  rays_ += to_light.size();
  const bool has_root = !cells_.empty() || (rays_ >= kRaysToBegin && begin_root());
  if (!has_root || aside_ > 0) {
    aside_ -= std::min(aside_, to_light.size());
    return render::occlusions(scene_, to_light, light_, occluded);
  }
  look_up(to_light, occluded);
  looked_up_ += to_light.size();
  in_vain_ += others_.size();
  if (looked_up_ >= kTrial) {
    if (3 * in_vain_ > 2 * looked_up_) aside_ = kAside;
    looked_up_ = in_vain_ = 0;
  }
  answers_.resize(others_.size());
  render::occlusions(scene_, others_, light_, answers_);
  for (std::size_t i = 0; i != others_.size(); ++i) occluded[places_[i]] = answers_[i];
}

LightCells::Counts LightCells::counts() const noexcept {
  Counts counts;
  for (const Use& use : uses_) counts.decided += use.decided;
  counts.left = rays_ - counts.decided;
  for (const Cell& cell : cells_) {
    counts.made += cell.state != State::waiting;
    counts.divided += cell.state == State::divided;
  }
  return counts;
}

bool LightCells::begin_root() {
  if (!grid_) return false;
  // 64 x 64 cells, or 32 x 32 on each face of a cube.
  const unsigned bits = LightGrid::kBits - (grid_->faces() == 1 ? 6 : 5);
  const std::uint32_t side = LightGrid::kSquares >> bits;
  const std::size_t count = std::size_t{grid_->faces()} * side * side;
  if (count * sizeof(Cell) >= most_bytes_) {
    grid_.reset();
    return false;
  }
  Cell cell;
  cell.bits = static_cast<std::uint8_t>(bits);
  cells_.resize(count, cell);
  return true;
}

bool LightCells::are_useful(unsigned bits) const noexcept {
  const auto [tried, decided] = uses_[bits];
  return 2 * decided + kRaysToJudge >= tried || rays_ % kRaysToJudge == 0;
}

bool LightCells::has_room() const noexcept {
  return cells_.size() * sizeof(Cell) + leaves_.size() * sizeof(TreeLeaf) < most_bytes_;
}

std::uint32_t LightCells::cell_at(const LightGrid::Place& place) {
  const unsigned bits = cells_[0].bits;
  const std::uint32_t side = LightGrid::kSquares >> bits;
  std::uint32_t index = (place.face * side + (place.y >> bits)) * side + (place.x >> bits);
  while (cells_[index].state == State::divided) {
    const unsigned inner = cells_[cells_[index].first].bits;
    index = cells_[index].first + (place.y >> inner) % kDivision * kDivision + (place.x >> inner) % kDivision;
  }
  Cell& cell = cells_[index];
  if (cell.state == State::waiting) {
    if (cell.rays < kRaysToMake) ++cell.rays;
    if (cell.rays == kRaysToMake && are_useful(cell.bits) && has_room()) make(cell, place);
  }
  return cell.state == State::made ? index : kNone;
}

void LightCells::divide(std::uint32_t index) {
  if (cells_[index].bits < kDivisionBits || !has_room()) {
    cells_[index].state = State::hopeless;
    return;
  }
  Cell inner;
  inner.bits = static_cast<std::uint8_t>(cells_[index].bits - kDivisionBits);
  cells_[index].state = State::divided;
  cells_[index].first = static_cast<std::uint32_t>(cells_.size());
  cells_.resize(cells_.size() + kDivision * kDivision, inner);
}

}  // namespace tessera::render
