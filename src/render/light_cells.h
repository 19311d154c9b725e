// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "render/light_grid.h"
#include "render/stream.h"

// Shadow rays seen from the light, where they all come together: what may stand in the way of one is looked up by the
// square of the light's grid that it goes through, instead of being searched for through the tree.
namespace tessera::render {

/// The occluders of one light, collected as rays ask for them.
///
/// A cell has the spheres nearest to the light that reach into its square. Where they leave too many rays undecided,
/// it is divided. Rays that no cell can answer, or that are too few to make one for, go through the tree; so the
/// answers are those of is_occluded, whatever has been asked before.
class LightCells {
 public:
  struct Counts {
    std::uint64_t decided = 0;  ///< rays, by cells
    std::uint64_t left = 0;     ///< rays, to the tree
    std::uint64_t made = 0;     ///< cells
    std::uint64_t divided = 0;  ///< of these
  };

  /// The cells take about `most_bytes` at most.
  /// requires: scene outlives the cells
  LightCells(const Scene& scene, std::size_t light, std::size_t most_bytes);

  /// occlusions() of stream.h.
  /// shapes:  occluded.size() = to_light.size()
  void occlusions(std::span<const RayInRegion> to_light, std::span<std::uint8_t> occluded);

  Counts counts() const noexcept;

 private:
  static constexpr std::size_t kMostLeaves = 4;

  enum class State : std::uint8_t {
    waiting,   ///< for enough rays to be worth making
    made,      ///< has leaves
    divided,   ///< has cells
    hopeless,  ///< decides too little
  };

  struct alignas(32) Cell {
    State state = State::waiting;
    std::uint8_t bits = 0;  ///< its square is 2^bits of the grid's wide
    std::uint8_t leaves = 0;
    std::uint16_t rays = 0;                   ///< that came while waiting, later that were left undecided
    std::uint32_t first = 0;                  ///< leaf or cell
    float end = 0;                            ///< no sphere that was left out begins nearer to the light
    std::array<float, kMostLeaves> begins{};  ///< of each leaf: none of its spheres begins nearer
  };

  enum class Answer : std::uint8_t { lit, occluded, none };

  bool begin_root();
  /// The cell of the lines through a place, or kNone.
  std::uint32_t cell_at(const LightGrid::Place& place);
  void make(Cell& cell, const LightGrid::Place& place);
  void divide(std::uint32_t cell);
  /// Whether cells of a width decide on enough of the rays that come to them.
  bool are_useful(unsigned bits) const noexcept;
  bool has_room() const noexcept;

  // With AVX2:
  /// Answers the rays that cells decide on, and notes the others.
  void look_up(std::span<const RayInRegion> to_light, std::span<std::uint8_t> occluded);
  Answer answer_of(std::uint32_t cell, const LightLine& line, const RayInRegion& ray, bool is_plain);

  /// Undecided rays that are worth smaller cells.
  static constexpr std::uint16_t kRaysToDivide = 128;
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  const Scene& scene_;
  std::size_t light_;
  std::size_t most_bytes_;
  std::optional<LightGrid> grid_;
  std::uint64_t rays_ = 0;        ///< asked for so far
  std::vector<Cell> cells_;       ///< first those of the root, all of one width
  std::vector<TreeLeaf> leaves_;  ///< centres relative to the grid's origin
  // Rays left to the tree, and where their answers go.
  std::vector<RayInRegion> others_;
  std::vector<std::size_t> places_;
  std::vector<std::uint8_t> answers_;
  /// Rays that came to cells of one width.
  struct Use {
    std::uint64_t tried = 0;
    std::uint64_t decided = 0;
  };
  std::array<Use, LightGrid::kBits + 1> uses_;  ///< by bits
  // Of late: rays that were looked up in vain, of how many, and how many are to go to the tree at once therefore.
  std::size_t looked_up_ = 0;
  std::size_t in_vain_ = 0;
  std::size_t aside_ = 0;
};

}  // namespace tessera::render
