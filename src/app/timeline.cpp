// SPDX-License-Identifier: BSD-3-Clause
#include "app/timeline.h"

#include <cstdint>
#include <cstdio>
#include <string>

#include "app/timeline_events.h"

namespace tessera::app {
namespace {

using io::TraceThread;
using scheduler::kMasterRank;
using scheduler::Rank;
using scheduler::TaskRecord;

class TimelineWriter {
 public:
  TimelineWriter(const Timeline& timeline, const io::TraceWriter::Sink& sink)
      : timeline_(timeline), run_(timeline.run), made_(events_of(timeline)), writer_(sink) {}

  void write() {
    write_names();
    for (const TimelineEvent& event : made_.events) write(event);
    writer_.finish();
  }

 private:
  static TraceThread tiles_thread(Rank rank) noexcept { return {rank, rank}; }
  TraceThread scheduling_thread() const noexcept {
    return {kMasterRank, static_cast<std::uint32_t>(run_.ranks.size())};  // no rank's number
  }
  static std::uint64_t way_out(std::size_t task) noexcept { return 2 * task + 1; }
  static std::uint64_t way_back(std::size_t task) noexcept { return 2 * task + 2; }

  void write_names() {
    for (const scheduler::RankRecord& rank : run_.ranks) {
      char label[48] = "";
      if (rank.clock_uncertainty_s > 0) {
        std::snprintf(label, sizeof label, "clock within %.3f us", 1e6 * rank.clock_uncertainty_s);
      }
      writer_.name_process(rank.rank, "rank " + std::to_string(rank.rank) + " (" + rank.host + ")", label);
      writer_.name_thread(tiles_thread(rank.rank), "tiles");
    }
    writer_.name_thread(scheduling_thread(), "scheduling");
  }

  void write(const TimelineEvent& event) {
    switch (event.kind) {
      case TimelineEventKind::task_done:
        done_ += event.what;
        return writer_.counter(kMasterRank, "tiles", "left", event.at_ns, run_.tasks.size() - done_);
      case TimelineEventKind::phase:
        return writer_.slice(tiles_thread(kMasterRank), timeline_.phases[event.what].name, event.at_ns, event.end_ns,
                             {});
      case TimelineEventKind::accept:
        return write_accept(event);
      case TimelineEventKind::delivered:
        return writer_.flow_finish(scheduling_thread(), "deliver", way_back(event.what), event.at_ns);
      case TimelineEventKind::hand_out:
        return write_hand_out(event);
      case TimelineEventKind::handed_out:
        return writer_.flow_start(scheduling_thread(), "assign", way_out(event.what), event.at_ns);
      case TimelineEventKind::tile:
        return write_tile(event);
      case TimelineEventKind::begun:
        return writer_.flow_finish(tiles_thread(run_.tasks[event.what].rank), "assign", way_out(event.what),
                                   event.at_ns);
      case TimelineEventKind::returned:
        return writer_.flow_start(tiles_thread(run_.tasks[event.what].rank), "deliver", way_back(event.what),
                                  event.at_ns);
    }
  }

  void write_accept(const TimelineEvent& event) {
    const TaskRecord& task = run_.tasks[event.what];
    writer_.slice(scheduling_thread(), "accept from rank " + std::to_string(task.rank), event.at_ns, event.end_ns,
                  {{"tile", event.what}, {"rank", task.rank}, {"bytes", task.bytes}});
  }

  void write_hand_out(const TimelineEvent& event) {
    const HandOut& hand_out = made_.hand_outs[event.what];
    writer_.slice(scheduling_thread(), "assign to rank " + std::to_string(hand_out.rank), event.at_ns, event.end_ns,
                  {{"rank", hand_out.rank}, {"tiles", hand_out.tasks}});
  }

  void write_tile(const TimelineEvent& event) {
    const render::Rect& tile = timeline_.tiles[event.what];
    const TaskRecord& task = run_.tasks[event.what];
    writer_.slice(tiles_thread(task.rank), "tile " + std::to_string(event.what), event.at_ns, event.end_ns,
                  {{"tile", event.what},
                   {"x", tile.x},
                   {"y", tile.y},
                   {"width", tile.width},
                   {"height", tile.height},
                   {"rays", timeline_.rays[event.what].total()},
                   {"bytes", task.bytes}});
  }

  const Timeline& timeline_;
  const scheduler::RunRecord& run_;
  TimelineEvents made_;
  io::TraceWriter writer_;
  std::uint64_t done_ = 0;
};

}  // namespace

void write_timeline(const Timeline& timeline, const io::TraceWriter::Sink& sink) {
  TimelineWriter(timeline, sink).write();
}

}  // namespace tessera::app
