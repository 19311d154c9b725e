// SPDX-License-Identifier: BSD-3-Clause
#include "render/wavefront.h"

#include <numeric>

#include "render/intersect.h"
#include "render/raster.h"
#include "render/vertex.h"

namespace tessera::render {
namespace {

/// The first of a buffer that only grows; what it held before is not cleared.
template <class T>
std::span<T> first_of(std::vector<T>& buffer, std::size_t size) {
  if (buffer.size() < size) buffer.resize(size);
  return std::span(buffer).first(size);
}

/// What the cells of all lights together may take.
constexpr std::size_t kCellBytes = std::size_t{64} << 20;

}  // namespace

Wavefront::Wavefront(const Scene& scene, const TraceOptions& options) : scene_(scene), options_(options) {
  const std::size_t lights = scene.data().lights.size();
  const std::size_t bytes = most_cell_bytes(scene);
  light_cells_.reserve(lights);
  for (std::size_t light = 0; light != lights; ++light) light_cells_.emplace_back(scene, light, bytes / lights);
}

std::size_t Wavefront::most_cell_bytes(const Scene& scene) noexcept {
  return scene.kernel() == Kernel::avx2 && !scene.data().lights.empty() && scene.sphere_count() > 0 ? kCellBytes : 0;
}

void Wavefront::trace(std::span<const RayInRegion> camera_rays, std::span<Rgb> radiances, RayCounts& counts,
                      const std::function<void()>& between_slices, std::span<const SurfaceId> first_spheres) {
  rays_.assign(camera_rays.begin(), camera_rays.end());
  paths_.resize(rays_.size());
  std::iota(paths_.begin(), paths_.end(), std::size_t{0});
  weights_.assign(rays_.size(), 1.0);
  std::fill(radiances.begin(), radiances.end(), Rgb{});
  counts.primary += rays_.size();

  for (std::uint32_t bounce = 0; !rays_.empty(); ++bounce) {
    const auto hits = first_of(hits_, rays_.size());
    if (bounce == 0 && !first_spheres.empty()) {
      avx2::nearest_hits(scene_, rays_, first_spheres, hits);
    } else {
      nearest_hits(scene_, rays_, hits);
    }
    between_slices();
    meet_surfaces(radiances);
    for (std::size_t light = 0; light != scene_.data().lights.size(); ++light) {
      if (light_surfaces(light, counts)) between_slices();
    }
    leave_surfaces(bounce == options_.max_bounces, radiances, counts);
  }
}

void Wavefront::meet_surfaces(std::span<Rgb> radiances) {
  vertices_.clear(rays_.size());
  for (std::size_t i = 0; i != rays_.size(); ++i) {
    if (!hits_[i]) {
      radiances[paths_[i]] += weights_[i] * scene_.data().environment.background;
      continue;
    }
    const auto& [ray, region] = rays_[i];
    const SurfacePoint& hit = *hits_[i];
    const Material& material = material_of(scene_, hit, cell_of(scene_, hit));
    vertices_.add({.ray = static_cast<std::uint32_t>(i),
                   .material = &material,
                   .point = hit.point,
                   .normal = facing_normal(scene_, hit, *region),
                   .incoming = ray.direction,
                   .local = ambient_radiance(scene_, material)});
  }
  turn_to_viewers(scene_.kernel(), vertices_);
}

bool Wavefront::light_surfaces(std::size_t light_index, RayCounts& counts) {
  const auto shares = first_of(shares_, vertices_.lanes().size());
  light_up(scene_.kernel(), scene_.data().lights[light_index], options_.shade, vertices_, shares);
  list_lit_vertices(light_index);
  if (lit_.empty()) return false;

  const auto rays = first_of(light_rays_, lit_.size());
  const auto occluded = first_of(occluded_, lit_.size());
  for (std::size_t i = 0; i != lit_.size(); ++i) {
    const auto [group, lane] = lit_[i];
    const std::size_t from = vertices_.lanes()[group].ray[lane];
    rays[i] = {ray_to_light(*hits_[from], shares[group].way[lane]), rays_[from].region};
  }
  counts.shadow += rays.size();
  light_cells_[light_index].occlusions(rays, occluded);
  for (std::size_t i = 0; i != lit_.size(); ++i) {
    if (occluded[i] != 0) continue;
    const auto [group, lane] = lit_[i];
    const Vec3 share = shares[group].share[lane];
    vertices_.lanes()[group].local[lane] += {share.x, share.y, share.z};
  }
  return true;
}

// Without a branch on which they are, for that cannot be predicted.
void Wavefront::list_lit_vertices(std::size_t light_index) {
  lit_.resize(vertices_.size());
  std::size_t size = 0;
  for (std::uint32_t i = 0; i != vertices_.size(); ++i) {
    lit_[size] = {i / kLanes, i % kLanes};
    size += shares_[i / kLanes].shines[i % kLanes];
  }
  lit_.resize(size);
  if (scene_.data().planes.empty()) return;
  std::erase_if(lit_, [&](const VertexPlace& vertex) {
    const std::size_t from = vertices_.lanes()[vertex.group].ray[vertex.lane];
    return !is_on_path_side(scene_, light_index, hits_[from]->surface, *rays_[from].region);
  });
}

// The rays that go on take the places of those that have met surfaces, of which there were no fewer.
void Wavefront::leave_surfaces(bool is_last, std::span<Rgb> radiances, RayCounts& counts) {
  std::size_t size = 0;
  for (std::size_t i = 0; i != vertices_.size(); ++i) {
    const VertexLanes& at = vertices_.lanes()[i / kLanes];
    const std::size_t lane = i % kLanes;
    const std::size_t from = at.ray[lane];
    Rgb& radiance = radiances[paths_[from]];
    const double k = at.material[lane]->reflection;
    if (k < 1) radiance += weights_[from] * (1 - k) * at.local[lane];
    const double weight = weights_[from] * k;
    if (weight < kLeastWeight) continue;
    if (is_last) {
      radiance += weight * scene_.data().environment.background;
      continue;
    }
    const auto& [ray, region] = rays_[from];
    rays_[size] = {mirrored_ray(*hits_[from], at.normal[lane], ray.direction), region};
    paths_[size] = paths_[from];
    weights_[size] = weight;
    ++size;
  }
  rays_.resize(size);
  paths_.resize(size);
  weights_.resize(size);
  counts.mirror += size;
}

}  // namespace tessera::render
