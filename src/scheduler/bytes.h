// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

// What travels between ranks.
namespace tessera::scheduler {

using Bytes = std::vector<std::byte>;

/// How much has travelled.
struct Traffic {
  std::uint64_t count = 0;  ///< messages
  std::uint64_t bytes = 0;

  friend bool operator==(const Traffic&, const Traffic&) = default;
};

}  // namespace tessera::scheduler
