// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/quad_oracle.h"
#include "render/rational.h"

// Whether a line meets a sphere, for many lines that all but touch it: in quad precision where that can tell, else in
// rational numbers. It shares nothing with how the renderer decides.
namespace tessera::stress {

/// r^2 d.d - |f x d|^2, f = center - origin, with a bound on its error.
struct QuadDiscriminant {
  render::reference::Quad value;
  double error;

  /// error:   e = 2^-113. Let F, D be the sums of |f|'s and |d|'s components, S that of w's, w = f x d.
  ///          f is off by e of itself, its products with d by 2.01 e, so w by 3.02 e F D in each component (1 e of it
  ///          from the difference, |w_k| <= F D). Then w.w is off by 2 S 3.02 e F D + 3 (3.02 e F D)^2 and 3.01 e w.w
  ///          from the squares and their sum; r^2 d.d by 4.01 e of itself, all products of doubles being exact; the
  ///          difference by e (r^2 d.d + w.w). The numbers below are larger, for the sum is itself rounded.
  QuadDiscriminant(const render::Vec3& origin, const render::Vec3& direction, const render::Vec3& center,
                   double radius) {
    using namespace render::reference;
    const QuadVec f = QuadVec(center) - QuadVec(origin);
    const QuadVec w = quad_cross(f, direction);
    const Quad reach = Quad(radius) * radius * quad_dot(direction, direction);
    const Quad passing = quad_dot(w, w);
    value = reach - passing;
    const double fd = sum_of(f) * sum_of(direction);
    error = 0x1p-113 * (8 * sum_of(w) * fd + 8 * static_cast<double>(reach + passing)) + 0x1p-220 * fd * fd;
  }

 private:
  static double sum_of(const render::reference::QuadVec& v) {
    using render::reference::magnitude;
    return static_cast<double>(magnitude(v.x) + magnitude(v.y) + magnitude(v.z));
  }
};

/// Counts what it had to ask rational numbers for.
class TangencyOracle {
 public:
  bool meets(const render::Vec3& origin, const render::Vec3& direction, const render::Vec3& center, double radius) {
    const QuadDiscriminant quad(origin, direction, center, radius);
    const bool is_sure = static_cast<double>(render::reference::magnitude(quad.value)) > quad.error;
    // Every so often rational numbers are asked all the same.
    const bool is_checked = asked_++ % 256 == 0;
    if (is_sure && !is_checked) return quad.value > 0;
    const bool exact = render::test::rational_discriminant(origin, direction, center, radius) >= 0;
    if (is_sure) {
      disagreements_ += exact != (quad.value > 0);
    } else {
      ++unsure_;
    }
    return exact;
  }

  std::size_t unsure() const { return unsure_; }
  std::size_t disagreements() const { return disagreements_; }

 private:
  std::size_t asked_ = 0;
  std::size_t unsure_ = 0;
  std::size_t disagreements_ = 0;
};

}  // namespace tessera::stress
