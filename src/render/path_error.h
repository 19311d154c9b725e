// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "render/color.h"
#include "render/hit_error.h"
#include "render/path_observer.h"
#include "render/region.h"
#include "render/scene.h"
#include "render/tube.h"

namespace tessera::render {

/// Bounds how far rounding has taken a path's radiance from that of the same camera ray in exact arithmetic.
///
/// Along the path it carries how far the ray may be off, see hit_error.h. Every decision of the path is asked whether
/// any ray within that could decide otherwise: the first surface, the cell of a board, each light's side and shadow. If
/// one could, the pixel is uncertified and the bound infinite, for an edge may lie between the two.
///
/// error:   holds on every certified path, underflow aside
/// source:  the propagation of Igehy, Tracing ray differentials (1999), with bounds in place of differentials
class PathError final : public PathObserver {
 public:
  /// The path runs in `region`; all three must outlive this.
  PathError(const Scene& scene, const Region& region, Shade shade) noexcept
      : scene_(scene), region_(region), shade_(shade) {}

  void on_hit(const PathVertex& vertex) override;
  void on_light(std::size_t light, bool is_lit) override;
  void on_miss(const Ray& ray, double weight) override;

  /// The bound on each channel of the radiance, or infinity.
  double bound() const noexcept;

 private:
  /// The hit that the path is at, as its lights see it.
  struct Place {
    SurfaceId surface = SurfaceId::none;
    Vec3 point;
    Vec3 normal;  ///< facing the path
    Vec3 to_viewer;
    const Material* material = nullptr;
    double weight = 0;  ///< of the local light in the radiance
    double position_error = 0;
    double normal_error = 0;
    double direction_error = 0;  ///< of the viewer's direction
  };
  struct Highlight {
    double value = 0;
    double error = 0;
  };

  std::optional<HitError> error_at(const PathVertex& vertex);
  void check_first(const Ray& ray, SurfaceId hit, double latest);
  void check_cell(const Plane& plane, const Vec3& point, double position_error);
  void check_shadow(std::size_t light, bool is_lit, const Vec3& to_light, double distance, double way_error);
  Highlight highlight_of(const Vec3& to_light, double n_l, double n_l_error, double way_error) const;

  void add(const Rgb& term, const Rgb& error);
  void give_up() noexcept { is_certified_ = false; }

  const Scene& scene_;
  const Region& region_;
  Shade shade_;

  bool is_certified_ = true;
  RayError ray_error_;  ///< of the next ray
  InnerRun inner_run_;
  Place place_;

  Rgb error_;
  Rgb radiance_;
  double vertices_ = 0;
  double remaining_weight_ = 1;  ///< of what the path has not met yet
};

}  // namespace tessera::render
