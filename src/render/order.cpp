// SPDX-License-Identifier: BSD-3-Clause
#include "render/order.h"

#include "render/exact_formula.h"

namespace tessera::render {
namespace {

/// The distance (b + sign sqrt(S)) / a with a > 0, as every meeting can be written.
template <class Number>
struct Distance {
  Number b;
  Number squared_root;  ///< S
  int sign;
  Number a;
};

template <class N>
Distance<N> zero() {
  return {0.0, 0.0, 0, 1.0};
}

template <class N>
Distance<N> distance_along_sphere(const Ray& ray, const Sphere& sphere, int sign) {
  const VecOf<N> d(ray.direction);
  const VecOf<N> f = difference<N>(sphere.center, ray.origin);
  const VecOf<N> w = cross(f, d);
  const N a = dot(d, d);
  return {dot(f, d), N(sphere.radius) * N(sphere.radius) * a - dot(w, w), sign, a};
}

/// The facts about a candidate that decide which form its distance takes; themselves exact.
struct Form {
  bool is_behind = false;  ///< counts as distance 0
  int sign = 0;            ///< of the root
};

Form form_of(const Scene& scene, const Ray& ray, const Candidate& candidate) {
  switch (candidate.meeting) {
    case Meeting::entry: {
      const Sphere& sphere = scene.sphere(candidate.surface);
      return {side_of(ray.origin, sphere.center, sphere.radius) <= 0, -1};
    }
    case Meeting::exit: {
      const Sphere& sphere = scene.sphere(candidate.surface);
      const bool recedes = side_of_plane(sphere.center, ray.origin, ray.direction) < 0;
      const bool meets = line_meets_sphere(ray.origin, ray.direction, sphere.center, sphere.radius) >= 0;
      return {recedes && (!meets || side_of(ray.origin, sphere.center, sphere.radius) > 0), meets ? 1 : 0};
    }
    case Meeting::own_exit:
      return {sign_of_dot(ray.from_normal, ray.direction) >= 0, 0};
    case Meeting::plane: {
      const Plane& plane = scene.plane(candidate.surface);
      const int ahead = side_of_plane(plane.point, ray.origin, plane.normal);
      return {ahead * sign_of_dot(plane.normal, ray.direction) <= 0, sign_of_dot(plane.normal, ray.direction)};
    }
  }
  return {};
}

template <class N>
Distance<N> distance_of(const Scene& scene, const Ray& ray, const Candidate& candidate, const Form& form) {
  if (form.is_behind) return zero<N>();
  switch (candidate.meeting) {
    case Meeting::entry:
    case Meeting::exit:
      return distance_along_sphere<N>(ray, scene.sphere(candidate.surface), form.sign);
    case Meeting::own_exit: {
      const VecOf<N> d(ray.direction);
      const N twice_radius = N(-2.0) * N(scene.sphere(candidate.surface).radius);
      return {twice_radius * dot(VecOf<N>(ray.from_normal), d), 0.0, 0, dot(d, d)};
    }
    case Meeting::plane: {
      const Plane& plane = scene.plane(candidate.surface);
      const VecOf<N> normal(plane.normal);
      const N side(static_cast<double>(form.sign));
      return {side * dot(difference<N>(plane.point, ray.origin), normal), 0.0, 0,
              side * dot(normal, VecOf<N>(ray.direction))};
    }
  }
  return zero<N>();
}

/// Sign of p sqrt(P) + q sqrt(Q), for signs p and q.
/// shapes:  P, Q > 0 unless its sign is 0
int sign_of_roots(int p, const Dyadic& P, int q, const Dyadic& Q) {
  if (p == 0 || q == 0 || p == q) return p != 0 ? p : q;
  return p * (P - Q).sign();
}

/// Sign of x + p sqrt(P) + q sqrt(Q): compares squares until no root is left.
/// shapes:  P, Q >= 0 unless its sign is 0
int sign_with_roots(const Dyadic& x, int p, const Dyadic& P, int q, const Dyadic& Q) {
  if (P.sign() == 0) p = 0;
  if (Q.sign() == 0) q = 0;
  const int roots = sign_of_roots(p, P, q, Q);
  const int rest = x.sign();
  if (roots * rest >= 0) return rest != 0 ? rest : roots;
  // Opposite signs: x^2 against (p sqrt(P) + q sqrt(Q))^2, that is z against 2 p q sqrt(P Q).
  Dyadic z = x * x;
  if (p != 0) z = z - P;
  if (q != 0) z = z - Q;
  const int product = p * q;
  if (product == 0) return rest * z.sign();
  if (z.sign() != product) return -rest * product;
  return rest * product * (z * z - Dyadic(4.0) * P * Q).sign();
}

std::optional<int> sign_of_difference(const Distance<Certified>& a, const Distance<Certified>& b) {
  const Certified left = (a.b + Certified(a.sign) * root_of(a.squared_root)) * b.a;
  const Certified right = (b.b + Certified(b.sign) * root_of(b.squared_root)) * a.a;
  return (left - right).sign();
}
int sign_of_difference(const Distance<Dyadic>& a, const Distance<Dyadic>& b) {
  return sign_with_roots(a.b * b.a - b.b * a.a, a.sign, a.squared_root * b.a * b.a, -b.sign,
                         b.squared_root * a.a * a.a);
}

/// Sign of the difference of two distances.
int compare(const Scene& scene, const Ray& ray, const Candidate& a, const Candidate& b) {
  const Form form_a = form_of(scene, ray, a);
  const Form form_b = form_of(scene, ray, b);
  const auto difference = [&]<class N>() {
    return sign_of_difference(distance_of<N>(scene, ray, a, form_a), distance_of<N>(scene, ray, b, form_b));
  };
  if (const auto sign = difference.operator()<Certified>()) return *sign;
  return difference.operator()<Dyadic>();
}

bool coincide(const Scene& scene, const Candidate& a, const Candidate& b) noexcept {
  return a.meeting == b.meeting && scene.are_coincident(a.surface, b.surface);
}

}  // namespace

bool comes_first_exactly(const Scene& scene, const Ray& ray, const Candidate& a, const Candidate& b) noexcept {
  const int order = coincide(scene, a, b) ? 0 : compare(scene, ray, a, b);
  return order < 0 || (order == 0 && a.surface < b.surface);
}

}  // namespace tessera::render
