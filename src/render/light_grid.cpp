// SPDX-License-Identifier: BSD-3-Clause
#include "render/light_grid.h"

#include <cmath>

namespace tessera::render {
namespace {

constexpr double kHalf = LightGrid::kSquares / 2.0;

/// Lights farther away than this many times the spheres' extent are left alone.
constexpr double kFarthest = 64;
/// So are points at this distance: a ray from there is off by less than TreeSpace::kFloor where it comes to the light.
constexpr float kFarthestPoint = 0x1p10F;
/// From nearer than this the spheres are seen at an angle that one face is too flat for.
constexpr double kNearest = 1.5;

/// More than float puts a line aside, in half faces: five roundings of the direction, on a face kFarthest times
/// narrower.
constexpr double kMargin = 0x1p-15;

float along(const std::array<float, 3>& a, const float b[3]) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::array<float, 3> as_floats(const Vec3& v) noexcept {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

std::optional<LightGrid> LightGrid::of(const TreeSpace& space, const Light& light) {
  if (!(space.extent > 0)) return std::nullopt;
  if (light.kind == LightKind::directional) {
    const Vec3 direction = normalized(light.vector);
    LightGrid grid(space, space.to_scene(space.middle - 2 * space.extent * direction), Pencil::Kind::prism);
    grid.add_face(direction, space.extent);
    return grid;
  }
  LightGrid grid(space, light.vector, Pencil::Kind::pyramid);
  const Vec3 way = space.middle - grid.origin();
  const double distance = length(way);
  if (!(distance < kFarthest * space.extent)) return std::nullopt;
  if (distance > kNearest * space.extent) {
    const double sine = space.extent / distance;
    grid.add_face(way / distance, sine / std::sqrt(1 - sine * sine));
    return grid;
  }
  for (const double sign : {1.0, -1.0}) {
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) grid.add_face(sign * axis, 1);
  }
  return grid;
}

void LightGrid::add_face(const Vec3& axis, double half_width) {
  const Vec3 aside = std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 right = normalized(cross(axis, aside));
  const Vec3 up = cross(right, axis);
  const double squares = kHalf / half_width;
  faces_.push_back({axis, half_width * right, half_width * up, as_floats(axis), as_floats(squares * right),
                    as_floats(squares * up)});
}

std::optional<LightGrid::Place> LightGrid::place_of(const LightLine& line) const noexcept {
  if (!(line.distance < kFarthestPoint)) return std::nullopt;
  std::uint32_t face = 0;
  if (faces_.size() > 1) {
    const float size[3] = {std::abs(line.unit[0]), std::abs(line.unit[1]), std::abs(line.unit[2])};
    std::uint32_t axis = size[1] > size[0] ? 1 : 0;
    if (size[2] > size[axis]) axis = 2;
    face = axis + (line.unit[axis] < 0 ? 3 : 0);
  }
  const Face& on = faces_[face];
  const float* const from_axis = is_point() ? line.unit : line.across;
  const float ahead = is_point() ? along(on.ahead, line.unit) : 1;
  if (!(ahead > 0)) return std::nullopt;
  const float x = along(on.to_x, from_axis) / ahead + static_cast<float>(kHalf);
  const float y = along(on.to_y, from_axis) / ahead + static_cast<float>(kHalf);
  constexpr auto kEnd = static_cast<float>(kSquares);
  if (!(x >= 0 && x < kEnd && y >= 0 && y < kEnd)) return std::nullopt;
  return Place{face, static_cast<std::uint32_t>(static_cast<int>(x)), static_cast<std::uint32_t>(static_cast<int>(y))};
}

Pencil LightGrid::pencil(const Place& place, unsigned bits) const noexcept {
  const Face& on = faces_[place.face];
  const double unit = is_point() ? 1 : 1 / space_.scale;  // what a pencil's vectors are given in
  const auto range = [&](std::uint32_t at) {
    const std::uint32_t low = at >> bits << bits;
    const std::uint32_t high = low + (1U << bits);
    return std::array<double, 2>{low / kHalf - 1 - kMargin, high / kHalf - 1 + kMargin};
  };
  return {kind_, origin_, on.axis, unit * on.right, unit * on.up, range(place.x), range(place.y)};
}

}  // namespace tessera::render
