// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "render/vec3.h"

// Random numbers that are the same on every machine: the standard's distributions are not.
namespace tessera::render::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// A double in [lo, hi), of 53 random bits.
  double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }
  double uniform() { return uniform(0, 1); }

  /// A double whose logarithm is uniform.
  double over_decades(double lo, double hi) { return lo * std::pow(hi / lo, uniform()); }

  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(engine_() % bound); }
  bool flip() { return (engine_() >> 40) % 2 == 0; }

  Vec3 in_box(double half_side) {
    return {uniform(-half_side, half_side), uniform(-half_side, half_side), uniform(-half_side, half_side)};
  }

  /// A direction, uniform on the unit sphere, of length 1 up to rounding.
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in_box(1);
      const double squared = dot(v, v);
      if (squared > 0.01 && squared < 1) return normalized(v);
    }
  }

  /// A unit vector perpendicular to `axis`.
  Vec3 perpendicular_to(const Vec3& axis) {
    for (;;) {
      const Vec3 v = cross(axis, direction());
      if (dot(v, v) > 0.01 * dot(axis, axis)) return normalized(v);
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace tessera::render::test
