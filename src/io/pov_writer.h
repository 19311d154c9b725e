// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/written_scene.h"
#include "render/scene_data.h"

// Scenes for the ray tracer POV-Ray 3.7 (.pov). Its picture is ours, pixel centre by pixel centre:
//
//   povray +IS.pov +OS.png +W1024 +H1024 -D +WT1 -A       (with File_Gamma=1.0 where ours has the transfer "none")
//
// The camera is given by its vectors, which say which way is right, so the geometry stays as it is. A checker board is
// a board of cubes there, laid so that the plane cuts one layer of them in the middle. Weights are those of POV-Ray's
// `ambient`, `diffuse`, `phong` (R.V)^phong_size, `specular` (N.H)^(1 / roughness) and `reflection`, which is added.
namespace tessera::io {

/// requires: scene.camera
WrittenScene write_pov(const render::SceneData& scene);

}  // namespace tessera::io
