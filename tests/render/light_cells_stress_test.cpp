// SPDX-License-Identifier: BSD-3-Clause
// Scenes that are hard to see from the light: huge beside tiny, far away, in one line, grazed, all copies.
#include <cmath>
#include <string>

#include "render/light_cells_check.h"

using namespace tessera::render;
using namespace tessera::render::test;

BOOST_AUTO_TEST_SUITE(light_cells_stress)

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
