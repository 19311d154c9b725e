// SPDX-License-Identifier: BSD-3-Clause
#include "render/bvh.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <set>
#include <vector>

#include "render/bvh_build.h"
#include "render/exact.h"
#include "render/scene_kinds.h"
#include "render/tree_inspection.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

}  // namespace

BOOST_AUTO_TEST_SUITE(bvh)

BOOST_AUTO_TEST_CASE(every_sphere_is_in_exactly_one_leaf_and_every_box_holds_its_contents) {
  for (const SceneKind& kind : scene_kinds()) {
    BOOST_TEST_CONTEXT(kind.name) check_invariants(random_scene(kind, 31).spheres);
  }
}

BOOST_AUTO_TEST_CASE(trees_of_few_spheres_are_valid) {
  std::vector<Sphere> spheres;
  for (int n = 0; n != 20; ++n) {
    check_invariants(spheres);
    spheres.push_back({{n * 1.5, 0, n * 0.5}, 1});
  }
}

BOOST_AUTO_TEST_CASE(spheres_of_radius_zero_are_left_out) {
  check_invariants(std::vector<Sphere>(100, Sphere{{1, 2, 3}, 0}));
}

// No plane separates them, so the list is halved: depth about log8(n).
BOOST_AUTO_TEST_CASE(million_equal_centers_build_a_shallow_tree) {
  const std::vector<Sphere> spheres(1'000'000, Sphere{{1, 2, 3}, 0.5});
  const Bvh bvh = build_bvh(spheres);
  const Inspection found(bvh, spheres);
  BOOST_TEST(found.spheres.size() == spheres.size());
  BOOST_TEST(found.deepest <= 8);
}

// Centres at 2^-1, 2^-2, ...: whoever splits space in the middle peels off one sphere a level.
BOOST_AUTO_TEST_CASE(geometric_sequence_of_centers_stays_below_the_maximum_depth) {
  std::vector<Sphere> spheres;
  for (int i = 0; i != 1000; ++i) spheres.push_back({{std::ldexp(1.0, -i), 0, 0}, std::ldexp(1.0, -i - 3)});
  check_invariants(spheres);
}

BOOST_AUTO_TEST_CASE(box_grows_to_hold_others) {
  Box box;
  BOOST_TEST(box.is_empty());
  box.include({{0, 0, 0}, {1, 1, 1}});
  box.include({{0, 0, 1}, {1, 2, 3}});
  BOOST_TEST((box.lo == Vec3{0, 0, 0} && box.hi == Vec3{1, 2, 3}));
  BOOST_TEST(!box.is_empty());
  BOOST_TEST(box.contains({1, 2, 3}));
  BOOST_TEST(!box.contains({1, 2, 3.5}));
}

// At offset 1e9 the sum centre + radius rounds by 1e-7: the box must take it in all the same.
BOOST_AUTO_TEST_CASE(bounds_of_a_sphere_are_rounded_outward) {
  Random random(32);
  int outside = 0;
  for (int i = 0; i != 20000; ++i) {
    const Vec3 center = random.in_box(random.over_decades(1e-3, 1e12));
    const double radius = random.over_decades(1e-9, 1e3);
    const Box box = bounds_of(center, radius);
    for (int axis = 0; axis != 3; ++axis) {
      // c - lo >= r and hi - c >= r, exactly: TwoDiff's rest counts when the heads are equal.
      const TwoTerm below = two_diff(center[axis], box.lo[axis]);
      const TwoTerm above = two_diff(box.hi[axis], center[axis]);
      outside += below.hi < radius || (below.hi == radius && below.lo < 0);
      outside += above.hi < radius || (above.hi == radius && above.lo < 0);
    }
  }
  BOOST_TEST(outside == 0);
}

// The unit box from x = -1 and from x = 2, with zeros of both signs. (A ray in the very plane of a face is nobody's:
// boxes are wider than their spheres.)
BOOST_AUTO_TEST_CASE(slab_test_takes_rays_along_an_axis) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  for (const double zero : {0.0, -0.0}) {
    for (const double y : {0x1p-50, 0.5, 1 - 0x1p-50}) {
      const SlabTest forth({.origin = {-1, y, 1 - y}, .direction = {1, zero, -zero}});
      BOOST_TEST(forth.entry(box, kInf) == 1);
      BOOST_TEST(forth.entry(box, 0.5) == kInf);
      BOOST_TEST(SlabTest({.origin = {2, y, 1 - y}, .direction = {-0.5, zero, -zero}}).entry(box, kInf) == 2);
    }
    BOOST_TEST(SlabTest({.origin = {-1, 1.5, 0.5}, .direction = {1, zero, zero}}).entry(box, kInf) == kInf);
    BOOST_TEST(SlabTest({.origin = {2, 0.5, 0.5}, .direction = {1, zero, zero}}).entry(box, kInf) == kInf);
    BOOST_TEST(SlabTest({.origin = {0.5, 0.5, 0.5}, .direction = {zero, zero, 1}}).entry(box, kInf) == 0);
  }
}

// The diagonal meets all three slabs at once, at t = 1; so does a ray through an edge.
BOOST_AUTO_TEST_CASE(slab_test_takes_rays_through_corners_and_edges) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  BOOST_TEST(SlabTest({.origin = {-1, -1, -1}, .direction = {1, 1, 1}}).entry(box, kInf) == 1);
  BOOST_TEST(SlabTest({.origin = {-1, 2, 0.5}, .direction = {1, -1, 0}}).entry(box, kInf) == 1);
  BOOST_TEST(SlabTest({.origin = {-1, 1, 0.5}, .direction = {1, 1, 0}}).entry(box, kInf) == kInf);
  // Through the edge x = 0, y = 1 and no further: a corner hit is a hit.
  BOOST_TEST(SlabTest({.origin = {-1, 0, 0.5}, .direction = {1, 1, 0}}).entry(box, kInf) == 1);
}

BOOST_AUTO_TEST_CASE(visit_where_finds_every_sphere_around_a_point) {
  Random random(33);
  for (const SceneKind& kind : scene_kinds()) {
    const SceneData scene = random_scene(kind, 34);
    const Bvh bvh = build_bvh(scene.spheres);
    int lost = 0;
    for (int i = 0; i != 500; ++i) {
      const Vec3 point = kind.center + random.in_box(kind.size);
      std::set<std::size_t> visited;
      bvh.visit_where([&](const Box& box) { return box.contains(point); },
                      [&](SurfaceId id) { visited.insert(index_of(id)); });
      for (std::size_t s = 0; s != scene.spheres.size(); ++s) {
        const Sphere& sphere = scene.spheres[s];
        lost += sphere.radius > 0 && length(sphere.center - point) <= sphere.radius && !visited.contains(s);
      }
    }
    BOOST_TEST(lost == 0, kind.name);
  }
}

BOOST_AUTO_TEST_CASE(box_reaches_as_far_as_its_farthest_corner) {
  const Box box{{-1, 0, 2}, {2, 5, 10}};
  BOOST_TEST(box.reach_from({-1, 1, -2}) == 3 + 4 + 12);
  BOOST_TEST(box.reach_from({2, 4, 14}) == 3 + 4 + 12);
  BOOST_TEST(box.reach_from({0.5, 2.5, 6}) == 1.5 + 2.5 + 4);
}

BOOST_AUTO_TEST_SUITE_END()
