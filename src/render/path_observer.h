// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "render/ray.h"
#include "render/scene_data.h"

namespace tessera::render {

/// A surface that a path meets.
struct PathVertex {
  const Ray& ray;  ///< that meets it
  const Hit& hit;
  Cell cell;
  const Vec3& normal;  ///< unit, on the side that the path is on
  const Material& material;
  double weight;  ///< of this surface's radiance in the path's: the product of the mirrors before it
};

/// Watches a path while it is traced, for what the picture does not show: which decisions were taken, how sure they
/// are. It changes nothing.
class PathObserver {
 public:
  PathObserver() = default;
  PathObserver(const PathObserver&) = delete;
  PathObserver& operator=(const PathObserver&) = delete;
  virtual ~PathObserver() = default;

  virtual void on_hit(const PathVertex& vertex) = 0;

  /// Asked for every light of the scene, in order, where the surface just hit shows light at all.
  virtual void on_light(std::size_t light, bool is_lit) = 0;

  /// The ray leaves the scene; `weight` is that of the background in the path's radiance.
  virtual void on_miss(const Ray& ray, double weight) = 0;
};

}  // namespace tessera::render
