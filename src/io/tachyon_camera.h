// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/tachyon_tokens.h"
#include "render/scene_data.h"

// Tachyon's camera is left-handed (right = up x view); neither the length of VIEWDIR nor that of UPDIR matters, and
// UPDIR need not be at a right angle to VIEWDIR.
//
// Its image plane stands at distance 1 and is 1 / ZOOM high, so the vertical field of view is 2 atan(0.5 / ZOOM), and
// an orthographic picture is 1 / ZOOM world units high. FRUSTUM left right bottom top gives the plane's edges and
// overrides ZOOM. Each was measured on its pictures.
namespace tessera::io {

struct TachyonCamera {
  render::Camera camera;
  std::uint32_t max_bounces = 0;   ///< RAYDEPTH counts the camera ray's hit too: one less
  std::vector<std::string> notes;  ///< what is drawn in another way, a line each
};

/// Reads `[PROJECTION …] ZOOM … END_CAMERA` for a picture of the size in `image`.
/// throws:  Error(bad_scene), also for a camera that cannot be drawn
TachyonCamera read_camera(TachyonTokens& in, const render::ImageSettings& image);

}  // namespace tessera::io
