// SPDX-License-Identifier: BSD-3-Clause
#include "io/nest_slices.h"

#include <algorithm>
#include <vector>

namespace tessera::io {
namespace {

/// A slice that may still hold some of those that follow.
struct Open {
  Slice* slice;
  std::uint64_t filled_ns;  ///< what it holds so far ends here
  std::uint64_t next_ns;    ///< what it holds next begins here or later
};

class Nesting {
 public:
  void add(Slice& slice) {
    for (;;) {
      while (!open_.empty() && !can_hold(*open_.back().slice, slice)) close_before(slice.begin_ns);
      slice.begin_ns = std::max(slice.begin_ns, open_.empty() ? next_ns_ : open_.back().next_ns);
      if (open_.empty() || slice.begin_ns < open_.back().slice->end_ns) break;
    }
    if (!open_.empty()) slice.end_ns = std::min(slice.end_ns, gap_before(open_.back().slice->end_ns));
    slice.end_ns = std::max(slice.end_ns, slice.begin_ns + 1);
    open_.push_back({&slice, slice.begin_ns, slice.begin_ns});
  }

 private:
  static bool can_hold(const Slice& outer, const Slice& inner) noexcept {
    return outer.level < inner.level && inner.begin_ns < outer.end_ns;
  }

  static std::uint64_t gap_before(std::uint64_t ns) noexcept { return std::max(ns, kSliceGapNs) - kSliceGapNs; }

  /// Ends the innermost open slice where the next one begins, if it goes on until then.
  void close_before(std::uint64_t begin_ns) {
    const Open last = open_.back();
    open_.pop_back();
    const std::uint64_t least_ns = std::max(last.slice->begin_ns + 1, last.filled_ns);
    last.slice->end_ns = std::max(std::min(last.slice->end_ns, gap_before(begin_ns)), least_ns);
    const std::uint64_t end_ns = last.slice->end_ns;
    if (open_.empty()) {
      next_ns_ = end_ns + kSliceGapNs;
    } else {
      open_.back().filled_ns = end_ns;
      open_.back().next_ns = end_ns + kSliceGapNs;
    }
  }

  std::vector<Open> open_;     ///< each within the one before
  std::uint64_t next_ns_ = 0;  ///< what nothing holds begins here or later
};

}  // namespace

void nest_slices(std::span<Slice> slices) {
  std::sort(slices.begin(), slices.end(), [](const Slice& a, const Slice& b) {
    if (a.begin_ns != b.begin_ns) return a.begin_ns < b.begin_ns;
    if (a.level != b.level) return a.level < b.level;
    return a.what < b.what;
  });
  Nesting nesting;
  for (Slice& slice : slices) nesting.add(slice);
}

}  // namespace tessera::io
