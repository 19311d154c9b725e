// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/host.h"

#include <unistd.h>

#include <array>

namespace tessera::scheduler {

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "unknown";
  return name.data();
}

std::uint32_t process_id() noexcept {
  return static_cast<std::uint32_t>(getpid());
}

}  // namespace tessera::scheduler
