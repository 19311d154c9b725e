// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>
#include <string>
#include <utility>
#include <vector>

#include "render/bvh_build.h"
#include "render/kernels.h"
#include "render/same_bits.h"
#include "render/sphere.h"
#include "render/stream.h"

// Whether a tree loses hits. Oracle: entry_into, which decides exactly, for every sphere.
namespace tessera::render::test {

/// Where a sphere is in the tree: its leaf, and the children around it from the root on.
struct Place {
  std::vector<std::pair<const TreeNode*, int>> around;
  const TreeLeaf* leaf = nullptr;
  int lane = 0;
};

/// Sends rays through spheres and their tree, and counts what the tree leaves out though it is hit; says so at its end.
class TreeCheck {
 public:
  TreeCheck(std::string name, std::vector<Sphere> spheres)
      : name_(std::move(name)), spheres_(std::move(spheres)), bvh_(build_bvh(spheres_)), places_(spheres_.size()) {
    visit(0, {});
  }
  ~TreeCheck() {
    BOOST_TEST(lost_ == 0, name_ << ": " << lost_ << " of " << hits_ << " hits lost");
    BOOST_TEST(hits_ > rays_.size() / 10, name_ << ": " << hits_ << " hits of " << rays_.size() << " rays");
    check_kernels();
  }
  TreeCheck(const TreeCheck&) = delete;

  const std::vector<Sphere>& spheres() const { return spheres_; }

  const Vec3& base() const { return bvh_.space().base; }

  /// Requires every sphere that the ray hits of every step that leads to it.
  void trace(const Vec3& eye, const Vec3& direction) {
    if (!is_squarable(dot(direction, direction))) return;
    const Ray ray{.origin = eye, .direction = direction};
    const DirectionNorm norm = norm_of(direction);
    const double inverse_length = look_bounds(norm, 1).inverse_length;
    const TreeRay tree_ray(bvh_.space(), ray, inverse_length);
    for (std::size_t i = 0; i != spheres_.size(); ++i) {
      const auto& [center, radius, material] = spheres_[i];
      if (side_of(eye, center, radius) <= 0) continue;
      const auto crossing = entry_into(ray, norm, center, radius);
      if (!crossing) continue;
      const double latest = crossing->t.value + crossing->t.error;
      ++hits_;
      lost_ +=
          !is_on_the_way(places_[i], tree_ray, tree_ray.t_of(latest)) || !is_visited(i, ray, inverse_length, latest);
    }
    rays_.push_back(ray);
  }

 private:
  void visit(std::uint32_t child, Place place) {
    if (TreeChild::is_leaf(child)) {
      place.leaf = &bvh_.leaves()[TreeChild::index(child)];
      for (place.lane = 0; place.lane != kTreeWidth; ++place.lane) {
        const SurfaceId id = place.leaf->id[place.lane];
        if (id != SurfaceId::none) places_[index_of(id)] = place;
      }
      return;
    }
    const TreeNode& node = bvh_.nodes()[child];
    for (int i = 0; i != kTreeWidth; ++i) {
      if (!(node.bounds[0][0][i] <= node.bounds[0][1][i])) continue;
      Place inner = place;
      inner.around.emplace_back(&node, i);
      visit(node.child[i], inner);
    }
  }

  static bool is_on_the_way(const Place& place, const TreeRay& ray, float latest) {
    for (const auto& [node, child] : place.around) {
      float entry = -1;
      if (!meets_child(*node, child, ray, latest, entry)) return false;
      if (!(0 <= entry && entry <= latest * TreeRay::kSlack)) return false;
    }
    return may_meet(*place.leaf, place.lane, ray, latest);
  }

  bool is_visited(std::size_t sphere, const Ray& ray, double inverse_length, double latest) const {
    bool found = false;
    bvh_.visit_along(ray, inverse_length, latest, [&](SurfaceId id) { return found = index_of(id) == sphere; });
    return found;
  }

  /// The lanes' first looks round differently: they must not lose a first hit either.
  void check_kernels() const {
    SceneData data;
    data.spheres = spheres_;
    const Scene brute(data, Kernel::brute);
    std::vector<Region> regions;
    for (const Ray& ray : rays_) regions.emplace_back(brute, brute.placement_of(ray.origin), ray.origin, ray.direction);
    std::vector<RayInRegion> rays;
    for (std::size_t i = 0; i != rays_.size(); ++i) rays.push_back({rays_[i], &regions[i]});
    std::vector<std::optional<SurfacePoint>> expected(rays.size());
    std::vector<std::optional<SurfacePoint>> hits(rays.size());
    nearest_hits(brute, rays, expected);
    for (const auto& [kernel, kernel_name] : supported_kernels()) {
      nearest_hits(Scene(data, kernel), rays, hits);
      int differences = 0;
      for (std::size_t i = 0; i != rays.size(); ++i) differences += !same_bits(hits[i], expected[i]);
      BOOST_TEST(differences == 0, name_ << ": " << differences << " first hits differ with " << kernel_name);
    }
  }

  std::string name_;
  std::vector<Sphere> spheres_;
  Bvh bvh_;
  std::vector<Place> places_;
  std::vector<Ray> rays_;
  std::size_t hits_ = 0;
  std::size_t lost_ = 0;
};

}  // namespace tessera::render::test
