// SPDX-License-Identifier: BSD-3-Clause
#include "app/framing.h"

#include "io/error.h"
#include "render/camera.h"
#include "render/check.h"

namespace tessera::app {

void require_camera(render::SceneData& scene, const std::filesystem::path& input) {
  if (scene.camera) return;
  scene.camera = framed_camera(bounds_of(scene), scene.image.width, scene.image.height);
  if (const auto problem = problem_with(*scene.camera)) {
    throw io::Error(io::ErrorKind::bad_scene,
                    input.string() + ": the scene has no camera and none fits its bounds: " + *problem);
  }
}

}  // namespace tessera::app
