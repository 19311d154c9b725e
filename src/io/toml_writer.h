// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/written_scene.h"
#include "render/scene_data.h"

// Our own scene files (.toml), which say everything: a scene that is written and read is the same.
namespace tessera::io {

/// Spheres beyond some hundreds go into a table, for TOML takes 20 times as long to read. With hundreds of materials
/// too the table's rows have colours, and the materials read back in another order, those of no sphere left out.
/// shapes:  `table_name` is that of the table's file, from the scene file's folder
WrittenScene write_toml(const render::SceneData& scene, const std::string& table_name);

}  // namespace tessera::io
