// SPDX-License-Identifier: BSD-3-Clause
#include "io/suggest.h"

#include <algorithm>
#include <numeric>

#include "io/lower_case.h"

namespace tessera::io {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Row i holds the distances from the first i letters of a to the first 0, 1, ... letters of b
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});

  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replace, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongestWord = 100;  // nothing known is longer, and the work is bounded
  if (word.size() > kLongestWord) return std::nullopt;

  const std::string lower_word = lower_case(std::string(word));
  std::optional<std::string> nearest;
  std::size_t smallest = word.size();
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(lower_word, lower_case(candidate));
    const std::size_t allowed = (std::max(word.size(), candidate.size()) + 1) / 3;
    if (distance > allowed || distance >= smallest) continue;
    smallest = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const auto nearest = nearest_word(word, known);
  return nearest ? ", did you mean \"" + *nearest + "\"?" : "";
}

}  // namespace tessera::io
