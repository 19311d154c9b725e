// SPDX-License-Identifier: BSD-3-Clause
#include "render/shading.h"

#include "render/vertex.h"

namespace tessera::render {

void turn_to_viewers(Kernel kernel, Vertices& vertices) noexcept {
  if (kernel == Kernel::avx2) return avx2::turn_to_viewers(vertices);
  for (std::size_t i = 0; i != vertices.size(); ++i) turn_to_viewer(vertices.lanes()[i / kLanes], i % kLanes);
}

void light_up(Kernel kernel, const Light& light, Shade shade, const Vertices& vertices,
              std::span<LightLanes> shares) noexcept {
  if (kernel == Kernel::avx2) return avx2::light_up(light, shade, vertices, shares);
  for (std::size_t i = 0; i != vertices.size(); ++i) {
    light_up(light, shade, vertices.lanes()[i / kLanes], i % kLanes, shares[i / kLanes]);
  }
}

void turn_to_viewer(VertexLanes& vertices, std::size_t lane) noexcept {
  vertices.to_viewer.set(lane, to_viewer_of(*vertices.material[lane], vertices.to_viewer[lane]));
}

void light_up(const Light& light, Shade shade, const VertexLanes& vertices, std::size_t lane,
              LightLanes& shares) noexcept {
  const Material& material = *vertices.material[lane];
  const Vec3 normal = vertices.normal[lane];
  const Vec3 way = way_to(light, vertices.point[lane]);
  shares.shines[lane] = material.reflection < 1 && shows_light(material) && dot(normal, way) > 0;
  if (shares.shines[lane] == 0) return;
  const Rgb share = reflected_light(material, light.color, shade, normal, normalized(way), vertices.to_viewer[lane]);
  shares.way.set(lane, way);
  shares.share.set(lane, {share.r, share.g, share.b});
}

}  // namespace tessera::render
