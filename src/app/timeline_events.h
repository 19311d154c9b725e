// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/timeline.h"

// What there is to be seen on a timeline, in the order in which it is written.
namespace tessera::app {

/// Kinds in the order in which they come where times are equal: a slice before what it holds, an end of an arrow right
/// after the slice that it belongs to.
enum class TimelineEventKind : std::uint8_t {
  task_done,   ///< one task less is left; `what` 0 marks the beginning, where none is done
  phase,       ///< a slice of the phase `what`
  accept,      ///< a slice on rank 0 for the result of the task `what`
  delivered,   ///< the end of an arrow from the task to it
  hand_out,    ///< a slice on rank 0 for the hand-out `what`
  handed_out,  ///< the start of an arrow from it to the task `what`
  tile,        ///< a slice of the task `what` on its rank
  begun,       ///< the end of an arrow to it
  returned,    ///< the start of an arrow from it to its acceptance
};

/// units:   nanoseconds since the render command began
struct TimelineEvent {
  std::uint64_t at_ns;
  std::uint64_t end_ns;  ///< of a slice
  TimelineEventKind kind;
  std::size_t what;
};

/// Tasks that a rank was handed at the same moment.
struct HandOut {
  scheduler::Rank rank;
  std::uint32_t tasks;
};

struct TimelineEvents {
  std::vector<TimelineEvent> events;  ///< by time
  std::vector<HandOut> hand_outs;
};

/// Slices that share a thread nest, and every arrow's ends lie within their slices, the start no later than the end.
TimelineEvents events_of(const Timeline& timeline);

}  // namespace tessera::app
