// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "render/scene_data.h"
#include "render/shared_array.h"
#include "scheduler/mpi/node_memory.h"
#include "scheduler/mpi/session.h"

namespace tessera::app {

/// How often a node holds what is meant to be there once.
struct Copies {
  std::uint32_t on_node = 1;
  bool is_shared = false;  ///< whether this rank's is in memory that ranks can share, not in its own
};

/// What there may be millions of in a scene.
struct SceneArrays {
  render::SharedArray<render::Sphere> spheres;
  render::SharedArray<render::Material> materials;
  Copies copies;
};

/// Rank 0's spheres and materials for all ranks; the others give none. Between nodes they travel once a node, and
/// there is one copy of them a node, or one a rank where memory cannot be shared. Collective.
/// throws:  std::bad_alloc, std::runtime_error
SceneArrays share_arrays(scheduler::mpi::Session& session, std::vector<render::Sphere> spheres,
                         std::vector<render::Material> materials,
                         scheduler::mpi::Sharing sharing = scheduler::mpi::Sharing::if_possible);

}  // namespace tessera::app
