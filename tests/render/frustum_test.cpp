// SPDX-License-Identifier: BSD-3-Clause
// What a ray of a pencil meets is never left out, wherever the pencil begins and however narrow or wide it is. Oracle:
// points on rays of the pencil, which spheres and boxes are put around, touching them from outside.
#include "render/frustum.h"

#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "render/bvh_build.h"
#include "render/frustum_avx2.h"
#include "render/kernel.h"
#include "render/random.h"
#include "render/random_spheres.h"
#include "render/sphere.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

double place_in(const std::array<double, 2>& range, Random& random) {
  // The sides are where a plane could be too near.
  const std::uint32_t choice = random.below(4);
  return choice == 0 ? range[0] : choice == 1 ? range[1] : random.uniform(range[0], range[1]);
}

Ray ray_of(const Pencil& pencil, Random& random) {
  const Vec3 offset = place_in(pencil.x, random) * pencil.right + place_in(pencil.y, random) * pencil.down;
  if (pencil.kind == Pencil::Kind::pyramid) return {.origin = pencil.origin, .direction = pencil.axis + offset};
  return {.origin = pencil.origin + offset, .direction = pencil.axis};
}

/// A pencil about the way from `eye` to `target`: from next to nothing to nearly a half space wide, flat or a line too.
Pencil random_pencil(Random& random, Pencil::Kind kind, const Vec3& eye, const Vec3& target) {
  Pencil pencil{kind, eye, target - eye, {}, {}, {}, {}};
  const double distance = length(pencil.axis);
  pencil.axis = random.over_decades(1e-3, 1e3) / distance * pencil.axis;
  const double unit = kind == Pencil::Kind::pyramid ? length(pencil.axis) : 1;
  pencil.right =
      random.over_decades(1e-3, 1e3) * random.perpendicular_to(pencil.axis) + random.uniform(-0.3, 0.3) * pencil.axis;
  pencil.down = random.uniform(0.5, 2) * normalized(cross(pencil.axis, pencil.right));
  for (auto [range, side] : {std::pair(&pencil.x, &pencil.right), std::pair(&pencil.y, &pencil.down)}) {
    const double half =
        random.below(6) == 0 ? 0 : unit / length(*side) * random.over_decades(1e-9, random.flip() ? 2 : 0.1);
    const double middle = half * random.uniform(-2, 2);
    *range = {middle - half, middle + half};
  }
  return pencil;
}

/// Which children and which spheres are met, lane by lane and together: the same numbers.
#if defined(__x86_64__)
TESSERA_BEGIN_AVX2
[[gnu::flatten]] unsigned children_met(const TreeNode& node, const TreeFrustum& frustum, float* depths) {
  avx2::Float8 depth;
  const avx2::LaneMask met = avx2::meets_children(node, frustum, depth);
  depth.store(depths);
  return met;
}
[[gnu::flatten]] unsigned spheres_met(const TreeLeaf& leaf, const TreeFrustum& frustum, float* depths) {
  avx2::Float8 depth;
  const avx2::LaneMask met = avx2::may_meet(leaf, frustum, depth);
  depth.store(depths);
  return met;
}
TESSERA_END_AVX2
#endif

bool same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// Sends rays of pencils through the tree of some spheres, and counts what the frustum leaves out though it is hit.
class FrustumCheck {
 public:
  FrustumCheck(std::string name, const std::vector<Sphere>& spheres)
      : name_(std::move(name)), spheres_(spheres), bvh_(build_bvh(spheres)) {}
  ~FrustumCheck() {
    BOOST_TEST(lost_ == 0, name_ << ": " << lost_ << " of " << hits_ << " hits lost");
    BOOST_TEST(late_ == 0, name_ << ": " << late_ << " of " << hits_ << " depths behind the hit");
    BOOST_TEST(unlike_ == 0, name_ << ": " << unlike_ << " lanes differ");
    BOOST_TEST(hits_ > 300, name_ << ": " << hits_ << " hits");
  }
  FrustumCheck(const FrustumCheck&) = delete;

  const std::vector<Sphere>& spheres() const { return spheres_; }
  std::size_t left_out() const { return left_out_; }
  std::size_t looks() const { return looks_; }

  void look(const Pencil& pencil, Random& random, int rays) {
    const TreeFrustum frustum(bvh_.space(), pencil);
    std::vector<double> first(spheres_.size(), std::numeric_limits<double>::infinity());
    for (int i = 0; i != rays; ++i) {
      const Ray ray = ray_of(pencil, random);
      if (!is_squarable(dot(ray.direction, ray.direction))) continue;
      const DirectionNorm norm = norm_of(ray.direction);
      for (std::size_t s = 0; s != spheres_.size(); ++s) {
        if (side_of(ray.origin, spheres_[s].center, spheres_[s].radius) <= 0) continue;
        const auto crossing = entry_into(ray, norm, spheres_[s].center, spheres_[s].radius);
        if (!crossing) continue;
        const double t = (crossing->t.value + crossing->t.error) * norm.length * bvh_.space().scale;
        first[s] = std::min(first[s], t - way_to_start(pencil, ray, frustum.shift) + 0x1p-46 * t);
        ++hits_;
      }
    }
    visit(0, frustum, first);
  }

 private:
  /// How far a ray is said to start beyond its origin, in tree units.
  double way_to_start(const Pencil& pencil, const Ray& ray, double shift) const {
    if (shift == 0) return 0;
    const Vec3 axis = normalized(pencil.axis);
    double aside = pencil.kind == Pencil::Kind::prism ? -std::numeric_limits<double>::infinity() : 0;
    for (const double x : pencil.x) {
      for (const double y : pencil.y) {
        const Vec3 start = x * pencil.right + y * pencil.down;
        if (pencil.kind == Pencil::Kind::prism) aside = std::max(aside, dot(ray.origin - pencil.origin - start, axis));
      }
    }
    return (shift - aside * bvh_.space().scale) / dot(normalized(ray.direction), axis);
  }

  /// How far along its ray the first hit below a child is.
  double visit(std::uint32_t child, const TreeFrustum& frustum, const std::vector<double>& first) {
    double nearest = std::numeric_limits<double>::infinity();
    float depths[kTreeWidth]{};
    if (TreeChild::is_leaf(child)) {
      const TreeLeaf& leaf = bvh_.leaves()[TreeChild::index(child)];
      unsigned met = 0;
      for (int lane = 0; lane != kTreeWidth; ++lane) {
        const bool is_met = may_meet(leaf, lane, frustum, depths[lane]);
        met |= is_met ? 1U << lane : 0;
        if (leaf.id[lane] == SurfaceId::none) {
          unlike_ += is_met;
          continue;
        }
        const double hit = first[index_of(leaf.id[lane])];
        count(is_met, depths[lane], hit);
        nearest = std::min(nearest, hit);
      }
      if (is_supported(Kernel::avx2))
        compare(met, depths, [&](float* lanes) { return spheres_met(leaf, frustum, lanes); });
      return nearest;
    }
    const TreeNode& node = bvh_.nodes()[child];
    unsigned met = 0;
    for (int i = 0; i != kTreeWidth; ++i) {
      const bool is_met = meets_child(node, i, frustum, depths[i]);
      met |= is_met ? 1U << i : 0;
      if (!(node.bounds[0][0][i] <= node.bounds[0][1][i])) {
        unlike_ += is_met;
        continue;
      }
      const double hit = visit(node.child[i], frustum, first);
      count(is_met, depths[i], hit);
      nearest = std::min(nearest, hit);
    }
    if (is_supported(Kernel::avx2))
      compare(met, depths, [&](float* lanes) { return children_met(node, frustum, lanes); });
    return nearest;
  }

  void count(bool is_met, float depth, double hit) {
    ++looks_;
    left_out_ += !is_met;
    if (hit == std::numeric_limits<double>::infinity()) return;
    lost_ += !is_met;
    late_ += depth > hit;
  }

  template <class Lanes>
  void compare(unsigned met, const float* depths, Lanes&& lanes) {
#if defined(__x86_64__)
    alignas(32) float others[kTreeWidth];
    unlike_ += lanes(others) != met;
    for (int i = 0; i != kTreeWidth; ++i) unlike_ += !same(others[i], depths[i]);
#endif
  }

  std::string name_;
  std::vector<Sphere> spheres_;
  Bvh bvh_;
  std::size_t hits_ = 0;
  std::size_t lost_ = 0;
  std::size_t late_ = 0;
  std::size_t unlike_ = 0;
  std::size_t looks_ = 0;
  std::size_t left_out_ = 0;
};

void look_from(FrustumCheck& check, Random& random, double nearest, double farthest, int count) {
  for (int i = 0; i != count; ++i) {
    const Sphere& aim = one_of(random, check.spheres());
    const Vec3 target = aim.center + random.in_box(aim.radius);
    const Vec3 eye = target + random.over_decades(nearest, farthest) * random.direction();
    if (eye == target) continue;
    const auto kind = random.flip() ? Pencil::Kind::pyramid : Pencil::Kind::prism;
    check.look(random_pencil(random, kind, eye, target), random, 12);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(frustum)

BOOST_AUTO_TEST_CASE(spheres_of_all_sizes_stay_from_any_distance) {
  Random random(111);
  for (const double extent : {1.0, 1e-3, 1e-60, 1e-130}) {
    for (const double decades : {1.0, 6.0, 12.0}) {
      FrustumCheck check("extent " + std::to_string(std::log10(extent)) + ", decades " + std::to_string(decades),
                         cloud(random, {0, 0, 0}, extent, decades, 60));
      look_from(check, random, extent * 1e-3, extent * 10, 300);
      look_from(check, random, extent, extent * 1e12, 300);
      // Nor are all others kept.
      BOOST_TEST(check.left_out() > check.looks() / 4);
    }
  }
}

BOOST_AUTO_TEST_CASE(spheres_far_from_the_base_stay) {
  Random random(112);
  for (const double cluster : {1e-2, 1e-6, 1e-12}) {
    for (const double offset : {0.0, 1e2, 1e6}) {
      const Vec3 base = offset * Vec3{1, -1, 0.5};
      std::vector<Sphere> spheres = cloud(random, base, cluster, 2, 60);
      for (const Sphere& sphere : cloud(random, base, 1, 10, 30)) spheres.push_back(sphere);
      FrustumCheck check("cluster of " + std::to_string(std::log10(cluster)) + " at " + std::to_string(offset),
                         spheres);
      look_from(check, random, 1e-3, 1e12, 300);
      look_from(check, random, 1e-3 * cluster, 1e3 * cluster, 200);
    }
  }
}

// A pyramid of one ray through a sphere's rim, where planes and spheres touch.
BOOST_AUTO_TEST_CASE(spheres_that_a_line_touches_stay) {
  Random random(113);
  FrustumCheck check("rims", cloud(random, {0.3, -0.1, 0.2}, 1, 3, 100));
  for (int i = 0; i != 3000; ++i) {
    const Sphere& aim = one_of(random, check.spheres());
    const Vec3 direction = random.direction();
    const Vec3 across = random.perpendicular_to(direction);
    const double rim = aim.radius * (1 - random.over_decades(1e-14, 1e-2));
    const Vec3 eye = aim.center + rim * across - random.over_decades(1e-2, 1e6) * direction;
    const Vec3 down = cross(direction, across);
    // The sphere may be on the outer side of a plane but for its rim.
    const std::array<double, 2> aside{random.flip() ? -1e-3 : 0, 0};
    check.look(
        {random.flip() ? Pencil::Kind::pyramid : Pencil::Kind::prism, eye, direction, -across, down, aside, {0, 0}},
        random, 4);
  }
}

BOOST_AUTO_TEST_CASE(pencils_open_too_wide_leave_nothing_out) {
  Random random(114);
  FrustumCheck check("wide", cloud(random, {0, 0, 0}, 1, 2, 60));
  for (int i = 0; i != 200; ++i) {
    const Vec3 axis = random.direction();
    const Vec3 right = random.perpendicular_to(axis);
    check.look({Pencil::Kind::pyramid, random.in_box(2), axis, right, cross(axis, right), {-1e3, 1e3}, {-1, 1e6}},
               random, 20);
  }
}

BOOST_AUTO_TEST_SUITE_END()
