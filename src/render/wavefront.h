// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "render/light_cells.h"
#include "render/shading.h"
#include "render/tracer.h"

// Follows many paths at once, surface by surface: first all their rays are traced, then all rays to one light after
// the other, then all mirror rays. What belongs together is done together; each path's arithmetic is that of
// radiance_along, and so are its bits.
namespace tessera::render {

class Wavefront {
 public:
  /// requires: scene outlives the wavefront
  Wavefront(const Scene& scene, const TraceOptions& options);

  /// About what the cells of all lights together take at most.
  static std::size_t most_cell_bytes(const Scene& scene) noexcept;

  /// radiance_along of every camera ray. Calls `between_slices` after each step that took rays.
  /// shapes:  radiances.size() = camera_rays.size(); some hundreds at a time are enough. first_spheres: what is known
  ///          of each ray as in raster.h, or empty
  void trace(std::span<const RayInRegion> camera_rays, std::span<Rgb> radiances, RayCounts& counts,
             const std::function<void()>& between_slices, std::span<const SurfaceId> first_spheres = {});

 private:
  /// Which vertex: its lane of a group.
  struct VertexPlace {
    std::uint32_t group;
    std::uint32_t lane;
  };

  void meet_surfaces(std::span<Rgb> radiances);
  /// Returns whether any ray was sent to the light.
  bool light_surfaces(std::size_t light, RayCounts& counts);
  void list_lit_vertices(std::size_t light);
  void leave_surfaces(bool is_last, std::span<Rgb> radiances, RayCounts& counts);

  const Scene& scene_;
  TraceOptions options_;
  std::vector<LightCells> light_cells_;  ///< by light
  // Paths still on their way: their rays, which they are, what is seen along them weighs, and where they meet what.
  std::vector<RayInRegion> rays_;
  std::vector<std::size_t> paths_;
  std::vector<double> weights_;
  std::vector<std::optional<SurfacePoint>> hits_;
  Vertices vertices_;
  std::vector<LightLanes> shares_;
  // Rays to one light: from which vertices, and whether something is in the way.
  std::vector<RayInRegion> light_rays_;
  std::vector<VertexPlace> lit_;
  std::vector<std::uint8_t> occluded_;
};

}  // namespace tessera::render
