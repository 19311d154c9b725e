// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "io/material_set.h"
#include "io/toml_fields.h"

// Materials in a scene file: where they are defined and where they are named.
namespace tessera::io {

/// Adds the [material.NAME] tables of a scene file to `materials`, in the order of their names.
/// throws:  Error(bad_scene)
void read_materials(const TomlFields& file, MaterialSet& materials);

/// throws:  Error(bad_scene) at the name for one that isn't known
render::MaterialIndex material_named(const PlacedWord& name, const MaterialSet& materials);

/// The material that `key` names, or the default one where the key is left out.
/// throws:  Error(bad_scene)
render::MaterialIndex read_material_name(const TomlFields& fields, std::string_view key, MaterialSet& materials);

}  // namespace tessera::io
