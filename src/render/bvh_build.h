// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "render/bvh.h"
#include "render/scene_data.h"

namespace tessera::render {

/// Builds the tree top-down: each node is split in two where the surface area heuristic expects the cheapest
/// traversal, then the largest of its parts again, until there are eight. Spheres of radius 0 are left out: they are
/// never hit. Input that no plane can split (a million equal centres) is halved by position in the list, so the depth
/// stays within Bvh::kMaxDepth.
/// shapes:  n >= 0 spheres; leaves hold 1 to 8 of them
/// source:  Wald, On fast construction of SAH-based bounding volume hierarchies (2007); Wald, Benthin, Boulos,
///          Getting rid of packets (2008), for wide nodes
Bvh build_bvh(std::span<const Sphere> spheres);

}  // namespace tessera::render
