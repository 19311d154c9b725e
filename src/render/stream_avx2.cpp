// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <limits>
#include <new>

#include "render/intersect.h"
#include "render/lanes_avx2.h"
#include "render/search.h"
#include "render/stream.h"

#if defined(__x86_64__)
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {
namespace {

/// Rays in flight: enough that while one waits for memory, or for its own last step, others go on.
constexpr std::size_t kInFlight = 32;

/// A ray on its way through the tree.
template <class Search>
struct Traversal {
  TreeRay ray;
  float latest;        ///< of the search, in the tree's units
  SurfaceId from;      ///< never offered
  std::uint32_t size;  ///< of the stack
  std::size_t query;
  Search search;
  // Children put aside, where they are entered and which they are. Lanes beyond the last are written too.
  std::uint32_t entry[Bvh::kStackSize + kTreeWidth];
  std::uint32_t child[Bvh::kStackSize + kTreeWidth];

  Traversal(const Bvh& bvh, const Search& asked, std::size_t number) noexcept
      : ray(bvh.space(), asked.ray(), asked.inverse_length()),
        latest(ray.t_of(asked.latest())),
        from(asked.ray().from),
        size(1),
        query(number),
        search(asked) {
    entry[0] = 0;
    child[0] = 0;
  }

  /// Drops what lies behind the nearest surface found since it was put aside.
  bool has_next() noexcept {
    const float end = latest * TreeRay::kSlack;
    while (size > 0 && !(std::bit_cast<float>(entry[size - 1]) <= end)) --size;
    return size > 0;
  }
};

/// Traces rays through a tree, many at a time. Each step of a ray is a handful of vector instructions without a
/// branch; steps of different rays are independent of each other, so the processor overlaps them.
template <class Search>
class Stream {
 public:
  explicit Stream(const Bvh& bvh) noexcept : nodes_(bvh.nodes().data()), leaves_(bvh.leaves().data()), bvh_(bvh) {}

  /// requires: !is_full()
  void add(const Search& search, std::size_t query) noexcept {
    const std::size_t slot = free_ == 0 ? size_ : free_slots_[--free_];
    active_[size_++] = static_cast<std::uint8_t>(slot);
    new (traversal(slot)) Traversal<Search>(bvh_, search, query);
  }
  bool is_full() const noexcept { return size_ == kInFlight; }
  bool is_empty() const noexcept { return size_ == 0; }

  /// Takes every ray one step on; calls done(query, search) for those that are at their end.
  template <class Done>
  void step(Done& done) noexcept {
    std::size_t nodes = 0;
    std::size_t leaves = 0;
    for (std::size_t i = 0; i < size_;) {
      const std::uint8_t slot = active_[i];
      Traversal<Search>& at = *traversal(slot);
      if (!at.has_next()) {
        done(at.query, at.search);
        free_slots_[free_++] = slot;
        active_[i] = active_[--size_];
        continue;
      }
      const Step next{&at, at.child[--at.size]};
      const bool is_leaf = TreeChild::is_leaf(next.child);
      node_steps_[nodes] = next;
      leaf_steps_[leaves] = next;
      nodes += !is_leaf;
      leaves += is_leaf;
      ++i;
    }
    for (std::size_t i = 0; i != nodes; ++i) enter_node(*node_steps_[i].ray, nodes_[node_steps_[i].child]);
    std::size_t offers = 0;
    for (std::size_t i = 0; i != leaves; ++i) {
      offers = look_at_leaf(*leaf_steps_[i].ray, leaves_[TreeChild::index(leaf_steps_[i].child)], offers);
    }
    for (std::size_t i = 0; i != offers; ++i) offer(*offers_[i].ray, offers_[i].sphere);
  }

 private:
  struct Step {
    Traversal<Search>* ray;
    std::uint32_t child;
  };
  struct Offer {
    Traversal<Search>* ray;
    SurfaceId sphere;
  };

  Traversal<Search>* traversal(std::size_t slot) noexcept {
    return std::launder(reinterpret_cast<Traversal<Search>*>(storage_ + slot * sizeof(Traversal<Search>)));
  }

  /// As meets_child of bvh.h, for all children.
  static void enter_node(Traversal<Search>& at, const TreeNode& node) noexcept {
    const TreeRay& ray = at.ray;
    const auto near_at = [&](int axis) {
      const Float8 side = Float8::load(node.bounds[axis][ray.near_side[axis]]);
      return (side - Float8::all(ray.near_origin[axis])) * Float8::all(ray.inverse[axis]);
    };
    const auto far_at = [&](int axis) {
      const Float8 side = Float8::load(node.bounds[axis][1 - ray.near_side[axis]]);
      return (side - Float8::all(ray.far_origin[axis])) * Float8::all(ray.inverse[axis]);
    };
    const Float8 enter = max(max(near_at(0), near_at(1)), max(near_at(2), Float8::all(0)));
    const Float8 leave = min(min(far_at(0), far_at(1)), min(far_at(2), Float8::all(at.latest)));
    const LaneMask met = enter <= leave * Float8::all(TreeRay::kSlack);

    const Int8 lanes = lanes_descending(enter, met);
    lanes.store(at.entry + at.size);
    Int8::load(node.child).picked(lanes).store(at.child + at.size);
    at.size += static_cast<std::uint32_t>(std::popcount(met));
  }

  /// As may_meet of bvh.h, for all spheres.
  std::size_t look_at_leaf(Traversal<Search>& at, const TreeLeaf& leaf, std::size_t offers) noexcept {
    const TreeRay& ray = at.ray;
    const Float8 fx = Float8::load(leaf.center[0]) - Float8::all(ray.origin[0]);
    const Float8 fy = Float8::load(leaf.center[1]) - Float8::all(ray.origin[1]);
    const Float8 fz = Float8::load(leaf.center[2]) - Float8::all(ray.origin[2]);
    const Float8 dx = Float8::all(ray.direction[0]);
    const Float8 dy = Float8::all(ray.direction[1]);
    const Float8 dz = Float8::all(ray.direction[2]);
    const Float8 foot = fused(fz, dz, fused(fy, dy, fx * dx));
    const Float8 px = fused_minus(foot, dx, fx);
    const Float8 py = fused_minus(foot, dy, fy);
    const Float8 pz = fused_minus(foot, dz, fz);
    const Float8 square = fused(pz, pz, fused(py, py, px * px));
    const Float8 reach = Float8::load(leaf.radius) + Float8::all(ray.sphere_error);
    LaneMask met =
        (square <= reach * reach) & (Float8::all(0) <= foot + reach) & (foot - reach <= Float8::all(at.latest));
    met &= ~lanes_equal(Int8::load(leaf.id), static_cast<std::uint32_t>(at.from));
    for (; met != 0; met &= met - 1) {
      offers_[offers++] = {&at, leaf.id[std::countr_zero(met)]};
    }
    return offers;
  }

  static void offer(Traversal<Search>& at, SurfaceId sphere) noexcept {
    if (at.search.offer(sphere)) at.size = 0;
    at.latest = at.ray.t_of(at.search.latest());
  }

  const TreeNode* nodes_;
  const TreeLeaf* leaves_;
  const Bvh& bvh_;
  std::size_t size_ = 0;
  std::size_t free_ = 0;
  std::uint8_t active_[kInFlight];
  std::uint8_t free_slots_[kInFlight];
  Step node_steps_[kInFlight];
  Step leaf_steps_[kInFlight];
  Offer offers_[kInFlight * kTreeWidth];
  alignas(64) std::byte storage_[kInFlight * sizeof(Traversal<Search>)];
};

/// Where answers go.
struct Hits {
  std::span<std::optional<Hit>> hits;
  void operator()(std::size_t query, NearestSearch& search) noexcept { hits[query] = search.finish(); }
};
struct Occlusions {
  std::span<std::uint8_t> occluded;
  void operator()(std::size_t query, const OcclusionSearch& search) noexcept { occluded[query] = search.is_occluded(); }
};

}  // namespace

[[gnu::flatten]] void nearest_hits(const Scene& scene, std::span<const RayInRegion> rays,
                                   std::span<std::optional<Hit>> hits) {
  Stream<NearestSearch> stream(scene.bvh());
  Hits done{hits};
  for (std::size_t next = 0; next != rays.size() || !stream.is_empty();) {
    for (; next != rays.size() && !stream.is_full(); ++next) {
      const auto& [ray, region] = rays[next];
      if (!is_squarable(dot(ray.direction, ray.direction))) {
        hits[next] = nearest_hit(scene, ray, *region);
        continue;
      }
      stream.add(NearestSearch(scene, ray, *region), next);
    }
    stream.step(done);
  }
}

[[gnu::flatten]] void occlusions(const Scene& scene, std::span<const RayInRegion> to_light, std::size_t light,
                                 std::span<std::uint8_t> occluded) {
  Stream<OcclusionSearch> stream(scene.bvh());
  Occlusions done{occluded};
  const bool is_point = scene.data().lights[light].kind == LightKind::point;
  const double end = is_point ? 1 : std::numeric_limits<double>::infinity();
  for (std::size_t next = 0; next != to_light.size() || !stream.is_empty();) {
    for (; next != to_light.size() && !stream.is_full(); ++next) {
      const auto& [ray, region] = to_light[next];
      if (!is_squarable(dot(ray.direction, ray.direction)) || is_shut_off(scene, light, *region)) {
        occluded[next] = is_occluded(scene, ray, light, *region);
        continue;
      }
      stream.add(OcclusionSearch(scene, ray, end, light, *region), next);
    }
    stream.step(done);
  }
}

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#else

namespace tessera::render::avx2 {

// Never called: no such kernel is supported here.
void nearest_hits(const Scene&, std::span<const RayInRegion>, std::span<std::optional<Hit>>) {}
void occlusions(const Scene&, std::span<const RayInRegion>, std::size_t, std::span<std::uint8_t>) {}

}  // namespace tessera::render::avx2
#endif
