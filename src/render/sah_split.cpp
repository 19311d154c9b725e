// SPDX-License-Identifier: BSD-3-Clause
#include "render/sah_split.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
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

/// Puts the items that go left in front of `middle` and the others behind it, without a branch that could be guessed
/// wrong: each item goes to both places, and one of them moves on. Returns the bounds of both parts' centres.
/// shapes:  middle - begin items go left; room holds the others
std::array<Bounds, 2> sort_apart(Item* begin, Item* end, const Binning& binning, const Plane& plane, Item* middle,
                                 Item* room) noexcept {
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
  Item* next_left = begin;
  Item* next_right = room;
  Item* const room_end = room + (end - middle);
  const Item* at = begin;
  for (; next_left != middle && next_right != room_end; ++at) {
    const Item item = *at;
    const bool is_left = sort(item);
    *next_left = item;
    *next_right = item;
    next_left += is_left ? 1 : 0;
    next_right += is_left ? 0 : 1;
  }
  // One part is complete: the rest is the other's
  Item* rest = next_left == middle ? next_right : next_left;
  for (; at != end; ++at) {
    sort(*at);
    *rest++ = *at;
  }
  std::copy(room, room_end, middle);
  return {left, right};
}

std::size_t count_left(const Histogram& histogram, const Plane& plane) noexcept {
  const auto& counts = histogram.count[static_cast<std::size_t>(plane.axis)];
  return std::accumulate(counts.begin(), counts.begin() + plane.bin + 1, std::size_t{0});
}

/// Items that a thread takes at a time. Once they are sorted apart, the left ones come first.
struct Chunk {
  Item* begin;
  Item* end;
  Item* middle = nullptr;
  Histogram histogram{0};
  std::array<Bounds, 2> centers{Bounds::empty(), Bounds::empty()};
};

std::vector<Chunk> chunks_of(const Range& range) {
  std::vector<Chunk> chunks;
  for (Item* at = range.begin; at != range.end; at = chunks.back().end) {
    chunks.push_back({at, at + std::min(kChunk, static_cast<std::size_t>(range.end - at))});
  }
  return chunks;
}

/// Two runs of items that are to change places.
struct Exchange {
  Item* one;
  Item* other;
  std::size_t count;
};

/// What brings sorted chunks' left items before `middle` and their right ones behind it.
std::vector<Exchange> exchanges_of(std::span<const Chunk> chunks, Item* middle) {
  struct Run {
    Item* begin;
    Item* end;
  };
  std::vector<Run> rights;  // before the middle
  std::vector<Run> lefts;   // behind it: as many
  for (const Chunk& chunk : chunks) {
    if (chunk.middle < std::min(chunk.end, middle)) rights.push_back({chunk.middle, std::min(chunk.end, middle)});
    if (std::max(chunk.begin, middle) < chunk.middle) lefts.push_back({std::max(chunk.begin, middle), chunk.middle});
  }
  std::vector<Exchange> exchanges;
  for (auto right = rights.begin(), left = lefts.begin(); right != rights.end();) {
    const std::ptrdiff_t count = std::min(right->end - right->begin, left->end - left->begin);
    exchanges.push_back({right->begin, left->begin, static_cast<std::size_t>(count)});
    right->begin += count;
    left->begin += count;
    if (right->begin == right->end) ++right;
    if (left->begin == left->end) ++left;
  }
  return exchanges;
}

}  // namespace

std::pair<Range, Range> split(const Range& range, Item* room) noexcept {
  const Binning binning(range);
  Histogram histogram(binning.bins());
  histogram.include(range.begin, range.end, binning);
  const Plane plane = best_plane(histogram, binning);
  if (!plane.cuts()) return halve(range);

  Item* const middle = range.begin + count_left(histogram, plane);
  const auto centers = sort_apart(range.begin, range.end, binning, plane, middle, room);
  Range left{range.begin, middle, Bounds::empty(), centers[0]};
  Range right{middle, range.end, Bounds::empty(), centers[1]};
  set_boxes(left, right, histogram, binning.bins(), plane);
  return {left, right};
}

std::pair<Range, Range> split_by_threads(const Range& range, unsigned threads) {
  std::vector<Chunk> chunks = chunks_of(range);
  const Binning binning(range);
  parallel_for(threads, chunks.size(), [&](std::size_t i) {
    chunks[i].histogram = Histogram(binning.bins());
    chunks[i].histogram.include(chunks[i].begin, chunks[i].end, binning);
  });
  Histogram histogram(binning.bins());
  for (const Chunk& chunk : chunks) histogram.include(chunk.histogram, binning.bins());
  const Plane plane = best_plane(histogram, binning);
  if (!plane.cuts()) return halve(range);

  parallel_for(threads, chunks.size(), [&](std::size_t i) {
    static thread_local std::array<Item, kChunk> room;
    Chunk& chunk = chunks[i];
    chunk.middle = chunk.begin + count_left(chunk.histogram, plane);
    chunk.centers = sort_apart(chunk.begin, chunk.end, binning, plane, chunk.middle, room.data());
  });
  Range left{range.begin, range.begin + count_left(histogram, plane)};
  Range right{left.end, range.end};
  const std::vector<Exchange> exchanges = exchanges_of(chunks, left.end);
  parallel_for(threads, exchanges.size(), [&](std::size_t i) {
    const auto& [one, other, count] = exchanges[i];
    std::swap_ranges(one, one + count, other);
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
