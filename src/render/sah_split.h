// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "render/bvh.h"

// Where a set of spheres is best cut in two: at one of a few planes across each axis, by the surface area heuristic.
namespace tessera::render {

/// x, y, z and a lane to spare: one register.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

/// A box in tree space.
struct Bounds {
  static constexpr float kInf = std::numeric_limits<float>::infinity();
  Float4 lo;
  Float4 hi;

  static Bounds empty() noexcept { return {Float4{} + kInf, Float4{} - kInf}; }
  void include(const Bounds& other) noexcept {
    lo = other.lo < lo ? other.lo : lo;
    hi = other.hi > hi ? other.hi : hi;
  }
  void include(Float4 point) noexcept { include({point, point}); }
  float half_area() const noexcept {
    const Float4 d = hi - lo;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
};

/// A sphere to be sorted into the tree. Its index keeps in the lane of its box that is to spare.
struct Item {
  Bounds box;  ///< rounded outward

  Item() = default;  // without a value: an array costs nothing before it is filled
  Item(const Vec3& lo, const Vec3& hi, std::size_t index) noexcept {
    const auto bits = static_cast<std::uint32_t>(index);
    box.lo = Float4{TreeSpace::down(lo.x), TreeSpace::down(lo.y), TreeSpace::down(lo.z), std::bit_cast<float>(bits)};
    box.hi = Float4{TreeSpace::up(hi.x), TreeSpace::up(hi.y), TreeSpace::up(hi.z), 0};
  }
  std::uint32_t index() const noexcept { return std::bit_cast<std::uint32_t>(static_cast<float>(box.lo[3])); }
  /// The lane to spare is 0.
  Float4 twice_center() const noexcept {
    return std::bit_cast<Float4>(std::bit_cast<Int4>(box.lo + box.hi) & Int4{-1, -1, -1, 0});
  }
};

/// Items of one subtree, side by side in memory.
struct Range {
  Item* begin = nullptr;
  Item* end = nullptr;
  Bounds box = Bounds::empty();
  Bounds centers = Bounds::empty();  ///< times two

  std::size_t count() const noexcept { return static_cast<std::size_t>(end - begin); }
  void include(const Item& item) noexcept {
    box.include(item.box);
    centers.include(item.twice_center());
  }
};

/// Both parts of a range that is cut where that promises the least traversal, or in the middle where no plane can cut
/// it. Reorders the items.
/// shapes:  room holds range.count() items, which become worthless
std::pair<Range, Range> split(const Range& range, Item* room) noexcept;

/// The same cut of a large range by several threads, with little room of their own. The order of the items depends on
/// nothing but that before.
std::pair<Range, Range> split_by_threads(const Range& range, unsigned threads);

/// Both halves of a range as it lies.
std::pair<Range, Range> halve(const Range& range) noexcept;

}  // namespace tessera::render
