// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "render/entry_points.h"
#include "render/vec3_avx2.h"

#if defined(__x86_64__)
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {
namespace {

/// Four entries into spheres.
struct Entry4 {
  Vec3x4 normal;
  Vec3x4 point;
  Mask4 is_plain;  ///< in the other lanes lengths have to be scaled: they hold nothing
};

/// As entry_point, four at a time.
Entry4 entry_of(const Vec3x4& origin, const Vec3x4& direction, const Vec3x4& center, Double4 radius) noexcept {
  const Double4 length = sqrt(dot(direction, direction));
  const ExactDifference4 f = exact_difference(center, origin);
  const Vec3x4 w = exact_cross(f.hi, direction) + cross(f.lo, direction);
  const Double4 l_squared = dot(w, w);
  const Double4 l = sqrt(l_squared);
  const Double4 r = radius * length;
  const Double4 s = sqrt(max((r - l) * (r + l), Double4::all(0)));

  const Vec3x4 outward = -s * direction - cross(direction, w);
  const Double4 squared = dot(outward, outward);
  const Mask4 is_plain = are_squarable(l_squared) & are_squarable(squared);
  const Vec3x4 normal = outward / where(is_plain, sqrt(squared), Double4::all(1));
  return {normal, center + radius * normal, is_plain};
}

}  // namespace

[[gnu::flatten]] void entry_points(const Scene& scene, std::span<const RayInRegion> rays,
                                   std::span<const SureEntry> entries,
                                   std::span<std::optional<SurfacePoint>> points) noexcept {
  for (std::size_t first = 0; first < entries.size(); first += 4) {
    const std::size_t size = std::min<std::size_t>(entries.size() - first, 4);
    // The last takes the lanes that are left.
    const auto in_lane = [&](std::size_t lane) -> const SureEntry& {
      return entries[first + std::min(lane, size - 1)];
    };
    const auto in_lanes = [&](auto vector_of) {
      return Vec3x4::of(vector_of(in_lane(0)), vector_of(in_lane(1)), vector_of(in_lane(2)), vector_of(in_lane(3)));
    };
    const auto radius = [&](std::size_t lane) { return scene.sphere(in_lane(lane).sphere).radius; };
    const Entry4 entry = entry_of(in_lanes([&](const SureEntry& e) { return rays[e.ray].ray.origin; }),
                                  in_lanes([&](const SureEntry& e) { return rays[e.ray].ray.direction; }),
                                  in_lanes([&](const SureEntry& e) { return scene.sphere(e.sphere).center; }),
                                  Double4::of(radius(0), radius(1), radius(2), radius(3)));

    Vec3Lanes point;
    Vec3Lanes normal;
    entry.point.store(point);
    entry.normal.store(normal);
    for (std::size_t lane = 0; lane != size; ++lane) {
      const auto& [ray, sphere] = in_lane(lane);
      const bool is_plain = (entry.is_plain.bits() >> lane & 1) != 0;
      points[ray] =
          is_plain ? SurfacePoint{sphere, point[lane], normal[lane]} : entry_point(scene, rays[ray].ray, sphere);
    }
  }
}

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#else

namespace tessera::render::avx2 {

// Never called: no such kernel is supported here.
void entry_points(const Scene&, std::span<const RayInRegion>, std::span<const SureEntry>,
                  std::span<std::optional<SurfacePoint>>) noexcept {}

}  // namespace tessera::render::avx2
#endif
