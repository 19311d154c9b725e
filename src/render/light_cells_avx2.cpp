// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "render/frustum_avx2.h"
#include "render/intersect.h"
#include "render/lanes_avx2.h"
#include "render/light_cells.h"
#include "render/perpendicular_avx2.h"
#include "render/search.h"

#if defined(__x86_64__)
TESSERA_BEGIN_AVX2
namespace tessera::render {
namespace {

using namespace avx2;

/// The line through the middle of a pencil, and how wide the pencil is.
struct Core {
  Vec3 start;  ///< in tree space
  Vec3 unit;
  double half_width;   ///< from the middle to a corner, where it is the same all along
  double half_spread;  ///< the same for every unit of length along the line

  Core(const TreeSpace& space, const Pencil& pencil) noexcept {
    const Vec3 corner =
        0.5 * (pencil.x[1] - pencil.x[0]) * pencil.right + 0.5 * (pencil.y[1] - pencil.y[0]) * pencil.down;
    const Vec3 middle =
        0.5 * (pencil.x[0] + pencil.x[1]) * pencil.right + 0.5 * (pencil.y[0] + pencil.y[1]) * pencil.down;
    const bool is_pyramid = pencil.kind == Pencil::Kind::pyramid;
    start = space.from_scene(is_pyramid ? pencil.origin : pencil.origin + middle);
    unit = normalized(is_pyramid ? pencil.axis + middle : pencil.axis);
    half_width = is_pyramid ? 0 : length(corner) * space.scale;
    half_spread = is_pyramid ? length(corner) : 0;
  }

  /// How far along the line a sphere that hides all behind it from the whole pencil has its centre, or infinity.
  float cover(const Vec3& center, double radius) const noexcept {
    const Vec3 f = center - start;
    const double foot = dot(f, unit);
    const double room = radius - half_width - half_spread * foot;
    const bool covers = foot > radius && room > 0 && dot(f, f) - foot * foot < room * room;
    return covers ? static_cast<float>(foot) : std::numeric_limits<float>::infinity();
  }
};

/// A shadow ray's line, from the light to what it shines on.
/// shapes:  squared is that of the ray's direction
LightLine line_of(const LightGrid& grid, const TreeSpace& space, const Ray& to_light, double squared) noexcept {
  LightLine line{};
  double distance = 0;
  const auto set = [](float(&to)[3], const Vec3& v) {
    for (int axis = 0; axis != 3; ++axis) to[axis] = static_cast<float>(v[axis]);
  };
  if (grid.is_point()) {
    const double length = std::sqrt(squared);
    set(line.unit, to_light.direction * (-1 / length));
    distance = length * space.scale;
  } else {
    const Vec3 way = space.from_scene(to_light.origin) - grid.origin();
    line.distance = std::numeric_limits<float>::infinity();
    if (sum_of_sizes(way) > TreeRay::kFarthest) return line;
    distance = dot(way, grid.direction());
    set(line.unit, grid.direction());
    set(line.across, way - distance * grid.direction());
  }
  line.distance = TreeSpace::up(std::clamp(distance * (1 + 0x1p-20), 0.0, TreeRay::kFarthest));
  return line;
}

/// More than the perpendicular from a centre to a line, and its foot, are off by for f = C - origin: see blockers_of.
constexpr double kError = 0x1p-18;
/// Outweighs twice that for everything that a line may meet.
constexpr float kLooseness = 0x1p-16F;

/// Spheres of a leaf that may stand in a line's way, and those of them that surely do.
struct Blockers {
  LaneMask maybe;
  LaneMask surely;
};

/// error:   With f = C - origin, in sums of sizes, |across| is less than 2.5 |f|, for the origin of a directional light
///          is an extent before every sphere. As in TreeRay, the perpendicular from the centre and the foot are off by
///          less than 14 2^-24 (|f| + |across|) < 2^-18 |f|, two of them from rounding and subtracting f and across; C
///          itself has been off by less than 2^-19 |C|. The leaf's radius is widened by both. Twice that is at most
///          2^-16 (3 + distance + radius) for a sphere whose foot is not beyond the distance: |C| <= 3, and
///          |f| <= 1.74 (distance + radius + 2.5), without the 2.5 for a point light
Blockers blockers_of(const TreeLeaf& leaf, const LightLine& line, bool has_start) noexcept {
  const auto [foot, square] = perpendicular(leaf, line.across, line.unit);
  const Float8 reach = Float8::load(leaf.radius);
  const Float8 error = fused(reach, Float8::all(kLooseness), Float8::all(kLooseness * (3 + line.distance)));
  const Float8 sure_reach = reach - error;
  const Float8 distance = Float8::all(line.distance);
  const Float8 start = Float8::all(has_start ? 0 : -std::numeric_limits<float>::infinity());
  return {(square <= reach * reach) & (foot <= distance + error) & (start <= foot + error),
          (square <= sure_reach * sure_reach) & (foot <= distance - error) & (start <= foot - error) &
              (Float8::all(0) <= sure_reach)};
}

/// A sphere that reaches into a pencil.
struct Occluder {
  float begin;  ///< nothing of it is nearer to where lines start
  float radius;
  std::array<float, 3> at;  ///< in tree space
  SurfaceId id;

  Vec3 center() const noexcept { return {at[0], at[1], at[2]}; }
};

/// Those nearest to the light, in this order.
struct Occluders {
  std::vector<Occluder> spheres;
  float end = std::numeric_limits<float>::infinity();  ///< none that was left out begins before
};

void prefetch_child(const Bvh& bvh, std::uint32_t child) noexcept {
  const std::uint32_t index = TreeChild::index(child);
  TreeChild::is_leaf(child) ? prefetch(bvh.leaves().data() + index) : prefetch(bvh.nodes().data() + index);
}

/// Opens boxes in the order in which they begin, until `most` spheres are found or one that hides all others.
Occluders occluders_in(const Bvh& bvh, const Pencil& pencil, std::size_t most) {
  struct Box {
    float begin;
    std::uint32_t child;
  };
  const auto later = [](const Box& a, const Box& b) { return a.begin > b.begin; };
  const TreeFrustum frustum(bvh.space(), pencil);
  const Core core(bvh.space(), pencil);
  const auto shift = static_cast<float>(frustum.shift);
  Occluders found;
  auto& [spheres, end] = found;
  spheres.reserve(3 * most);
  std::vector<Box> boxes;
  boxes.reserve(128);
  boxes.push_back({0, 0});
  alignas(32) float begin[kTreeWidth];
  while (!boxes.empty()) {
    const Box box = boxes.front();
    // Some more, for those found last need not be the farthest.
    if (spheres.size() >= 2 * most) end = std::min(end, box.begin);
    if (box.begin >= end) break;
    std::pop_heap(boxes.begin(), boxes.end(), later);
    boxes.pop_back();
    Float8 depth;
    if (TreeChild::is_leaf(box.child)) {
      const TreeLeaf& leaf = bvh.leaves()[TreeChild::index(box.child)];
      const auto& [x, y, z] = leaf.center;
      LaneMask met = may_meet(leaf, frustum, depth);
      depth.store(begin);
      for (; met != 0; met &= met - 1) {
        const int i = std::countr_zero(met);
        spheres.push_back({begin[i], leaf.radius[i], {x[i], y[i], z[i]}, leaf.id[i]});
        end = std::min(end, core.cover(spheres.back().center(), leaf.radius[i]) - shift);
      }
    } else {
      const TreeNode& node = bvh.nodes()[box.child];
      LaneMask met = meets_children(node, frustum, depth);
      depth.store(begin);
      for (; met != 0; met &= met - 1) {
        const int i = std::countr_zero(met);
        boxes.push_back({begin[i], node.child[i]});
        prefetch_child(bvh, node.child[i]);
        std::push_heap(boxes.begin(), boxes.end(), later);
      }
    }
  }
  std::sort(spheres.begin(), spheres.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  while (!spheres.empty() && (spheres.size() > most || spheres.back().begin > end)) {
    end = std::min(end, spheres.back().begin);
    spheres.pop_back();
  }
  // Depths count from where the spheres begin.
  const auto from_start = [&](float& depth) {
    if (depth < std::numeric_limits<float>::infinity()) depth = TreeSpace::down(depth + frustum.shift);
  };
  for (Occluder& sphere : spheres) from_start(sphere.begin);
  from_start(end);
  return found;
}

}  // namespace

[[gnu::flatten]] void LightCells::make(Cell& cell, const LightGrid::Place& place) {
  const Occluders found = occluders_in(scene_.bvh(), grid_->pencil(place, cell.bits), kMostLeaves * kTreeWidth);
  cell.state = State::made;
  cell.rays = 0;
  cell.end = found.end;
  cell.first = static_cast<std::uint32_t>(leaves_.size());
  const std::size_t count = found.spheres.size();
  for (std::size_t i = 0; i < count; i += kTreeWidth) {
    cell.begins[cell.leaves++] = found.spheres[i].begin;
    TreeLeaf& leaf = leaves_.emplace_back(TreeLeaf::empty());
    for (std::size_t lane = 0; lane != std::min<std::size_t>(kTreeWidth, count - i); ++lane) {
      const Occluder& sphere = found.spheres[i + lane];
      const Vec3 f = sphere.center() - grid_->origin();
      for (int axis = 0; axis != 3; ++axis) leaf.center[axis][lane] = static_cast<float>(f[axis]);
      leaf.radius[lane] = TreeSpace::up(sphere.radius + kError * sum_of_sizes(f));
      leaf.id[lane] = sphere.id;
    }
  }
}

[[gnu::flatten]] void LightCells::look_up(std::span<const RayInRegion> to_light, std::span<std::uint8_t> occluded) {
  others_.clear();
  places_.clear();
  constexpr std::size_t kTogether = 64;  // enough to hide the way to memory
  std::array<LightLine, kTogether> lines;
  std::array<std::uint32_t, kTogether> cells;
  const Region* region = nullptr;
  bool is_shut = false;
  bool is_plain = false;  // no ray of the region starts or ends on or in a sphere but the one that it leaves
  for (std::size_t first = 0; first < to_light.size(); first += kTogether) {
    const auto rays = to_light.subspan(first, std::min(kTogether, to_light.size() - first));
    for (std::size_t i = 0; i != rays.size(); ++i) {
      const Ray& ray = rays[i].ray;
      cells[i] = kNone;
      const double squared = dot(ray.direction, ray.direction);
      if (!is_squarable(squared)) continue;
      lines[i] = line_of(*grid_, scene_.bvh().space(), ray, squared);
      if (const auto place = grid_->place_of(lines[i])) cells[i] = cell_at(*place);
      if (cells[i] != kNone && cells_[cells[i]].leaves > 0) prefetch(&leaves_[cells_[cells[i]].first]);
    }
    for (std::size_t i = 0; i != rays.size(); ++i) {
      if (rays[i].region != region) {
        region = rays[i].region;
        is_shut = is_shut_off(scene_, light_, *region);
        is_plain = region->is_open() && scene_.light_placement(light_).touching.empty();
      }
      const Answer answer =
          cells[i] == kNone || is_shut ? Answer::none : answer_of(cells[i], lines[i], rays[i], is_plain);
      if (answer == Answer::none) {
        others_.push_back(rays[i]);
        places_.push_back(first + i);
      }
      occluded[first + i] = answer == Answer::occluded;
    }
  }
}

LightCells::Answer LightCells::answer_of(std::uint32_t index, const LightLine& line, const RayInRegion& ray,
                                         bool is_plain) {
  Cell& cell = cells_[index];
  if (cell.state != State::made) return Answer::none;  // it was when it was looked up
  Use& use = uses_[cell.bits];
  ++use.tried;
  ++use.decided;
  const TreeLeaf* const leaves = leaves_.data() + cell.first;
  for (std::size_t i = 0; i != cell.leaves; ++i) {
    if (cell.begins[i] > line.distance) return Answer::lit;
    const TreeLeaf& leaf = leaves[i];
    const Blockers blockers = blockers_of(leaf, line, grid_->is_point());
    const LaneMask others = ~lanes_equal(Int8::load(leaf.id), static_cast<std::uint32_t>(ray.ray.from));
    LaneMask maybe = blockers.maybe & others;
    if (maybe == 0) continue;
    if (is_plain && (blockers.surely & others) != 0) return Answer::occluded;
    OcclusionSearch search(scene_, ray.ray, grid_->is_point() ? 1 : std::numeric_limits<double>::infinity(), light_,
                           *ray.region);
    for (; maybe != 0; maybe &= maybe - 1) {
      if (search.offer(leaf.id[std::countr_zero(maybe)])) return Answer::occluded;
    }
  }
  if (line.distance <= cell.end) return Answer::lit;
  --use.decided;
  if (++cell.rays >= kRaysToDivide) divide(index);
  return Answer::none;
}

}  // namespace tessera::render
TESSERA_END_AVX2
#else

namespace tessera::render {

// Never called: no kernel has cells here.
void LightCells::make(Cell&, const LightGrid::Place&) {}
void LightCells::look_up(std::span<const RayInRegion>, std::span<std::uint8_t>) {}

}  // namespace tessera::render
#endif
