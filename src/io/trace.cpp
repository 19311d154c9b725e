// SPDX-License-Identifier: BSD-3-Clause
#include "io/trace.h"

#include <utility>

#include "io/json_string.h"

namespace tessera::io {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 16;

/// "12.345" of 12345 nanoseconds.
std::string microseconds(std::uint64_t ns) {
  std::string text = std::to_string(ns / 1000);
  text += '.';
  for (const unsigned place : {100U, 10U, 1U}) text += "0123456789"[ns / place % 10];
  return text;
}

/// A JSON object with one member.
std::string object(std::string_view key, std::string_view json) {
  std::string text = "{";
  text += json_string(key);
  text += ':';
  text += json;
  return text += '}';
}

}  // namespace

TraceWriter::TraceWriter(Sink sink) : sink_(std::move(sink)), text_("{\"traceEvents\":[\n") {}

void TraceWriter::name_process(std::uint32_t process, std::string_view name, std::string_view label) {
  const TraceThread thread{process, process};
  metadata(thread, "process_name", "name", json_string(name));
  metadata(thread, "process_sort_index", "sort_index", std::to_string(process));
  if (!label.empty()) metadata(thread, "process_labels", "labels", json_string(label));
}

void TraceWriter::name_thread(const TraceThread& thread, std::string_view name) {
  metadata(thread, "thread_name", "name", json_string(name));
  metadata(thread, "thread_sort_index", "sort_index", std::to_string(thread.thread));
}

void TraceWriter::slice(const TraceThread& thread, std::string_view name, std::uint64_t begin_ns, std::uint64_t end_ns,
                        std::initializer_list<TraceArgument> arguments) {
  begin('X', thread, name);
  member("ts", microseconds(begin_ns));
  member("dur", microseconds(end_ns - begin_ns));
  std::string all;
  for (const TraceArgument& argument : arguments) {
    all += all.empty() ? '{' : ',';
    all += json_string(argument.name);
    all += ':';
    all += std::to_string(argument.value);
  }
  if (!all.empty()) member("args", all += '}');
  end();
}

void TraceWriter::flow_start(const TraceThread& thread, std::string_view name, std::uint64_t id, std::uint64_t at_ns) {
  flow('s', thread, name, id, at_ns);
}

void TraceWriter::flow_finish(const TraceThread& thread, std::string_view name, std::uint64_t id, std::uint64_t at_ns) {
  flow('f', thread, name, id, at_ns);
}

void TraceWriter::counter(std::uint32_t process, std::string_view name, std::string_view series, std::uint64_t at_ns,
                          std::uint64_t value) {
  begin('C', {process, process}, name);
  member("ts", microseconds(at_ns));
  member("args", object(series, std::to_string(value)));
  end();
}

void TraceWriter::finish() {
  text_ += "\n]}\n";
  hand_on();
}

void TraceWriter::begin(char kind, const TraceThread& thread, std::string_view name) {
  text_ += first_ ? "" : ",\n";
  first_ = false;
  text_ += "{\"ph\":\"";
  text_ += kind;
  text_ += '"';
  member("name", json_string(name));
  member("pid", std::to_string(thread.process));
  member("tid", std::to_string(thread.thread));
}

void TraceWriter::metadata(const TraceThread& thread, std::string_view kind, std::string_view key,
                           const std::string& json) {
  begin('M', thread, kind);
  member("args", object(key, json));
  end();
}

void TraceWriter::flow(char kind, const TraceThread& thread, std::string_view name, std::uint64_t id,
                       std::uint64_t at_ns) {
  begin(kind, thread, name);
  member("cat", "\"flow\"");
  member("id", std::to_string(id));
  member("ts", microseconds(at_ns));
  member("bp", "\"e\"");
  end();
}

void TraceWriter::member(std::string_view key, std::string_view json) {
  text_ += ",\"";
  text_ += key;
  text_ += "\":";
  text_ += json;
}

void TraceWriter::hand_on() {
  sink_(text_);
  text_.clear();
}

void TraceWriter::end() {
  text_ += '}';
  if (text_.size() >= kPieceBytes) hand_on();
}

}  // namespace tessera::io
