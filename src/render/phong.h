// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "render/power.h"
#include "render/scene_data.h"

// Light reflected by a surface itself, without mirrors.
namespace tessera::render {

/// What one unblocked light adds:
/// I (diffuse color N.L + specular (R.V)^shininess), R being L mirrored at N; with Shade::blinn (N.H)^shininess,
/// H halfway between L and V. Nothing where N.L <= 0; no highlight where R.V <= 0.
/// shapes:  normal, to_light and to_viewer are unit vectors, to_viewer any without a highlight; normal faces the viewer
/// source:  Phong, Illumination for computer generated pictures (1975); Blinn (1977)
inline Rgb reflected_light(const Material& material, const Rgb& intensity, Shade shade, const Vec3& normal,
                           const Vec3& to_light, const Vec3& to_viewer) noexcept {
  const double n_l = dot(normal, to_light);
  if (!(n_l > 0)) return {};
  Rgb sum = material.diffuse * n_l * material.color;
  if (material.specular > 0) {
    const Vec3 half = to_light + to_viewer;  // 0 for a light straight behind a surface seen edge on
    const double cosine = shade == Shade::phong ? 2 * n_l * dot(normal, to_viewer) - dot(to_light, to_viewer)
                          : half == Vec3{}      ? 0
                                                : dot(normal, normalized(half));
    if (cosine > 0) {
      const double highlight = material.specular * power(std::min(cosine, 1.0), material.shininess);
      sum += Rgb{highlight, highlight, highlight};
    }
  }
  return intensity * sum;
}

}  // namespace tessera::render
