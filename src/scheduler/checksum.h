// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tessera::scheduler {

/// 64 bits that tell whether bytes arrived as they were sent; `seed` carries on from bytes before them. No protection
/// against malice.
/// source:  XXH3, Collet, https://xxhash.com
std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t seed = 0) noexcept;

}  // namespace tessera::scheduler
