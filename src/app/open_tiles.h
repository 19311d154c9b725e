// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "render/image.h"
#include "scheduler/bytes.h"

// Which of a job's tiles remain to be rendered: rank 0 knows, and tells the others with a bit a tile, for all of them
// must number the same tiles alike.
namespace tessera::app {

class Coverage;

/// A bit for each tile, set where it must be rendered because a pixel of it is missing; whole bytes.
scheduler::Bytes mark_open(std::span<const render::Rect> tiles, const Coverage& coverage);

/// The tiles whose bit is set, in their order; all where `marks` is empty.
/// throws:  std::runtime_error where there are not as many bits as tiles
std::vector<render::Rect> open_tiles(std::vector<render::Rect> tiles, std::span<const std::byte> marks);

}  // namespace tessera::app
