// SPDX-License-Identifier: BSD-3-Clause
// Shadows of spheres against the cone that their light makes, and lights at their limits.
#include "stress/stress_scene.h"

using namespace tessera::stress;

namespace {

/// What a pixel shows of sphere 0: light from light 0, or none. Other surfaces are left out.
enum class Shown : std::uint8_t { lit, dark, other };

/// The closed form: sphere 1 casts a cone with its tip in light 0 and the half angle asin(radius / distance). A point
/// that is not inside of sphere 1 lies behind it if it is in the cone and farther away than where the cone touches.
bool is_in_cone(const Vec3& light, const Sphere& blocker, const QuadVec& point) {
  const QuadVec axis = QuadVec(blocker.center) - light;
  const QuadVec reach = point - QuadVec(light);
  const QuadVec across = quad_cross(reach, axis);
  const Quad square = Quad(blocker.radius) * blocker.radius;
  return quad_dot(across, across) < square * quad_dot(reach, reach) && quad_dot(reach, axis) > 0 &&
         quad_dot(reach, reach) > quad_dot(axis, axis) - square;
}

/// A square picture of sphere 0 that sphere 1 throws a shadow on, as rendered and as the cone has it.
struct Umbra {
  Umbra(const SceneData& data, std::uint32_t side) {
    const Scene scene = prepared(data);
    const CameraRays rays(*scene.data().camera, side, side);
    std::vector<Shown> expected;
    std::vector<Shown> rendered;
    for (std::uint32_t i = 0; i != side * side; ++i) {
      const Ray ray = rays.through(i % side + 0.5, i / side + 0.5);
      expected.push_back(by_cone(scene, ray));
      const auto hit = hit_from(scene, ray.origin, ray.direction);
      const bool is_other = !hit || index_of(hit->surface) != 0;
      const bool is_lit = seen_from(scene, ray.origin, ray.direction).r > 0;
      rendered.push_back(is_other ? Shown::other : is_lit ? Shown::lit : Shown::dark);
      different += rendered.back() != expected.back();
      dark += expected.back() == Shown::dark;
    }
    pixels = expected.size();
    for (std::size_t i = 0; i != pixels; ++i) off += !is_near(expected, i, side, rendered[i]);
  }

  std::size_t pixels = 0;
  std::size_t dark = 0;
  std::size_t different = 0;  ///< pixels that are not as the cone has them
  std::size_t off = 0;        ///< pixels that are not as the cone has them nor any of their neighbours

 private:
  static Shown by_cone(const Scene& scene, const Ray& ray) {
    const auto hit = QuadTracer(scene.view(), ray.origin, ray.direction).first_hit();
    if (!hit || hit->surface != 0) return Shown::other;
    const Vec3& light = scene.data().lights[0].vector;
    const bool faces = quad_dot(hit->normal, QuadVec(light) - hit->point) > 0;
    return faces && !is_in_cone(light, scene.spheres()[1], hit->point) ? Shown::lit : Shown::dark;
  }
  static bool is_near(const std::vector<Shown>& picture, std::size_t at, std::size_t side, Shown shown) {
    const std::size_t x = at % side;
    const std::size_t y = at / side;
    for (std::size_t v = y - (y > 0); v <= std::min(y + 1, side - 1); ++v) {
      for (std::size_t u = x - (x > 0); u <= std::min(x + 1, side - 1); ++u) {
        if (picture[v * side + u] == shown) return true;
      }
    }
    return false;
  }
};

/// Over several pictures.
struct UmbraCount {
  std::size_t off = 0;
  std::size_t pixels = 0;
  std::size_t different = 0;
  bool all_are_seen = true;

  void include(const Umbra& umbra) {
    off += umbra.off;
    pixels += umbra.pixels;
    different += umbra.different;
    all_are_seen = all_are_seen && umbra.dark > 100;
  }

  void report(Verdict& verdict, const std::string& seen) const {
    verdict.none_wrong("pixels off by more than 1", off, pixels);
    verdict.none_wrong("pixels off at all", different, pixels);
    verdict.require(all_are_seen, seen);
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(light_cases)

// The picture is 8 radii of the occluder wide, so a pixel is an eighth of that radius down to 1e-12.
BOOST_AUTO_TEST_CASE(case_22_shadow_of_a_tiny_sphere_on_a_large_one) {
  Verdict verdict(22, "shadow matches the cone formula to 1 px, occluder radius 1e-2 to 1e-12");
  Random random(22);
  UmbraCount count;
  for (int k = 2; k <= 12; ++k) {
    const double q = std::pow(10.0, -k);
    for (int i = 0; i != 3; ++i) {
      SceneData data;
      add_sphere(data, {}, 1);
      add_sphere(data, {0, 0, 1 + q}, q);
      // The eye looks from the side that the shadow falls to.
      const double turn = random.uniform(0, 2 * kPi);
      const double other = turn + random.uniform(0.5, 1.5) * kPi;
      const Vec3 contact{0, 0, 1};
      const Vec3 eye = contact + Vec3{2 * std::cos(other), 2 * std::sin(other), 2};
      add_point_light(data, {3 * std::cos(turn), 3 * std::sin(turn), random.uniform(2, 5)});
      const double half_angle = 4 * q / length(eye - contact);
      data.camera = Camera{.eye = eye, .target = contact, .fov = 2 * half_angle * 180 / kPi};
      count.include(Umbra(data, 64));
    }
  }
  count.report(verdict, "a shadow in each picture");
}

// From the light's place the blocker hides the cone of half angle asin(q / D1), which the camera sees from beside it.
BOOST_AUTO_TEST_CASE(case_27_umbra_in_a_hollow_sphere) {
  Verdict verdict(27, "umbra half angle asin(q/D1) to 1 px");
  Random random(27);
  UmbraCount count;
  for (int i = 0; i != 30; ++i) {
    const double q = random.over_decades(1e-3, 0.2);
    const double distance = random.uniform(2, 20) * q;
    const Vec3 light = random.in_box(0.2);
    const Vec3 axis = random.direction();
    SceneData data;
    add_sphere(data, {}, 5);
    add_sphere(data, light + distance * axis, q);
    add_point_light(data, light);
    // Beside the light, as far as the blocker is wide; the umbra on the wall fills about half of the picture.
    data.camera = Camera{.eye = light + 3 * q * random.perpendicular_to(axis), .target = light + 5 * axis};
    data.camera->up = random.perpendicular_to(axis);
    data.camera->fov = 4 * std::asin(q / distance) * 180 / kPi;
    count.include(Umbra(data, 64));
  }
  count.report(verdict, "an umbra in each picture");
}

// A light at F l against one along -l: at P, N.L differs by ((N.l)(P.l) - N.P) / F to first order, which is at most
// |P| / F: with |P| <= 3 and F = 3e12 at most 1e-12, besides a few roundings.
BOOST_AUTO_TEST_CASE(case_29_light_far_away_is_a_directional_one) {
  Verdict verdict(29, "light at 1e12 r and directional: within 1e-11, diffuse only");
  Random random(29);
  double error = 0;
  bool lit = true;
  for (const double r : {1e-6, 1.0, 1e6}) {
    SceneData data;
    for (int i = 0; i != 12; ++i) add_sphere(data, r / 3 * random.in_box(1.5), r / 3 * random.uniform(0.2, 0.5));
    data.camera = Camera{.eye = {0, -4 * r, r}, .target = {}, .fov = 16};
    const Vec3 towards = random.direction();
    SceneData directional = data;
    add_point_light(data, 1e12 * r * towards);
    add_directional_light(directional, -towards);
    const auto picture = picture_of(data, 64);
    error = std::max(error, largest_difference(picture, picture_of(directional, 64)));
    lit = lit && std::count_if(picture.begin(), picture.end(), [](const Rgb& c) { return c.r > 0; }) > 100;
  }
  verdict.at_most("error", error, 1e-11);
  verdict.require(lit, "lit pixels in each picture");
}

// A light in the tangent plane of the point shaded, a few roundings above or below it.
BOOST_AUTO_TEST_CASE(case_30_light_at_the_terminator) {
  Verdict verdict(30, "sign as in quad precision, or contribution < 1e-15");
  Random random(30);
  double contribution = 0;
  std::size_t wrong = 0;
  std::size_t lit = 0;
  std::size_t other_sign = 0;
  constexpr std::size_t kCount = 20000;
  for (std::size_t i = 0; i != kCount; ++i) {
    SceneData data;
    const Vec3 center = random.in_box(0.5);
    add_sphere(data, center, random.uniform(0.2, 0.4));
    const bool is_inside = i % 4 == 0;
    const Vec3 away = random.direction();
    const Vec3 eye = is_inside ? center + 0.1 * away : center + 3 * away;
    const Vec3 direction = is_inside ? random.direction() : 0.15 * random.direction() - 3 * away;
    const auto hit = hit_from(Scene(data, Kernel::automatic), eye, direction);
    BOOST_REQUIRE(hit.has_value());
    const Vec3 along = random.perpendicular_to(hit->normal) + random.uniform(-1e-16, 1e-16) * hit->normal;
    if (i % 2 == 0) {
      add_directional_light(data, -along);
    } else {
      add_point_light(data, hit->point + random.uniform(0.1, 1) * along);
    }
    const double seen = seen_from(data, eye, direction).r;
    const Quad exact = QuadTracer(data, eye, direction).radiance().x;
    const bool is_sign_equal = (seen > 0) == (exact > 0);
    const double larger = std::max(seen, static_cast<double>(exact));
    lit += exact > 0;
    other_sign += !is_sign_equal;
    wrong += !is_sign_equal && !(larger < 1e-15);
    if (!is_sign_equal) contribution = std::max(contribution, larger);
  }
  verdict.none_wrong("signs wrong by more than that", wrong, kCount);
  verdict.at_most(std::to_string(other_sign) + " other signs, contribution", contribution, 1e-15);
  verdict.require(lit > kCount / 10 && lit < kCount * 9 / 10, "lit ones and dark ones");
}

BOOST_AUTO_TEST_SUITE_END()
