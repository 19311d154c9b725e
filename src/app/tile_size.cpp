// SPDX-License-Identifier: BSD-3-Clause
#include "app/tile_size.h"

#include <algorithm>
#include <cmath>

#include "scheduler/grain.h"

namespace tessera::app {
namespace {

constexpr double kSampleSeconds = 0.3e-6;
constexpr double kDearToMean = 6;
constexpr long kLeastLog2 = 6;
constexpr long kMostLog2 = 14;

constexpr std::uint64_t kLeastTilesPerRank = 2;
/// Twice as much as where bands begin to lose, for the guess may be too high.
constexpr double kLeastWorkRatio = 6;

double predicted_s(const render::Rect& area, double samples) noexcept {
  return kSampleSeconds * samples * static_cast<double>(area.pixels());
}

std::uint64_t tiles_along(std::uint32_t length, std::uint32_t tile) noexcept {
  return (std::uint64_t{length} + tile - 1) / tile;
}

}  // namespace

Size tile_size_without_costs(const render::Rect& area, double samples) noexcept {
  const auto pixels = static_cast<double>(area.pixels());
  const double dear_pixel_s = kDearToMean * kSampleSeconds * samples;
  const double best = std::sqrt(pixels * scheduler::kMasterSecondsPerTask / dear_pixel_s);
  const long log2 = std::clamp(std::lround(std::log2(best)), kLeastLog2, kMostLog2);
  return {1U << ((log2 + 1) / 2), 1U << (log2 / 2)};
}

bool bands_will_do(const render::Rect& area, double samples, std::uint32_t ranks) noexcept {
  const Size size = tile_size_without_costs(area, samples);
  const std::uint64_t tiles = tiles_along(area.width, size.width) * tiles_along(area.height, size.height);
  return ranks > 1 && (tiles < kLeastTilesPerRank * ranks ||
                       scheduler::work_ratio(predicted_s(area, samples), ranks) < kLeastWorkRatio);
}

}  // namespace tessera::app
