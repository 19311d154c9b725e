// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "scheduler/task.h"

// The seven ways to share tasks out. A policy is a pure function from how things stand to how much a rank gets next, so
// comparing policies is a flag, and the results stay the same.
namespace tessera::scheduler {

enum class Policy : std::uint8_t {
  dynamic,          ///< on demand, each worker a few tasks ahead of its results
  static_bands,     ///< task i belongs to rank i mod P; a task is one of P bands of the picture
  cyclic_rows,      ///< task i belongs to rank i mod P; a task is a row of the picture
  self_scheduling,  ///< on demand, one task at a time
  guided,           ///< on demand, in chunks of 1/P of what remains
  factoring,        ///< on demand, in batches of P equal chunks that halve what remains
  trapezoid,        ///< on demand, in chunks that fall linearly from 1/(2P) of the whole to one task
};

/// The policy with this name ("dynamic", "static-bands", "cyclic-rows", "self", "guided", "factoring", "trapezoid"),
/// or nullopt.
std::optional<Policy> parse_policy(std::string_view name) noexcept;
std::string_view name_of(Policy policy) noexcept;

/// Whether every task has an owner from the start: task i belongs to rank i mod P and to nobody else.
constexpr bool has_owners(Policy policy) noexcept {
  return policy == Policy::static_bands || policy == Policy::cyclic_rows;
}

/// Whether tasks go out in chunks, whose sizes the policy lays down.
constexpr bool is_chunked(Policy policy) noexcept {
  return policy == Policy::guided || policy == Policy::factoring || policy == Policy::trapezoid;
}

/// The tasks that a rank may get, of all ranks' or of its own where tasks have owners.
/// units:   seconds are predicted, 0 where no costs are known
struct Backlog {
  std::uint32_t tasks = 0;      ///< from the start
  std::uint32_t remaining = 0;  ///< not handed out yet
  double tasks_s = 0;
  double remaining_s = 0;
  double next_s = 0;  ///< of the task that goes out next
};

/// How things stand for a rank at the moment it asks for work.
/// units:   seconds
struct Standing {
  Rank rank = 0;
  std::uint32_t ranks = 1;
  Backlog backlog;
  std::uint32_t held = 0;              ///< tasks that this rank has and has not delivered
  std::optional<double> round_trip_s;  ///< from a request of this rank to its answer, none before its first result
  std::optional<double> mean_task_s;   ///< of this rank's recent tasks, none before its first result
  std::optional<unsigned> prefetch;    ///< tasks that a worker shall hold, where the user says so
};

/// What a rank gets: so many tasks or, where that is reached earlier, the fewest whose predicted work comes to this.
struct Share {
  std::uint32_t tasks = 0;
  std::optional<double> seconds;

  friend bool operator==(const Share&, const Share&) = default;
};

/// What a rank gets now. The chunks of guided, factoring and trapezoid are counted in tasks where no costs are known,
/// and are predicted work where they are.
/// source:  self: Tang and Yew, Processor self-scheduling for multiple-nested parallel loops, ICPP (1986);
///          guided: Polychronopoulos and Kuck, Guided self-scheduling, IEEE Trans. Computers C-36(12) (1987);
///          factoring: Hummel, Schonberg and Flynn, Factoring: a method for scheduling parallel loops, CACM 35(8)
///          (1992); trapezoid: Tzen and Ni, Trapezoid self-scheduling, IEEE Trans. Parallel Distrib. Syst. 4(1) (1993)
Share share_to_assign(Policy policy, const Standing& standing) noexcept;

}  // namespace tessera::scheduler
