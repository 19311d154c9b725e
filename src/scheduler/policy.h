// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "scheduler/task.h"

// The five ways to share tasks out. A policy is a pure function from how things stand to how many tasks a rank gets
// next, so comparing policies is a flag, and the results stay the same.
namespace tessera::scheduler {

enum class Policy : std::uint8_t {
  dynamic,          ///< on demand, each worker a few tasks ahead of its results
  static_bands,     ///< task i belongs to rank i mod P; a task is one of P bands of the picture
  cyclic_rows,      ///< task i belongs to rank i mod P; a task is a row of the picture
  self_scheduling,  ///< on demand, one task at a time
  guided,           ///< on demand, in runs that shrink with what remains
};

/// The policy with this name ("dynamic", "static-bands", "cyclic-rows", "self", "guided"), or nullopt.
std::optional<Policy> parse_policy(std::string_view name) noexcept;
std::string_view name_of(Policy policy) noexcept;

/// Whether every task has an owner from the start: task i belongs to rank i mod P and to nobody else.
constexpr bool has_owners(Policy policy) noexcept {
  return policy == Policy::static_bands || policy == Policy::cyclic_rows;
}

/// How things stand for a rank at the moment it asks for work.
/// units:   seconds
struct Standing {
  Rank rank = 0;
  std::uint32_t ranks = 1;
  std::uint32_t remaining = 0;        ///< tasks not handed out yet, of those that this rank may get
  std::uint32_t held = 0;             ///< tasks that this rank has and has not delivered
  std::optional<double> mean_task_s;  ///< of this rank's recent tasks, none before its first result
  std::optional<unsigned> prefetch;   ///< tasks that a worker shall hold, where the user says so
};

/// How many tasks a rank gets now.
/// source:  guided: Polychronopoulos and Kuck, Guided self-scheduling, IEEE Trans. Computers C-36(12) (1987);
///          self: Tang and Yew, Processor self-scheduling for multiple-nested parallel loops, ICPP (1986)
std::uint32_t tasks_to_assign(Policy policy, const Standing& standing) noexcept;

}  // namespace tessera::scheduler
