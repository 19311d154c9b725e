// SPDX-License-Identifier: BSD-3-Clause
#include "io/generate.h"

#include <array>
#include <cstddef>
#include <random>

namespace tessera::io {
namespace {

using render::Sphere;
using render::Vec3;

// --- sphereflake ---

/// Which way a sphere of the flake stands: three unit vectors at right angles.
struct Frame {
  Vec3 side;
  Vec3 front;
  Vec3 pole;
};

/// Where a child sits on its parent.
struct Seat {
  double cos_azimuth, sin_azimuth;
  double cos_elevation, sin_elevation;
};

constexpr double kCos30 = 0.86602540378443864676;
constexpr double kCos55 = 0.57357643635104609611;
constexpr double kSin55 = 0.81915204428899178968;
constexpr std::size_t kChildren = 9;

constexpr std::array<Seat, kChildren> kSeats{{
    {1, 0, 1, 0},  // the equator, every 60 degrees
    {0.5, kCos30, 1, 0},
    {-0.5, kCos30, 1, 0},
    {-1, 0, 1, 0},
    {-0.5, -kCos30, 1, 0},
    {0.5, -kCos30, 1, 0},
    {kCos30, 0.5, kCos55, kSin55},  // above it at azimuths 30, 150 and 270 degrees
    {-kCos30, 0.5, kCos55, kSin55},
    {0, -1, kCos55, kSin55},
}};

Frame child_frame(const Frame& parent, const Seat& seat) {
  const Vec3 outward = seat.cos_azimuth * parent.side + seat.sin_azimuth * parent.front;
  const Vec3 pole = seat.cos_elevation * outward + seat.sin_elevation * parent.pole;
  const Vec3 side = seat.cos_azimuth * parent.front - seat.sin_azimuth * parent.side;
  return {side, cross(pole, side), pole};
}

std::size_t flake_size(std::uint32_t level) {
  std::size_t generation = 1;
  std::size_t total = 1;
  for (std::uint32_t i = 0; i < level; ++i) total += generation *= kChildren;
  return total;
}

// --- cloud ---

/// Random numbers that the standard fixes to the bit, unlike those of std::uniform_real_distribution.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

  /// Uniform in 0 ... n - 1.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

 private:
  std::mt19937_64 bits_;
};

/// shapes:  1 <= n <= 2e8
/// error:   relative 1e-15
/// source:  Newton's iteration from above, where it always converges
double cube_root(double n) {
  double root = n;
  for (int i = 0; i < 64; ++i) root = (2 * root + n / (root * root)) / 3;
  return root;
}

}  // namespace

std::vector<Sphere> generate_sphereflake(const Sphereflake& flake) {
  const std::size_t total = flake_size(flake.level);
  const std::size_t parents = (total - 1) / kChildren;
  std::vector<Sphere> spheres;
  std::vector<Frame> frames;  // of the spheres that have children
  spheres.reserve(total);
  frames.reserve(parents + 1);
  spheres.push_back({flake.center, flake.radius, flake.materials[0]});
  frames.push_back({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});

  std::size_t parent = 0;
  for (std::uint32_t generation = 1; generation <= flake.level; ++generation) {
    const auto material = flake.materials[generation % flake.materials.size()];
    for (const std::size_t end = spheres.size(); parent < end; ++parent) {
      const double radius = spheres[parent].radius / 3;
      const double distance = spheres[parent].radius + radius;
      for (const Seat& seat : kSeats) {
        const Frame frame = child_frame(frames[parent], seat);
        spheres.push_back({spheres[parent].center + distance * frame.pole, radius, material});
        if (frames.size() < parents) frames.push_back(frame);
      }
    }
  }
  return spheres;
}

std::vector<Sphere> generate_cloud(const Cloud& cloud) {
  const double largest = cloud.scale * cloud.fill / cube_root(static_cast<double>(cloud.count));
  Random random(cloud.seed);
  const auto coordinate = [&] { return cloud.scale * (2 * random.uniform() - 1); };

  std::vector<Sphere> spheres(cloud.count);
  for (Sphere& sphere : spheres) {
    const double x = coordinate();
    const double y = coordinate();
    const double z = coordinate();
    sphere.center = cloud.center + Vec3{x, y, z};
    sphere.radius = largest * (0.3 + 0.7 * random.uniform());
    sphere.material = cloud.materials[random.below(cloud.materials.size())];
  }
  return spheres;
}

}  // namespace tessera::io
