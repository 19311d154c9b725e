// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "embree_scene.h"
#include "render/camera.h"
#include "render/ray_counts.h"

// The pixel loop: camera rays, shading, shadows and mirrors around Embree.
namespace tessera::embree {

/// How rays are handed to Embree; which is faster depends on the scene. Either way eight are shaded at a time.
/// Streams (rtcIntersect1M) are left out: for camera rays they took as long as packets on every scene tried.
enum class Mode : std::uint8_t {
  single,   ///< rtcIntersect1, rtcOccluded1
  packets,  ///< rtcIntersect8, rtcOccluded8 for the rays of 4x2 pixels, mirrored ones and shadows too
};

struct Picture {
  std::vector<Triple<float>> pixels;  ///< linear, row by row, top row first
  render::RayCounts rays;
};

/// Draws the scene on the calling thread, one ray through the centre of each pixel.
Picture draw(const Scene& scene, const render::CameraRays& camera, std::uint32_t width, std::uint32_t height,
             Mode mode);

}  // namespace tessera::embree
