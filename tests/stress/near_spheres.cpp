// SPDX-License-Identifier: BSD-3-Clause
#include "stress/near_spheres.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace tessera::stress {
namespace {

using render::Sphere;
using render::Vec3;

constexpr double kSlack = 1e-9;

/// So many spheres at a time, in columns.
struct Block {
  static constexpr std::size_t kSize = 256;
  std::array<double, kSize> x;
  std::array<double, kSize> y;
  std::array<double, kSize> z;
  std::array<double, kSize> square;  ///< of the radius
  std::size_t count = 0;

  void add(const Sphere& sphere) {
    x[count] = sphere.center.x;
    y[count] = sphere.center.y;
    z[count] = sphere.center.z;
    square[count++] = sphere.radius * sphere.radius;
  }
};

/// The candidates of one segment.
class Collector {
 public:
  explicit Collector(const Segment& segment)
      : segment_(segment),
        inverse_(1 / dot(segment.direction, segment.direction)),
        origin_slack_(1e-20 * dot(segment.origin, segment.origin)),
        latest_(segment.end) {}

  void look(const Block& block, std::uint32_t first) {
    // How far the line passes outside of each sphere, squared, with slack: p <= r + s follows from
    // p^2 <= r^2 (1 + e) + s^2 (1 + 1 / e).
    std::array<double, Block::kSize> excess;
    for (std::size_t i = 0; i != Block::kSize; ++i) {
      const double fx = block.x[i] - segment_.origin.x;
      const double fy = block.y[i] - segment_.origin.y;
      const double fz = block.z[i] - segment_.origin.z;
      const double b = fx * segment_.direction.x + fy * segment_.direction.y + fz * segment_.direction.z;
      const double f = fx * fx + fy * fy + fz * fz;
      excess[i] = f - b * b * inverse_ - block.square[i] - kSlack * (f + block.square[i]);
    }
    for (std::size_t i = 0; i != block.count; ++i) {
      if (excess[i] <= origin_slack_) weigh(block, i, first + static_cast<std::uint32_t>(i));
    }
  }

  std::vector<std::uint32_t> take() {
    if (blocker_) return {*blocker_};
    std::vector<std::uint32_t> indices;
    for (const Candidate& candidate : candidates_) {
      if (candidate.earliest <= latest_) indices.push_back(candidate.sphere);
    }
    return indices;
  }

 private:
  struct Candidate {
    std::uint32_t sphere;
    double earliest;  ///< no hit comes before
  };

  void weigh(const Block& block, std::size_t i, std::uint32_t sphere) {
    const Vec3 f = Vec3{block.x[i], block.y[i], block.z[i]} - segment_.origin;
    const double foot = dot(f, segment_.direction) * inverse_;
    const double f2 = dot(f, f);
    const double p2 = std::max(f2 - foot * foot / inverse_, 0.0);
    const double slack = kSlack * (f2 + block.square[i]) + origin_slack_;
    const double foot_slack =
        2 * std::sqrt((kSlack * kSlack * f2 + 1e-30 * dot(segment_.origin, segment_.origin)) * inverse_);
    if (blocker_ || foot < -foot_slack || foot - foot_slack > segment_.end) return;
    const double widest = std::sqrt(std::max(block.square[i] + slack - p2, 0.0) * inverse_);
    const double earliest = segment_.is_shadow ? 0 : foot - widest - foot_slack;
    if (earliest > latest_) return;
    candidates_.push_back({sphere, earliest});

    // What is surely met bounds all others.
    if (p2 > block.square[i] - slack || foot < foot_slack) return;
    if (segment_.is_shadow) {
      if (foot + foot_slack < segment_.end) blocker_ = sphere;
      return;
    }
    const double narrowest = std::sqrt((block.square[i] - slack - p2) * inverse_);
    latest_ = std::min(latest_, foot - narrowest + foot_slack);
  }

  Segment segment_;
  double inverse_;
  double origin_slack_;
  double latest_;
  std::vector<Candidate> candidates_;
  std::optional<std::uint32_t> blocker_;  ///< surely between the ends
};

}  // namespace

std::vector<std::vector<std::uint32_t>> spheres_near(std::span<const Sphere> spheres,
                                                     const std::vector<Segment>& segments) {
  std::vector<Collector> collectors(segments.begin(), segments.end());
  for (std::size_t first = 0; first < spheres.size(); first += Block::kSize) {
    Block block{};
    for (std::size_t i = first; i != std::min(first + Block::kSize, spheres.size()); ++i) block.add(spheres[i]);
    for (Collector& collector : collectors) collector.look(block, static_cast<std::uint32_t>(first));
  }
  std::vector<std::vector<std::uint32_t>> near;
  for (Collector& collector : collectors) near.push_back(collector.take());
  return near;
}

}  // namespace tessera::stress
