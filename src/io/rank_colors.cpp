// SPDX-License-Identifier: BSD-3-Clause
#include "io/rank_colors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "io/oklab.h"

namespace tessera::io {
namespace {

constexpr unsigned kLevels = 9;
constexpr Rgb8 kFirst{0x40, 0x80, 0xDF};

/// A colour that may be chosen, and how far it is from the nearest chosen one.
struct Candidate {
  Rgb8 color;
  Oklab look;
  double apart;
};

std::uint8_t channel_of(unsigned level) noexcept {
  return static_cast<std::uint8_t>((510 * level / (kLevels - 1) + 1) / 2);
}

/// A grid of colours without greys and what is almost black or white.
std::vector<Candidate> candidates() {
  std::vector<Candidate> all;
  for (unsigned red = 0; red != kLevels; ++red) {
    for (unsigned green = 0; green != kLevels; ++green) {
      for (unsigned blue = 0; blue != kLevels; ++blue) {
        const Rgb8 color{channel_of(red), channel_of(green), channel_of(blue)};
        const Oklab look = oklab_of(color);
        const bool is_strong = look.lightness >= 0.35 && look.lightness <= 0.93 && std::hypot(look.a, look.b) >= 0.05;
        if (is_strong) all.push_back({color, look, std::numeric_limits<double>::infinity()});
      }
    }
  }
  return all;
}

}  // namespace

std::vector<Rgb8> rank_colors(std::uint32_t count) {
  std::vector<Candidate> left = candidates();
  std::vector<Rgb8> colors;
  colors.reserve(count);
  const std::size_t different = std::min<std::size_t>(count, left.size());
  auto next = std::find_if(left.begin(), left.end(), [](const Candidate& c) { return c.color == kFirst; });
  while (colors.size() != different) {
    const Candidate chosen = *next;
    colors.push_back(chosen.color);
    for (Candidate& candidate : left) {
      candidate.apart = std::min(candidate.apart, distance_between(candidate.look, chosen.look));
    }
    next = std::max_element(left.begin(), left.end(),
                            [](const Candidate& a, const Candidate& b) { return a.apart < b.apart; });
  }
  while (colors.size() != count) colors.push_back(colors[colors.size() - different]);
  return colors;
}

}  // namespace tessera::io
