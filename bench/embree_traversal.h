// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "embree_lanes.h"

// Waves of eight rays through Embree's tree: as one packet, or one by one.
namespace tessera::embree {

/// How the rays of a wave are handed to Embree.
enum class Hand : std::uint8_t { one_by_one, packet };

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Rays {
  Wide origin;
  Wide direction;  ///< unit
  Lanes near;      ///< what is nearer is the surface that the ray leaves
  Lanes far;       ///< what is farther does not count
};

/// What a wave of rays met in the tree.
struct TreeHits {
  std::array<std::uint32_t, kLanes> sphere;  ///< RTC_INVALID_GEOMETRY_ID on a miss
  Wide normal;                               ///< of any length; anything on a miss
};

/// Embree's ray of one lane.
inline RTCRay single_ray(const Rays& rays, std::size_t lane) {
  RTCRay ray;
  ray.org_x = rays.origin.x[lane];
  ray.org_y = rays.origin.y[lane];
  ray.org_z = rays.origin.z[lane];
  ray.tnear = rays.near[lane];
  ray.dir_x = rays.direction.x[lane];
  ray.dir_y = rays.direction.y[lane];
  ray.dir_z = rays.direction.z[lane];
  ray.time = 0;
  ray.tfar = rays.far[lane];
  ray.mask = ~0U;
  ray.id = 0;
  ray.flags = 0;
  return ray;
}

inline void fill(RTCRay8& ray, const Rays& rays) {
  constexpr stdx::vector_aligned_tag kAligned;
  rays.origin.x.copy_to(ray.org_x, kAligned);
  rays.origin.y.copy_to(ray.org_y, kAligned);
  rays.origin.z.copy_to(ray.org_z, kAligned);
  rays.near.copy_to(ray.tnear, kAligned);
  rays.direction.x.copy_to(ray.dir_x, kAligned);
  rays.direction.y.copy_to(ray.dir_y, kAligned);
  rays.direction.z.copy_to(ray.dir_z, kAligned);
  rays.far.copy_to(ray.tfar, kAligned);
  std::fill_n(ray.time, kLanes, 0.0F);
  std::fill_n(ray.mask, kLanes, ~0U);
  std::fill_n(ray.id, kLanes, 0U);
  std::fill_n(ray.flags, kLanes, 0U);
}

inline std::array<int, kLanes> valid_lanes(const LaneMask& active) {
  std::array<int, kLanes> valid{};
  for (std::size_t i = 0; i != kLanes; ++i) valid[i] = active[i] ? -1 : 0;
  return valid;
}

/// The nearest sphere of each active lane; what the others hold means nothing.
template <Hand hand>
TreeHits intersect(RTCScene tree, RTCIntersectContext& context, const Rays& rays, const LaneMask& active) {
  TreeHits hits;
  if constexpr (hand == Hand::packet) {
    alignas(32) const std::array<int, kLanes> valid = valid_lanes(active);
    RTCRayHit8 query;
    fill(query.ray, rays);
    std::fill_n(query.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(query.hit.primID, kLanes, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect8(valid.data(), tree, &context, &query);
    std::copy_n(query.hit.primID, kLanes, hits.sphere.begin());
    constexpr stdx::vector_aligned_tag kAligned;
    hits.normal = {Lanes(query.hit.Ng_x, kAligned), Lanes(query.hit.Ng_y, kAligned), Lanes(query.hit.Ng_z, kAligned)};
  } else {
    hits.sphere.fill(RTC_INVALID_GEOMETRY_ID);
    for (std::size_t i = 0; i != kLanes; ++i) {
      if (!active[i]) continue;
      RTCRayHit query;
      query.ray = single_ray(rays, i);
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.primID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(tree, &context, &query);
      hits.sphere[i] = query.hit.primID;
      set(hits.normal, i, {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z});
    }
  }
  return hits;
}

/// Which of the active lanes meet a sphere.
template <Hand hand>
LaneMask is_occluded(RTCScene tree, RTCIntersectContext& context, const Rays& rays, const LaneMask& active) {
  if constexpr (hand == Hand::packet) {
    alignas(32) const std::array<int, kLanes> valid = valid_lanes(active);
    RTCRay8 query;
    fill(query, rays);
    rtcOccluded8(valid.data(), tree, &context, &query);
    return active && Lanes(query.tfar, stdx::vector_aligned) < 0.0F;
  } else {
    LaneMask is_blocked(false);
    for (std::size_t i = 0; i != kLanes; ++i) {
      if (!active[i]) continue;
      RTCRay query = single_ray(rays, i);
      rtcOccluded1(tree, &context, &query);
      is_blocked[i] = query.tfar < 0;
    }
    return is_blocked;
  }
}

}  // namespace tessera::embree
