// SPDX-License-Identifier: BSD-3-Clause
#include "render/bvh.h"

#include <cmath>

namespace tessera::render {

std::size_t Bvh::memory_bytes() const noexcept {
  return nodes_.size() * sizeof(TreeNode) + leaves_.size() * sizeof(TreeLeaf);
}

Box Bvh::child_box(const TreeNode& node, int child) const noexcept {
  const auto corner = [&](int side) {
    return Vec3{node.bounds[0][side][child], node.bounds[1][side][child], node.bounds[2][side][child]};
  };
  Box box{corner(0), corner(1)};
  if (box.is_empty()) return box;
  // Back in the scene's coordinates each side rounds twice.
  const auto outward = [&](double x, double base, double slack) { return base + (x + slack) / space_.scale; };
  const double base_size = sum_of_sizes(space_.base) * space_.scale;
  const auto slack_of = [&](double x) { return 0x1p-50 * (std::abs(x) + base_size); };
  const auto lower = [&](double x, double base) { return outward(x, base, -slack_of(x)); };
  const auto upper = [&](double x, double base) { return outward(x, base, slack_of(x)); };
  box.lo = {lower(box.lo.x, space_.base.x), lower(box.lo.y, space_.base.y), lower(box.lo.z, space_.base.z)};
  box.hi = {upper(box.hi.x, space_.base.x), upper(box.hi.y, space_.base.y), upper(box.hi.z, space_.base.z)};
  return box;
}

}  // namespace tessera::render
