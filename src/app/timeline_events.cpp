// SPDX-License-Identifier: BSD-3-Clause
#include "app/timeline_events.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/nest_slices.h"

namespace tessera::app {
namespace {

using io::Slice;
using scheduler::kMasterRank;
using scheduler::TaskRecord;
using Kind = TimelineEventKind;

constexpr std::uint64_t kHandOutNs = 1000;
// Two times that went through different sums of seconds may be so far from each other's order.
constexpr std::uint64_t kRoundingNs = 2;

// What may hold what, on rank 0's two threads.
constexpr std::uint32_t kPhaseLevel = 0;
constexpr std::uint32_t kTileLevel = 1;
constexpr std::uint32_t kAcceptLevel = 0;
constexpr std::uint32_t kHandOutLevel = 1;

/// Where a task is to be seen.
struct Sight {
  std::optional<std::size_t> hand_out;  ///< none of a task that a worker began with
  std::uint64_t handed_out_ns = 0;
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint64_t accepted_ns = 0;  ///< begin of the acceptance
};

class Layout {
 public:
  explicit Layout(const Timeline& timeline)
      : timeline_(timeline), run_(timeline.run), sights_(timeline.run.tasks.size()) {}

  TimelineEvents make() {
    find_hand_outs();
    add_scheduling();
    add_tiles();
    add_arrows();
    add_counter();
    std::sort(made_.events.begin(), made_.events.end(), [](const TimelineEvent& a, const TimelineEvent& b) {
      if (a.at_ns != b.at_ns) return a.at_ns < b.at_ns;
      if (a.kind != b.kind) return a.kind < b.kind;
      return a.what < b.what;
    });
    return std::move(made_);
  }

 private:
  /// A time of the run, which counts from its beginning.
  std::uint64_t ns_of(double run_s) const {
    return static_cast<std::uint64_t>(std::llround(1e9 * std::max(0.0, timeline_.run_begin_s + run_s)));
  }

  void add(Kind kind, std::size_t what, std::uint64_t at_ns, std::uint64_t end_ns = 0) {
    made_.events.push_back({at_ns, end_ns, kind, what});
  }

  /// Tells which tasks were handed out together.
  void find_hand_outs() {
    std::vector<std::size_t> order;
    for (std::size_t task = 0; task != run_.tasks.size(); ++task) {
      if (run_.tasks[task].assigned_s > 0) order.push_back(task);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const TaskRecord& first = run_.tasks[a];
      const TaskRecord& second = run_.tasks[b];
      return first.assigned_s != second.assigned_s ? first.assigned_s < second.assigned_s : first.rank < second.rank;
    });
    for (const std::size_t task : order) {
      const scheduler::Rank rank = run_.tasks[task].rank;
      const std::uint64_t at_ns = ns_of(run_.tasks[task].assigned_s);
      if (handed_out_ns_.empty() || handed_out_ns_.back() != at_ns || made_.hand_outs.back().rank != rank) {
        handed_out_ns_.push_back(at_ns);
        made_.hand_outs.push_back({rank, 0});
      }
      ++made_.hand_outs.back().tasks;
      sights_[task].hand_out = made_.hand_outs.size() - 1;
    }
  }

  /// Rank 0's second thread: an acceptance can hold the hand-outs that it leads to.
  void add_scheduling() {
    std::vector<Slice> slices;
    for (std::size_t task = 0; task != run_.tasks.size(); ++task) {
      slices.push_back({ns_of(run_.tasks[task].received_s), ns_of(run_.tasks[task].accepted_s), kAcceptLevel, task});
    }
    for (std::size_t i = 0; i != handed_out_ns_.size(); ++i) {
      slices.push_back({handed_out_ns_[i], handed_out_ns_[i] + kHandOutNs, kHandOutLevel, i});
    }
    nest_slices(slices);
    for (const Slice& slice : slices) {
      const bool is_acceptance = slice.level == kAcceptLevel;
      add(is_acceptance ? Kind::accept : Kind::hand_out, slice.what, slice.begin_ns, slice.end_ns);
      (is_acceptance ? sights_[slice.what].accepted_ns : handed_out_ns_[slice.what]) = slice.begin_ns;
    }
    for (Sight& sight : sights_) {
      if (sight.hand_out) sight.handed_out_ns = handed_out_ns_[*sight.hand_out];
    }
  }

  Slice slice_of_tile(std::size_t task) const {
    const TaskRecord& record = run_.tasks[task];
    const double offset_s = run_.ranks[record.rank].clock_offset_s;
    Slice slice{ns_of(record.start_s + offset_s), ns_of(record.end_s + offset_s), kTileLevel, task};
    const std::uint64_t handed_out_ns = sights_[task].handed_out_ns;
    const std::uint64_t received_ns = ns_of(record.received_s);
    const bool is_rounded_down = slice.begin_ns < handed_out_ns && slice.begin_ns + kRoundingNs >= handed_out_ns;
    const bool is_rounded_up = slice.end_ns > received_ns && slice.end_ns <= received_ns + kRoundingNs;
    if (is_rounded_down) slice.begin_ns = handed_out_ns;
    if (is_rounded_up || record.rank == kMasterRank) slice.end_ns = received_ns;
    return slice;
  }

  /// Every rank's first thread.
  void add_tiles() {
    std::vector<std::vector<Slice>> of_rank(run_.ranks.size());
    for (std::size_t task = 0; task != run_.tasks.size(); ++task) {
      of_rank[run_.tasks[task].rank].push_back(slice_of_tile(task));
    }
    for (std::size_t i = 0; i != timeline_.phases.size(); ++i) {
      const Phase& phase = timeline_.phases[i];
      const double command_began_s = -timeline_.run_begin_s;
      of_rank[kMasterRank].push_back(
          {ns_of(command_began_s + phase.begin_s), ns_of(command_began_s + phase.end_s), kPhaseLevel, i});
    }
    for (std::vector<Slice>& slices : of_rank) {
      nest_slices(slices);
      for (const Slice& slice : slices) {
        const bool is_phase = slice.level == kPhaseLevel;
        add(is_phase ? Kind::phase : Kind::tile, slice.what, slice.begin_ns, slice.end_ns);
        if (is_phase) continue;
        sights_[slice.what].begin_ns = slice.begin_ns;
        sights_[slice.what].end_ns = slice.end_ns;
      }
    }
  }

  void add_arrows() {
    for (std::size_t task = 0; task != sights_.size(); ++task) {
      const Sight& sight = sights_[task];
      if (sight.hand_out && sight.handed_out_ns <= sight.begin_ns) {
        add(Kind::handed_out, task, sight.handed_out_ns);
        add(Kind::begun, task, sight.begin_ns);
      }
      const std::uint64_t last_ns = sight.end_ns - 1;  // at its end a slice is over
      if (last_ns < sight.accepted_ns) {
        add(Kind::returned, task, last_ns);
        add(Kind::delivered, task, sight.accepted_ns);
      }
    }
  }

  void add_counter() {
    add(Kind::task_done, 0, ns_of(0));
    for (const TaskRecord& task : run_.tasks) add(Kind::task_done, 1, ns_of(task.accepted_s));
  }

  const Timeline& timeline_;
  const scheduler::RunRecord& run_;
  std::vector<Sight> sights_;                 ///< of each task
  std::vector<std::uint64_t> handed_out_ns_;  ///< of each hand-out
  TimelineEvents made_;
};

}  // namespace

TimelineEvents events_of(const Timeline& timeline) {
  return Layout(timeline).make();
}

}  // namespace tessera::app
