// SPDX-License-Identifier: BSD-3-Clause
#include "render/sah_split.h"

#include <algorithm>
#include <array>
#include <vector>

#include "render/parallel_for.h"

namespace tessera::render {
namespace {

constexpr std::size_t kMaxBins = 16;
constexpr std::size_t kChunk = std::size_t{1} << 13;  ///< items that a thread takes at a time

/// Leaf tests that so many spheres cost.
float cost_of(std::size_t count) noexcept {
  return static_cast<float>((count + kTreeWidth - 1) / kTreeWidth);
}

/// Maps centres to bins, along all axes at once. An axis that no plane can cut has a single bin.
class Binning {
 public:
  explicit Binning(const Range& range) noexcept
      : bins_(std::min(kMaxBins, 4 + range.count() / 4)), origin_(range.centers.lo) {
    const Float4 extent = range.centers.hi - range.centers.lo;
    const Float4 scale = static_cast<float>(bins_) * (1 - 0x1p-20F) / (extent > 0 ? extent : Float4{} + 1);
    for (int axis = 0; axis != 3; ++axis) {
      can_split_[static_cast<std::size_t>(axis)] = extent[axis] > 0 && scale[axis] < std::numeric_limits<float>::max();
      scale_[axis] = can_split_[static_cast<std::size_t>(axis)] ? scale[axis] : 0;
    }
  }

  std::size_t bins() const noexcept { return bins_; }
  bool can_split(int axis) const noexcept { return can_split_[static_cast<std::size_t>(axis)]; }
  Int4 bins_of(const Item& item) const noexcept {
    return __builtin_convertvector((item.twice_center() - origin_) * scale_, Int4);
  }

 private:
  std::size_t bins_;
  Float4 origin_;
  Float4 scale_{};
  std::array<bool, 3> can_split_{};
};

/// What falls into each bin of each axis.
struct Histogram {
  std::array<std::array<Bounds, kMaxBins>, 3> box;
  std::array<std::array<std::uint32_t, kMaxBins>, 3> count;

  explicit Histogram(std::size_t bins) noexcept {
    for (std::size_t axis = 0; axis != 3; ++axis) {
      std::fill_n(box[axis].begin(), bins, Bounds::empty());
      std::fill_n(count[axis].begin(), bins, 0);
    }
  }
  void include(const Item* begin, const Item* end, const Binning& binning) noexcept {
    for (const Item* item = begin; item != end; ++item) {
      const Int4 bins = binning.bins_of(*item);
      for (int axis = 0; axis != 3; ++axis) {
        const auto bin = static_cast<std::size_t>(bins[axis]);
        box[static_cast<std::size_t>(axis)][bin].include(item->box);
        ++count[static_cast<std::size_t>(axis)][bin];
      }
    }
  }
  void include(const Histogram& other, std::size_t bins) noexcept {
    for (std::size_t axis = 0; axis != 3; ++axis) {
      for (std::size_t i = 0; i != bins; ++i) {
        box[axis][i].include(other.box[axis][i]);
        count[axis][i] += other.count[axis][i];
      }
    }
  }
};

/// A plane between two bins on one axis, and the leaf tests that are expected beyond it.
struct Plane {
  int axis = -1;
  int bin = 0;  ///< items in bins <= bin go left
  float cost = std::numeric_limits<float>::infinity();

  bool cuts() const noexcept { return axis >= 0; }
  bool has_left(Int4 bins) const noexcept { return bins[axis] <= bin; }
};

/// Sweeps the planes between bins: costs of the right sides first, then left sides against them.
void consider_planes(const Histogram& all, std::size_t bins, int axis, Plane& best) noexcept {
  const auto& box = all.box[static_cast<std::size_t>(axis)];
  const auto& count = all.count[static_cast<std::size_t>(axis)];
  std::array<float, kMaxBins> right_cost;
  Bounds right = Bounds::empty();
  std::size_t right_count = 0;
  for (std::size_t i = bins - 1; i > 0; --i) {
    right.include(box[i]);
    right_count += count[i];
    right_cost[i] = right_count == 0 ? 0 : right.half_area() * cost_of(right_count);
  }
  Bounds left = Bounds::empty();
  std::size_t left_count = 0;
  const std::size_t total = right_count + count[0];
  for (std::size_t i = 0; i + 1 < bins; ++i) {
    left.include(box[i]);
    left_count += count[i];
    if (left_count == 0 || left_count == total) continue;
    const float cost = left.half_area() * cost_of(left_count) + right_cost[i + 1];
    if (cost < best.cost) best = {axis, static_cast<int>(i), cost};
  }
}

Plane best_plane(const Histogram& histogram, const Binning& binning) noexcept {
  Plane best;
  for (int axis = 0; axis != 3; ++axis) {
    if (binning.can_split(axis)) consider_planes(histogram, binning.bins(), axis, best);
  }
  return best;
}

/// Gives both parts their boxes: what they hold is known bin by bin.
void set_boxes(Range& left, Range& right, const Histogram& histogram, std::size_t bins, const Plane& plane) noexcept {
  const auto& box = histogram.box[static_cast<std::size_t>(plane.axis)];
  for (std::size_t i = 0; i != bins; ++i) {
    (static_cast<int>(i) <= plane.bin ? left : right).box.include(box[i]);
  }
}

/// Where items go: the left ones to begin ... middle, the right ones to `right` and on.
struct Places {
  Item* left;
  Item* left_end;
  Item* right;
  Item* right_end;
};

/// Sorts items to the left and right without a branch that could be guessed wrong: each goes to both places, and one
/// of them moves on. `to.left` may be `begin`. Returns the bounds of both parts' centres.
std::array<Bounds, 2> sort_apart(const Item* begin, const Item* end, const Binning& binning, const Plane& plane,
                                 Places to) noexcept {
  const Float4 nowhere = Float4{} + Bounds::kInf;
  Bounds left = Bounds::empty();
  Bounds right = Bounds::empty();
  const auto sort = [&](const Item& item) {
    const Int4 side = binning.bins_of(item);
    const bool is_left = plane.has_left(side);
    const Int4 in_left = Int4{} - (is_left ? 1 : 0);
    const Float4 center = item.twice_center();
    left.include({in_left ? center : nowhere, in_left ? center : -nowhere});
    right.include({in_left ? nowhere : center, in_left ? -nowhere : center});
    return is_left;
  };
  const Item* at = begin;
  for (; to.left != to.left_end && to.right != to.right_end; ++at) {
    const Item item = *at;
    const bool is_left = sort(item);
    *to.left = item;
    *to.right = item;
    to.left += is_left ? 1 : 0;
    to.right += is_left ? 0 : 1;
  }
  // One part is complete: the rest is the other's
  Item* rest = to.left == to.left_end ? to.right : to.left;
  for (; at != end; ++at) {
    sort(*at);
    *rest++ = *at;
  }
  return {left, right};
}

}  // namespace

std::pair<Range, Range> split(const Range& range, Item* room) noexcept {
  const Binning binning(range);
  Histogram histogram(binning.bins());
  histogram.include(range.begin, range.end, binning);
  const Plane plane = best_plane(histogram, binning);
  if (!plane.cuts()) return halve(range);

  const auto& counts = histogram.count[static_cast<std::size_t>(plane.axis)];
  std::size_t left_count = 0;
  for (int i = 0; i <= plane.bin; ++i) left_count += counts[static_cast<std::size_t>(i)];
  Item* const middle = range.begin + left_count;
  const auto centers =
      sort_apart(range.begin, range.end, binning, plane, {range.begin, middle, room, room + (range.end - middle)});
  std::copy(room, room + (range.end - middle), middle);
  Range left{range.begin, middle, Bounds::empty(), centers[0]};
  Range right{middle, range.end, Bounds::empty(), centers[1]};
  set_boxes(left, right, histogram, binning.bins(), plane);
  return {left, right};
}

std::pair<Range, Range> split_by_threads(const Range& range, Item* to, unsigned threads) {
  struct Chunk {
    Item* begin;
    Item* end;
    Histogram histogram{0};
    Item* left_to = nullptr;
    Item* right_to = nullptr;
    std::array<Bounds, 2> centers{Bounds::empty(), Bounds::empty()};
  };
  std::vector<Chunk> chunks;
  for (Item* at = range.begin; at != range.end;) {
    Item* const end = at + std::min(kChunk, static_cast<std::size_t>(range.end - at));
    chunks.push_back({at, end});
    at = end;
  }

  const Binning binning(range);
  parallel_for(threads, chunks.size(), [&](std::size_t i) {
    chunks[i].histogram = Histogram(binning.bins());
    chunks[i].histogram.include(chunks[i].begin, chunks[i].end, binning);
  });
  Histogram histogram(binning.bins());
  for (const Chunk& chunk : chunks) histogram.include(chunk.histogram, binning.bins());
  const Plane plane = best_plane(histogram, binning);
  if (!plane.cuts()) {
    std::copy(range.begin, range.end, to);
    return halve({to, to + range.count(), range.box, range.centers});
  }

  // Each chunk has its place in both parts
  const auto left_count = [&](const Histogram& part) {
    const auto& counts = part.count[static_cast<std::size_t>(plane.axis)];
    std::size_t sum = 0;
    for (int i = 0; i <= plane.bin; ++i) sum += counts[static_cast<std::size_t>(i)];
    return sum;
  };
  Range left{to, to + left_count(histogram)};
  Range right{left.end, to + range.count()};
  Item* left_to = left.begin;
  Item* right_to = right.begin;
  for (Chunk& chunk : chunks) {
    const std::size_t lefts = left_count(chunk.histogram);
    chunk.left_to = left_to;
    chunk.right_to = right_to;
    left_to += lefts;
    right_to += static_cast<std::size_t>(chunk.end - chunk.begin) - lefts;
  }
  parallel_for(threads, chunks.size(), [&](std::size_t i) {
    Chunk& chunk = chunks[i];
    const auto count = static_cast<std::size_t>(chunk.end - chunk.begin);
    const std::size_t lefts = left_count(chunk.histogram);
    chunk.centers = sort_apart(chunk.begin, chunk.end, binning, plane,
                               {chunk.left_to, chunk.left_to + lefts, chunk.right_to, chunk.right_to + count - lefts});
  });
  for (const Chunk& chunk : chunks) {
    left.centers.include(chunk.centers[0]);
    right.centers.include(chunk.centers[1]);
  }
  set_boxes(left, right, histogram, binning.bins(), plane);
  return {left, right};
}

std::pair<Range, Range> halve(const Range& range) noexcept {
  Item* const middle = range.begin + range.count() / 2;
  Range left{range.begin, middle};
  Range right{middle, range.end};
  for (Range* part : {&left, &right}) {
    for (const Item* item = part->begin; item != part->end; ++item) part->include(*item);
  }
  return {left, right};
}

}  // namespace tessera::render
