// SPDX-License-Identifier: BSD-3-Clause
#include "render/bvh_build.h"

#include <algorithm>
#include <array>

namespace tessera::render {
namespace {

constexpr std::size_t kBins = 16;
constexpr std::size_t kLeafSize = 8;
constexpr int kHalvingDepth = 60;  // from here on halve: 60 + log2(2^32) stays below Bvh::kMaxDepth
constexpr double kNodeCost = 1;    // of a box test
constexpr double kSphereCost = 1;  // of a sphere test, in box tests

struct Item {
  Box box;
  LeafSphere sphere;
};

struct Bin {
  Box box;
  std::size_t count = 0;
};

/// A plane between two bins on one axis, and what it is expected to cost.
struct Split {
  int axis = -1;
  std::size_t bin = 0;  ///< items in bins <= bin go left
  double cost = std::numeric_limits<double>::infinity();
};

/// Maps centres to bins along one axis of their bounds.
struct Binning {
  double origin;
  double scale;

  Binning(double lo, double hi) noexcept : origin(lo), scale(static_cast<double>(kBins) / (hi - lo)) {}
  std::size_t operator()(double center) const noexcept {
    return std::min(kBins - 1, static_cast<std::size_t>((center - origin) * scale));
  }
};

class Builder {
 public:
  explicit Builder(std::vector<Item> items) : items_(std::move(items)) {
    nodes_.reserve(items_.size());
    nodes_.emplace_back();
    if (items_.empty()) return;
    split(0, 0, items_.size(), 0);
  }

  Bvh finish() && {
    if (items_.empty()) return {};
    std::vector<LeafSphere> spheres;
    spheres.reserve(items_.size());
    for (const Item& item : items_) spheres.push_back(item.sphere);
    nodes_.shrink_to_fit();
    return {std::move(nodes_), std::move(spheres)};
  }

 private:
  void split(std::size_t node, std::size_t begin, std::size_t end, int depth) {
    Box box;
    Box centers;
    for (std::size_t i = begin; i != end; ++i) {
      box.include(items_[i].box);
      centers.include({items_[i].sphere.center, items_[i].sphere.center});
    }
    nodes_[node].box = box;

    const std::size_t count = end - begin;
    const std::size_t middle = partition(box, centers, begin, end, depth);
    if (middle == begin) {
      nodes_[node].first = static_cast<std::uint32_t>(begin);
      nodes_[node].count = static_cast<std::uint32_t>(count);
      return;
    }
    const std::size_t left = nodes_.size();
    nodes_.resize(left + 2);
    nodes_[node].first = static_cast<std::uint32_t>(left);
    split(left, begin, middle, depth + 1);
    split(left + 1, middle, end, depth + 1);
  }

  /// Puts the items of the left child first and returns where the right child's begin; `begin` asks for a leaf.
  std::size_t partition(const Box& box, const Box& centers, std::size_t begin, std::size_t end, int depth) {
    const std::size_t count = end - begin;
    if (count == 1) return begin;
    if (depth < kHalvingDepth) {
      const Split best = best_split(box, centers, begin, end);
      const double leaf_cost = kSphereCost * static_cast<double>(count);
      if (count <= kLeafSize && best.cost >= leaf_cost) return begin;
      if (best.axis >= 0) {
        const Binning bin_of(centers.lo[best.axis], centers.hi[best.axis]);
        const auto left = [&](const Item& item) { return bin_of(item.sphere.center[best.axis]) <= best.bin; };
        const auto first = items_.begin();
        const auto middle =
            std::partition(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end), left);
        return static_cast<std::size_t>(middle - first);
      }
    }
    return count <= kLeafSize ? begin : begin + count / 2;
  }

  Split best_split(const Box& box, const Box& centers, std::size_t begin, std::size_t end) const {
    Split best;
    for (int axis = 0; axis != 3; ++axis) {
      if (!(centers.lo[axis] < centers.hi[axis])) continue;
      const Binning bin_of(centers.lo[axis], centers.hi[axis]);
      if (!std::isfinite(bin_of.scale)) continue;
      std::array<Bin, kBins> bins{};
      for (std::size_t i = begin; i != end; ++i) {
        Bin& bin = bins[bin_of(items_[i].sphere.center[axis])];
        bin.box.include(items_[i].box);
        ++bin.count;
      }
      consider_planes(bins, box.half_area(), axis, best);
    }
    return best;
  }

  /// Sweeps the planes between bins: costs of the right sides first, then left sides against them.
  static void consider_planes(const std::array<Bin, kBins>& bins, double area, int axis, Split& best) {
    std::array<double, kBins> right_cost{};
    Bin right;
    for (std::size_t i = kBins - 1; i > 0; --i) {
      right.box.include(bins[i].box);
      right.count += bins[i].count;
      right_cost[i] = right.count == 0 ? 0 : right.box.half_area() * static_cast<double>(right.count);
    }
    Bin left;
    const std::size_t total = right.count + bins[0].count;
    for (std::size_t i = 0; i + 1 < kBins; ++i) {
      left.box.include(bins[i].box);
      left.count += bins[i].count;
      if (left.count == 0 || left.count == total) continue;
      const double left_cost = left.box.half_area() * static_cast<double>(left.count);
      const double cost = kNodeCost + kSphereCost * (left_cost + right_cost[i + 1]) / area;
      if (cost < best.cost) best = {axis, i, cost};
    }
  }

  std::vector<Item> items_;
  std::vector<Bvh::Node> nodes_;
};

}  // namespace

Bvh build_bvh(std::span<const Sphere> spheres) {
  std::vector<Item> items;
  items.reserve(spheres.size());
  for (std::size_t i = 0; i != spheres.size(); ++i) {
    const Sphere& sphere = spheres[i];
    if (sphere.radius == 0) continue;
    items.push_back({bounds_of(sphere.center, sphere.radius), {sphere.center, sphere.radius, surface_id(i)}});
  }
  return Builder(std::move(items)).finish();
}

}  // namespace tessera::render
