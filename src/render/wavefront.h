// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "render/stream.h"
#include "render/tracer.h"

// Follows many paths at once, surface by surface: first all their rays are traced, then all rays to one light after
// the other, then all mirror rays. What belongs together is done together; each path's arithmetic is that of
// radiance_along, and so are its bits.
namespace tessera::render {

class Wavefront {
 public:
  /// requires: scene outlives the wavefront
  Wavefront(const Scene& scene, const TraceOptions& options) : scene_(scene), options_(options) {}

  /// radiance_along of every camera ray. Calls `between_slices` after each step of all paths.
  /// shapes:  radiances.size() = camera_rays.size(); some hundreds at a time are enough
  void trace(std::span<const RayInRegion> camera_rays, std::span<Rgb> radiances, RayCounts& counts,
             const std::function<void()>& between_slices);

 private:
  /// A path at the surface that it met last.
  struct Vertex {
    std::size_t path;
    const Region* region;
    SurfacePoint hit;
    const Material* material;
    Vec3 normal;     ///< unit, on the side that the path is on
    Vec3 incoming;   ///< direction of the ray that met the surface
    Vec3 to_viewer;  ///< unit, where a highlight needs it
    double weight;   ///< of what is seen here in the path's radiance
    Rgb local;
  };

  void meet_surfaces(std::span<Rgb> radiances);
  void light_surfaces(std::size_t light, RayCounts& counts);
  void leave_surfaces(bool is_last, std::span<Rgb> radiances, RayCounts& counts);

  const Scene& scene_;
  TraceOptions options_;
  // Paths still on their way: their rays, and which they are.
  std::vector<RayInRegion> rays_;
  std::vector<std::size_t> paths_;
  std::vector<double> weights_;
  std::vector<std::optional<SurfacePoint>> hits_;
  std::vector<Vertex> vertices_;
  // Rays to one light: from which vertices, and whether something is in the way.
  std::vector<RayInRegion> light_rays_;
  std::vector<std::size_t> lit_vertices_;
  std::vector<std::uint8_t> occluded_;
};

}  // namespace tessera::render
