// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/tile_times.h"
#include "render/image.h"

// What each part of a picture is predicted to cost.
namespace tessera::app {

/// The times of an earlier run, spread over a picture that may have another resolution.
class CostMap {
 public:
  /// The tiles' pixels are taken to be the whole `picture`, or where their shape is another one, the `area` of it that
  /// is to be rendered; each of ours costs what one of theirs did. `file` is where the times are from, for messages.
  /// throws:  io::Error(bad_scene) where the tiles have neither shape
  CostMap(const std::vector<io::TileTime>& tiles, const render::Rect& area, const render::Rect& picture,
          const std::string& file);

  /// requires: rect lies in the area
  /// units:   seconds
  double seconds(const render::Rect& rect) const noexcept;
  /// The same of the whole area.
  double seconds() const noexcept { return sums_.back(); }

 private:
  struct Box {
    double left, top, right, bottom;
  };
  /// Adds `density` times the pixels of `box` to the blocks that it lies in.
  void spread(const Box& box, double density);
  void add_up() noexcept;
  /// What lies left of x and above y, in pixels from the area's corner; within a block all pixels cost the same.
  double sum(double x, double y) const noexcept;
  double corner(std::size_t column, std::size_t row) const noexcept { return sums_[row * (columns_ + 1) + column]; }

  render::Rect area_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<double> sums_;  ///< of all blocks left of and above a corner
};

}  // namespace tessera::app
