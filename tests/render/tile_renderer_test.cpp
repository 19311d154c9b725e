// SPDX-License-Identifier: BSD-3-Clause
#include "render/tile_renderer.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstring>

#include "render/image_difference.h"
#include "render/scene_fixture.h"
#include "render/scene_kinds.h"
#include "render/tile.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

constexpr PixelFormat kFormats[] = {PixelFormat::rgb8, PixelFormat::rgb16, PixelFormat::rgb32f};

/// A busy little scene with mirrors, a checker floor and shadows.
SceneData busy_scene(std::uint32_t width = 37, std::uint32_t height = 23) {
  SceneData scene = random_scene(scene_kinds()[1], 171);
  scene.camera = Camera{.eye = {-7, -6, 5}, .target = {0, 0, 0}};
  scene.image.width = width;
  scene.image.height = height;
  return scene;
}

/// The bytes of one rectangle, cut out of the whole picture.
std::vector<std::byte> cut(const Image& image, const Rect& rect) {
  const std::size_t pixel = bytes_per_pixel(image.format);
  std::vector<std::byte> bytes;
  for (std::uint32_t y = rect.y; y != rect.y + rect.height; ++y) {
    const auto row = image.bytes.begin() + static_cast<std::ptrdiff_t>((std::size_t{y} * image.width + rect.x) * pixel);
    bytes.insert(bytes.end(), row, row + static_cast<std::ptrdiff_t>(rect.width * pixel));
  }
  return bytes;
}

double green(const Image& image, std::size_t x, std::size_t y) {
  return channel_value(image, 3 * (y * image.width + x) + 1);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tile_renderer)

// Any rectangle alone has the bytes that it has in the whole picture, in every format, with samples, from any camera.
BOOST_AUTO_TEST_CASE(pixels_do_not_depend_on_the_rectangle_they_are_rendered_in) {
  Random random(172);
  for (const PixelFormat format : kFormats) {
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
      SceneData data = busy_scene();
      data.camera->projection = projection;
      data.camera->height = 8;
      data.image.samples = format == PixelFormat::rgb16 ? 4 : 1;
      const Scene scene(data, Kernel::automatic);
      const Image whole = render_picture(scene, format);
      for (int i = 0; i != 25; ++i) {
        const std::uint32_t x = random.below(37);
        const std::uint32_t y = random.below(23);
        const Rect rect{x, y, 1 + random.below(37 - x), 1 + random.below(23 - y)};
        BOOST_TEST((render_rect(scene, rect, format).bytes == cut(whole, rect)));
      }
    }
  }
}

// One renderer for all tiles, in the reverse order: what it carries from one to the next changes nothing.
BOOST_AUTO_TEST_CASE(every_tiling_gives_the_same_picture) {
  const Scene scene(busy_scene(), Kernel::automatic);
  const TileRenderer renderer(scene, PixelFormat::rgb32f);
  const Image whole = render_picture(scene, PixelFormat::rgb32f);
  for (const std::uint32_t side : {1U, 2U, 5U, 8U, 16U, 1024U}) {
    std::vector<Rect> tiles = tile_grid({0, 0, 37, 23}, side, side + 1);
    std::reverse(tiles.begin(), tiles.end());
    for (const Rect& tile : tiles) {
      Image part(tile.width, tile.height, PixelFormat::rgb32f);
      renderer.render(tile, {part.bytes}, [] {});
      BOOST_REQUIRE((part.bytes == cut(whole, tile)));
    }
  }
}

// By then most shadows are looked up, which another kernel never does.
BOOST_AUTO_TEST_CASE(renderer_that_has_seen_much_gives_the_same_picture) {
  const Rect rect{0, 0, 160, 120};
  const SceneData data = busy_scene(rect.width, rect.height);
  const Image whole = render_picture(Scene(data, Kernel::scalar), PixelFormat::rgb32f);
  const Scene scene(data, Kernel::automatic);
  const TileRenderer renderer(scene, PixelFormat::rgb32f);
  for (const std::uint32_t side : {160U, 40U, 11U, 160U, 25U, 64U}) {
    std::vector<Rect> tiles = tile_grid(rect, side, side);
    if (side % 2 != 0) std::reverse(tiles.begin(), tiles.end());
    for (const Rect& tile : tiles) {
      Image part(tile.width, tile.height, PixelFormat::rgb32f);
      renderer.render(tile, {part.bytes}, [] {});
      BOOST_REQUIRE((part.bytes == cut(whole, tile)));
    }
  }
}

BOOST_AUTO_TEST_CASE(both_kernels_give_the_same_bytes) {
  for (const SceneKind& kind : scene_kinds()) {
    SceneData data = random_scene(kind, 173);
    data.camera =
        framed_camera({kind.center - kind.size * Vec3{1, 1, 1}, kind.center + kind.size * Vec3{1, 1, 1}}, 40, 30);
    data.image.width = 40;
    data.image.height = 30;
    const Image in_tree = render_picture(Scene(data, Kernel::automatic), PixelFormat::rgb32f);
    BOOST_TEST((in_tree.bytes == render_picture(Scene(data, Kernel::brute), PixelFormat::rgb32f).bytes), kind.name);
  }
}

// Every pixel is what the ray through its centre sees.
BOOST_AUTO_TEST_CASE(pixels_are_sampled_at_their_centre) {
  const Scene scene(busy_scene(), Kernel::automatic);
  const Image image = render_picture(scene, PixelFormat::rgb32f);
  const CameraRays rays(*scene.data().camera, 37, 23);
  for (std::uint32_t y = 0; y != 23; ++y) {
    for (std::uint32_t x = 0; x != 37; ++x) {
      const Ray ray = rays.through(x + 0.5, y + 0.5);
      const double expected = static_cast<float>(seen_from(scene, ray.origin, ray.direction).g);
      BOOST_REQUIRE(green(image, x, y) == expected);
    }
  }
}

// samples = k^2: the average over a regular k x k grid, (i + 1/2) / k from the pixel's corner.
BOOST_AUTO_TEST_CASE(samples_are_averaged_over_a_regular_grid) {
  for (const std::uint32_t k : {2U, 3U, 5U}) {
    SceneData data = busy_scene(11, 7);
    data.image.samples = k * k;
    const Scene scene(data, Kernel::automatic);
    const Image image = render_picture(scene, PixelFormat::rgb32f);
    const CameraRays rays(*data.camera, 11, 7);
    for (std::uint32_t pixel = 0; pixel != 77; ++pixel) {
      double sum = 0;
      for (std::uint32_t s = 0; s != k * k; ++s) {
        const Ray ray = rays.through(pixel % 11 + (s % k + 0.5) / k, pixel / 11 + (s / k + 0.5) / k);
        sum += seen_from(scene, ray.origin, ray.direction).g;
      }
      BOOST_TEST(std::abs(green(image, pixel % 11, pixel / 11) - sum / (k * k)) <= 1e-7);
    }
  }
}

BOOST_AUTO_TEST_CASE(left_handed_camera_mirrors_the_picture_exactly) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    SceneData data = busy_scene();
    data.camera->projection = projection;
    data.camera->height = 8;
    const Image right = render_picture(Scene(data, Kernel::automatic), PixelFormat::rgb32f);
    data.camera->handedness = Handedness::left;
    const Image left = render_picture(Scene(data, Kernel::automatic), PixelFormat::rgb32f);
    for (std::uint32_t x = 0; x != 37; ++x) {
      BOOST_REQUIRE((cut(right, {x, 0, 1, 23}) == cut(left, {36 - x, 0, 1, 23})));
    }
  }
}

// The eye's plane z = 0 cuts spheres of radius 1 (seen from within: red) about the origin; rays beside it look down on
// the floor (green). Each ray has its own answer.
BOOST_AUTO_TEST_CASE(orthographic_rays_start_each_in_their_own_place) {
  SceneData data;
  add_sphere(data, {0, 0, 0}, 1, glowing({1, 0, 0}));
  add_plane(data, {0, 0, -5}, {0, 0, 1}, glowing({0, 1, 0}));
  data.camera = Camera{.eye = {0, 0, 0}, .target = {0, 0, -1}, .up = {0, 1, 0}};
  data.camera->projection = Projection::orthographic;
  data.camera->height = 4;
  data.image.width = 40;
  data.image.height = 40;
  const Image image = render_picture(Scene(data, Kernel::automatic), PixelFormat::rgb32f);
  for (std::size_t y = 0; y != 40; ++y) {
    for (std::size_t x = 0; x != 40; ++x) {
      const double distance = std::hypot(static_cast<double>(x) - 19.5, static_cast<double>(y) - 19.5) / 10;
      BOOST_REQUIRE(green(image, x, y) == (distance < 1 ? 0 : 1));
    }
  }
}

// Eye on a sphere: the half of the picture that looks in sees its far wall and what is within, the rest the background.
BOOST_AUTO_TEST_CASE(eye_on_a_surface_is_decided_for_every_ray) {
  SceneData data;
  add_sphere(data, {3, 4, 0}, 5, glowing({0, 1, 0}));
  add_sphere(data, {-0.5, 1, 0}, 0.3, glowing({0, 0.5, 0}));
  data.camera = Camera{.eye = {0, 0, 0}, .target = {-4, 3, 0}, .fov = 90};
  data.image.width = 20;
  data.image.height = 20;
  const Image image = render_picture(Scene(data, Kernel::automatic), PixelFormat::rgb32f);
  // Facing (-4, 3, 0) with z up, the centre (3, 4, 0) is on the right; the small ball half way to the edge.
  for (std::size_t x = 0; x != 20; ++x) BOOST_TEST(green(image, x, 2) == (x < 10 ? 0 : 1));
  BOOST_TEST(green(image, 14, 10) == 0.5);
}

BOOST_AUTO_TEST_CASE(pictures_of_extreme_shape_render) {
  for (const auto& [width, height] : {std::pair{1U, 1U}, {1U, 10000U}, {10000U, 1U}}) {
    const Scene scene(busy_scene(width, height), Kernel::automatic);
    BOOST_TEST(render_picture(scene, PixelFormat::rgb8).bytes.size() == 3U * width * height);
  }
}

// One camera ray a sample; equal in all tilings, however the work is cut.
BOOST_AUTO_TEST_CASE(rays_are_counted_by_purpose) {
  SceneData data = busy_scene();
  data.image.samples = 4;
  const Scene scene(data, Kernel::automatic);
  const TileRenderer renderer(scene, PixelFormat::rgb8);
  Image image(37, 23, PixelFormat::rgb8);
  const RayCounts whole = renderer.render({0, 0, 37, 23}, {image.bytes}, [] {});
  RayCounts parts;
  for (const Rect& tile : tile_grid({0, 0, 37, 23}, 7, 5)) parts += renderer.render(tile, {image.bytes}, [] {});
  BOOST_TEST(whole.primary == 4U * 37 * 23);
  BOOST_TEST(whole.total() == whole.primary + whole.shadow + whole.mirror);
  BOOST_TEST((parts == whole));
  BOOST_TEST(whole.mirror > 0U);
  BOOST_TEST(whole.shadow > 0U);
}

// In quad precision, through the same camera rays: the same floats where nothing is left to round.
BOOST_AUTO_TEST_CASE(reference_shows_the_same_picture_and_signatures) {
  SceneData data = busy_scene();
  data.image.samples = 4;
  const Scene scene(data, Kernel::automatic);
  const auto rendered = [&](Tracer tracer, std::vector<Signature>& signatures, RayCounts& counts) {
    Image image(37, 23, PixelFormat::rgb32f);
    signatures.resize(37 * 23);
    counts = TileRenderer(scene, image.format, tracer).render({0, 0, 37, 23}, {image.bytes, signatures}, [] {});
    return image;
  };
  std::vector<Signature> fast_signatures;
  std::vector<Signature> exact_signatures;
  RayCounts fast_counts;
  RayCounts exact_counts;
  const Image fast = rendered(Tracer::fast, fast_signatures, fast_counts);
  const Image exact = rendered(Tracer::reference, exact_signatures, exact_counts);
  BOOST_TEST(difference_between(fast, exact).max_abs < 1e-7);
  BOOST_TEST((fast_signatures == exact_signatures));
  BOOST_TEST((fast_counts == exact_counts));
  BOOST_TEST((fast.bytes == render_picture(scene, PixelFormat::rgb32f).bytes));
}

BOOST_AUTO_TEST_CASE(slices_are_announced_and_change_nothing) {
  const Scene scene(busy_scene(64, 64), Kernel::automatic);
  Image image(64, 64, PixelFormat::rgb8);
  int slices = 0;
  TileRenderer(scene, PixelFormat::rgb8).render({0, 0, 64, 64}, {image.bytes}, [&] { ++slices; });
  BOOST_TEST(slices >= 8);
  BOOST_TEST((image.bytes == render_picture(scene, PixelFormat::rgb8).bytes));
}

BOOST_AUTO_TEST_SUITE_END()
