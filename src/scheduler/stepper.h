// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "scheduler/backoff.h"
#include "scheduler/transport.h"

// A rank's part in a run goes in steps that never wait. A process that has a core to itself takes one after the other;
// a test takes turns between all ranks.
namespace tessera::scheduler {

/// What a step found.
enum class Step : std::uint8_t {
  worked,    ///< there was something to do
  idle,      ///< there was not: try again later
  finished,  ///< there will never be again
};

/// Steps until finished, giving way while idle.
template <class Stepper>
void run_to_end(Stepper& stepper, Transport& transport) {
  Backoff backoff(transport.patience());
  for (Step step = stepper.step(); step != Step::finished; step = stepper.step()) {
    if (step == Step::worked) {
      backoff.reset();
    } else {
      transport.wait_for_message(backoff);
    }
  }
}

}  // namespace tessera::scheduler
