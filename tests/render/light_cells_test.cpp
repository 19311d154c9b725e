// SPDX-License-Identifier: BSD-3-Clause
// Shadow rays looked up from the light's side against every sphere tried: the same answers, whatever was asked before.
#include "render/light_cells.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <deque>
#include <numeric>
#include <string>
#include <vector>

#include "render/kernels.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"
#include "render/vertex.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr std::size_t kRoom = std::size_t{64} << 20;
constexpr std::size_t kAsked = 100'000;
constexpr std::size_t kSizes[] = {500, 0, 1, 64, 63, 65};

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
    const auto& spheres = scene_.data().spheres;
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

SceneData with_materials() {
  SceneData data;
  for (int i = 0; i != 3; ++i) add_material(data, matte());
  return data;
}
void put(SceneData& data, const Vec3& center, double radius) {
  data.spheres.push_back({center, radius, MaterialIndex{0}});
}

SceneData cloud(int count, double least_radius, double most_radius) {
  SceneData data = with_materials();
  Random random(133);
  for (int i = 0; i != count; ++i) put(data, random.in_box(1), random.over_decades(least_radius, most_radius));
  return data;
}

/// From everywhere: far, near, among the spheres, in a direction.
void add_lights(SceneData& data) {
  add_point_light(data, {3, 4, 5});
  add_point_light(data, {1.2, -0.4, 1.1});
  add_point_light(data, {0.3, 0.2, -0.1});
  add_directional_light(data, {0.2, -0.3, -1});
}

bool has_cells() {
  return is_supported(Kernel::avx2);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(light_cells)

BOOST_AUTO_TEST_CASE(shadows_are_those_of_brute_force_in_every_kind_of_scene) {
  for (const SceneKind& kind : scene_kinds()) {
    for (const std::uint64_t seed : {135U, 136U}) {
      SceneData data = random_scene(kind, seed);
      add_point_light(data, data.spheres[1].center);
      add_point_light(data, data.spheres[2].center + Vec3{data.spheres[2].radius, 0, 0});
      CellsCheck check(kind.name, data);
      check.look_from_box(kind.center, 2 * kind.size, 24, 500);
      check.ask_all();
    }
  }
}

BOOST_AUTO_TEST_CASE(cells_decide_most_rays_of_ordinary_scenes) {
  for (const int count : {30, 3000}) {
    SceneData data = count == 30 ? cloud(30, 0.1, 0.4) : cloud(3000, 0.005, 0.05);
    add_plane(data, {0, 0, -1}, {0, 0, 1});
    add_lights(data);
    CellsCheck check("cloud of " + std::to_string(count), data);
    Random random(145);
    for (int i = 0; i != 4; ++i) {
      check.points().see(check.scene(), random.in_box(2) + Vec3{0, 0, 3}, random.in_box(0.5), 0.1, 2000, random);
    }
    const LightCells::Counts counts = check.ask_all();
    if (!has_cells()) continue;
    BOOST_TEST(counts.decided > counts.left, count << " spheres");
    BOOST_TEST(counts.made > 100U, count << " spheres");
  }
}

BOOST_AUTO_TEST_CASE(cells_with_too_many_spheres_are_divided) {
  SceneData data = cloud(10, 0.01, 0.1);
  Random random(146);
  for (int i = 0; i != 2000; ++i) put(data, random.in_box(0.1), random.over_decades(2e-4, 2e-3));
  add_lights(data);
  CellsCheck check("dust", data);
  for (int i = 0; i != 8; ++i) check.points().see(check.scene(), random.direction(), {0, 0, 0}, 0.1, 500, random);
  const LightCells::Counts counts = check.ask_all();
  if (!has_cells()) return;
  BOOST_TEST(counts.decided > counts.left);
  BOOST_TEST(counts.divided > 10U);
}

BOOST_AUTO_TEST_CASE(other_kernels_have_no_cells) {
  SceneData data = cloud(30, 0.1, 0.4);
  add_lights(data);
  for (const Kernel kernel : {Kernel::scalar, Kernel::brute}) {
    CellsCheck check("no cells", data, kernel);
    check.look_from_box({0, 0, 1}, 2, 8, 500);
    const LightCells::Counts counts = check.ask_all();
    BOOST_TEST(counts.decided == 0U);
    BOOST_TEST(counts.made == 0U);
  }
}

// A tree without a node, and a scene without anything.
BOOST_AUTO_TEST_CASE(scenes_without_spheres_are_lit) {
  for (int i = 0; i != 2; ++i) {
    SceneData data = with_materials();
    if (i == 1) put(data, {0, 0, 1}, 0);
    add_plane(data, {0, 0, -1}, {0, 0, 1});
    add_lights(data);
    CellsCheck check("plane", data);
    Random random(137);
    check.points().see(check.scene(), {0, 0, 1}, {0, 0, -1}, 0.5, 3000, random);
    check.ask_all();
  }
}

BOOST_AUTO_TEST_CASE(little_memory_changes_no_answer) {
  SceneData data = cloud(3000, 0.005, 0.05);
  add_lights(data);
  CellsCheck check("little memory", data);
  check.look_from_box({0, 0, 1}, 2, 10, 1000);
  for (const std::size_t bytes :
       {std::size_t{0}, std::size_t{1000}, std::size_t{4096 * 32}, std::size_t{200'000}, std::size_t{250'000}}) {
    for (const std::size_t light : {0U, 2U, 3U}) {
      const auto counts = check.ask(light, bytes);
      BOOST_TEST(counts.made * sizeof(TreeLeaf) <= bytes + 4 * sizeof(TreeLeaf));
      if (bytes <= 4096 * 32) BOOST_TEST(counts.made == 0U);
    }
  }
}

BOOST_AUTO_TEST_CASE(shadows_on_a_huge_floor) {
  for (const double radius : {1e3, 1e7}) {
    SceneData data = with_materials();
    Random random(138);
    put(data, {0, 0, -radius}, radius);
    for (int i = 0; i != 2000; ++i) {
      const double r = random.over_decades(0.002, 0.03);
      put(data, {random.uniform(-1, 1), random.uniform(-1, 1), i % 2 == 0 ? r : 3 * r}, r);
    }
    add_point_light(data, {0.5, 0.2, 3});
    add_point_light(data, {-2, 1, 0.2});
    add_point_light(data, {0, 0, 0});
    add_directional_light(data, {0.5, 0.1, -0.3});
    CellsCheck check("floor of " + std::to_string(radius), data);
    for (int i = 0; i != 10; ++i) {
      check.points().see(check.scene(), {random.uniform(-2, 2), -3, 1}, {random.uniform(-1, 1), 0.2, 0}, 0.2, 800,
                         random);
    }
    check.ask_all();
  }
}

BOOST_AUTO_TEST_CASE(shadows_of_many_spheres_in_one_line) {
  SceneData data = with_materials();
  Random random(139);
  for (int i = 0; i != 3000; ++i) put(data, 0.001 * i * normalized(Vec3{1, 2, 3}), 0.01 + 1e-5 * (i % 7));
  add_point_light(data, 3.2 * normalized(Vec3{1, 2, 3}));
  add_point_light(data, 20 * normalized(Vec3{1, 2, 3}));
  add_directional_light(data, {-1, -2, -3});
  add_plane(data, {0, 0, -0.2}, {0, 0, 1});
  CellsCheck check("line", data);
  for (int i = 0; i != 4; ++i) {
    check.points().see(check.scene(), random.in_box(1) + Vec3{0, 0, 1}, {0, 0, -0.2}, 0.05, 1000, random);
    check.points().see(check.scene(), random.in_box(1) + Vec3{0, 0, 1}, {0.5, 1, 1.5}, 0.1, 500, random);
  }
  check.ask_all();
}

// Copies begin where their originals do, so nothing tells which are nearest.
BOOST_AUTO_TEST_CASE(shadows_of_thousands_of_copies) {
  SceneData data = with_materials();
  for (int i = 0; i != 4000; ++i) put(data, {i % 2 * 0.5, 0, 0}, 0.2);
  add_plane(data, {0, 0, -0.4}, {0, 0, 1});
  add_point_light(data, {1, 2, 3});
  add_directional_light(data, {0.3, 0.1, -1});
  CellsCheck check("copies", data);
  Random random(140);
  check.points().see(check.scene(), {0.2, -2, 2}, {0, 0, -0.4}, 0.5, 3000, random);
  check.ask_all();
}

// A cluster among great spheres; lights in it too, which all float coordinates are coarse for.
BOOST_AUTO_TEST_CASE(shadows_of_radii_over_decades) {
  for (const double smallest : {1e-6, 1e-10}) {
    SceneData data = with_materials();
    Random random(141);
    const Vec3 middle{0.3, 0.4, 0.1};
    for (int i = 0; i != 400; ++i) put(data, random.in_box(1), random.over_decades(1e-6, 0.1));
    for (int i = 0; i != 400; ++i) put(data, middle + smallest * 20 * random.in_box(1), smallest * random.uniform());
    add_point_light(data, middle);
    add_point_light(data, middle + smallest * Vec3{60, -70, 80});
    add_point_light(data, {3, 2, 1});
    add_directional_light(data, {-0.2, 0.1, 0.3});
    add_plane(data, {0, 0, -1}, {0, 0.1, 1});
    CellsCheck check("decades to " + std::to_string(std::log10(smallest)), data);
    for (int i = 0; i != 6; ++i) {
      const Vec3 eye = middle + smallest * 100 * random.direction();
      check.points().see(check.scene(), eye, middle, smallest * 20, 500, random);
      check.points().see(check.scene(), random.in_box(2), random.in_box(1), 0.2, 500, random);
    }
    check.ask_all();
  }
}

BOOST_AUTO_TEST_CASE(shadows_far_from_the_origin) {
  for (const double offset : {1e3, 1e6, 1e9, 1e12}) {
    SceneData data = cloud(300, 0.02, 0.2);
    add_lights(data);
    add_plane(data, {0, 0, -2}, {0, 0, 1});
    const Vec3 moved = offset * Vec3{1, 0.7, -0.9};
    for (Sphere& sphere : data.spheres) sphere.center = sphere.center + moved;
    for (Light& light : data.lights) {
      if (light.kind == LightKind::point) light.vector = light.vector + moved;
    }
    data.planes[0].point = data.planes[0].point + moved;
    CellsCheck check("at " + std::to_string(offset), data);
    check.look_from_box(moved, 2, 8, 1000);
    check.ask_all();
  }
}

BOOST_AUTO_TEST_CASE(shadows_at_every_scale) {
  for (const int k : {-100, -40, 40, 100}) {
    SceneData data = cloud(200, 0.02, 0.2);
    add_lights(data);
    add_point_light(data, {1e3, 2, 3});
    add_point_light(data, {1e12, 2e12, 3});
    for (Sphere& sphere : data.spheres) {
      sphere.center = std::ldexp(1.0, k) * sphere.center;
      sphere.radius = std::ldexp(sphere.radius, k);
    }
    for (Light& light : data.lights) light.vector = std::ldexp(1.0, k) * light.vector;
    CellsCheck check("scale " + std::to_string(k), data);
    check.look_from_box({0, 0, 0}, std::ldexp(2, k), 8, 1000);
    check.ask_all();
  }
}

// Within some ulps of touching a sphere, before it, behind it, and at the very point.
BOOST_AUTO_TEST_CASE(rays_that_graze_a_sphere) {
  Random random(142);
  SceneData data = cloud(60, 0.01, 0.3);
  add_lights(data);
  add_point_light(data, {40, 50, 60});
  data.spheres[0] = {{2, 0, 0}, 0.25, MaterialIndex{0}};
  add_point_light(data, {2, 0, 0.25});
  CellsCheck check("grazing", data);
  const Region region = region_at(check.scene(), {2, 2, 2}, {1, 0, 0});
  for (std::size_t light = 0; light != data.lights.size(); ++light) {
    const bool is_point = data.lights[light].kind == LightKind::point;
    std::vector<RayInRegion> rays;
    while (rays.size() < 20000) {
      const Sphere& sphere = data.spheres[random.flip() ? 0 : random.below(60)];
      const double rim = sphere.radius * (1 + (random.flip() ? 1 : -1) * random.over_decades(1e-17, 1e-5));
      Vec3 unit = normalized(data.lights[light].vector);
      Vec3 touched = sphere.center + rim * random.perpendicular_to(unit);
      if (is_point) {
        const Vec3 way = sphere.center - data.lights[light].vector;
        const double distance = length(way);
        if (distance <= rim) continue;
        const double sine = rim / distance;
        const Vec3 aside = random.perpendicular_to(way);
        unit = normalized(std::sqrt(1 - sine * sine) / distance * way + sine * aside);
        touched = data.lights[light].vector + std::sqrt(distance * distance - rim * rim) * unit;
      }
      const double beyond[] = {0, -1e-16, 1e-16, random.uniform(-0.1, 0.1), random.over_decades(1e-9, 10)};
      const Vec3 point = touched + beyond[random.below(5)] * unit;
      rays.push_back({{.origin = point, .direction = way_to(data.lights[light], point)}, &region});
    }
    check.ask(light, rays, kRoom);
  }
}

// A shadow falls as far as one likes, but what a ray is rounded by grows: onto spheres as small as that.
BOOST_AUTO_TEST_CASE(rays_from_far_away_that_graze_a_sphere) {
  Random random(143);
  for (const double size : {1.0, 1e-12, 1e-40}) {
    SceneData data = with_materials();
    for (int i = 0; i != 60; ++i) put(data, size * random.in_box(1), size * random.over_decades(1e-9, 0.3));
    add_point_light(data, {0, 0, 0});
    add_point_light(data, size * Vec3{2, 3, 4});
    add_directional_light(data, {0.2, -0.3, -1});
    add_directional_light(data, {0, -0.0, 1});
    CellsCheck check("far from size " + std::to_string(std::log10(size)), data);
    const Region region = region_at(check.scene(), size * Vec3{2, 2, 2}, {1, 0, 0});
    for (std::size_t light = 0; light != data.lights.size(); ++light) {
      const Light& from = data.lights[light];
      std::vector<RayInRegion> rays;
      while (rays.size() < 4000) {
        const Sphere& sphere = data.spheres[random.below(60)];
        const Vec3 aim = sphere.center + sphere.radius * (1 + 1e-3 * random.uniform(-1, 1)) * random.direction();
        const Vec3 unit = from.kind == LightKind::point ? normalized(aim - from.vector) : normalized(from.vector);
        double distance = size * random.over_decades(1, 1e5);
        if (rays.size() % 16 == 0) distance = size * random.over_decades(1e9, 1e14);
        if (rays.size() % 16 == 1) distance = random.over_decades(1, 1e12);
        const Vec3 point = aim + distance * (random.below(16) == 0 ? -1 : 1) * unit;
        rays.push_back({{.origin = point, .direction = way_to(from, point)}, &region});
      }
      check.ask(light, rays, kRoom);
    }
  }
}

// Rays that leave the one sphere in their way, along its surface and through it.
BOOST_AUTO_TEST_CASE(spheres_do_not_shade_their_own_points) {
  SceneData data = with_materials();
  put(data, {0, 0, 0}, 1);
  put(data, {3, 0, 0}, 0.5);
  add_point_light(data, {0.2, 0.1, 4});
  add_point_light(data, {0, 0, 1});
  add_directional_light(data, {0, 0, -1});
  CellsCheck check("own points", data);
  const Region region = region_at(check.scene(), {5, 5, 5}, {1, 0, 0});
  Random random(144);
  for (int i = 0; i != 20000; ++i) {
    Vec3 normal = random.direction();
    if (i % 4 == 0) normal = normalized(Vec3{normal.x, normal.y, 1e-9 * normal.z});
    check.points().all.push_back({{surface_id(0), normal, normal}, &region});
  }
  check.ask_all();
}

BOOST_AUTO_TEST_SUITE_END()
