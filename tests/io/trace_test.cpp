// SPDX-License-Identifier: BSD-3-Clause
#include "io/trace.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <functional>
#include <string>
#include <vector>

namespace tessera::io {
namespace {

// What `write` makes of an empty trace.
std::string text_of(const std::function<void(TraceWriter&)>& write) {
  std::string text;
  TraceWriter writer([&](std::string_view piece) { text += piece; });
  write(writer);
  writer.finish();
  return text;
}

std::string in_array(const std::string& events) {
  return "{\"traceEvents\":[\n" + events + "\n]}\n";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(Trace)

BOOST_AUTO_TEST_CASE(nothing_is_an_empty_array) {
  BOOST_TEST(text_of([](TraceWriter&) {}) == in_array(""));
}

BOOST_AUTO_TEST_CASE(a_slice_has_its_times_in_microseconds_and_its_arguments) {
  const std::string text = text_of([](TraceWriter& writer) {
    writer.slice({3, 4}, "tile 5", 1'002'003, 1'002'050, {{"x", 16}, {"rays", 18'446'744'073'709'551'615U}});
    writer.slice({3, 4}, "empty", 0, 0, {});
  });
  BOOST_TEST(text == in_array(R"({"ph":"X","name":"tile 5","pid":3,"tid":4,"ts":1002.003,"dur":0.047,)"
                              R"("args":{"x":16,"rays":18446744073709551615}},)"
                              "\n"
                              R"({"ph":"X","name":"empty","pid":3,"tid":4,"ts":0.000,"dur":0.000})"));
}

BOOST_AUTO_TEST_CASE(the_ends_of_a_flow_share_all_that_identifies_it) {
  const std::string text = text_of([](TraceWriter& writer) {
    writer.flow_start({0, 9}, "assign", 7, 10);
    writer.flow_finish({1, 1}, "assign", 7, 20);
  });
  BOOST_TEST(text == in_array(R"({"ph":"s","name":"assign","pid":0,"tid":9,"cat":"flow","id":7,"ts":0.010,"bp":"e"},)"
                              "\n"
                              R"({"ph":"f","name":"assign","pid":1,"tid":1,"cat":"flow","id":7,"ts":0.020,"bp":"e"})"));
}

BOOST_AUTO_TEST_CASE(a_counter_belongs_to_a_process) {
  const std::string text = text_of([](TraceWriter& writer) { writer.counter(2, "tiles", "left", 1500, 99); });
  BOOST_TEST(text == in_array(R"({"ph":"C","name":"tiles","pid":2,"tid":2,"ts":1.500,"args":{"left":99}})"));
}

BOOST_AUTO_TEST_CASE(names_are_escaped) {
  const std::string text = text_of([](TraceWriter& writer) {
    writer.name_process(1, "a\"b\\c\n\xff", "");
    writer.name_process(2, "x", "label");
    writer.name_thread({1, 5}, "scheduling");
  });
  const std::string mark = "\uFFFD";
  BOOST_TEST(text ==
             in_array(R"({"ph":"M","name":"process_name","pid":1,"tid":1,"args":{"name":"a\"b\\c\u000a)" + mark +
                      "\"}},\n" + R"({"ph":"M","name":"process_sort_index","pid":1,"tid":1,"args":{"sort_index":1}},)" +
                      "\n" + R"({"ph":"M","name":"process_name","pid":2,"tid":2,"args":{"name":"x"}},)" + "\n" +
                      R"({"ph":"M","name":"process_sort_index","pid":2,"tid":2,"args":{"sort_index":2}},)" + "\n" +
                      R"({"ph":"M","name":"process_labels","pid":2,"tid":2,"args":{"labels":"label"}},)" + "\n" +
                      R"({"ph":"M","name":"thread_name","pid":1,"tid":5,"args":{"name":"scheduling"}},)" + "\n" +
                      R"({"ph":"M","name":"thread_sort_index","pid":1,"tid":5,"args":{"sort_index":5}})"));
}

BOOST_AUTO_TEST_CASE(a_large_trace_leaves_in_pieces) {
  std::size_t pieces = 0;
  std::size_t longest = 0;
  std::size_t bytes = 0;
  TraceWriter writer([&](std::string_view piece) {
    ++pieces;
    longest = std::max(longest, piece.size());
    bytes += piece.size();
  });
  for (std::uint64_t i = 0; i < 100'000; ++i) writer.counter(0, "tiles", "left", i, i);
  writer.finish();
  BOOST_TEST(bytes > 5'000'000U);
  BOOST_TEST(pieces > 50U);
  BOOST_TEST(longest < 70'000U);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
