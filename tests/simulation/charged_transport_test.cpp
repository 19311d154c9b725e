// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/charged_transport.h"

#include <boost/test/unit_test.hpp>

#include "scheduler/loopback.h"

namespace tessera::simulation {

BOOST_AUTO_TEST_SUITE(charged_transport)

BOOST_AUTO_TEST_CASE(each_message_that_arrives_costs_its_time) {
  scheduler::LoopbackNetwork network(2, 1);
  double spent_s = 0;
  ChargedTransport charged(network.transport(0), {.per_message_s = 2, .per_byte_s = 0.5},
                           [&](double seconds) { spent_s += seconds; });
  BOOST_TEST(!charged.receive());
  BOOST_TEST(spent_s == 0);
  network.transport(1).send(0, scheduler::Bytes(10));
  while (!charged.receive()) {
  }
  BOOST_TEST(spent_s == 2 + 10 * 0.5);
}

BOOST_AUTO_TEST_CASE(sending_passes_through_and_counts) {
  scheduler::LoopbackNetwork network(2, 1);
  ChargedTransport charged(network.transport(0), {}, [](double) {});
  charged.send(1, scheduler::Bytes(7));
  BOOST_TEST(charged.sent().bytes == 7U);
  std::optional<scheduler::Envelope> arrived;
  while (!arrived) arrived = network.transport(1).receive();
  BOOST_TEST(arrived->bytes.size() == 7U);
  BOOST_TEST(charged.rank() == 0U);
  BOOST_TEST(charged.size() == 2U);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::simulation
