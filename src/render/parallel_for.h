// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <system_error>
#include <vector>

namespace tessera::render {

/// Calls visit(i) for all i < count, each once and in any order, on so many threads, of which this is one, or on fewer
/// where the system has no more. With one thread the order ascends.
/// throws:  what `visit` throws, once all threads have come to their end
template <class Visit>
void parallel_for(unsigned threads, std::size_t count, Visit&& visit) {
  std::atomic<std::size_t> next{0};
  const auto take_turns = [&] {
    for (std::size_t i = next++; i < count; i = next++) visit(i);
  };
  std::vector<std::future<void>> helpers;
  const std::size_t most = std::min<std::size_t>(threads, count);
  helpers.reserve(most);
  try {
    while (helpers.size() + 1 < most) helpers.push_back(std::async(std::launch::async, take_turns));
  } catch (const std::system_error&) {
    // Those that are there take the turns of the others.
  }
  take_turns();
  for (std::future<void>& helper : helpers) helper.get();
}

}  // namespace tessera::render
