// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/kernel.h"
#include "render/vertices.h"

// The local light of many vertices at once: every kernel gives each of them the bits of phong.h and vertex.h.
namespace tessera::render {

/// What one light adds to a few vertices if nothing stands in its way.
/// shapes:  way and share are defined where it shines
struct LightLanes {
  std::uint8_t shines[kLanes];  ///< 1 where it is on the vertex's side and shows there, else 0
  Vec3Lanes way;                ///< way_to the light
  Vec3Lanes share;              ///< r, g, b of the reflected_light
};

/// Turns every incoming direction into to_viewer.
void turn_to_viewers(Kernel kernel, Vertices& vertices) noexcept;

/// What a light adds to all vertices.
/// shapes:  shares.size() = vertices.lanes().size()
void light_up(Kernel kernel, const Light& light, Shade shade, const Vertices& vertices,
              std::span<LightLanes> shares) noexcept;

// The same for one vertex, which is the specification.
void turn_to_viewer(VertexLanes& vertices, std::size_t lane) noexcept;
void light_up(const Light& light, Shade shade, const VertexLanes& vertices, std::size_t lane,
              LightLanes& shares) noexcept;

namespace avx2 {

void turn_to_viewers(Vertices& vertices) noexcept;
void light_up(const Light& light, Shade shade, const Vertices& vertices, std::span<LightLanes> shares) noexcept;

}  // namespace avx2
}  // namespace tessera::render
