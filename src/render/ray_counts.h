// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace tessera::render {

/// Rays traced, by what they are for.
struct RayCounts {
  std::uint64_t primary = 0;
  std::uint64_t shadow = 0;
  std::uint64_t mirror = 0;

  friend bool operator==(const RayCounts&, const RayCounts&) = default;

  std::uint64_t total() const noexcept { return primary + shadow + mirror; }
  RayCounts& operator+=(const RayCounts& o) noexcept {
    primary += o.primary;
    shadow += o.shadow;
    mirror += o.mirror;
    return *this;
  }
};

}  // namespace tessera::render
