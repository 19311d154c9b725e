// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/tile.h"
#include "scheduler/bytes.h"

// Tiles that follow from no tile size, on their way from rank 0 to the others: 20 bytes each, in the order of their
// ids.
namespace tessera::app {

scheduler::Bytes encode_tiles(std::span<const render::CostedTile> tiles);

/// Bytes that so many tiles take.
std::size_t encoded_size(std::uint32_t tiles) noexcept;

/// Costs come back as floats.
/// throws:  io::Error where the bytes are no tiles that cover each pixel of `area` once
std::vector<render::CostedTile> decode_tiles(std::span<const std::byte> bytes, const render::Rect& area);

}  // namespace tessera::app
