// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace tessera::scheduler {

/// The name of the machine that this process runs on, "unknown" where it has none.
std::string host_name();
std::uint32_t process_id() noexcept;

}  // namespace tessera::scheduler
