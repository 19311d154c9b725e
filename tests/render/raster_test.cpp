// SPDX-License-Identifier: BSD-3-Clause
// Spheres drawn against rays traced: what the raster says of first spheres is so, it says it of nearly all rays, and
// pictures are the same bits.
#include "render/raster.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "render/kernel.h"
#include "render/random.h"
#include "render/same_bits.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

bool runs_here() {
  if (is_supported(Kernel::avx2)) return true;
  BOOST_TEST_MESSAGE("not tested: this machine has no AVX2");
  return false;
}

/// Places of samples on one axis of a picture.
std::vector<double> places(std::uint32_t first, std::size_t count, std::uint32_t grid) {
  std::vector<double> result;
  for (std::uint32_t i = 0; i != count; ++i) result.push_back(first + (i + 0.5) / grid);
  return result;
}

Camera camera_at(const Vec3& eye, const Vec3& target, double fov, Random& random) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.up = random.perpendicular_to(target - eye);
  camera.fov = fov;
  if (random.flip()) camera.handedness = Handedness::left;
  return camera;
}

/// Draws blocks of pictures of one scene, and counts what is known of their rays.
class RasterCheck {
 public:
  RasterCheck(std::string name, const SceneData& data)
      : name_(std::move(name)),
        scene_(data, Kernel::avx2),
        scalar_(data, Kernel::scalar),
        bare_(without_planes(data), Kernel::scalar) {}
  ~RasterCheck() {
    BOOST_TEST(wrong_ == 0, name_ << ": " << wrong_ << " of " << rays_ << " first spheres are not");
    BOOST_TEST(unlike_ == 0, name_ << ": " << unlike_ << " of " << rays_ << " points differ");
    BOOST_TEST(rays_ > 0U, name_);
  }
  RasterCheck(const RasterCheck&) = delete;

  std::span<const Sphere> spheres() const { return scene_.spheres(); }
  double rays() const { return static_cast<double>(rays_); }
  double unsure() const { return static_cast<double>(unsure_); }
  double entered() const { return static_cast<double>(entered_); }

  /// A block of a picture of `size` x `size` pixels.
  void draw(const Camera& camera, std::uint32_t size, std::uint32_t grid, Random& random) {
    const CameraRays rays(camera, size, size);
    const Placement placement = scene_.placement_of(camera.eye);
    if (!placement.touching.empty()) return;
    const Region region(scene_, placement, camera.eye, camera.target - camera.eye);
    const auto columns = 1 + random.below(avx2::Raster::kSide);
    const auto rows = 1 + random.below(avx2::Raster::kSide);
    const auto x = places(random.below(size), columns, grid);
    const auto y = places(random.below(size), rows, grid);
    avx2::Raster raster(scene_, rays, region);
    DrawingRecord record;
    const bool any = raster.draw(x, y, record);

    std::vector<RayInRegion> block;
    std::vector<SurfaceId> known;
    for (std::size_t row = 0; row != rows; ++row) {
      for (std::size_t column = 0; column != columns; ++column) {
        block.push_back({rays.through(x[column], y[row]), &region});
        known.push_back(any ? raster.first_sphere(column, row) : SurfaceId::none);
      }
    }
    check(block, known, region);
  }

 private:
  static SceneData without_planes(SceneData data) {
    data.planes.clear();
    return data;
  }

  void check(const std::vector<RayInRegion>& block, const std::vector<SurfaceId>& known, const Region& region) {
    std::vector<std::optional<SurfacePoint>> points(block.size());
    avx2::nearest_hits(scene_, block, known, points);
    for (std::size_t i = 0; i != block.size(); ++i) {
      ++rays_;
      unsure_ += known[i] == kUnsureSphere;
      unlike_ += !same_bits(points[i], nearest_hit(scalar_, block[i].ray, region));
      // Every sphere is before the walls but those behind other walls: there is no saying from the hit alone.
      const auto hit = nearest_hit(bare_, block[i].ray, region);
      const bool enters = hit && !region.is_inside(hit->surface);
      entered_ += enters;
      if (known[i] == kUnsureSphere || (!enters && !region.walls().empty())) continue;
      wrong_ += known[i] != (hit ? hit->surface : SurfaceId::none);
    }
  }

  std::string name_;
  Scene scene_;
  Scene scalar_;
  Scene bare_;  ///< without planes
  std::size_t rays_ = 0;
  std::size_t unsure_ = 0;
  std::size_t entered_ = 0;
  std::size_t wrong_ = 0;
  std::size_t unlike_ = 0;
};

const Sphere& one_of(Random& random, std::span<const Sphere> spheres) {
  return spheres[random.below(static_cast<std::uint32_t>(spheres.size()))];
}

/// Eyes anywhere about a scene, also inside of spheres and in points where they touch.
void draw_about(RasterCheck& check, Random& random, const Vec3& center, double size, int count) {
  for (int i = 0; i != count; ++i) {
    const Sphere& aim = one_of(random, check.spheres());
    const Vec3 target = aim.center + random.in_box(1.2 * aim.radius);
    Vec3 eye = center + random.over_decades(0.1, 10) * size * random.direction();
    if (i % 4 == 1) eye = aim.center + random.in_box(0.5 * aim.radius);
    if (i % 4 == 2) eye = aim.center + random.over_decades(1, 2) * aim.radius * random.direction();
    if (eye == target) continue;
    const double fovs[] = {1e-3, 1, 40, 100, 170};
    check.draw(camera_at(eye, target, fovs[random.below(5)], random), 1 + random.below(300), 1 + random.below(4),
               random);
  }
}

SceneData one_material() {
  SceneData data;
  add_material(data, matte());
  return data;
}

void put(SceneData& data, const Vec3& center, double radius) {
  data.spheres.push_back({center, radius, MaterialIndex{0}});
}

SceneData cloud_data(Random& random, int count, double smallest, double largest) {
  SceneData data = one_material();
  for (int i = 0; i != count; ++i) put(data, random.in_box(1), random.over_decades(smallest, largest));
  return data;
}

Image picture(const SceneData& data, Kernel kernel, const Rect& tile, RayCounts& counts) {
  const Scene scene(data, kernel);
  Image image(tile.width, tile.height, PixelFormat::rgb32f);
  counts = TileRenderer(scene, image.format).render(tile, {image.bytes}, [] {});
  return image;
}

void check_picture(SceneData data, std::uint32_t width, std::uint32_t height, std::uint32_t samples,
                   const std::string& what) {
  data.image.width = width;
  data.image.height = height;
  data.image.samples = samples;
  data.image.max_bounces = 2;
  RayCounts expected_counts;
  RayCounts counts;
  const Image expected = picture(data, Kernel::scalar, {0, 0, width, height}, expected_counts);
  const Image image = picture(data, Kernel::avx2, {0, 0, width, height}, counts);
  BOOST_TEST((image.bytes == expected.bytes), what << ", " << width << "x" << height << ", " << samples << " samples");
  BOOST_TEST((counts == expected_counts), what << ", " << width << "x" << height << ", " << samples << " samples");
}

}  // namespace

BOOST_AUTO_TEST_SUITE(raster)

BOOST_AUTO_TEST_CASE(first_spheres_are_first_in_every_kind_of_scene) {
  if (!runs_here()) return;
  for (const SceneKind& kind : scene_kinds()) {
    for (const std::uint64_t seed : {121U, 122U}) {
      Random random(seed);
      RasterCheck check(kind.name + ", " + std::to_string(seed), random_scene(kind, seed));
      draw_about(check, random, kind.center, kind.size, 150);
    }
  }
}

BOOST_AUTO_TEST_CASE(nearly_all_rays_of_an_ordinary_picture_are_sure) {
  if (!runs_here()) return;
  Random random(123);
  for (const double smallest : {0.1, 0.01}) {
    RasterCheck check("ordinary", cloud_data(random, 300, smallest, 0.1));
    for (int i = 0; i != 200; ++i) {
      check.draw(camera_at(random.uniform(2.5, 4) * random.direction(), random.in_box(0.3), 35, random), 600, 1,
                 random);
    }
    BOOST_TEST(check.unsure() < 0.002 * check.rays());
    BOOST_TEST(check.entered() > 0.1 * check.rays());
  }
}

// Narrow pictures of rims: on both sides of them are rays that meet and rays that miss by less than a float can tell.
BOOST_AUTO_TEST_CASE(first_spheres_at_the_rims_of_others_are_first) {
  if (!runs_here()) return;
  Random random(124);
  RasterCheck check("rims", cloud_data(random, 100, 1e-4, 0.3));
  for (int i = 0; i != 1500; ++i) {
    const Sphere& aim = one_of(random, check.spheres());
    const double distance = aim.radius * random.over_decades(1.001, 1e3);
    const Vec3 eye = aim.center + distance * random.direction();
    // A tangent touches at the angle from the centre whose sine is r / distance.
    const double sine = aim.radius / distance;
    const double cosine = std::sqrt(1 - sine * sine);
    const Vec3 toward = normalized(aim.center - eye);
    const Vec3 rim = eye + distance * cosine * (cosine * toward + sine * random.perpendicular_to(toward));
    check.draw(camera_at(eye, rim, random.over_decades(1e-7, 10), random), 1 + random.below(20), 1, random);
  }
  BOOST_TEST(check.unsure() < 0.9 * check.rays());
  BOOST_TEST(check.entered() > 0.2 * check.rays());
}

BOOST_AUTO_TEST_CASE(first_of_spheres_that_lie_close_behind_each_other_is_first) {
  if (!runs_here()) return;
  Random random(125);
  for (int k = 1; k != 13; ++k) {
    SceneData data = one_material();
    for (int i = 0; i != 12; ++i) {
      const Vec3 center = random.in_box(1);
      const double radius = random.uniform(0.1, 0.4);
      put(data, center, radius);
      put(data, center, radius * (1 + std::pow(10, -k)));
      put(data, center + std::pow(10, -k) * random.direction(), radius);
    }
    RasterCheck check("shells " + std::to_string(k), data);
    draw_about(check, random, {}, 1, 60);
    // Once nothing can be told apart, nothing may be said to be.
    if (k > 9) BOOST_TEST(check.unsure() > 0.5 * check.entered());
  }
}

// From far away, where the eye's own coordinates round to more than spheres are large.
BOOST_AUTO_TEST_CASE(first_spheres_seen_from_afar_are_first) {
  if (!runs_here()) return;
  Random random(126);
  for (const double distance : {1e1, 1e2, 1e3, 1e5, 1e7, 1e12}) {
    RasterCheck check("from " + std::to_string(std::log10(distance)), cloud_data(random, 60, 1e-2, 0.3));
    for (int i = 0; i != 100; ++i) {
      check.draw(camera_at(distance * random.direction(), {}, 60 / distance, random), 100, 1, random);
    }
  }
}

BOOST_AUTO_TEST_CASE(first_spheres_beside_large_ones_are_first) {
  if (!runs_here()) return;
  Random random(127);
  for (const double large : {10.0, 1e3, 1e6}) {
    SceneData data = cloud_data(random, 40, 0.01, 0.1);
    put(data, {0, 0, -large - 1}, large);
    RasterCheck check("over " + std::to_string(large), data);
    for (int i = 0; i != 200; ++i) {
      const Vec3 eye{random.uniform(-2, 2), random.uniform(-2, 2), -1 + random.over_decades(1e-6, 2)};
      check.draw(camera_at(eye, random.in_box(1), 90, random), 200, 1, random);
    }
  }
}

BOOST_AUTO_TEST_CASE(blocks_of_very_many_small_spheres_hold_the_first) {
  if (!runs_here()) return;
  Random random(128);
  RasterCheck check("dust", cloud_data(random, 20000, 1e-4, 1e-2));
  for (int i = 0; i != 60; ++i) {
    check.draw(camera_at(random.uniform(0.1, 4) * random.direction(), {}, 50, random), 100, 1, random);
  }
  BOOST_TEST(check.unsure() < 0.02 * check.rays());
}

BOOST_AUTO_TEST_CASE(drawn_pictures_are_those_of_the_scalar_kernel) {
  if (!runs_here()) return;
  std::uint64_t seed = 131;
  for (const SceneKind& kind : scene_kinds()) {
    Random random(++seed);
    SceneData data = random_scene(kind, seed);
    const Sphere& aim = one_of(random, data.spheres);
    const Vec3 inside = aim.center + 0.3 * aim.radius * random.direction();
    for (const Vec3& eye : {kind.center + 2 * kind.size * random.direction(), inside}) {
      for (const double fov : {1e-3, 50.0, 170.0}) {
        if (eye == kind.center) continue;
        data.camera = camera_at(eye, kind.center, fov, random);
        check_picture(data, 1, 1, 4, kind.name);
        check_picture(data, 37, 19, 1, kind.name);
        check_picture(data, 7, 5, 9, kind.name);
      }
      data.camera = camera_at(eye, kind.center, 60, random);
      check_picture(data, 19, 3, 16, kind.name);
      check_picture(data, 3, 4, 64, kind.name);
      check_picture(data, 2, 1, 289, kind.name);
    }
  }
}

BOOST_AUTO_TEST_CASE(drawing_is_left_off_where_it_does_not_pay_and_tried_again) {
  DrawingRecord record;
  BOOST_TEST(record.pays());
  record.add(256, 10 * DrawingRecord::kTracingCost * 256);
  BOOST_TEST(!record.pays());
  int skipped = 0;
  for (; !record.pays(); ++skipped) record.skip(256);
  BOOST_TEST(skipped == 9 * 16);
  for (int i = 0; i != 1000; ++i) record.add(256, 256 * 10);
  BOOST_TEST(record.pays());
  // It forgets what was long ago.
  int bad = 0;
  for (; record.pays(); ++bad) record.add(256, 10 * DrawingRecord::kTracingCost * 256);
  BOOST_TEST(bad < 50);
}

BOOST_AUTO_TEST_SUITE_END()
