// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene_data.h"

// What the writers for other renderers have in common.
namespace tessera::io {

/// The material for a renderer that adds the mirror (local + k mirrored) where we mix it ((1 - k) local + k mirrored).
render::Material with_added_mirror(render::Material material);

/// "1 sphere of radius 0", "22 spheres of radius 0"
std::string counted(std::size_t n, std::string_view one, std::string_view many);

/// Whether paths can end at the last bounce, and what they see there instead is not black.
bool shows_cut_paths(const render::SceneData& scene);

/// What no other renderer's file says.
std::vector<std::string> common_notes(const render::SceneData& scene);

}  // namespace tessera::io
