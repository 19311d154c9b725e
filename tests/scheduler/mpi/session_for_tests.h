// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "scheduler/mpi/session.h"

namespace tessera::scheduler::mpi {

/// The session that the test program's main opened.
Session& session_for_tests();

/// More ranks than this count as several nodes.
std::uint32_t most_ranks_on_node_in_tests();

}  // namespace tessera::scheduler::mpi
