// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/scene_data.h"
#include "render/vec3_lanes.h"

namespace tessera::render {

/// Where a path has met a surface.
struct Vertex {
  std::uint32_t ray;  ///< that met the surface, by its number
  const Material* material;
  Vec3 point;
  Vec3 normal;    ///< unit, on the side that the path is on
  Vec3 incoming;  ///< direction of the ray
  Rgb local;      ///< radiance
};

/// A few of them side by side.
struct VertexLanes {
  Vec3Lanes point;
  Vec3Lanes normal;
  Vec3Lanes to_viewer;  ///< unit, where a highlight needs it; at first the incoming direction
  // Of the material. Lights do not show on a perfect mirror: both of its weights are 0 here.
  Lanes diffuse;
  Lanes specular;
  Lanes shininess;
  Vec3Lanes color;
  const Material* material[kLanes];
  std::uint32_t ray[kLanes];
  Rgb local[kLanes];
};

/// Many of them.
class Vertices {
 public:
  std::size_t size() const noexcept { return size_; }

  /// shapes:  behind the last vertex there may be lanes with what was there before, or 0
  std::span<VertexLanes> lanes() noexcept { return std::span(lanes_).first(lanes_for(size_)); }
  std::span<const VertexLanes> lanes() const noexcept { return std::span(lanes_).first(lanes_for(size_)); }

  /// Empties them, and makes room for so many.
  void clear(std::size_t most) {
    size_ = 0;
    if (lanes_for(most) > lanes_.size()) lanes_.resize(lanes_for(most));
  }

  void add(const Vertex& vertex) noexcept {
    VertexLanes& lanes = lanes_[size_ / kLanes];
    const std::size_t lane = size_++ % kLanes;
    const Material& material = *vertex.material;
    const bool takes_light = material.reflection < 1;
    lanes.point.set(lane, vertex.point);
    lanes.normal.set(lane, vertex.normal);
    lanes.to_viewer.set(lane, vertex.incoming);
    lanes.diffuse[lane] = takes_light ? material.diffuse : 0;
    lanes.specular[lane] = takes_light ? material.specular : 0;
    lanes.shininess[lane] = material.shininess;
    lanes.color.set(lane, {material.color.r, material.color.g, material.color.b});
    lanes.material[lane] = vertex.material;
    lanes.ray[lane] = vertex.ray;
    lanes.local[lane] = vertex.local;
  }

 private:
  std::size_t size_ = 0;
  std::vector<VertexLanes> lanes_;
};

}  // namespace tessera::render
