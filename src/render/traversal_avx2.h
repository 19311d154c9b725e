// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

#include "render/bvh.h"
#include "render/lanes_avx2.h"
#include "render/perpendicular_avx2.h"

#if defined(__x86_64__)

// Rays on their way through the tree, many at a time. Each step of a ray is a handful of vector instructions without a
// branch; steps of different rays are independent of each other, so the processor overlaps them.
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {

/// Rays in flight: enough that while one waits for memory, or for its own last step, others go on.
inline constexpr std::size_t kInFlight = 32;

/// A ray on its way through the tree.
template <class Search>
struct Traversal {
  Search search;
  TreeRay ray;
  float latest;         ///< of the search, in the tree's units
  SurfaceId from;       ///< never offered
  std::uint32_t size;   ///< of the stack
  unsigned far_octant;  ///< the lane where a node's farthest child should be; see place_by_octant in bvh_build.cpp
  std::size_t query;
  // Children put aside, where they are entered and which they are. Lanes beyond the last are written too.
  float entry[1 + Bvh::kStackSize + kTreeWidth];
  std::uint32_t child[1 + Bvh::kStackSize + kTreeWidth];

  /// Under everything on the stack; never superfluous.
  static constexpr std::uint32_t kEnd = ~std::uint32_t{0};

  template <class Queries>
  Traversal(const TreeSpace& space, const Queries& queries) noexcept
      : search(queries.search()), query(queries.number()) {
    set_tree_ray(space);
    latest = ray.t_of(search.latest());
    from = search.ray().from;
    size = 2;
    entry[0] = -std::numeric_limits<float>::infinity();
    child[0] = kEnd;
    entry[1] = 0;
    child[1] = 0;
  }

  /// As the constructor of TreeRay, on all axes at once.
  void set_tree_ray(const TreeSpace& space) noexcept {
    const TreeRay::Start start = TreeRay::start_of(space, search.ray(), search.inverse_length());
    const Double4 x = clamp(Double4::of(start.origin), TreeRay::kFarthest);
    const Double4 d = Double4::of(start.unit);
    const Double4 off = Double4::all(start.off);
    const auto rounding = [](Double4 p) {
      return p.size() * Double4::all(TreeSpace::kRounding) + Double4::all(TreeSpace::kFloor);
    };
    const Double4 high = clamp(x + off, TreeRay::kFarthest);
    const Double4 low = clamp(x - off, TreeRay::kFarthest);
    const Double4 up = high + rounding(high);
    const Double4 down = low - rounding(low);
    where_negative(d, down, up).store(ray.near_origin);
    where_negative(d, up, down).store(ray.far_origin);
    clamp(Double4::all(1) / d, TreeRay::kLargestInverse).store(ray.inverse);
    x.store(ray.origin);
    d.store(ray.direction);
    const LaneMask negative = negative_lanes(d);
    for (unsigned axis = 0; axis != 3; ++axis) ray.near_side[axis] = negative >> axis & 1;
    far_octant = 7 ^ (ray.near_side[0] << 2 | ray.near_side[1] << 1 | ray.near_side[2]);
    ray.set_scalars(space, start, search.inverse_length());
  }

  std::uint32_t next_child() noexcept {
    // Drop what lies behind the nearest surface found since it was put aside.
    if constexpr (Search::kCanShorten) {
      const float end = latest * TreeRay::kSlack;
      while (entry[size - 1] > end) --size;
    }
    return child[--size];
  }

  /// As meets_child of bvh.h, for all children.
  void enter(const TreeNode& node) noexcept {
    const auto near_at = [&](int axis) {
      const Float8 side = Float8::load(node.bounds[axis][ray.near_side[axis]]);
      return (side - Float8::all(ray.near_origin[axis])) * Float8::all(ray.inverse[axis]);
    };
    const auto far_at = [&](int axis) {
      const Float8 side = Float8::load(node.bounds[axis][1 - ray.near_side[axis]]);
      return (side - Float8::all(ray.far_origin[axis])) * Float8::all(ray.inverse[axis]);
    };
    const Float8 enter = max(max(near_at(0), near_at(1)), max(near_at(2), Float8::all(0)));
    const Float8 leave = min(min(far_at(0), far_at(1)), min(far_at(2), Float8::all(latest)));
    const LaneMask met = enter <= leave * Float8::all(TreeRay::kSlack);

    const Int8 lanes = lanes_in_order(met, far_octant);
    picked(enter, lanes).store(entry + size);
    picked(Int8::load(node.child), lanes).store(child + size);
    size += static_cast<std::uint32_t>(std::popcount(met));
  }

  /// As may_meet of bvh.h, for all spheres.
  LaneMask may_meet(const TreeLeaf& leaf) const noexcept {
    const auto [foot, square] = perpendicular(leaf, ray.origin, ray.direction);
    const Float8 reach = Float8::load(leaf.radius) + Float8::all(ray.sphere_error);
    const LaneMask met =
        (square <= reach * reach) & (Float8::all(0) <= foot + reach) & (foot - reach <= Float8::all(latest));
    return met & ~lanes_equal(Int8::load(leaf.id), static_cast<std::uint32_t>(from));
  }

  void offer(SurfaceId sphere) noexcept {
    if (search.offer(sphere)) size = 1;
    if constexpr (Search::kCanShorten) latest = ray.t_of(search.latest());
  }
};

/// Traces rays through a tree, many at a time.
template <class Search, class Queries>
class RayStream {
 public:
  RayStream(const Bvh& bvh, Queries& queries) noexcept
      : space_(bvh.space()), nodes_(bvh.nodes().data()), leaves_(bvh.leaves().data()), queries_(queries) {}

  /// Answers all queries. `queries` has find_next(), which goes on to the next that has to be traced if there is one,
  /// number() and search() of that, and answer(number, search).
  void run() noexcept {
    while (size_ != kInFlight && queries_.find_next()) {
      active_[size_] = static_cast<std::uint32_t>(size_);
      start(size_++);
    }
    while (size_ > 0) step();
  }

 private:
  /// A slot, and the node, leaf or sphere that its ray comes to.
  struct Steps {
    std::uint32_t slot[kInFlight * kTreeWidth + kTreeWidth];
    std::uint32_t target[kInFlight * kTreeWidth + kTreeWidth];
    std::size_t size = 0;

    /// Adds a step if it `is_one`, without a branch.
    void add_if(bool is_one, std::uint32_t from, std::uint32_t to) noexcept {
      slot[size] = from;
      target[size] = to;
      size += is_one;
    }
  };

  Traversal<Search>& traversal(std::size_t slot) noexcept {
    return *std::launder(reinterpret_cast<Traversal<Search>*>(storage_ + slot * sizeof(Traversal<Search>)));
  }

  void start(std::size_t slot) noexcept {
    new (storage_ + slot * sizeof(Traversal<Search>)) Traversal<Search>(space_, queries_);
  }

  /// Takes every ray one step on.
  void step() noexcept {
    Steps nodes;
    Steps leaves;
    std::size_t ended[kInFlight];
    std::size_t ends = 0;
    for (std::size_t i = 0; i != size_; ++i) {
      const std::uint32_t slot = active_[i];
      const std::uint32_t child = traversal(slot).next_child();
      const bool is_end = child == Traversal<Search>::kEnd;
      nodes.add_if(!TreeChild::is_leaf(child), slot, child);
      leaves.add_if(TreeChild::is_leaf(child) && !is_end, slot, TreeChild::index(child));
      ended[ends] = i;
      ends += is_end;
    }
    for (std::size_t i = 0; i != nodes.size; ++i) traversal(nodes.slot[i]).enter(nodes_[nodes.target[i]]);
    Steps offers;
    for (std::size_t i = 0; i != leaves.size; ++i) {
      const TreeLeaf& leaf = leaves_[leaves.target[i]];
      const LaneMask met = traversal(leaves.slot[i]).may_meet(leaf);
      Int8::all(leaves.slot[i]).store(offers.slot + offers.size);
      picked(Int8::load(leaf.id), lanes_in_order(met, 0)).store(offers.target + offers.size);
      offers.size += static_cast<std::size_t>(std::popcount(met));
    }
    for (std::size_t i = 0; i != offers.size; ++i) {
      traversal(offers.slot[i]).offer(static_cast<SurfaceId>(offers.target[i]));
    }
    // From the back, for the last takes the place of one that ends.
    while (ends > 0) end(ended[--ends]);
  }

  void end(std::size_t i) noexcept {
    const std::uint32_t slot = active_[i];
    Traversal<Search>& at = traversal(slot);
    queries_.answer(at.query, at.search);
    if (queries_.find_next()) {
      start(slot);
    } else {
      active_[i] = active_[--size_];
    }
  }

  TreeSpace space_;
  const TreeNode* nodes_;
  const TreeLeaf* leaves_;
  Queries& queries_;
  std::size_t size_ = 0;
  std::uint32_t active_[kInFlight];
  alignas(64) std::byte storage_[kInFlight * sizeof(Traversal<Search>)];
};

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#endif
