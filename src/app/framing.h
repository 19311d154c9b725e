// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "render/scene_data.h"

namespace tessera::app {

/// Gives a scene that has no camera the one that shows all of it; `input` is where it was read from.
/// throws:  io::Error(bad_scene) where none does
void require_camera(render::SceneData& scene, const std::filesystem::path& input);

}  // namespace tessera::app
