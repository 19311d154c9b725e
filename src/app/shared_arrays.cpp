// SPDX-License-Identifier: BSD-3-Clause
#include "app/shared_arrays.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

namespace tessera::app {
namespace {

using render::Material;
using render::Sphere;
using scheduler::mpi::NodeMemory;
using scheduler::mpi::Session;

/// What stands in memory: the spheres, then the materials.
struct Layout {
  std::uint64_t spheres;
  std::uint64_t materials;

  std::size_t bytes() const noexcept { return spheres * sizeof(Sphere) + materials * sizeof(Material); }
  std::span<Sphere> spheres_in(std::span<std::byte> memory) const noexcept {
    return {reinterpret_cast<Sphere*>(memory.data()), spheres};
  }
  std::span<Material> materials_in(std::span<std::byte> memory) const noexcept {
    return {reinterpret_cast<Material*>(memory.data() + spheres * sizeof(Sphere)), materials};
  }
};
static_assert(std::has_unique_object_representations_v<Layout> && sizeof(Layout) == 16);
static_assert(std::is_trivially_copyable_v<Sphere> && sizeof(Sphere) == 40);
static_assert(std::is_trivially_copyable_v<Material> && sizeof(Material) == 64);
static_assert(sizeof(Sphere) % alignof(Material) == 0);

/// Copies elements to where they stay, and frees where they were.
template <class T>
void move_to(std::span<T> to, std::vector<T> from) {
  std::copy(from.begin(), from.end(), to.begin());
}

}  // namespace

SceneArrays share_arrays(Session& session, std::vector<Sphere> spheres, std::vector<Material> materials,
                         scheduler::mpi::Sharing sharing) {
  Layout layout{spheres.size(), materials.size()};
  session.broadcast(std::as_writable_bytes(std::span(&layout, 1)));

  const bool is_reader = session.rank() == scheduler::kMasterRank;
  if (is_reader && session.ranks_on_node() == 1) {
    session.broadcast_to_nodes(std::as_writable_bytes(std::span(spheres)));
    session.broadcast_to_nodes(std::as_writable_bytes(std::span(materials)));
    return {std::move(spheres), std::move(materials), {}};
  }

  const auto memory = std::make_shared<NodeMemory>(session, layout.bytes(), sharing);
  const auto all_spheres = layout.spheres_in(memory->bytes());
  const auto all_materials = layout.materials_in(memory->bytes());
  if (is_reader) {
    move_to(all_spheres, std::move(spheres));
    move_to(all_materials, std::move(materials));
  }
  session.broadcast_to_nodes(std::as_writable_bytes(all_spheres));
  session.broadcast_to_nodes(std::as_writable_bytes(all_materials));
  memory->publish(session);
  const bool is_shared = memory->is_shared();
  return {{memory, all_spheres}, {memory, all_materials}, {is_shared ? 1 : session.ranks_on_node(), is_shared}};
}

}  // namespace tessera::app
