// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/written_scene.h"
#include "render/scene_data.h"

// Scenes for the ray tracer Tachyon (.dat); tachyon_scene.h says what its pictures show.
//
// The geometry stays as it is. Tachyon is left-handed, so its picture of a right-handed scene is the mirror image of
// ours: flip one of them to compare. At twice the size, its row 2 y + 1 and column 2 x hold our sample points.
namespace tessera::io {

/// requires: scene.camera
WrittenScene write_tachyon(const render::SceneData& scene);

}  // namespace tessera::io
