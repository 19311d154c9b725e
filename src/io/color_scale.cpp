// SPDX-License-Identifier: BSD-3-Clause
#include "io/color_scale.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "io/oklab.h"

namespace tessera::io {
namespace {

// Corners of a path through what a display can show; between them it is straight.
constexpr std::array<Oklab, 5> kPath{{
    {0.22, 0.021, -0.077},
    {0.40, 0.086, -0.123},
    {0.58, 0.180, 0.000},
    {0.76, 0.080, 0.115},
    {0.95, -0.012, 0.069},
}};

using Lengths = std::array<double, kPath.size() - 1>;

Lengths lengths_of_path() noexcept {
  Lengths lengths{};
  for (std::size_t i = 0; i != lengths.size(); ++i) lengths[i] = distance_between(kPath[i], kPath[i + 1]);
  return lengths;
}

Oklab between(const Oklab& from, const Oklab& to, double share) noexcept {
  return {from.lightness + share * (to.lightness - from.lightness), from.a + share * (to.a - from.a),
          from.b + share * (to.b - from.b)};
}

}  // namespace

Rgb8 scale_color(double value) noexcept {
  static const Lengths lengths = lengths_of_path();
  double whole = 0;
  for (const double length : lengths) whole += length;
  double rest = std::clamp(value, 0.0, 1.0) * whole;
  std::size_t leg = 0;
  for (; leg + 1 != lengths.size() && rest > lengths[leg]; ++leg) rest -= lengths[leg];
  return rgb8_of(between(kPath[leg], kPath[leg + 1], std::min(rest / lengths[leg], 1.0)));
}

}  // namespace tessera::io
