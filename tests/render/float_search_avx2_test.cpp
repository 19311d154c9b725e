// SPDX-License-Identifier: BSD-3-Clause
// What floats say of spheres along a ray against the exact decisions: it is so, and it is said of nearly all spheres.
#include "render/float_search_avx2.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <utility>
#include <vector>

#include "render/bvh_build.h"
#include "render/kernel.h"
#include "render/random.h"
#include "render/random_spheres.h"

#if defined(__x86_64__)
using namespace tessera::render;
using namespace tessera::render::test;

TESSERA_BEGIN_AVX2
namespace {

/// Offers all leaves of a tree to rays, and counts what the bounds say; says what is wrong at its end.
class BoundsCheck {
 public:
  BoundsCheck(std::string name, std::vector<Sphere> spheres)
      : name_(std::move(name)), spheres_(std::move(spheres)), bvh_(build_bvh(spheres_)) {}
  ~BoundsCheck() {
    BOOST_TEST(lost_ == 0, name_ << ": " << lost_ << " of " << entered_ << " entries are no candidates");
    BOOST_TEST(wrong_ == 0, name_ << ": " << wrong_ << " of " << entered_ << " entries are out of bounds");
    BOOST_TEST(false_ == 0, name_ << ": " << false_ << " spheres are not entered, though surely");
    BOOST_TEST(entered_ > 0, name_);
  }
  BoundsCheck(const BoundsCheck&) = delete;

  const std::vector<Sphere>& spheres() const { return spheres_; }
  /// The share of entries that are sure.
  double sureness() const { return static_cast<double>(sure_) / static_cast<double>(entered_); }

  /// From an eye that is outside of all spheres, or on one of them.
  void trace(const Ray& ray) {
    const DirectionNorm norm = norm_of(ray.direction);
    const TreeRay tree_ray(bvh_.space(), ray, 1 / norm.length);
    for (const TreeLeaf& leaf : bvh_.leaves()) {
      avx2::Candidates candidates;
      candidates.add<true>(leaf, 7, tree_ray, ray.from, std::numeric_limits<float>::max());
      candidates.finish();
      for (const SurfaceId id : leaf.id) {
        if (id == SurfaceId::none) continue;
        const auto& [center, radius, material] = spheres_[index_of(id)];
        if (id != ray.from && side_of(ray.origin, center, radius) <= 0) continue;
        const auto crossing = id == ray.from ? std::nullopt : entry_into(ray, norm, center, radius);
        compare(candidates, id, crossing, tree_ray, dot(center - ray.origin, ray.direction) / norm.squared);
      }
    }
  }

 private:
  void compare(const avx2::Candidates& candidates, SurfaceId id, const std::optional<Crossing>& crossing,
               const TreeRay& ray, double foot) {
    entered_ += crossing.has_value();
    std::size_t i = 0;
    while (i != candidates.size() && candidates.sphere(i) != id) ++i;
    if (i == candidates.size()) {
      lost_ += crossing.has_value();
      return;
    }
    const auto [low, up, foot_up] = candidates.bounds(i);
    if (candidates.ray(i) != 7) ++wrong_;
    if (!crossing) {
      false_ += up < avx2::kNever;
      return;
    }
    sure_ += up < avx2::kNever;
    // In the tree's units, with what doubles are off by.
    const auto along = [&](double t) { return t * ray.t_scale - ray.t_shift; };
    const auto [t, error] = crossing->t;
    wrong_ += low > along(t + error) || up < along(t - error) * (1 - 0x1p-48) ||
              foot_up < along(foot) * (1 - 0x1p-48) - 0x1p-48;
  }

  std::string name_;
  std::vector<Sphere> spheres_;
  Bvh bvh_;
  std::size_t entered_ = 0;
  std::size_t sure_ = 0;
  std::size_t lost_ = 0;
  std::size_t wrong_ = 0;
  std::size_t false_ = 0;
};

/// Into a sphere, and about its rim: half of them very close to it.
void aim(BoundsCheck& check, Random& random, const Vec3& eye, SurfaceId from, const Vec3& normal) {
  const Sphere& sphere = one_of(random, check.spheres());
  const double rim = sphere.radius * (random.flip() ? random.uniform(0, 1.1) : 1 - random.over_decades(1e-9, 1e-2));
  const Vec3 direction = sphere.center + rim * random.perpendicular_to(sphere.center - eye) - eye;
  if (from != SurfaceId::none && dot(direction, normal) < 0) return;
  check.trace({eye, random.over_decades(1e-9, 1e9) * direction, from, normal});
}

/// From points in a box, and from points of spheres.
void trace_within(BoundsCheck& check, Random& random, const Vec3& middle, double extent, int count) {
  for (int i = 0; i != count; ++i) {
    aim(check, random, middle + random.in_box(extent), SurfaceId::none, {});
    const auto from = random.below(static_cast<std::uint32_t>(check.spheres().size()));
    const Sphere& sphere = check.spheres()[from];
    const Vec3 normal = random.direction();
    aim(check, random, sphere.center + sphere.radius * normal, surface_id(from), normal);
  }
}

}  // namespace
TESSERA_END_AVX2

BOOST_AUTO_TEST_SUITE(float_search_avx2)

BOOST_AUTO_TEST_CASE(bounds_hold_for_spheres_of_all_sizes,
                     *boost::unit_test::precondition([](auto) { return is_supported(Kernel::avx2); })) {
  Random random(501);
  for (const double decades : {0.5, 3.0, 8.0}) {
    BoundsCheck check("decades " + std::to_string(decades), cloud(random, {0.3, -0.2, 0.1}, 1, decades, 100));
    trace_within(check, random, {0.3, -0.2, 0.1}, 3, 1000);
    if (decades < 1) BOOST_TEST(check.sureness() > 0.7);
  }
}

// Where floats are finest and where they are coarsest: most spheres in a cluster, others far from it.
BOOST_AUTO_TEST_CASE(bounds_hold_in_a_cluster_and_far_from_it,
                     *boost::unit_test::precondition([](auto) { return is_supported(Kernel::avx2); })) {
  Random random(502);
  for (const double cluster : {1e-2, 1e-5, 1e-9}) {
    std::vector<Sphere> spheres = cloud(random, {5, 6, 7}, cluster, 0.5, 120);
    for (const Sphere& sphere : cloud(random, {5, 6, 7}, 1, 1, 40)) {
      if (length(sphere.center - Vec3{5, 6, 7}) > sphere.radius + 2 * cluster) spheres.push_back(sphere);
    }
    BoundsCheck check("cluster of " + std::to_string(std::log10(cluster)), spheres);
    trace_within(check, random, {5, 6, 7}, cluster, 500);
    trace_within(check, random, {5, 6, 7}, 2, 500);
    BOOST_TEST(check.sureness() > 0.5);
  }
}

// Eyes so far away that the ray begins where the spheres do.
BOOST_AUTO_TEST_CASE(bounds_hold_from_afar,
                     *boost::unit_test::precondition([](auto) { return is_supported(Kernel::avx2); })) {
  Random random(503);
  BoundsCheck check("from afar", cloud(random, {0, 0, 0}, 1, 1, 100));
  for (int i = 0; i != 2000; ++i) {
    aim(check, random, random.over_decades(1e1, 1e4) * random.direction(), SurfaceId::none, {});
  }
}
BOOST_AUTO_TEST_SUITE_END()
#endif
