// SPDX-License-Identifier: BSD-3-Clause
#include "app/shared_tree.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>

#include "render/bvh_build.h"

namespace tessera::app {
namespace {

/// What stands in memory: the nodes, then the leaves.
struct Layout {
  render::TreeSpace space;
  std::uint64_t nodes;
  std::uint64_t leaves;

  std::size_t bytes() const noexcept { return nodes * sizeof(render::TreeNode) + leaves * sizeof(render::TreeLeaf); }
  std::span<render::TreeNode> nodes_in(std::span<std::byte> memory) const noexcept {
    return {reinterpret_cast<render::TreeNode*>(memory.data()), nodes};
  }
  std::span<render::TreeLeaf> leaves_in(std::span<std::byte> memory) const noexcept {
    return {reinterpret_cast<render::TreeLeaf*>(memory.data() + nodes * sizeof(render::TreeNode)), leaves};
  }
};
static_assert(std::is_trivially_copyable_v<Layout> && sizeof(Layout) == 80);
static_assert(std::is_trivially_copyable_v<render::TreeNode> && std::is_trivially_copyable_v<render::TreeLeaf>);
static_assert(sizeof(render::TreeNode) % alignof(render::TreeLeaf) == 0);

}  // namespace

render::Bvh build_on_node(scheduler::mpi::Session& session, std::span<const render::Sphere> spheres,
                          scheduler::mpi::Sharing sharing) {
  if (session.ranks_on_node() == 1) return render::build_bvh(spheres);

  std::optional<render::BvhBuild> build;
  Layout layout{};
  if (session.is_first_on_node()) {
    const scheduler::mpi::NodeCores cores(session);
    build.emplace(spheres, cores.threads());
    layout = {build->space(), build->node_count(), build->leaf_count()};
  }
  session.broadcast_on_node(std::as_writable_bytes(std::span(&layout, 1)));

  const auto memory = std::make_shared<scheduler::mpi::NodeMemory>(session, layout.bytes(), sharing);
  const auto nodes = layout.nodes_in(memory->bytes());
  const auto leaves = layout.leaves_in(memory->bytes());
  if (build) {
    const scheduler::mpi::NodeCores cores(session);
    build->move_to(nodes, leaves);
  }
  memory->publish(session);
  return {layout.space, {memory, nodes}, {memory, leaves}};
}

}  // namespace tessera::app
