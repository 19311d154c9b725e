// SPDX-License-Identifier: BSD-3-Clause
#include "render/bvh_build.h"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>

#include "render/huge_array.h"
#include "render/parallel_for.h"
#include "render/sah_split.h"

namespace tessera::render {
namespace {

constexpr std::size_t kLeafSize = kTreeWidth;
// From here on ranges are halved: 2^32 spheres in leaves of eight need ten more levels, which stays within kMaxDepth.
constexpr int kHalvingDepth = 20;
static_assert(kHalvingDepth + 10 < Bvh::kMaxDepth);

constexpr std::size_t kChunk = std::size_t{1} << 14;          ///< spheres that a thread prepares at a time
constexpr std::size_t kMostInSubtree = std::size_t{1} << 17;  ///< items of what one thread builds alone
constexpr std::size_t kFewToShare = std::size_t{1} << 14;     ///< items that threads do not split together

using Parts = std::array<Range, kTreeWidth>;

/// Puts parts on the high side of an axis into lanes with the bit of that axis, as well as that goes: x has bit 4,
/// y bit 2, z bit 1. So a ray that goes through the lanes in order of lane ^ octant meets near children first.
/// source:  Ylitie, Karras, Laine, Efficient incoherent ray traversal on GPUs through compressed wide BVHs (2017)
void place_by_octant(Parts& parts, const Bounds& box) noexcept {
  const Float4 middle = box.lo + box.hi;
  const auto place = [&](const Range& part, int axis) {
    return part.count() == 0 ? middle[axis] : part.box.lo[axis] + part.box.hi[axis];
  };
  for (std::size_t size = kTreeWidth, axis = 0; size > 1; size /= 2, ++axis) {
    for (std::size_t first = 0; first != kTreeWidth; first += size) {
      const auto begin = parts.begin() + static_cast<std::ptrdiff_t>(first);
      std::sort(begin, begin + static_cast<std::ptrdiff_t>(size), [&](const Range& a, const Range& b) {
        return place(a, static_cast<int>(axis)) < place(b, static_cast<int>(axis));
      });
    }
  }
}

/// The part with the largest surface, of equals that with the most items; at great depth that with the most items.
/// None where all fit into leaves.
Range* part_to_split(std::span<Range> parts, int depth) noexcept {
  const auto weight = [&](const Range& part) {
    return std::pair(depth < kHalvingDepth ? part.box.half_area() : 0, part.count());
  };
  Range* most = nullptr;
  for (Range& part : parts) {
    if (part.count() > kLeafSize && (most == nullptr || weight(part) > weight(*most))) most = &part;
  }
  return most;
}

/// Splits a range into up to eight; the others are empty.
template <class Split>
Parts parts_of(const Range& range, int depth, Split&& split) {
  Parts parts{range};
  std::size_t count = 1;
  while (count < kTreeWidth) {
    Range* const part = part_to_split(std::span(parts).first(count), depth);
    if (part == nullptr) break;
    const auto [left, right] = depth < kHalvingDepth ? split(*part) : halve(*part);
    *part = left;
    parts[count++] = right;
  }
  place_by_octant(parts, range.box);
  return parts;
}

TreeNode empty_node() noexcept {
  TreeNode node{};
  for (auto& axis : node.bounds) {
    std::fill(std::begin(axis[0]), std::end(axis[0]), std::numeric_limits<float>::infinity());
    std::fill(std::begin(axis[1]), std::end(axis[1]), -std::numeric_limits<float>::infinity());
  }
  return node;
}

TreeNode node_around(const Parts& parts) noexcept {
  TreeNode node = empty_node();
  for (std::size_t i = 0; i != kTreeWidth; ++i) {
    if (parts[i].count() == 0) continue;
    for (std::size_t axis = 0; axis != 3; ++axis) {
      node.bounds[axis][0][i] = parts[i].box.lo[axis];
      node.bounds[axis][1][i] = parts[i].box.hi[axis];
    }
  }
  return node;
}

TreeLeaf leaf_of(const Range& range, std::span<const Sphere> spheres, const TreeSpace& space) noexcept {
  TreeLeaf leaf = TreeLeaf::empty();
  for (std::size_t lane = 0; lane != range.count(); ++lane) {
    const std::uint32_t index = range.begin[lane].index();
    const Vec3 c = space.from_scene(spheres[index].center);
    for (int axis = 0; axis != 3; ++axis) leaf.center[axis][lane] = static_cast<float>(c[axis]);
    const double error = TreeRay::kSphereError * sum_of_sizes(c);
    leaf.radius[lane] = TreeSpace::up(spheres[index].radius * space.scale * (1 + 0x1p-20) + error);
    leaf.id[lane] = surface_id(index);
  }
  return leaf;
}

/// A point in the middle of most spheres: on each axis the median of some of the centres.
Vec3 median_center(std::span<const Sphere> spheres) {
  constexpr std::size_t kSamples = 4096;
  const std::size_t step = spheres.size() / kSamples + 1;
  const auto median = [&](int axis) {
    std::vector<double> samples;
    for (std::size_t i = 0; i < spheres.size(); i += step) {
      if (spheres[i].radius > 0) samples.push_back(spheres[i].center[axis]);
    }
    if (samples.empty()) return spheres.front().center[axis];
    const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
    std::nth_element(samples.begin(), middle, samples.end());
    return *middle;
  };
  return {median(0), median(1), median(2)};
}

/// What some spheres that can be hit need: how many they are, and their box.
struct Extent {
  std::size_t count = 0;
  Box box;
};

TreeSpace space_of(std::span<const Sphere> spheres, const Box& box) {
  TreeSpace space;
  if (box.is_empty()) return space;
  space.base = median_center(spheres);
  int exponent = 0;
  std::frexp(std::max(largest_component(box.lo - space.base), largest_component(box.hi - space.base)), &exponent);
  space.scale = std::ldexp(1.0, -exponent);
  const Vec3 lo = space.from_scene(box.lo);
  const Vec3 hi = space.from_scene(box.hi);
  space.middle = 0.5 * (lo + hi);
  space.extent = 0.5 * length(hi - lo) * (1 + 0x1p-20);
  return space;
}

}  // namespace

/// A subtree that is still to be built.
struct BvhBuild::Task {
  Range range;
  int depth;
};

BvhBuild::BvhBuild(std::span<const Sphere> spheres, unsigned threads) : spheres_(spheres), threads_(threads) {
  // Measure the spheres, chunk by chunk
  const std::size_t chunks = (spheres.size() + kChunk - 1) / kChunk;
  const auto chunk = [&](std::size_t i) {
    return spheres.subspan(i * kChunk, std::min(kChunk, spheres.size() - i * kChunk));
  };
  std::vector<Extent> extents(chunks);
  parallel_for(threads, chunks, [&](std::size_t i) {
    extents[i].box = hittable_bounds(chunk(i));
    extents[i].count =
        static_cast<std::size_t>(std::ranges::count_if(chunk(i), [](const Sphere& s) { return s.radius > 0; }));
  });
  Extent all;
  for (Extent& extent : extents) {
    all.box.include(extent.box);
    all.count += std::exchange(extent.count, all.count);  // from here on: those before
  }
  space_ = space_of(spheres, all.box);
  parts_.resize(1);
  if (all.count == 0) return;

  // Make items of them
  const auto items = huge_array<Item>(all.count);
  std::vector<Range> ranges(chunks);
  parallel_for(threads, chunks, [&](std::size_t i) {
    Item* at = items.get() + extents[i].count;
    for (const Sphere& sphere : chunk(i)) {
      if (sphere.radius == 0) continue;
      const Vec3 c = space_.from_scene(sphere.center);
      const double r = sphere.radius * space_.scale;
      const Vec3 reach{r, r, r};
      *at = Item(c - reach, c + reach, static_cast<std::size_t>(&sphere - spheres.data()));
      ranges[i].include(*at++);
    }
  });
  Range root{items.get(), items.get() + all.count};
  for (const Range& range : ranges) {
    root.box.include(range.box);
    root.centers.include(range.centers);
  }

  // The top together, then each subtree by one thread, large ones first
  std::vector<Task> tasks;
  if (root.count() > kMostInSubtree) {
    build_top(root, 0, tasks);
  } else {
    tasks.push_back({root, 0});
  }
  parts_.resize(1 + tasks.size());
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, std::greater<>{}, [&](std::size_t i) { return tasks[i].range.count(); });
  parallel_for(threads, tasks.size(), [&](std::size_t i) {
    Part& part = parts_[1 + order[i]];
    const Task& task = tasks[order[i]];
    part.leaves.reserve(task.range.count() / 4);
    part.nodes.reserve(task.range.count() / 24 + 1);
    const auto room = huge_array<Item>(task.range.count());
    build_subtree(task.range, task.depth, room.get(), part);
  });
  for (const Part& part : parts_) {
    node_count_ += part.nodes.size();
    leaf_count_ += part.leaves.size();
  }
}

std::uint32_t BvhBuild::build_top(const Range& range, int depth, std::vector<Task>& tasks) {
  const Parts parts = parts_of(range, depth, [&](const Range& part) {
    if (part.count() >= kFewToShare) return split_by_threads(part, threads_);
    return split(part, std::vector<Item>(part.count()).data());
  });
  auto& [nodes, leaves] = parts_[0];
  const auto index = static_cast<std::uint32_t>(nodes.size());
  nodes.push_back(node_around(parts));
  for (std::size_t i = 0; i != kTreeWidth; ++i) {
    if (parts[i].count() == 0) continue;
    std::uint32_t child = 0;
    if (parts[i].count() <= kLeafSize) {
      child = add_leaf(parts[i], parts_[0]);
    } else if (parts[i].count() > kMostInSubtree) {
      child = build_top(parts[i], depth + 1, tasks);
    } else {
      joints_.push_back({index, i});
      tasks.push_back({parts[i], depth + 1});
    }
    nodes[index].child[i] = child;
  }
  return index;
}

std::uint32_t BvhBuild::build_subtree(const Range& range, int depth, Item* room, Part& to) const {
  const Parts parts = parts_of(range, depth, [&](const Range& part) { return split(part, room); });
  const auto index = static_cast<std::uint32_t>(to.nodes.size());
  to.nodes.push_back(node_around(parts));
  // All leaves' spheres are on their way from memory before the first is needed
  for (const Range& part : parts) {
    if (part.count() > kLeafSize) continue;
    for (const Item* item = part.begin; item != part.end; ++item) __builtin_prefetch(&spheres_[item->index()]);
  }
  for (std::size_t i = 0; i != kTreeWidth; ++i) {
    if (parts[i].count() == 0) continue;
    const std::uint32_t child =
        parts[i].count() <= kLeafSize ? add_leaf(parts[i], to) : build_subtree(parts[i], depth + 1, room, to);
    to.nodes[index].child[i] = child;
  }
  return index;
}

std::uint32_t BvhBuild::add_leaf(const Range& range, Part& to) const {
  to.leaves.push_back(leaf_of(range, spheres_, space_));
  return TreeChild::kLeafBit | static_cast<std::uint32_t>(to.leaves.size() - 1);
}

void BvhBuild::move_to(std::span<TreeNode> nodes, std::span<TreeLeaf> leaves) {
  // Each part follows the one before
  struct Begin {
    std::size_t node = 0;
    std::size_t leaf = 0;
  };
  std::vector<Begin> begins{{}};
  for (const Part& part : parts_) {
    begins.push_back({begins.back().node + part.nodes.size(), begins.back().leaf + part.leaves.size()});
  }
  for (std::size_t i = 0; i != joints_.size(); ++i) {
    parts_[0].nodes[joints_[i].node].child[joints_[i].lane] = static_cast<std::uint32_t>(begins[1 + i].node);
  }
  parallel_for(threads_, parts_.size(), [&](std::size_t i) {
    const Part part = std::move(parts_[i]);
    const auto& [first_node, first_leaf] = begins[i];
    std::ranges::copy(part.leaves, leaves.begin() + static_cast<std::ptrdiff_t>(first_leaf));
    std::ranges::copy(part.nodes, nodes.begin() + static_cast<std::ptrdiff_t>(first_node));
    for (TreeNode& node : nodes.subspan(first_node, part.nodes.size())) {
      for (std::size_t lane = 0; lane != kTreeWidth; ++lane) {
        if (!(node.bounds[0][0][lane] <= node.bounds[0][1][lane])) continue;
        node.child[lane] += static_cast<std::uint32_t>(TreeChild::is_leaf(node.child[lane]) ? first_leaf : first_node);
      }
    }
  });
}

Bvh build_bvh(std::span<const Sphere> spheres, unsigned threads) {
  BvhBuild build(spheres, threads);
  const std::shared_ptr<TreeNode[]> nodes = huge_array<TreeNode>(build.node_count());
  const std::shared_ptr<TreeLeaf[]> leaves = huge_array<TreeLeaf>(build.leaf_count());
  const std::span all_nodes(nodes.get(), build.node_count());
  const std::span all_leaves(leaves.get(), build.leaf_count());
  build.move_to(all_nodes, all_leaves);
  return {build.space(), {nodes, all_nodes}, {leaves, all_leaves}};
}

}  // namespace tessera::render
