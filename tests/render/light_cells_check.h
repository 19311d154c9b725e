// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <deque>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "render/kernels.h"
#include "render/light_cells.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"
#include "render/vertex.h"

// Shadow rays looked up from the light's side against every sphere tried: the same answers, whatever was asked before.
namespace tessera::render::test {

inline constexpr std::size_t kRoom = std::size_t{64} << 20;
inline constexpr std::size_t kAsked = 100'000;
inline constexpr std::size_t kSizes[] = {500, 0, 1, 64, 63, 65};

/// Points on surfaces, and the regions that they are seen in.
struct Points {
  struct Point {
    SurfacePoint at;
    const Region* region;
  };
  std::deque<Region> regions;
  std::vector<Point> all;

  void add(const std::optional<Hit>& hit, const Region& region) {
    if (hit) all.push_back({*hit, &region});
  }

  /// What an eye sees in a few narrow directions, and what mirrors there show: many points, close to each other.
  void see(const Scene& scene, const Vec3& eye, const Vec3& target, double width, int rays, Random& random) {
    const Vec3 axis = target - eye;
    if (axis == Vec3{}) return;
    const Region& region = regions.emplace_back(region_at(scene, eye, axis));
    for (int i = 0; i != rays; ++i) {
      const Vec3 d = axis + random.in_box(width);
      if (d == Vec3{}) continue;
      const auto hit = nearest_hit(scene, {.origin = eye, .direction = d}, region);
      add(hit, region);
      if (!hit || i % 4 != 0) continue;
      const Vec3 mirrored = d - 2 * dot(d, hit->normal) * hit->normal;
      add(nearest_hit(scene, {hit->point, mirrored, hit->surface, hit->normal}, region), region);
    }
  }
};

/// A scene, as it is and for brute force, and points in it that light falls on.
class CellsCheck {
 public:
  CellsCheck(std::string name, const SceneData& data, Kernel kernel = Kernel::automatic)
      : name_(std::move(name)), scene_(data, kernel), brute_(data, Kernel::brute) {}

  const Scene& scene() const { return scene_; }
  Points& points() { return points_; }

  /// From eyes in a box, and some in and on spheres, towards spheres.
  void look_from_box(const Vec3& center, double half_side, int eyes, int rays) {
    Random random(131);
    const auto spheres = scene_.spheres();
    const auto some = [&] { return spheres[random.below(static_cast<std::uint32_t>(spheres.size()))]; };
    for (int i = 0; i != eyes; ++i) {
      const Sphere aim = some();
      const Sphere at = some();
      Vec3 eye = center + random.in_box(half_side);
      if (i % 8 == 3) eye = at.center + random.in_box(0.5 * at.radius);
      if (i % 8 == 5) eye = at.center + Vec3{0, at.radius, 0};
      points_.see(scene_, eye, aim.center, std::max(1.1 * aim.radius, 0.1 * half_side), rays, random);
    }
  }

  std::vector<RayInRegion> rays_to(std::size_t light) const {
    std::vector<RayInRegion> rays;
    for (const auto& [at, region] : points_.all) {
      const Vec3 way = way_to(scene_.data().lights[light], at.point);
      if (way == Vec3{} || dot(at.normal, way) == 0) continue;
      // In the shade of its own sphere is one point in eight, which no renderer would ask for.
      const bool faces = dot(facing_normal(scene_, at, *region), way) > 0;
      if (!faces && rays.size() % 8 != 0) continue;
      rays.push_back({ray_to_light(at, way), region});
    }
    return rays;
  }

  /// Asks for everything at least three times, in batches of all sizes and in different orders: often enough for cells
  /// to be made, divided and given up.
  LightCells::Counts ask(std::size_t light, std::size_t most_bytes = kRoom) const {
    return ask(light, rays_to(light), most_bytes);
  }
  LightCells::Counts ask(std::size_t light, const std::vector<RayInRegion>& rays, std::size_t most_bytes) const {
    std::vector<std::uint8_t> expected;
    expected.reserve(rays.size());
    for (const auto& [ray, region] : rays) expected.push_back(is_occluded(brute_, ray, light, *region) ? 1 : 0);
    LightCells cells(scene_, light, most_bytes);
    std::vector<std::size_t> order(rays.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<RayInRegion> batch;
    std::vector<std::uint8_t> occluded;
    int differences = 0;
    std::uint64_t asked = 0;
    const std::size_t times = 3 + kAsked / std::max<std::size_t>(rays.size(), 1000);
    for (std::size_t time = 0; time != times; ++time) {
      if (time == 1) std::reverse(order.begin(), order.end());
      if (time >= 2) shuffle(order);
      std::size_t next = 0;
      for (std::size_t i = 0; next != order.size(); ++i) {
        const std::size_t size = std::min(kSizes[i % std::size(kSizes)], order.size() - next);
        batch.clear();
        for (std::size_t k = 0; k != size; ++k) batch.push_back(rays[order[next + k]]);
        occluded.assign(size, 7);
        cells.occlusions(batch, occluded);
        for (std::size_t k = 0; k != size; ++k) differences += occluded[k] != expected[order[next + k]];
        next += size;
        asked += size;
      }
    }
    const LightCells::Counts counts = cells.counts();
    const auto shadows = std::accumulate(expected.begin(), expected.end(), 0);
    BOOST_TEST_MESSAGE(name_ << ", light " << light << ": " << rays.size() << " rays, " << shadows << " occluded; "
                             << counts.decided << " decided, " << counts.made << " made, " << counts.divided
                             << " divided");
    BOOST_TEST(differences == 0, name_ << ", light " << light << ": " << differences << " answers differ");
    BOOST_TEST(counts.decided + counts.left == asked, name_);
    return counts;
  }

  /// The same for all lights; returns all counts together.
  LightCells::Counts ask_all() const {
    LightCells::Counts sum;
    for (std::size_t light = 0; light != scene_.data().lights.size(); ++light) {
      const LightCells::Counts counts = ask(light);
      sum.decided += counts.decided;
      sum.left += counts.left;
      sum.made += counts.made;
      sum.divided += counts.divided;
    }
    return sum;
  }

 private:
  static void shuffle(std::vector<std::size_t>& order) {
    static Random random(132);
    for (std::size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    }
  }

  std::string name_;
  Scene scene_;
  Scene brute_;
  Points points_;
};

inline SceneData with_materials() {
  SceneData data;
  for (int i = 0; i != 3; ++i) add_material(data, matte());
  return data;
}
inline void put(SceneData& data, const Vec3& center, double radius) {
  data.spheres.push_back({center, radius, MaterialIndex{0}});
}

inline SceneData cloud(int count, double least_radius, double most_radius) {
  SceneData data = with_materials();
  Random random(133);
  for (int i = 0; i != count; ++i) put(data, random.in_box(1), random.over_decades(least_radius, most_radius));
  return data;
}

/// From everywhere: far, near, among the spheres, in a direction.
inline void add_lights(SceneData& data) {
  add_point_light(data, {3, 4, 5});
  add_point_light(data, {1.2, -0.4, 1.1});
  add_point_light(data, {0.3, 0.2, -0.1});
  add_directional_light(data, {0.2, -0.3, -1});
}

inline bool has_cells() {
  return is_supported(Kernel::avx2);
}

}  // namespace tessera::render::test
