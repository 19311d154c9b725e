// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "render/ray.h"
#include "render/scene.h"
#include "render/sphere.h"

namespace tessera::render {

/// How a ray meets a surface; each way has a formula of its own for the distance.
enum class Meeting : std::uint8_t {
  entry,     ///< into a sphere from outside
  exit,      ///< out of a sphere from inside
  own_exit,  ///< out of the sphere whose inner side the ray has just left
  plane,
};

/// A surface that a ray meets, and where.
struct Candidate {
  SurfaceId surface = SurfaceId::none;
  Meeting meeting = Meeting::entry;
  Bounded t;

  double earliest() const noexcept { return t.value - t.error; }
  double latest() const noexcept { return t.value + t.error; }
};

/// The same where double precision cannot tell.
bool comes_first_exactly(const Scene& scene, const Ray& ray, const Candidate& a, const Candidate& b) noexcept;

/// Whether `ray` meets `a` before `b`; exact. Distances below 0 count as 0, equal ones go to the lower surface.
inline bool comes_first(const Scene& scene, const Ray& ray, const Candidate& a, const Candidate& b) noexcept {
  if (a.latest() < b.earliest()) return true;
  if (b.latest() < a.earliest()) return false;
  return comes_first_exactly(scene, ray, a, b);
}

}  // namespace tessera::render
