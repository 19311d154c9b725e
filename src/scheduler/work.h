// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "scheduler/bytes.h"
#include "scheduler/task.h"

// What the caller brings: how a task is done, and where its result goes.
namespace tessera::scheduler {

/// Does one task and returns its result. Must call `between_slices` every 0.1 ms or so: there a rank 0 that renders
/// serves the others, and a worker keeps a large result moving.
using Work = std::function<Bytes(TaskId, const std::function<void()>& between_slices)>;

/// Takes a result, on rank 0, exactly once per task, in the order of arrival. Rank 0 calls it between the slices of its
/// own task as well. The bytes are gone when it returns.
using Accept = std::function<void(TaskId, std::span<const std::byte>)>;

/// Called on rank 0 between its steps and between the slices of its own tasks, every millisecond or more often, until
/// the run ends. What it throws ends the run.
using Pulse = std::function<void()>;

}  // namespace tessera::scheduler
