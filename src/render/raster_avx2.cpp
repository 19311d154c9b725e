// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "render/entry_points.h"
#include "render/frustum_avx2.h"
#include "render/lanes_avx2.h"
#include "render/perpendicular_avx2.h"
#include "render/raster.h"
#include "render/search.h"

#if defined(__x86_64__)
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

void round_to(float* out, const Vec3& p) noexcept {
  for (int axis = 0; axis != 3; ++axis) out[axis] = static_cast<float>(p[axis]);
}

}  // namespace

Raster::Raster(const Scene& scene, const CameraRays& camera, const Region& region) noexcept
    : scene_(scene), camera_(camera), region_(region) {
  const Vec3 eye = scene.bvh().space().from_scene(camera.eye());
  const double size = sum_of_sizes(eye);
  const double step = std::min(length(camera.right()), length(camera.down()));
  can_draw_ = size < kFarthest && step > kLeastStep;
  if (!can_draw_) return;
  round_to(eye_, eye);
  eye_error_ = TreeSpace::up(TreeRay::kSphereError * size + 4 * TreeSpace::kFloor);
  round_to(forward_, camera.forward());
}

Raster::Lines Raster::lines_of(const std::array<double, 2>& range, std::size_t count, const Vec3& unit,
                               double size) const noexcept {
  const double first = range[0] * size;
  const double last = range[1] * size;
  const double step = count > 1 ? (last - first) / static_cast<double>(count - 1) : size;
  Lines lines{};
  round_to(lines.normal, (unit - first * camera_.forward()) / step);
  const double farthest = std::max(std::abs(first), std::abs(last));
  lines.widening = TreeSpace::up(std::sqrt(1 + farthest * farthest) / std::abs(step));
  lines.last = static_cast<float>(count - 1);
  return lines;
}

[[gnu::flatten]] bool Raster::draw(std::span<const double> x, std::span<const double> y,
                                   DrawingRecord& record) noexcept {
  const std::size_t rays = x.size() * y.size();
  is_begun_ = false;
  cost_ = 0;
  if (scene_.bvh().nodes().empty()) return false;
  x_ = x;
  y_ = y;
  lane_columns_ = (x.size() + kTreeWidth - 1) / kTreeWidth * kTreeWidth;
  latest_ = kNever;
  if (!can_draw_ || !draw_tree(place_block(), kMostPerRay * rays)) {
    give_up();
  } else if (is_begun_) {
    settle();
  }
  record.add(rays, cost_);
  return is_begun_;
}

[[gnu::flatten]] TreeFrustum Raster::place_block() noexcept {
  const std::array<double, 2> across{camera_.across(x_.front()), camera_.across(x_.back())};
  const std::array<double, 2> along{camera_.along(y_.front()), camera_.along(y_.back())};
  const double right = length(camera_.right());
  const double down = length(camera_.down());
  columns_ = lines_of(across, x_.size(), camera_.right() / right, right);
  rows_ = lines_of(along, y_.size(), camera_.down() / down, down);

  const auto least_size = [](const std::array<double, 2>& range) {
    return range[0] <= 0 && range[1] >= 0 ? 0 : std::min(std::abs(range[0]), std::abs(range[1]));
  };
  const double least_x = least_size(across) * right;
  const double least_y = least_size(along) * down;
  closest_cosine_ = TreeSpace::up(1 / std::sqrt(1 + least_x * least_x + least_y * least_y));

  const Vec3 to_middle = 0.5 * (across[0] + across[1]) * camera_.right() + 0.5 * (along[0] + along[1]) * camera_.down();
  const double half_width = 0.5 * (across[1] - across[0]);
  const double half_height = 0.5 * (along[1] - along[0]);
  return {scene_.bvh().space(),
          {.kind = Pencil::Kind::pyramid,
           .origin = camera_.eye(),
           .axis = camera_.forward() + to_middle,
           .right = camera_.right(),
           .down = camera_.down(),
           .x = {-half_width, half_width},
           .y = {-half_height, half_height}}};
}

bool Raster::draw_tree(const TreeFrustum& frustum, std::uint64_t most_cost) noexcept {
  const Bvh& bvh = scene_.bvh();
  // Children in the octant that rays come from first: those of the high sides where the axis runs downwards.
  unsigned far_octant = 0;
  for (const float along : frustum.depth.normal) far_octant = far_octant << 1 | (along < 0 ? 0U : 1U);
  const auto shift = static_cast<float>(frustum.shift);
  float depths[Bvh::kStackSize + kTreeWidth];
  std::uint32_t children[Bvh::kStackSize + kTreeWidth];
  std::size_t size = 1;
  depths[0] = -kNever;
  children[0] = 0;
  while (size > 0) {
    if (cost_ > most_cost) return false;
    --size;
    // The shift, in float, takes a rounding of its own.
    const float latest = latest_ * TreeRay::kSlack - shift * (1 - 0x1p-20F);
    if (depths[size] > latest) continue;
    const std::uint32_t child = children[size];
    if (TreeChild::is_leaf(child)) {
      draw_leaf(bvh.leaves()[TreeChild::index(child)]);
      continue;
    }
    cost_ += kNodeCost;
    const TreeNode& node = bvh.nodes()[child];
    Float8 depth;
    LaneMask met = meets_children(node, frustum, depth);
    met &= depth <= Float8::all(latest);
    const Int8 lanes = lanes_in_order(met, far_octant);
    picked(depth, lanes).store(depths + size);
    picked(Int8::load(node.child), lanes).store(children + size);
    size += static_cast<std::size_t>(std::popcount(met));
  }
  return true;
}

// Directions are those of CameraRays::through.
void Raster::begin() noexcept {
  is_begun_ = true;
  alignas(32) double across[kSide];
  for (std::size_t i = 0; i != lane_columns_; ++i) across[i] = camera_.across(x_[std::min(i, x_.size() - 1)]);
  for (std::size_t row = 0; row != y_.size(); ++row) {
    const double along = camera_.along(y_[row]);
    for (std::size_t column = 0; column != lane_columns_; column += 4) {
      const Double4 places = Double4::load(across + column);
      const auto part = [&](int axis) {
        return Double4::all(camera_.forward()[axis]) +
               (places * Double4::all(camera_.right()[axis]) + Double4::all(along * camera_.down()[axis]));
      };
      const Double4 dx = part(0);
      const Double4 dy = part(1);
      const Double4 dz = part(2);
      const Double4 inverse = Double4::all(1) / sqrt(dx * dx + dy * dy + dz * dz);
      const std::size_t at = row * kSide + column;
      (dx * inverse).store(&direction_[0][at]);
      (dy * inverse).store(&direction_[1][at]);
      (dz * inverse).store(&direction_[2][at]);
    }
  }
  const std::size_t end = y_.size() * kSide;
  std::fill_n(entry_low_.begin(), end, kNever);
  std::fill_n(entry_up_.begin(), end, kNever);
  std::fill_n(others_low_.begin(), end, kNever);
  std::fill_n(first_.begin(), end, SurfaceId::none);
}

void Raster::draw_leaf(const TreeLeaf& leaf) noexcept {
  cost_ += kLeafCost;
  const Float8 cx = Float8::load(leaf.center[0]);
  const Float8 cy = Float8::load(leaf.center[1]);
  const Float8 cz = Float8::load(leaf.center[2]);
  const Float8 fx = cx - Float8::all(eye_[0]);
  const Float8 fy = cy - Float8::all(eye_[1]);
  const Float8 fz = cz - Float8::all(eye_[2]);
  const auto along = [&](const float* v) {
    return fused(fx, Float8::all(v[0]), fused(fy, Float8::all(v[1]), fz * Float8::all(v[2])));
  };
  const Float8 radius = Float8::load(leaf.radius);
  const Float8 reach = radius + Float8::all(eye_error_);
  const Float8 depth = along(forward_);

  // Leave out what is behind the eye or behind what all rays meet, and what reaches over no ray.
  const Float8 least_depth = Float8::all(eye_error_);
  const Float8 inverse = Float8::all(1) / max(depth, least_depth);
  const auto range = [&](const Lines& lines, Float8& first, Float8& last) {
    const Float8 middle = along(lines.normal);
    const Float8 half = reach * Float8::all(lines.widening);
    const Float8 low = (middle - half) * inverse - Float8::all(kMargin);
    const Float8 high = (middle + half) * inverse + Float8::all(kMargin);
    const Float8 zero = Float8::all(0);
    const Float8 all = Float8::all(lines.last);
    const Float8 beyond = Float8::all(lines.last + 1);
    first = ceil(min(max(where_less(least_depth, depth, low, zero), zero), beyond));
    last = floor(max(min(where_less(least_depth, depth, high, all), all), zero - Float8::all(1)));
    return first <= last;
  };
  Float8 first_column;
  Float8 last_column;
  Float8 first_row;
  Float8 last_row;
  LaneMask met = range(columns_, first_column, last_column) & range(rows_, first_row, last_row);
  met &= Float8::all(0) <= depth + reach;
  met &= depth - reach <= Float8::all(latest_ * closest_cosine_);
  if (!region_.walls().empty()) {
    for (std::size_t lane = 0; lane != kTreeWidth; ++lane) {
      if (region_.is_inside(leaf.id[lane])) met &= ~(1U << lane);
    }
  }
  if (met == 0) return;
  if (!is_begun_) begin();

  Spheres spheres;
  fx.store(spheres.f[0]);
  fy.store(spheres.f[1]);
  fz.store(spheres.f[2]);
  const Float8 center_error =
      Float8::all(static_cast<float>(TreeRay::kSphereError)) * (cx.size() + cy.size() + cz.size());
  const Float8 error = center_error + Float8::all(eye_error_);
  const Float8 own = radius - center_error;
  const Float8 off = fused(radius, Float8::all(0x1p-18F), error);
  (own * own).store(spheres.radius_squared);
  (off * (radius + radius + Float8::all(3) * off)).store(spheres.slack);
  (error * Float8::all(0.5F)).store(spheres.foot_slack);
  Int8::of(first_column).store(spheres.first_column);
  Int8::of(last_column).store(spheres.last_column);
  Int8::of(first_row).store(spheres.first_row);
  Int8::of(last_row).store(spheres.last_row);
  for (; met != 0; met &= met - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(met));
    draw_sphere(spheres, lane, leaf.id[lane]);
  }
  note_farthest();
}

void Raster::draw_sphere(const Spheres& spheres, std::size_t lane, SurfaceId id) noexcept {
  const Float8 fx = Float8::all(spheres.f[0][lane]);
  const Float8 fy = Float8::all(spheres.f[1][lane]);
  const Float8 fz = Float8::all(spheres.f[2][lane]);
  const Float8 radius_squared = Float8::all(spheres.radius_squared[lane]);
  const Float8 slack = Float8::all(spheres.slack[lane]);
  const Float8 foot_slack = Float8::all(spheres.foot_slack[lane]);
  const Int8 ids = Int8::all(static_cast<std::uint32_t>(id));
  const Float8 zero = Float8::all(0);
  const Float8 never = Float8::all(kNever);
  const std::size_t first = spheres.first_column[lane] / kTreeWidth * kTreeWidth;
  const std::size_t last = spheres.last_column[lane];
  cost_ += kSphereCost;
  for (std::size_t row = spheres.first_row[lane]; row <= spheres.last_row[lane]; ++row) {
    for (std::size_t column = first; column <= last; column += kTreeWidth) {
      const std::size_t at = row * kSide + column;
      const auto [foot, square] = perpendicular(fx, fy, fz, Float8::load(&direction_[0][at]),
                                                Float8::load(&direction_[1][at]), Float8::load(&direction_[2][at]));
      const Float8 inside = radius_squared - square;
      const Float8 most = inside + slack;
      const Float8 least = inside - slack;
      const Float8 early = foot - foot_slack;
      const Float8 late = foot + foot_slack;
      const Float8 low = where_less(min(most, late), zero, never, early - sqrt(max(most, zero)));
      const Float8 up = where_less(zero, min(least, early), late - sqrt(max(least, zero)), never);

      const Float8 best_low = Float8::load(&entry_low_[at]);
      const Float8 best_up = Float8::load(&entry_up_[at]);
      const Float8 others = Float8::load(&others_low_[at]);
      min(others, where_less(up, best_up, best_low, low)).store(&others_low_[at]);
      where_less(up, best_up, low, best_low).store(&entry_low_[at]);
      min(up, best_up).store(&entry_up_[at]);
      where_less(up, best_up, ids, Int8::load(&first_[at])).store(&first_[at]);
      cost_ += kLanesCost;
    }
  }
}

void Raster::note_farthest() noexcept {
  Float8 farthest = Float8::all(-kNever);
  for (std::size_t row = 0; row != y_.size(); ++row) {
    for (std::size_t column = 0; column != lane_columns_; column += kTreeWidth) {
      farthest = max(farthest, Float8::load(&entry_up_[row * kSide + column]));
    }
  }
  alignas(32) float lanes[kTreeWidth];
  farthest.store(lanes);
  latest_ = *std::max_element(std::begin(lanes), std::end(lanes));
}

void Raster::settle() noexcept {
  const Int8 unsure = Int8::all(static_cast<std::uint32_t>(kUnsureSphere));
  const Float8 never = Float8::all(kNever);
  std::uint64_t unsure_rays = 0;
  for (std::size_t row = 0; row != y_.size(); ++row) {
    for (std::size_t column = 0; column != lane_columns_; column += kTreeWidth) {
      const std::size_t at = row * kSide + column;
      const Float8 up = Float8::load(&entry_up_[at]);
      const Float8 others = Float8::load(&others_low_[at]);
      // Nothing at all is sure, too: then both are infinite.
      const Int8 known = where_less(up, others, Int8::load(&first_[at]), unsure);
      const Int8 first = where_less(min(up, others), never, known, Int8::load(&first_[at]));
      first.store(&first_[at]);
      unsure_rays +=
          static_cast<std::uint64_t>(std::popcount(lanes_equal(first, static_cast<std::uint32_t>(kUnsureSphere))));
    }
  }
  cost_ += DrawingRecord::kTracingCost * unsure_rays;
}

void Raster::give_up() noexcept {
  is_begun_ = true;
  first_.fill(kUnsureSphere);
  cost_ += DrawingRecord::kTracingCost * x_.size() * y_.size();
}

[[gnu::flatten]] void nearest_hits(const Scene& scene, std::span<const RayInRegion> rays,
                                   std::span<const SurfaceId> known, std::span<std::optional<SurfacePoint>> points) {
  std::vector<RayInRegion> unsure;
  std::vector<SureEntry> entries;
  entries.reserve(rays.size());
  for (std::size_t i = 0; i != rays.size(); ++i) {
    const auto& [ray, region] = rays[i];
    if (known[i] == kUnsureSphere) {
      unsure.push_back(rays[i]);
      continue;
    }
    SurfaceId sphere = known[i];
    if (!scene.visible_planes().empty() || !region->walls().empty()) {
      NearestSearch search(scene, ray, *region);
      if (known[i] != SurfaceId::none) search.offer(known[i]);
      sphere = search.sure_entry();
      if (sphere == SurfaceId::none) points[i] = search.finish();
    } else if (sphere == SurfaceId::none) {
      points[i] = std::nullopt;
    }
    if (sphere != SurfaceId::none) entries.push_back({static_cast<std::uint32_t>(i), sphere});
  }
  avx2::entry_points(scene, rays, entries, points);
  if (unsure.empty()) return;
  std::vector<std::optional<SurfacePoint>> found(unsure.size());
  avx2::nearest_hits(scene, unsure, found);
  for (std::size_t i = 0, next = 0; i != rays.size(); ++i) {
    if (known[i] == kUnsureSphere) points[i] = found[next++];
  }
}

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#else

namespace tessera::render::avx2 {

// Never called: no such kernel is supported here.
Raster::Raster(const Scene& scene, const CameraRays& camera, const Region& region) noexcept
    : scene_(scene), camera_(camera), region_(region) {}
bool Raster::draw(std::span<const double>, std::span<const double>, DrawingRecord&) noexcept {
  return false;
}
void nearest_hits(const Scene&, std::span<const RayInRegion>, std::span<const SurfaceId>,
                  std::span<std::optional<SurfacePoint>>) {}

}  // namespace tessera::render::avx2
#endif
