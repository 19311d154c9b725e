// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/scene_data.h"

// Reads a scene in any format we know, by the ending of its name.
namespace tessera::io {

/// A scene and what its reader has to say: each note is one line ("drawn as opaque: 22 textures with OPACITY < 1").
struct ReadScene {
  render::SceneData scene;
  std::vector<std::string> notes;
};

/// Reads `path`: .toml (ours), .dat (Tachyon), .txt .csv .bin (sphere tables).
/// throws:  Error with the place of the trouble
ReadScene read_scene(const std::filesystem::path& path);

}  // namespace tessera::io
