// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scheduler/mpi/session.h"

namespace tessera::scheduler::mpi {

/// The session that the test program's main opened.
Session& session_for_tests();

}  // namespace tessera::scheduler::mpi
