// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

// Who did what when, in the trace event format of Chrome, which Perfetto (ui.perfetto.dev) opens as well.
// source: Duca and Sinclair, Trace Event Format (2016)
namespace tessera::io {

/// Where a row of slices is drawn. Thread numbers are unique among all processes, for Perfetto looks names up by them,
/// and a process's first thread has the process's number.
struct TraceThread {
  std::uint32_t process = 0;
  std::uint32_t thread = 0;
};

/// What a slice says of itself.
struct TraceArgument {
  std::string_view name;
  std::uint64_t value;
};

/// Writes events as they come, so that a trace may be larger than memory. Times are in nanoseconds and appear in the
/// file in microseconds with three decimals, which keeps each of them.
///
/// What Perfetto asks for, the caller sees to: events come in the order of their times; slices of a thread lie apart or
/// within each other; an outer one comes before what it holds; a flow's two ends come right after the slices that they
/// belong to, within whose times they are, the start first.
class TraceWriter {
 public:
  /// Takes the file's text piece by piece.
  using Sink = std::function<void(std::string_view)>;

  explicit TraceWriter(Sink sink);

  /// Processes are shown in the order of their numbers; `label` stands beside the name, "" is none.
  void name_process(std::uint32_t process, std::string_view name, std::string_view label);
  void name_thread(const TraceThread& thread, std::string_view name);

  /// requires: begin_ns <= end_ns
  void slice(const TraceThread& thread, std::string_view name, std::uint64_t begin_ns, std::uint64_t end_ns,
             std::initializer_list<TraceArgument> arguments);

  /// An arrow from one slice to another. Its ends share `name` and `id`, which no other arrow has.
  void flow_start(const TraceThread& thread, std::string_view name, std::uint64_t id, std::uint64_t at_ns);
  void flow_finish(const TraceThread& thread, std::string_view name, std::uint64_t id, std::uint64_t at_ns);

  /// The value of a curve from now on; Perfetto shows it as "name series".
  void counter(std::uint32_t process, std::string_view name, std::string_view series, std::uint64_t at_ns,
               std::uint64_t value);

  /// Ends the file. Nothing can be written after it.
  void finish();

 private:
  /// Begins an event with what all have in common.
  void begin(char kind, const TraceThread& thread, std::string_view name);
  void metadata(const TraceThread& thread, std::string_view kind, std::string_view key, const std::string& json);
  void flow(char kind, const TraceThread& thread, std::string_view name, std::uint64_t id, std::uint64_t at_ns);
  void member(std::string_view key, std::string_view json);
  void end();
  void hand_on();

  Sink sink_;
  std::string text_;  ///< not yet in the sink
  bool first_ = true;
};

}  // namespace tessera::io
