// SPDX-License-Identifier: BSD-3-Clause
#include "app/memory_use.h"

#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <memory>

namespace tessera::app {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

}  // namespace

std::uint64_t memory_bytes(const render::Scene& scene) noexcept {
  const render::SceneView view = scene.view();
  return view.spheres.size_bytes() + view.materials.size_bytes() + scene.bvh().memory_bytes();
}

std::uint64_t private_bytes() noexcept {
  // Pages of the address space, those that are in memory, those of these that belong to files or are shared
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen("/proc/self/statm", "r"));
  std::uint64_t resident = 0;
  std::uint64_t shared = 0;
  if (!file || std::fscanf(file.get(), "%*u %" SCNu64 " %" SCNu64, &resident, &shared) != 2) return 0;
  return (resident - std::min(resident, shared)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

io::Stats::Memory memory_of(const render::Scene& scene, const Copies& copies) noexcept {
  const std::uint64_t copy = memory_bytes(scene);
  const std::uint64_t all = private_bytes();
  io::Stats::Memory memory;
  memory.node_bytes = copies.on_node * copy;
  memory.rank_bytes = copies.is_shared ? all : all - std::min(all, copy);
  if (scene.sphere_count() > 0) {
    memory.bytes_per_sphere = static_cast<double>(copy) / static_cast<double>(scene.sphere_count());
  }
  return memory;
}

}  // namespace tessera::app
