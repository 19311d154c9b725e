// SPDX-License-Identifier: BSD-3-Clause
// Main of every test program that runs under mpirun: "program [Boost.Test options] -- RANKS [MOST]" fails unless there
// are RANKS ranks; every MOST of them count as a node. Rank 0 reports; the others only speak of their failures, which
// fail the program as well.
#define BOOST_TEST_NO_MAIN
#define BOOST_TEST_ALTERNATIVE_INIT_API
#include <algorithm>
#include <boost/test/output/compiler_log_formatter.hpp>
#include <boost/test/unit_test.hpp>
#include <boost/test/unit_test_log.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "scheduler/mpi/session_for_tests.h"

namespace tessera::scheduler::mpi {
namespace {

Session* the_session = nullptr;
std::uint32_t most_ranks_on_node = std::numeric_limits<std::uint32_t>::max();

// Only failures, with the rank in front of their place.
class OtherRankLog : public boost::unit_test::output::compiler_log_formatter {
 public:
  void log_start(std::ostream&, boost::unit_test::counter_t) override {}
  void print_prefix(std::ostream& out, boost::unit_test::const_string file, std::size_t line) override {
    out << "rank " << the_session->rank() << ": ";
    compiler_log_formatter::print_prefix(out, file, line);
  }
};

bool set_up_log() {
  if (the_session->rank() != kMasterRank) boost::unit_test::unit_test_log.set_formatter(new OtherRankLog);  // takes it
  return true;
}

/// What comes after "--".
std::vector<std::string> words_for_us(const std::vector<char*>& arguments) {
  const auto dashes = std::find(arguments.begin(), arguments.end(), std::string_view("--"));
  return {dashes == arguments.end() ? dashes : dashes + 1, arguments.end()};
}

int run_tests(Session& session, std::vector<char*> arguments) {
  const std::vector<std::string> ours = words_for_us(arguments);
  if (ours.empty() || ours[0] != std::to_string(session.size())) {
    if (session.rank() == kMasterRank) {
      std::fprintf(stderr, "there are %u ranks, the last arguments must say so: -- %u\n", session.size(),
                   session.size());
    }
    return 1;
  }
  char quiet_log[] = "--log_level=error";
  char no_report[] = "--report_level=no";
  if (session.rank() != kMasterRank) {
    arguments.erase(arguments.begin() + 1, arguments.end() - static_cast<std::ptrdiff_t>(ours.size()) - 1);
    arguments.insert(arguments.begin() + 1, {quiet_log, no_report});
  }
  the_session = &session;
  return boost::unit_test::unit_test_main(&set_up_log, static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace

Session& session_for_tests() {
  return *the_session;
}

std::uint32_t most_ranks_on_node_in_tests() {
  return most_ranks_on_node;
}

namespace {

int run(int argc, char** argv) {
  const std::vector<char*> arguments(argv, argv + argc);
  const std::vector<std::string> ours = words_for_us(arguments);
  if (ours.size() > 1) most_ranks_on_node = static_cast<std::uint32_t>(std::stoul(ours[1]));
  Session session(argc, argv, most_ranks_on_node);
  return run_tests(session, arguments);
}

}  // namespace

}  // namespace tessera::scheduler::mpi

int main(int argc, char** argv) {
  return tessera::scheduler::mpi::run(argc, argv);
}
