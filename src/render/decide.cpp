// SPDX-License-Identifier: BSD-3-Clause
#include "render/decide.h"

#include "render/exact_formula.h"

namespace tessera::render {

int side_of_sphere(const Vec3& point, const Vec3& center, double radius) {
  return sign_of([&]<class N>() {
    const VecOf<N> f = difference<N>(center, point);
    return dot(f, f) - N(radius) * N(radius);
  });
}

int side_of_plane(const Vec3& point, const Vec3& base, const Vec3& normal) {
  return sign_of([&]<class N>() { return dot(difference<N>(point, base), VecOf<N>(normal)); });
}

int line_meets_sphere(const Vec3& origin, const Vec3& direction, const Vec3& center, double radius) {
  return sign_of([&]<class N>() {
    const VecOf<N> d(direction);
    const VecOf<N> w = cross(difference<N>(center, origin), d);
    return N(radius) * N(radius) * dot(d, d) - dot(w, w);
  });
}

int sign_of_dot(const Vec3& a, const Vec3& b) {
  return sign_of([&]<class N>() { return dot(VecOf<N>(a), VecOf<N>(b)); });
}

int nearest_point_against_end(const Vec3& origin, const Vec3& direction, double end, const Vec3& center) {
  return sign_of([&]<class N>() {
    const VecOf<N> d(direction);
    return dot(difference<N>(center, origin), d) - N(end) * dot(d, d);
  });
}

}  // namespace tessera::render
