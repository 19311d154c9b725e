// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/stepper.h"

#include <boost/test/unit_test.hpp>
#include <vector>

namespace tessera::scheduler {
namespace {

/// Counts how often it was waited on.
class WaitedOn final : public Transport {
 public:
  Rank rank() const noexcept override { return 0; }
  std::uint32_t size() const noexcept override { return 1; }
  void wait_for_message(Backoff&) override { ++waits; }
  bool try_flush() override { return true; }
  void abandon(Rank) override {}
  bool is_oversubscribed() const noexcept override { return false; }

  int waits = 0;

 private:
  void do_send(Rank, std::span<const std::byte>, std::span<const std::byte>) override {}
  std::optional<Envelope> do_receive() override { return std::nullopt; }
};

/// Takes the steps that it was given.
struct Script {
  std::vector<Step> steps;
  std::size_t taken = 0;

  Step step() { return steps.at(taken++); }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(stepper)

BOOST_AUTO_TEST_CASE(waits_once_on_the_transport_for_each_idle_step) {
  WaitedOn transport;
  Script script{{Step::worked, Step::idle, Step::idle, Step::worked, Step::idle, Step::finished}};
  run_to_end(script, transport);
  BOOST_TEST(script.taken == script.steps.size());
  BOOST_TEST(transport.waits == 3);
}

BOOST_AUTO_TEST_CASE(a_stepper_that_has_finished_takes_no_further_step) {
  WaitedOn transport;
  Script script{{Step::finished, Step::worked}};
  run_to_end(script, transport);
  BOOST_TEST(script.taken == 1U);
  BOOST_TEST(transport.waits == 0);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::scheduler
