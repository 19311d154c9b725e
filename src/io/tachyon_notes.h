// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

// What of a Tachyon scene is not drawn exactly as Tachyon would, counted, to be said in one line each.
namespace tessera::io {

enum class Inexact : std::uint8_t {
  visible_light,
  attenuated_light,
  spotlight,
  sky_light,
  ambient_occlusion,
  lower_shader_mode,
  opacity,
  texfunc,
  metal,
  outline,
  specular_out_of_range,
  local_terms_lost,
  fog,
  background_gradient,
  clip_group,
  count_  ///< not one of them: how many there are
};
inline constexpr std::size_t kInexactCount = static_cast<std::size_t>(Inexact::count_);

using InexactSet = std::bitset<kInexactCount>;

class TachyonNotes {
 public:
  void count(Inexact what) noexcept { ++counts_[static_cast<std::size_t>(what)]; }
  void count(const InexactSet& what) noexcept;

  /// Counts `n` things that cannot be drawn at all; `singular` must outlive this object ("triangle").
  void skip(std::string_view singular, std::uint64_t n = 1) { skipped_[singular] += n; }

  /// "skipped 22 cylinders, 3 triangles", or "" where nothing was.
  std::string skipped() const;

  /// One line each: skipped() first, then what is drawn inexactly.
  std::vector<std::string> lines() const;

 private:
  std::array<std::uint64_t, kInexactCount> counts_{};
  std::map<std::string_view, std::uint64_t> skipped_;
};

}  // namespace tessera::io
