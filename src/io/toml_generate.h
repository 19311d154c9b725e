// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "io/material_set.h"
#include "io/toml_fields.h"
#include "render/scene_data.h"

// The [generate] table of a scene file; see generate.h for what it makes. kind = "sphereflake" takes level, center and
// radius; kind = "cloud" takes count, seed, fill, center and scale; both take material = "NAME" or
// materials = ["NAME", ...].
namespace tessera::io {

/// The spheres that a scene file asks for, none where it has no [generate].
/// throws:  Error(bad_scene)
std::vector<render::Sphere> generate_spheres(const TomlFields& file, MaterialSet& materials);

}  // namespace tessera::io
