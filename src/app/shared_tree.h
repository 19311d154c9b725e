// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "render/bvh.h"
#include "render/scene_data.h"
#include "scheduler/mpi/node_memory.h"
#include "scheduler/mpi/session.h"

namespace tessera::app {

/// The tree over spheres that all ranks have alike: the first rank of a node builds it with as many threads as the node
/// has ranks, while the others wait, and there is one copy a node, or one a rank where memory cannot be shared.
/// Collective on a node.
/// throws:  std::bad_alloc, std::runtime_error
render::Bvh build_on_node(scheduler::mpi::Session& session, std::span<const render::Sphere> spheres,
                          scheduler::mpi::Sharing sharing = scheduler::mpi::Sharing::if_possible);

}  // namespace tessera::app
