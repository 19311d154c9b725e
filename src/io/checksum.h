// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tessera::io {

/// XXH3 in 64 bits: tells bytes from damaged or other ones, up to a chance of 2^-64; no protection against malice.
/// Bytes in pieces: give the checksum of a piece as the seed of the next.
std::uint64_t checksum_of(std::span<const std::byte> bytes, std::uint64_t seed = 0) noexcept;

}  // namespace tessera::io
