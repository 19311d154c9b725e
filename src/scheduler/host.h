// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace tessera::scheduler {

/// The name of the machine that this process runs on, "unknown" where it has none.
std::string host_name();
std::uint32_t process_id() noexcept;

/// Ends another process of this machine, if it runs the same program as this one: a number may have passed on to
/// somebody else's.
void end_process(std::uint32_t process) noexcept;

}  // namespace tessera::scheduler
