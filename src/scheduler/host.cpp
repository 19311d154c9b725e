// SPDX-License-Identifier: BSD-3-Clause
#include "scheduler/host.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>
#include <system_error>

namespace tessera::scheduler {

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "unknown";
  return name.data();
}

namespace {

bool runs_this_program(std::uint32_t process) noexcept {
  std::error_code error;
  const std::filesystem::path proc = "/proc";
  return std::filesystem::equivalent(proc / std::to_string(process) / "exe", proc / "self" / "exe", error);
}

}  // namespace

std::uint32_t process_id() noexcept {
  return static_cast<std::uint32_t>(getpid());
}

void end_process(std::uint32_t process) noexcept {
  if (process == process_id() || !runs_this_program(process)) return;
  ::kill(static_cast<::pid_t>(process), SIGKILL);
}

}  // namespace tessera::scheduler
