// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scheduler/policy.h"

// For test cases that hold for each policy.
namespace tessera::scheduler {

inline constexpr Policy kAllPolicies[] = {Policy::dynamic,         Policy::static_bands, Policy::cyclic_rows,
                                          Policy::self_scheduling, Policy::guided,       Policy::factoring,
                                          Policy::trapezoid};

}  // namespace tessera::scheduler
