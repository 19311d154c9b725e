// SPDX-License-Identifier: BSD-3-Clause
#include "app/timeline.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

using namespace tessera;
using namespace tessera::app;

namespace {

/// A task of a rank: assigned, begun, done, received and accepted, in microseconds.
scheduler::TaskRecord task_of(scheduler::Rank rank, double assigned, double start, double end, double received,
                              double accepted) {
  scheduler::TaskRecord task;
  task.rank = rank;
  task.assigned_s = 1e-6 * assigned;
  task.start_s = 1e-6 * start;
  task.end_s = 1e-6 * end;
  task.received_s = 1e-6 * received;
  task.accepted_s = 1e-6 * accepted;
  return task;
}

/// The trace of these tasks on two ranks, in a run that began a second after the command.
std::string trace_of(std::vector<scheduler::TaskRecord> tasks, double offset_us = 0) {
  scheduler::RunRecord run;
  run.tasks = std::move(tasks);
  run.ranks = {{.rank = 0, .host = "a"}, {.rank = 1, .host = "b", .clock_offset_s = 1e-6 * offset_us}};
  const std::vector<render::Rect> tiles(run.tasks.size(), render::Rect{0, 0, 8, 8});
  const std::vector<render::RayCounts> rays(run.tasks.size());
  std::string text;
  write_timeline({run, 1.0, tiles, rays, {}}, [&](std::string_view piece) { text += piece; });
  return text;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(TimelineTest)

BOOST_AUTO_TEST_CASE(times_of_another_rank_are_moved_to_rank_0s_clock) {
  const std::string text = trace_of({task_of(1, 10, 3, 7, 40, 50)}, 20);
  BOOST_TEST(count(text, R"("name":"tile 0","pid":1,"tid":1,"ts":1000023.000,"dur":4.000)") == 1U, text);
  BOOST_TEST(count(text, R"("name":"assign to rank 1","pid":0,"tid":2,"ts":1000010.000,"dur":1.000)") == 1U, text);
  BOOST_TEST(count(text, R"("name":"accept from rank 1","pid":0,"tid":2,"ts":1000040.000,"dur":10.000)") == 1U, text);
  BOOST_TEST(count(text, R"("pid":1,"tid":1,"args":{"name":"rank 1 (b))"
                         "\"}") == 1U,
             text);
}

BOOST_AUTO_TEST_CASE(tasks_of_one_assignment_share_a_slice) {
  const std::string text = trace_of({task_of(1, 10, 20, 30, 40, 50), task_of(1, 10, 31, 60, 70, 80)});
  BOOST_TEST(count(text, "\"assign to rank 1\"") == 1U, text);
  BOOST_TEST(count(text, R"({"rank":1,"tiles":2})") == 1U, text);
  BOOST_TEST(count(text, "\"ph\":\"s\"") == 4U, text);
}

BOOST_AUTO_TEST_CASE(a_tile_of_rank_0_lasts_until_rank_0_has_its_result) {
  const std::string text = trace_of({task_of(0, 10, 20, 30, 45, 50)});
  BOOST_TEST(count(text, R"("name":"tile 0","pid":0,"tid":0,"ts":1000020.000,"dur":25.000)") == 1U, text);
}

BOOST_AUTO_TEST_CASE(an_arrow_never_leads_back_in_time) {
  const std::string early = trace_of({task_of(1, 10, 5, 30, 40, 50)});
  BOOST_TEST(count(early, "\"name\":\"assign\"") == 0U, early);
  BOOST_TEST(count(early, "\"name\":\"deliver\"") == 2U, early);
  const std::string late = trace_of({task_of(1, 10, 15, 45, 40, 50)});
  BOOST_TEST(count(late, "\"name\":\"assign\"") == 2U, late);
  BOOST_TEST(count(late, "\"name\":\"deliver\"") == 0U, late);
}

BOOST_AUTO_TEST_CASE(a_clock_that_stands_still_loses_no_slice) {
  const std::string text = trace_of(std::vector<scheduler::TaskRecord>(5, task_of(1, 0, 0, 0, 0, 0)));
  BOOST_TEST(count(text, "\"name\":\"tile ") == 5U, text);
  BOOST_TEST(count(text, "\"name\":\"accept from rank 1\"") == 5U, text);
  BOOST_TEST(count(text, "\"dur\":0.000") == 0U, text);
  BOOST_TEST(count(text, "\"ph\":\"s\"") == count(text, "\"ph\":\"f\""), text);
}

BOOST_AUTO_TEST_SUITE_END()
