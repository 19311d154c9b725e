// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

// Slices of a trace as Perfetto wants those of one thread: apart, or one within the other.
namespace tessera::io {

/// A stretch of time on some thread. It can hold slices of higher levels only.
/// units:   nanoseconds
struct Slice {
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint32_t level = 0;
  std::size_t what = 0;  ///< the caller's own
};

/// Between neighbours, and at the end of a slice behind what it holds, where there is room: whoever reads microseconds
/// into a double and back to whole nanoseconds may lose one at either end.
inline constexpr std::uint64_t kSliceGapNs = 2;

/// Brings the slices of a thread into the order of their beginnings, the outer one first, and changes times where they
/// overlap without nesting: the earlier one ends when the later one begins. Each lasts a nanosecond at least, for which
/// later ones move where they must.
void nest_slices(std::span<Slice> slices);

}  // namespace tessera::io
