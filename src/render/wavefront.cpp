// SPDX-License-Identifier: BSD-3-Clause
#include "render/wavefront.h"

#include <numeric>

#include "render/intersect.h"
#include "render/vertex.h"

namespace tessera::render {

void Wavefront::trace(std::span<const RayInRegion> camera_rays, std::span<Rgb> radiances, RayCounts& counts,
                      const std::function<void()>& between_slices) {
  rays_.assign(camera_rays.begin(), camera_rays.end());
  paths_.resize(rays_.size());
  std::iota(paths_.begin(), paths_.end(), std::size_t{0});
  weights_.assign(rays_.size(), 1.0);
  std::fill(radiances.begin(), radiances.end(), Rgb{});
  counts.primary += rays_.size();

  for (std::uint32_t bounce = 0; !rays_.empty(); ++bounce) {
    hits_.resize(rays_.size());
    nearest_hits(scene_, rays_, hits_);
    between_slices();
    meet_surfaces(radiances);
    for (std::size_t light = 0; light != scene_.data().lights.size(); ++light) {
      light_surfaces(light, counts);
      between_slices();
    }
    leave_surfaces(bounce == options_.max_bounces, radiances, counts);
  }
}

void Wavefront::meet_surfaces(std::span<Rgb> radiances) {
  vertices_.clear();
  for (std::size_t i = 0; i != rays_.size(); ++i) {
    if (!hits_[i]) {
      radiances[paths_[i]] += weights_[i] * scene_.data().environment.background;
      continue;
    }
    const auto& [ray, region] = rays_[i];
    const SurfacePoint& hit = *hits_[i];
    const Material& material = material_of(scene_, hit, cell_of(scene_, hit));
    Vertex& at = vertices_.emplace_back();
    at.path = paths_[i];
    at.region = region;
    at.hit = hit;
    at.material = &material;
    at.normal = facing_normal(scene_, hit, *region);
    at.incoming = ray.direction;
    at.to_viewer = to_viewer_of(material, ray.direction);
    at.weight = weights_[i];
    at.local = ambient_radiance(scene_, material);
  }
}

void Wavefront::light_surfaces(std::size_t light_index, RayCounts& counts) {
  const Light& light = scene_.data().lights[light_index];
  light_rays_.clear();
  lit_vertices_.clear();
  for (std::size_t i = 0; i != vertices_.size(); ++i) {
    const Vertex& at = vertices_[i];
    if (at.material->reflection >= 1 || !shows_light(*at.material)) continue;
    const Vec3 way = way_to(light, at.hit.point);
    if (!(dot(at.normal, way) > 0) || !is_on_path_side(scene_, light_index, at.hit.surface, *at.region)) continue;
    light_rays_.push_back({ray_to_light(at.hit, way), at.region});
    lit_vertices_.push_back(i);
  }
  counts.shadow += light_rays_.size();
  occluded_.resize(light_rays_.size());
  occlusions(scene_, light_rays_, light_index, occluded_);
  for (std::size_t i = 0; i != light_rays_.size(); ++i) {
    if (occluded_[i] != 0) continue;
    Vertex& at = vertices_[lit_vertices_[i]];
    const Vec3 to_light = normalized(light_rays_[i].ray.direction);
    at.local += reflected_light(*at.material, light.color, options_.shade, at.normal, to_light, at.to_viewer);
  }
}

void Wavefront::leave_surfaces(bool is_last, std::span<Rgb> radiances, RayCounts& counts) {
  rays_.clear();
  paths_.clear();
  weights_.clear();
  for (const Vertex& at : vertices_) {
    Rgb& radiance = radiances[at.path];
    const double k = at.material->reflection;
    if (k < 1) radiance += at.weight * (1 - k) * at.local;
    const double weight = at.weight * k;
    if (weight < kLeastWeight) continue;
    if (is_last) {
      radiance += weight * scene_.data().environment.background;
      continue;
    }
    rays_.push_back({mirrored_ray(at.hit, at.normal, at.incoming), at.region});
    paths_.push_back(at.path);
    weights_.push_back(weight);
  }
  counts.mirror += rays_.size();
}

}  // namespace tessera::render
