// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/color.h"
#include "render/vec3.h"

// A scene as data, the one thing that every reader produces and the renderer takes. It holds nothing derived.
namespace tessera::render {

/// Position of a material in SceneData::materials.
enum class MaterialIndex : std::uint32_t {};

/// Weights of the local terms and of the mirror; see phong.h for the formula.
struct Material {
  Rgb color{0.8, 0.8, 0.8};
  double ambient = 0.1;
  double diffuse = 0.9;
  double specular = 0;
  double shininess = 32;
  double reflection = 0;  ///< k in [0, 1]: radiance = (1 - k) local + k mirrored

  friend bool operator==(const Material&, const Material&) = default;
};

/// An opaque two-sided sphere. Radius 0 is allowed and never hit.
struct Sphere {
  Vec3 center;
  double radius = 0;
  MaterialIndex material{};
};

/// The odd cells of a plane's checker board.
struct Checker {
  MaterialIndex material{};
  double size = 1;  ///< side of a cell, world units, > 0
};

/// Whether two spheres are the same but for their material; of these only the first is ever seen.
inline bool coincide(const Sphere& a, const Sphere& b) noexcept {
  return a.center == b.center && a.radius == b.radius;
}

/// Which cells of a checker board; even where there is no board.
enum class Cell : std::uint8_t { even, odd };

/// An opaque two-sided infinite plane.
struct Plane {
  Vec3 point{};
  Vec3 normal{0, 0, 1};  ///< any length > 0
  MaterialIndex material{};
  std::optional<Checker> checker{};
};

/// Whether two planes are given alike; of these only the first is ever seen.
inline bool coincide(const Plane& a, const Plane& b) noexcept {
  return a.point == b.point && a.normal == b.normal;
}

enum class LightKind : std::uint8_t { point, directional };

/// A light without fall-off, itself invisible.
struct Light {
  LightKind kind = LightKind::point;
  Vec3 vector{};       ///< point: its position; directional: the way the light travels, any length > 0
  Rgb color{1, 1, 1};  ///< colour times intensity, >= 0
};

enum class Projection : std::uint8_t { perspective, orthographic };
enum class Handedness : std::uint8_t { right, left };

struct Camera {
  Vec3 eye;
  Vec3 target;
  Vec3 up{0, 0, 1};
  Projection projection = Projection::perspective;
  double fov = 45;                            ///< perspective: vertical field of view, degrees in (0, 180)
  double height = 1;                          ///< orthographic: height of the picture, world units
  Handedness handedness = Handedness::right;  ///< left: the picture's x is flipped, the geometry stays
};

struct Environment {
  Rgb ambient{1, 1, 1};  ///< multiplies every material's ambient weight
  Rgb background{0, 0, 0};
};

enum class Transfer : std::uint8_t { srgb, none };  ///< curve from linear to the picture's numbers
enum class Shade : std::uint8_t { phong, blinn };   ///< highlight by (R.V) or by the half vector (N.H)

/// What picture to make: the part of a scene that the command line may override.
struct ImageSettings {
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  std::uint32_t samples = 1;  ///< per pixel, a square number
  std::uint32_t max_bounces = 5;
  Transfer transfer = Transfer::srgb;
  Shade shade = Shade::phong;
};

/// All of a scene but what there may be millions of.
struct Stage {
  std::vector<Plane> planes;
  std::vector<Light> lights;
  std::optional<Camera> camera;  ///< left out: framed_camera() of camera.h
  Environment environment;
  ImageSettings image;
};

struct SceneData : Stage {
  std::vector<Sphere> spheres;
  std::vector<Material> materials;
};

}  // namespace tessera::render
