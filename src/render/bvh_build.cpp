// SPDX-License-Identifier: BSD-3-Clause
#include "render/bvh_build.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace tessera::render {
namespace {

constexpr std::size_t kMaxBins = 16;
constexpr std::size_t kLeafSize = kTreeWidth;
// From here on ranges are halved: 2^32 spheres in leaves of eight need ten more levels, which stays within kMaxDepth.
constexpr int kHalvingDepth = 20;
static_assert(kHalvingDepth + 10 < Bvh::kMaxDepth);

/// x, y, z and a lane to spare: one register.
using Float4 = float __attribute__((vector_size(16)));

Float4 smaller(Float4 a, Float4 b) noexcept {
  return a < b ? a : b;
}
Float4 larger(Float4 a, Float4 b) noexcept {
  return a > b ? a : b;
}

/// A box in tree space.
struct Bounds {
  static constexpr float kInf = std::numeric_limits<float>::infinity();
  Float4 lo{kInf, kInf, kInf, kInf};
  Float4 hi{-kInf, -kInf, -kInf, -kInf};

  void include(const Bounds& other) noexcept {
    lo = smaller(lo, other.lo);
    hi = larger(hi, other.hi);
  }
  float half_area() const noexcept {
    const Float4 d = hi - lo;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
  }
};

/// A sphere to be sorted into the tree. Its index keeps in the lane of its box that is to spare.
struct Item {
  Bounds box;  ///< rounded outward

  Item(const Vec3& lo, const Vec3& hi, std::size_t index) noexcept {
    const auto bits = static_cast<std::uint32_t>(index);
    box.lo = Float4{TreeSpace::down(lo.x), TreeSpace::down(lo.y), TreeSpace::down(lo.z), std::bit_cast<float>(bits)};
    box.hi = Float4{TreeSpace::up(hi.x), TreeSpace::up(hi.y), TreeSpace::up(hi.z), 0};
  }
  std::uint32_t index() const noexcept { return std::bit_cast<std::uint32_t>(static_cast<float>(box.lo[3])); }
  Float4 twice_center() const noexcept { return box.lo + box.hi; }
};

/// Items of one subtree.
struct Range {
  std::size_t begin = 0;
  std::size_t end = 0;
  Bounds box;
  Bounds centers;  ///< times two

  std::size_t count() const noexcept { return end - begin; }
  void include(const Item& item) noexcept {
    box.include(item.box);
    const Float4 center = item.twice_center();
    centers.include({center, center});
  }
};

/// Leaf tests that so many spheres cost.
float cost_of(std::size_t count) noexcept {
  return static_cast<float>((count + kLeafSize - 1) / kLeafSize);
}

struct Bin {
  Bounds box;
  std::size_t count = 0;
};
using Bins = std::array<Bin, kMaxBins>;

/// Maps centres to bins, along all axes at once.
class Binning {
 public:
  explicit Binning(const Range& range) noexcept
      : bins_(std::min(kMaxBins, 4 + range.count() / 4)), origin_(range.centers.lo) {
    scale_ = static_cast<float>(bins_) * (1 - 0x1p-20F) / (range.centers.hi - range.centers.lo);
  }

  std::size_t bins() const noexcept { return bins_; }
  bool can_split(int axis) const noexcept {
    return scale_[axis] > 0 && scale_[axis] < std::numeric_limits<float>::max();
  }
  std::size_t bin_of(const Item& item, int axis) const noexcept {
    return static_cast<std::size_t>((item.twice_center()[axis] - origin_[axis]) * scale_[axis]);
  }

 private:
  std::size_t bins_;
  Float4 origin_;
  Float4 scale_;
};

/// A plane between two bins on one axis, and the leaf tests that are expected beyond it.
struct Split {
  int axis = -1;
  std::size_t bin = 0;  ///< items in bins <= bin go left
  float cost = std::numeric_limits<float>::infinity();
};

/// Sweeps the planes between bins: costs of the right sides first, then left sides against them.
void consider_planes(const Bins& bins, std::size_t count, int axis, Split& best) noexcept {
  std::array<float, kMaxBins> right_cost{};
  Bin right;
  for (std::size_t i = count - 1; i > 0; --i) {
    right.box.include(bins[i].box);
    right.count += bins[i].count;
    right_cost[i] = right.count == 0 ? 0 : right.box.half_area() * cost_of(right.count);
  }
  Bin left;
  const std::size_t total = right.count + bins[0].count;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    left.box.include(bins[i].box);
    left.count += bins[i].count;
    if (left.count == 0 || left.count == total) continue;
    const float cost = left.box.half_area() * cost_of(left.count) + right_cost[i + 1];
    if (cost < best.cost) best = {axis, i, cost};
  }
}

class Builder {
 public:
  Builder(std::span<const Sphere> spheres, const TreeSpace& space) : spheres_(spheres), space_(space) {
    items_.reserve(spheres.size());
    Range all;
    for (std::size_t i = 0; i != spheres.size(); ++i) {
      if (spheres[i].radius == 0) continue;
      items_.push_back(item_of(i));
      all.include(items_.back());
    }
    all.end = items_.size();
    if (items_.empty()) return;
    leaves_.reserve(items_.size() / 4);
    nodes_.reserve(items_.size() / 24 + 1);
    build_node(all, 0);
  }

  Bvh finish() && {
    nodes_.shrink_to_fit();
    leaves_.shrink_to_fit();
    return {space_, std::move(nodes_), std::move(leaves_)};
  }

 private:
  Item item_of(std::size_t index) const noexcept {
    const Sphere& sphere = spheres_[index];
    const Vec3 c = space_.from_scene(sphere.center);
    const double r = sphere.radius * space_.scale;
    const Vec3 reach{r, r, r};
    return {c - reach, c + reach, index};
  }

  std::uint32_t build_node(const Range& range, int depth) {
    std::array<Range, kTreeWidth> parts{range};
    std::size_t count = 1;
    while (count < kTreeWidth) {
      Range* const part = part_to_split(std::span(parts).first(count), depth);
      if (part == nullptr) break;
      const auto [left, right] = split(*part, depth);
      *part = left;
      parts[count++] = right;
    }

    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(empty_node());
    place_by_octant(parts, range.box);
    for (std::size_t i = 0; i != kTreeWidth; ++i) {
      if (parts[i].count() == 0) continue;
      const std::uint32_t child = parts[i].count() <= kLeafSize ? add_leaf(parts[i]) : build_node(parts[i], depth + 1);
      nodes_[index].child[i] = child;
      for (std::size_t axis = 0; axis != 3; ++axis) {
        nodes_[index].bounds[axis][0][i] = parts[i].box.lo[axis];
        nodes_[index].bounds[axis][1][i] = parts[i].box.hi[axis];
      }
    }
    return index;
  }

  /// Puts parts on the high side of an axis into lanes with the bit of that axis, as well as that goes: x has bit 4,
  /// y bit 2, z bit 1. So a ray that goes through the lanes in order of lane ^ octant meets near children first.
  /// source:  Ylitie, Karras, Laine, Efficient incoherent ray traversal on GPUs through compressed wide BVHs (2017)
  static void place_by_octant(std::array<Range, kTreeWidth>& parts, const Bounds& box) noexcept {
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
  static Range* part_to_split(std::span<Range> parts, int depth) noexcept {
    const auto weight = [&](const Range& part) {
      return std::pair(depth < kHalvingDepth ? part.box.half_area() : 0, part.count());
    };
    Range* most = nullptr;
    for (Range& part : parts) {
      if (part.count() > kLeafSize && (most == nullptr || weight(part) > weight(*most))) most = &part;
    }
    return most;
  }

  std::pair<Range, Range> split(const Range& range, int depth) {
    if (depth < kHalvingDepth) {
      const Binning binning(range);
      const Split best = best_split(range, binning);
      if (best.axis >= 0) return split_at(range, binning, best);
    }
    const std::size_t middle = range.begin + range.count() / 2;
    return {range_of(range.begin, middle), range_of(middle, range.end)};
  }

  Split best_split(const Range& range, const Binning& binning) const noexcept {
    std::array<Bins, 3> bins{};
    for (std::size_t i = range.begin; i != range.end; ++i) {
      for (int axis = 0; axis != 3; ++axis) {
        if (!binning.can_split(axis)) continue;
        Bin& bin = bins[static_cast<std::size_t>(axis)][binning.bin_of(items_[i], axis)];
        bin.box.include(items_[i].box);
        ++bin.count;
      }
    }
    Split best;
    for (int axis = 0; axis != 3; ++axis) {
      if (binning.can_split(axis)) consider_planes(bins[static_cast<std::size_t>(axis)], binning.bins(), axis, best);
    }
    return best;
  }

  std::pair<Range, Range> split_at(const Range& range, const Binning& binning, const Split& at) noexcept {
    Range left{range.begin, range.begin, {}, {}};
    Range right{range.end, range.end, {}, {}};
    while (left.end != right.begin) {
      Item& item = items_[left.end];
      if (binning.bin_of(item, at.axis) <= at.bin) {
        left.include(item);
        ++left.end;
      } else {
        right.include(item);
        std::swap(item, items_[--right.begin]);
      }
    }
    return {left, right};
  }

  Range range_of(std::size_t begin, std::size_t end) const noexcept {
    Range range{begin, end, {}, {}};
    for (std::size_t i = begin; i != end; ++i) range.include(items_[i]);
    return range;
  }

  static TreeNode empty_node() noexcept {
    TreeNode node{};
    for (auto& axis : node.bounds) {
      std::fill(std::begin(axis[0]), std::end(axis[0]), std::numeric_limits<float>::infinity());
      std::fill(std::begin(axis[1]), std::end(axis[1]), -std::numeric_limits<float>::infinity());
    }
    return node;
  }

  std::uint32_t add_leaf(const Range& range) {
    TreeLeaf leaf{};
    std::fill(std::begin(leaf.radius), std::end(leaf.radius), -TreeLeaf::kNowhere);
    std::fill(std::begin(leaf.id), std::end(leaf.id), SurfaceId::none);
    for (std::size_t lane = 0; lane != range.count(); ++lane) {
      const std::uint32_t index = items_[range.begin + lane].index();
      const Vec3 c = space_.from_scene(spheres_[index].center);
      for (int axis = 0; axis != 3; ++axis) leaf.center[axis][lane] = static_cast<float>(c[axis]);
      const double error = TreeRay::kSphereError * sum_of_sizes(c);
      leaf.radius[lane] = TreeSpace::up(spheres_[index].radius * space_.scale * (1 + 0x1p-20) + error);
      leaf.id[lane] = surface_id(index);
    }
    leaves_.push_back(leaf);
    return TreeChild::kLeafBit | static_cast<std::uint32_t>(leaves_.size() - 1);
  }

  std::span<const Sphere> spheres_;
  TreeSpace space_;
  std::vector<Item> items_;
  std::vector<TreeNode> nodes_;
  std::vector<TreeLeaf> leaves_;
};

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

TreeSpace space_of(std::span<const Sphere> spheres) {
  TreeSpace space;
  Box box;
  for (const Sphere& sphere : spheres) {
    if (sphere.radius > 0) box.include(bounds_of(sphere.center, sphere.radius));
  }
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

Bvh build_bvh(std::span<const Sphere> spheres) {
  return Builder(spheres, space_of(spheres)).finish();
}

}  // namespace tessera::render
