// SPDX-License-Identifier: BSD-3-Clause
#include "render/check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "render/scale.h"

namespace tessera::render {
namespace {

using Problem = std::optional<std::string>;

/// The shortest text that reads back as `value`.
std::string text_of(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string must_be(const std::string& name, const std::string& rule, double value) {
  return name + " must be " + rule + " (it is " + text_of(value) + ")";
}

/// The first problem of several, in the order of the arguments.
template <class... Problems>
Problem first_of(const Problems&... problems) {
  Problem first;
  ((first = first ? first : problems), ...);
  return first;
}

Problem not_finite(const std::string& name, const Vec3& v) {
  if (is_finite(v)) return std::nullopt;
  return name + " must be finite (it holds nan or inf)";
}

Problem not_in(const std::string& name, const std::string& range, double value, bool is_in_range) {
  if (!std::isfinite(value)) return must_be(name, "finite", value);
  return is_in_range ? std::nullopt : Problem(must_be(name, range, value));
}

/// Compares only what can be compared: a NaN is refused before.
bool is_above(double value, double bound) {
  return std::isfinite(value) && value > bound;
}

Problem not_non_negative(const std::string& name, double value) {
  if (is_above(value, kLargestWeight)) return must_be(name, "at most " + text_of(kLargestWeight), value);
  return not_in(name, ">= 0", value, is_above(value, 0) || value == 0);
}

Problem not_non_negative(const std::string& name, const Rgb& color) {
  return first_of(not_non_negative(name, color.r), not_non_negative(name, color.g), not_non_negative(name, color.b));
}

Problem no_direction(const std::string& name, const Vec3& v) {
  if (const auto problem = not_finite(name, v)) return problem;
  if (v == Vec3{}) return name + " must not be zero (it has no direction)";
  return std::nullopt;
}

}  // namespace

Problem problem_with(const Material& m) {
  const bool is_share = m.reflection == 0 || (is_above(m.reflection, 0) && !is_above(m.reflection, 1));
  return first_of(not_non_negative("color", m.color), not_non_negative("ambient", m.ambient),
                  not_non_negative("diffuse", m.diffuse), not_non_negative("specular", m.specular),
                  not_non_negative("shininess", m.shininess),
                  not_in("reflection", "in [0, 1]", m.reflection, is_share));
}

Problem problem_with(const Sphere& sphere) {
  const double r = sphere.radius;
  return first_of(not_finite("center", sphere.center), not_in("radius", ">= 0", r, !is_above(-r, 0)));
}

Problem problem_with(const Plane& plane) {
  const double size = plane.checker ? plane.checker->size : 1;
  return first_of(not_finite("point", plane.point), no_direction("normal", plane.normal),
                  not_in("checker_size", "> 0", size, is_above(size, 0)));
}

Problem problem_with(const Light& light) {
  return first_of(
      light.kind == LightKind::point ? not_finite("position", light.vector) : no_direction("direction", light.vector),
      not_non_negative("color", light.color));
}

Problem problem_with(const Camera& camera) {
  const auto problem =
      first_of(not_finite("eye", camera.eye), not_finite("target", camera.target), no_direction("up", camera.up));
  if (problem) return problem;
  if (camera.eye == camera.target) return "eye and target are the same point (no view direction)";
  Vec3 forward = camera.target - camera.eye;
  if (!is_finite(forward)) forward = 0.5 * camera.target - 0.5 * camera.eye;
  const Vec3 side = cross(normalized(forward), normalized(camera.up));
  // Directions this close are parallel up to the rounding of their own normalisation.
  if (length(side) <= 0x1p-50) return "up is parallel to the view direction (which way is up?) try another up";
  if (camera.projection == Projection::perspective) {
    const bool is_angle = is_above(camera.fov, 0) && !is_above(camera.fov, 180) && camera.fov != 180;
    return not_in("fov", "in (0, 180) degrees", camera.fov, is_angle);
  }
  return not_in("height", "> 0", camera.height, is_above(camera.height, 0));
}

Problem problem_with(const Environment& environment) {
  return first_of(not_non_negative("ambient", environment.ambient),
                  not_non_negative("background", environment.background));
}

Problem problem_with(const ImageSettings& image) {
  const std::string range = "1 to " + std::to_string(kMaxImageSide);
  if (image.width < 1 || image.width > kMaxImageSide) return must_be("width", range, image.width);
  if (image.height < 1 || image.height > kMaxImageSide) return must_be("height", range, image.height);
  if (image.samples > kMaxSamples) return must_be("samples", "at most " + std::to_string(kMaxSamples), image.samples);
  const auto root = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(image.samples)));
  if (image.samples >= 1 && root * root == image.samples) return std::nullopt;
  const std::string above = std::to_string((root + 1) * (root + 1));
  const std::string nearest = root == 0 ? above : std::to_string(root * root) + " or " + above;
  return "samples must be a square number (it is " + std::to_string(image.samples) + ") try " + nearest;
}

Problem problem_with_span(const SceneData& scene) {
  const double largest = largest_length_of(scene);
  double smallest = largest;
  for (const Sphere& sphere : scene.spheres) {
    if (sphere.radius > 0) smallest = std::min(smallest, sphere.radius);
  }
  for (const Plane& plane : scene.planes) {
    if (plane.checker) smallest = std::min(smallest, plane.checker->size);
  }
  if (smallest >= largest / kLargestSpan) return std::nullopt;
  return "lengths span from " + text_of(smallest) + " to " + text_of(largest) + " (a factor of more than " +
         text_of(kLargestSpan) + ") leave out what cannot be seen";
}

}  // namespace tessera::render
