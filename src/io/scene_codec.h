// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/scene_data.h"

// A scene as bytes, the way rank 0 sends it to the others: little-endian, every double exact.
namespace tessera::io {

std::vector<std::byte> encode_scene(const render::SceneData& scene);

/// The inverse. Believes nothing: lengths, enumerators and material indices are checked before they are used; of a
/// scene without spheres and materials, which travel apart, whoever puts all together checks the planes' materials.
/// throws:  Error(bad_scene) for anything that encode_scene() cannot have written, but for numbers out of range
render::SceneData decode_scene(std::span<const std::byte> bytes);

/// A hash of the bytes that encode_scene() gives, without making them all: equal scenes have equal ones.
std::uint64_t hash_of(const render::SceneData& scene);

}  // namespace tessera::io
