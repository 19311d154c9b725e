// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

#include "render/float_search_avx2.h"

#if defined(__x86_64__)

// Rays on their way through the tree, many at a time. Each step of a ray is a handful of vector instructions without a
// branch; steps of different rays are independent of each other, so the processor overlaps them.
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {

/// A ray, and where it is to go on in the tree.
class Traversal {
 public:
  /// Under everything on the stack; never superfluous.
  static constexpr std::uint32_t kEnd = ~std::uint32_t{0};

  /// requires: is_squarable(ray.direction)
  Traversal(const TreeSpace& space, const Ray& ray) noexcept {
    set_tree_ray(space, ray);
    size_ = 2;
    entry_[0] = -std::numeric_limits<float>::infinity();
    child_[0] = kEnd;
    entry_[1] = 0;
    child_[1] = 0;
  }

  const TreeRay& ray() const noexcept { return ray_; }

  float latest;  ///< of the search, in the tree's units

  /// Returns the child to go on with: kEnd where there is none.
  template <bool kCanShorten>
  std::uint32_t next_child() noexcept {
    // Drop what lies behind the nearest surface found since it was put aside.
    if constexpr (kCanShorten) {
      const float end = latest * TreeRay::kSlack;
      while (entry_[size_ - 1] > end) --size_;
    }
    return child_[--size_];
  }

  /// As meets_child of bvh.h, for all children.
  void enter(const TreeNode& node) noexcept {
    const auto near_at = [&](int axis) {
      const Float8 side = Float8::load(node.bounds[axis][ray_.near_side[axis]]);
      return (side - Float8::all(ray_.near_origin[axis])) * Float8::all(ray_.inverse[axis]);
    };
    const auto far_at = [&](int axis) {
      const Float8 side = Float8::load(node.bounds[axis][1 - ray_.near_side[axis]]);
      return (side - Float8::all(ray_.far_origin[axis])) * Float8::all(ray_.inverse[axis]);
    };
    const Float8 enter = max(max(near_at(0), near_at(1)), max(near_at(2), Float8::all(0)));
    const Float8 leave = min(min(far_at(0), far_at(1)), min(far_at(2), Float8::all(latest)));
    const LaneMask met = enter <= leave * Float8::all(TreeRay::kSlack);

    const Int8 lanes = lanes_in_order(met, far_octant_);
    picked(enter, lanes).store(entry_ + size_);
    picked(Int8::load(node.child), lanes).store(child_ + size_);
    size_ += static_cast<std::uint32_t>(std::popcount(met));
  }

  /// Leaves out whatever would come next.
  void end_if(bool is_over) noexcept { size_ = is_over ? 1 : size_; }

 private:
  /// As the constructor of TreeRay, on all axes at once.
  void set_tree_ray(const TreeSpace& space, const Ray& ray) noexcept {
    const double inverse_length = 1 / length(ray.direction);
    const TreeRay::Start start = TreeRay::start_of(space, ray, inverse_length);
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
    where_negative(d, down, up).store(ray_.near_origin);
    where_negative(d, up, down).store(ray_.far_origin);
    clamp(Double4::all(1) / d, TreeRay::kLargestInverse).store(ray_.inverse);
    x.store(ray_.origin);
    d.store(ray_.direction);
    const LaneMask negative = negative_lanes(d);
    for (unsigned axis = 0; axis != 3; ++axis) ray_.near_side[axis] = negative >> axis & 1;
    far_octant_ = 7 ^ (ray_.near_side[0] << 2 | ray_.near_side[1] << 1 | ray_.near_side[2]);
    ray_.set_scalars(space, start, inverse_length);
  }

  TreeRay ray_;
  std::uint32_t size_;   ///< of the stack
  unsigned far_octant_;  ///< the lane where a node's farthest child should be; see place_by_octant in bvh_build.cpp
  // Children put aside, where they are entered and which they are. Lanes beyond the last are written too.
  float entry_[1 + Bvh::kStackSize + kTreeWidth];
  std::uint32_t child_[1 + Bvh::kStackSize + kTreeWidth];
};

/// Traces rays through a tree, many at a time.
/// shapes:  Queries::Search is one of float_search_avx2.h
template <class Queries>
class RayStream {
 public:
  RayStream(const Bvh& bvh, Queries& queries) noexcept
      : space_(bvh.space()), nodes_(bvh.nodes().data()), leaves_(bvh.leaves().data()), queries_(queries) {}

  /// Answers all queries. `queries` has find_next(), which goes on to the next that has to be traced if there is one,
  /// number(), ray() and search() of that, and answer(number, search).
  void run() noexcept {
    while (size_ != kInFlight && queries_.find_next()) {
      active_[size_] = static_cast<std::uint32_t>(size_);
      start(size_++);
    }
    while (size_ > 0) step();
  }

 private:
  using Search = typename Queries::Search;

  /// Rays in flight: enough that while one waits for memory, or for its own last step, others go on.
  static constexpr std::size_t kInFlight = Candidates::kRays;

  /// A query on its way.
  struct Flight {
    Search search;
    std::size_t query;
    SurfaceId from;  ///< never a candidate
    Traversal traversal;

    Flight(const TreeSpace& space, const Queries& queries) noexcept
        : search(queries.search()), query(queries.number()), from(queries.ray().from), traversal(space, queries.ray()) {
      search.set_end(traversal.ray());
      traversal.latest = latest();
    }
    /// As far as the exact search knows.
    float latest() const noexcept { return traversal.ray().t_of(search.latest()); }
  };

  /// Slots, and what their rays come to.
  struct Steps {
    std::uint32_t slot[kInFlight];
    std::uint32_t target[kInFlight];
    std::size_t size = 0;

    /// Adds a step if it `is_one`, without a branch.
    void add_if(bool is_one, std::uint32_t from, std::uint32_t to) noexcept {
      slot[size] = from;
      target[size] = to;
      size += is_one;
    }
  };

  /// Bytes from one flight to the next: an odd number of cache lines, so that the same members of all are in different
  /// sets of the cache.
  static constexpr std::size_t kLine = 64;
  static constexpr std::size_t kStride = ((sizeof(Flight) + kLine - 1) / kLine | 1) * kLine;

  Flight& flight(std::size_t slot) noexcept {
    return *std::launder(reinterpret_cast<Flight*>(storage_ + slot * kStride));
  }

  void start(std::size_t slot) noexcept { new (storage_ + slot * kStride) Flight(space_, queries_); }

  /// Takes every ray one step on.
  void step() noexcept {
    Steps nodes;
    Steps leaves;
    std::size_t ended[kInFlight];
    std::size_t ends = 0;
    for (std::size_t i = 0; i != size_; ++i) {
      const std::uint32_t slot = active_[i];
      const std::uint32_t child = flight(slot).traversal.template next_child<Search::kCanShorten>();
      const bool is_end = child == Traversal::kEnd;
      nodes.add_if(!TreeChild::is_leaf(child), slot, child);
      leaves.add_if(TreeChild::is_leaf(child) && !is_end, slot, TreeChild::index(child));
      ended[ends] = i;
      ends += is_end;
    }
    for (std::size_t i = 0; i != nodes.size; ++i) {
      flight(nodes.slot[i]).traversal.enter(nodes_[nodes.target[i]]);
    }
    search_leaves(leaves);
    // From the back, for the last takes the place of one that ends.
    while (ends > 0) end(ended[--ends]);
  }

  void search_leaves(const Steps& leaves) noexcept {
    Candidates candidates;
    for (std::size_t i = 0; i != leaves.size; ++i) {
      const Flight& at = flight(leaves.slot[i]);
      candidates.template add<Search::kCanShorten>(leaves_[leaves.target[i]], leaves.slot[i], at.traversal.ray(),
                                                   at.from, at.traversal.latest);
    }
    candidates.finish();
    std::uint32_t unsure[kInFlight * kTreeWidth];
    std::size_t unsure_size = 0;
    for (std::uint32_t i = 0; i != candidates.size(); ++i) {
      Flight& of = flight(candidates.ray(i));
      unsure[unsure_size] = i;
      unsure_size += of.search.cannot_tell(candidates.sphere(i), candidates.bounds(i), of.traversal.latest);
      of.traversal.end_if(of.search.is_over());
    }
    for (std::size_t i = 0; i != unsure_size; ++i) {
      Flight& of = flight(candidates.ray(unsure[i]));
      of.search.offer(candidates.sphere(unsure[i]));
      of.traversal.latest = std::min(of.traversal.latest, of.latest());
      of.traversal.end_if(of.search.is_over());
    }
  }

  void end(std::size_t i) noexcept {
    const std::uint32_t slot = active_[i];
    Flight& at = flight(slot);
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
  alignas(kLine) std::byte storage_[kInFlight * kStride];
};

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#endif
