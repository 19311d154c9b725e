// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/reference/quad.h"

// Double precision measured against quad precision.
namespace tessera::render::test {

using namespace tessera::render::reference;

/// |a - exact|, rounded.
inline double error_of(double a, Quad exact) {
  return static_cast<double>(magnitude(a - exact));
}
inline double error_of(const Vec3& a, const QuadVec& exact) {
  return static_cast<double>(quad_length(QuadVec(a) - exact));
}

}  // namespace tessera::render::test
