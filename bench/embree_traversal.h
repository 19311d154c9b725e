// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "embree_scene.h"

// Waves of W rays through Embree's tree: as one packet, or one by one.
namespace tessera::embree {

/// How the rays of a wave are handed to Embree.
enum class Hand : std::uint8_t { one_by_one, packet };

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <std::size_t W>
struct Rays {
  Triple<Lanes<W>> origin;
  Triple<Lanes<W>> direction;  ///< unit
  Lanes<W> near;               ///< what is nearer is the surface that the ray leaves
  Lanes<W> far;                ///< what is farther does not count
};

/// What Embree says about a wave of rays; the normal is not unit.
template <std::size_t W>
struct TreeHits {
  alignas(64) float distance[W];
  alignas(64) float normal_x[W];
  alignas(64) float normal_y[W];
  alignas(64) float normal_z[W];
  alignas(64) std::uint32_t sphere[W];  ///< RTC_INVALID_GEOMETRY_ID on a miss
};

/// Embree's ray of one lane.
template <std::size_t W>
RTCRay single_ray(const Rays<W>& rays, std::size_t lane) {
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

inline void fill(RTCRay8& ray, const Rays<8>& rays) {
  constexpr stdx::vector_aligned_tag kAligned;
  rays.origin.x.copy_to(ray.org_x, kAligned);
  rays.origin.y.copy_to(ray.org_y, kAligned);
  rays.origin.z.copy_to(ray.org_z, kAligned);
  rays.near.copy_to(ray.tnear, kAligned);
  rays.direction.x.copy_to(ray.dir_x, kAligned);
  rays.direction.y.copy_to(ray.dir_y, kAligned);
  rays.direction.z.copy_to(ray.dir_z, kAligned);
  rays.far.copy_to(ray.tfar, kAligned);
  for (int i = 0; i != 8; ++i) {
    ray.time[i] = 0;
    ray.mask[i] = ~0U;
    ray.id[i] = 0;
    ray.flags[i] = 0;
  }
}

/// The nearest sphere of each active lane. Lanes that are not active hold anything.
template <Hand hand, std::size_t W>
void intersect(RTCScene tree, RTCIntersectContext& context, const Rays<W>& rays, const LaneMask<W>& active,
               TreeHits<W>& hits) {
  if constexpr (hand == Hand::packet) {
    RTCRayHit8 query;
    alignas(32) int valid[8];
    fill(query.ray, rays);
    for (std::size_t i = 0; i != 8; ++i) {
      valid[i] = active[i] ? -1 : 0;
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      query.hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(valid, tree, &context, &query);
    for (std::size_t i = 0; i != 8; ++i) {
      hits.distance[i] = query.ray.tfar[i];
      hits.normal_x[i] = query.hit.Ng_x[i];
      hits.normal_y[i] = query.hit.Ng_y[i];
      hits.normal_z[i] = query.hit.Ng_z[i];
      hits.sphere[i] = query.hit.primID[i];
    }
  } else {
    for (std::size_t i = 0; i != W; ++i) {
      if (!active[i]) continue;
      RTCRayHit query;
      query.ray = single_ray(rays, i);
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.primID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(tree, &context, &query);
      hits.distance[i] = query.ray.tfar;
      hits.normal_x[i] = query.hit.Ng_x;
      hits.normal_y[i] = query.hit.Ng_y;
      hits.normal_z[i] = query.hit.Ng_z;
      hits.sphere[i] = query.hit.primID;
    }
  }
}

/// Which of the active lanes meet a sphere.
template <Hand hand, std::size_t W>
LaneMask<W> occluded(RTCScene tree, RTCIntersectContext& context, const Rays<W>& rays, const LaneMask<W>& active) {
  LaneMask<W> blocked(false);
  if constexpr (hand == Hand::packet) {
    RTCRay8 query;
    alignas(32) int valid[8];
    fill(query, rays);
    for (std::size_t i = 0; i != 8; ++i) valid[i] = active[i] ? -1 : 0;
    rtcOccluded8(valid, tree, &context, &query);
    blocked = Lanes<8>(query.tfar, stdx::vector_aligned) < 0.0F && active;
  } else {
    for (std::size_t i = 0; i != W; ++i) {
      if (!active[i]) continue;
      RTCRay query = single_ray(rays, i);
      rtcOccluded1(tree, &context, &query);
      blocked[i] = query.tfar < 0;
    }
  }
  return blocked;
}

}  // namespace tessera::embree
