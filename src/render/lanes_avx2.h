// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "render/target_avx2.h"

#if defined(__x86_64__)
#include <immintrin.h>

// Eight lanes of float in one AVX2 register: the only place with intrinsics.
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {

/// One bit a lane, lane 0 lowest.
using LaneMask = std::uint32_t;

struct Float8 {
  __m256 v;

  static Float8 load(const float* p) noexcept { return {_mm256_load_ps(p)}; }
  static Float8 all(float x) noexcept { return {_mm256_set1_ps(x)}; }
};

inline Float8 operator+(Float8 a, Float8 b) noexcept {
  return {_mm256_add_ps(a.v, b.v)};
}
inline Float8 operator-(Float8 a, Float8 b) noexcept {
  return {_mm256_sub_ps(a.v, b.v)};
}
inline Float8 operator*(Float8 a, Float8 b) noexcept {
  return {_mm256_mul_ps(a.v, b.v)};
}
inline LaneMask operator<=(Float8 a, Float8 b) noexcept {
  return static_cast<LaneMask>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}
inline Float8 min(Float8 a, Float8 b) noexcept {
  return {_mm256_min_ps(a.v, b.v)};
}
inline Float8 max(Float8 a, Float8 b) noexcept {
  return {_mm256_max_ps(a.v, b.v)};
}
/// a b + c, rounded once.
inline Float8 fused(Float8 a, Float8 b, Float8 c) noexcept {
  return {_mm256_fmadd_ps(a.v, b.v, c.v)};
}
/// c - a b, rounded once.
inline Float8 fused_minus(Float8 a, Float8 b, Float8 c) noexcept {
  return {_mm256_fnmadd_ps(a.v, b.v, c.v)};
}

struct Int8 {
  __m256i v;

  static Int8 load(const void* p) noexcept { return {_mm256_load_si256(static_cast<const __m256i*>(p))}; }
  void store(void* p) const noexcept { _mm256_storeu_si256(static_cast<__m256i*>(p), v); }
  Int8 picked(Int8 lanes) const noexcept { return {_mm256_permutevar8x32_epi32(v, lanes.v)}; }
};

inline LaneMask lanes_equal(Int8 a, std::uint32_t b) noexcept {
  const __m256i equal = _mm256_cmpeq_epi32(a.v, _mm256_set1_epi32(static_cast<int>(b)));
  return static_cast<LaneMask>(_mm256_movemask_ps(_mm256_castsi256_ps(equal)));
}

/// The lanes of a mask one after the other, by mask.
inline constexpr auto kLanesOfMask = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (std::size_t mask = 0; mask != table.size(); ++mask) {
    std::size_t size = 0;
    for (std::uint8_t lane = 0; lane != 8; ++lane) {
      if ((mask >> lane & 1) != 0) table[mask][size++] = lane;
    }
  }
  return table;
}();

/// The lanes of a mask, ascending.
inline Int8 lanes_of(LaneMask mask) noexcept {
  std::int64_t bytes = 0;
  std::memcpy(&bytes, kLanesOfMask[mask].data(), sizeof bytes);
  return {_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(bytes))};
}

/// One step of a sorting network: of each pair of lanes the lower one takes the larger number.
template <int LowerTakesSmaller>
__m256i exchanged(__m256i a, __m256i partner) noexcept {
  return _mm256_blend_epi32(_mm256_max_epi32(a, partner), _mm256_min_epi32(a, partner), LowerTakesSmaller);
}

/// The lanes of a mask by their numbers >= 0, the largest first. The numbers' last three bits are lost: they hold the
/// lane.
/// source:  Batcher, Sorting networks and their applications (1968)
inline Int8 lanes_descending(Float8 numbers, LaneMask mask) noexcept {
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  // Numbers >= 0 are in the order of their bits; lanes that are out are below them all.
  __m256i key = _mm256_or_si256(_mm256_andnot_si256(_mm256_set1_epi32(7), _mm256_castps_si256(numbers.v)), lane);
  const __m256i in = _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(mask)), bit), bit);
  key = _mm256_or_si256(key, _mm256_andnot_si256(in, _mm256_set1_epi32(-1)));
  key = exchanged<0xAA>(key, _mm256_shuffle_epi32(key, 0xB1));
  key = exchanged<0xCC>(key, _mm256_shuffle_epi32(key, 0x1B));
  key = exchanged<0xAA>(key, _mm256_shuffle_epi32(key, 0xB1));
  key = exchanged<0xF0>(key, _mm256_permutevar8x32_epi32(key, _mm256_setr_epi32(7, 6, 5, 4, 3, 2, 1, 0)));
  key = exchanged<0xCC>(key, _mm256_shuffle_epi32(key, 0x4E));
  key = exchanged<0xAA>(key, _mm256_shuffle_epi32(key, 0xB1));
  return {key};
}

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#endif
