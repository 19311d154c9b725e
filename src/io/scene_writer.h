// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "io/written_scene.h"
#include "render/scene_data.h"

// Writes a scene in another format, by the ending of the file's name.
namespace tessera::io {

enum class SceneFormat { pov, tachyon };

/// The endings that scene_format_of() knows, for messages.
inline constexpr std::string_view kSceneEndings = ".pov or .dat";

/// By the ending of the file's name, whatever its case: .pov, .dat; nullopt for all others.
std::optional<SceneFormat> scene_format_of(const std::filesystem::path& path);

/// requires: scene.camera
WrittenScene write_scene(SceneFormat format, const render::SceneData& scene);

}  // namespace tessera::io
