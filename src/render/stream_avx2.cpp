// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "render/entry_points.h"
#include "render/intersect.h"
#include "render/stream.h"
#include "render/traversal_avx2.h"

#if defined(__x86_64__)
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {
namespace {

class NearestQueries {
 public:
  using Search = FloatNearestSearch;

  NearestQueries(const Scene& scene, std::span<const RayInRegion> rays,
                 std::span<std::optional<SurfacePoint>> points) noexcept
      : scene_(scene), rays_(rays), points_(points) {}

  bool find_next() noexcept {
    for (++number_; number_ < rays_.size(); ++number_) {
      const auto& [ray, region] = rays_[number_];
      if (is_squarable(dot(ray.direction, ray.direction))) return true;
      points_[number_] = nearest_hit(scene_, ray, *region);
    }
    return false;
  }
  std::size_t number() const noexcept { return number_; }
  const Ray& ray() const noexcept { return rays_[number_].ray; }
  Search search() const noexcept { return {scene_, ray(), *rays_[number_].region}; }
  void answer(std::size_t number, Search& search) noexcept {
    SurfaceId sphere = search.first();
    if (NearestSearch* const exact = search.exact()) {
      sphere = exact->sure_entry();
      if (sphere == SurfaceId::none) points_[number] = exact->finish();
    } else if (sphere == SurfaceId::none) {
      points_[number] = std::nullopt;
    }
    if (sphere == SurfaceId::none) return;
    entries_[size_++] = {static_cast<std::uint32_t>(number), sphere};
    if (size_ == kEntriesTogether) finish();
  }
  /// Computes the points that are left.
  void finish() noexcept {
    avx2::entry_points(scene_, rays_, std::span(entries_).first(size_), points_);
    size_ = 0;
  }

 private:
  static constexpr std::size_t kEntriesTogether = 64;

  const Scene& scene_;
  std::span<const RayInRegion> rays_;
  std::span<std::optional<SurfacePoint>> points_;
  std::size_t number_ = std::size_t{0} - 1;
  // Rays that have met their spheres, where they do being still to be computed.
  SureEntry entries_[kEntriesTogether];
  std::size_t size_ = 0;
};

class OcclusionQueries {
 public:
  using Search = FloatOcclusionSearch;

  OcclusionQueries(const Scene& scene, std::span<const RayInRegion> to_light, std::size_t light,
                   std::span<std::uint8_t> occluded) noexcept
      : scene_(scene), rays_(to_light), light_(light), occluded_(occluded) {
    const bool is_point = scene.data().lights[light].kind == LightKind::point;
    end_ = is_point ? 1 : std::numeric_limits<double>::infinity();
  }

  bool find_next() noexcept {
    for (++number_; number_ < rays_.size(); ++number_) {
      const auto& [ray, region] = rays_[number_];
      if (region != last_region_) {
        last_region_ = region;
        is_shut_off_ = is_shut_off(scene_, light_, *region);
      }
      if (!is_shut_off_ && is_squarable(dot(ray.direction, ray.direction))) return true;
      occluded_[number_] = is_occluded(scene_, ray, light_, *region);
    }
    return false;
  }
  std::size_t number() const noexcept { return number_; }
  const Ray& ray() const noexcept { return rays_[number_].ray; }
  Search search() const noexcept { return {scene_, ray(), end_, light_, *rays_[number_].region}; }
  void answer(std::size_t number, const Search& search) noexcept { occluded_[number] = search.is_occluded(); }
  void finish() noexcept {}

 private:
  const Scene& scene_;
  std::span<const RayInRegion> rays_;
  std::size_t light_;
  std::span<std::uint8_t> occluded_;
  double end_;
  const Region* last_region_ = nullptr;
  bool is_shut_off_ = false;  ///< in that region
  std::size_t number_ = std::size_t{0} - 1;
};

template <class Queries>
void answer_all(const Scene& scene, Queries queries) noexcept {
  if (scene.bvh().nodes().empty()) {
    while (queries.find_next()) {
      typename Queries::Search search = queries.search();
      queries.answer(queries.number(), search);
    }
  } else {
    RayStream<Queries>(scene.bvh(), queries).run();
  }
  queries.finish();
}

}  // namespace

[[gnu::flatten]] void nearest_hits(const Scene& scene, std::span<const RayInRegion> rays,
                                   std::span<std::optional<SurfacePoint>> points) {
  answer_all(scene, NearestQueries(scene, rays, points));
}

[[gnu::flatten]] void occlusions(const Scene& scene, std::span<const RayInRegion> to_light, std::size_t light,
                                 std::span<std::uint8_t> occluded) {
  answer_all(scene, OcclusionQueries(scene, to_light, light, occluded));
}

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#else

namespace tessera::render::avx2 {

// Never called: no such kernel is supported here.
void nearest_hits(const Scene&, std::span<const RayInRegion>, std::span<std::optional<SurfacePoint>>) {}
void occlusions(const Scene&, std::span<const RayInRegion>, std::size_t, std::span<std::uint8_t>) {}

}  // namespace tessera::render::avx2
#endif
