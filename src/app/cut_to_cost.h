// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "render/tile.h"

// Tiles that are as large as what they cost allows.
namespace tessera::app {

/// Cuts the area so that tiles shrink with the work that is left, from a quarter of a rank's share to as little as is
/// worth a task, the dearest first. How many pixels a tile holds is bounded too, for the costs may be wrong.
/// requires: all of the area takes more than 0
/// units:   seconds
std::vector<render::CostedTile> cut_to_cost(const render::Rect& area,
                                            const std::function<double(const render::Rect&)>& seconds_of,
                                            std::uint32_t ranks);

}  // namespace tessera::app
