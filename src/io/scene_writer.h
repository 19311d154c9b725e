// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "io/written_scene.h"
#include "render/scene_data.h"

// Writes a scene in another format, by the ending of the file's name.
namespace tessera::io {

enum class SceneFormat { toml, pov, tachyon };

/// The endings that scene_format_of() knows, for messages.
inline constexpr std::string_view kSceneEndings = ".toml, .pov or .dat";

/// By the ending of the file's name, whatever its case: .toml, .pov, .dat; nullopt for all others.
std::optional<SceneFormat> scene_format_of(const std::filesystem::path& path);

/// Where the spheres of a scene file go that are too many for it: a.spheres.txt for a.toml. (Not a.txt, from which it
/// may have been made.)
std::filesystem::path sphere_table_beside(const std::filesystem::path& path);

/// The scene as the file `path` of that format is to hold it.
/// requires: scene.camera, but for toml
WrittenScene write_scene(SceneFormat format, const render::SceneData& scene, const std::filesystem::path& path);

}  // namespace tessera::io
