// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "render/target_avx2.h"
#include "render/vec3_lanes.h"

#if defined(__x86_64__)
#include <immintrin.h>

// Eight lanes of float in one AVX2 register: the only place with intrinsics.
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {

/// One bit a lane, lane 0 lowest.
using LaneMask = std::uint32_t;

/// Has memory brought near: a leaf's first lines, the next follow by themselves.
inline void prefetch(const void* p) noexcept {
  const char* line = static_cast<const char*>(p);
  for (int i = 0; i != 3; ++i) _mm_prefetch(line + 64 * i, _MM_HINT_T0);
}

struct Float8 {
  __m256 v;

  static Float8 load(const float* p) noexcept { return {_mm256_load_ps(p)}; }
  static Float8 all(float x) noexcept { return {_mm256_set1_ps(x)}; }
  Float8 size() const noexcept { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0F), v)}; }
  void store(float* p) const noexcept { _mm256_storeu_ps(p, v); }
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
inline Float8 operator/(Float8 a, Float8 b) noexcept {
  return {_mm256_div_ps(a.v, b.v)};
}
inline LaneMask operator<=(Float8 a, Float8 b) noexcept {
  return static_cast<LaneMask>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}
/// Bits of the lanes that are negative, -0 too.
inline LaneMask negative_lanes(Float8 a) noexcept {
  return static_cast<LaneMask>(_mm256_movemask_ps(a.v));
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

inline Float8 sqrt(Float8 a) noexcept {
  return {_mm256_sqrt_ps(a.v)};
}
inline Float8 floor(Float8 a) noexcept {
  return {_mm256_floor_ps(a.v)};
}
inline Float8 ceil(Float8 a) noexcept {
  return {_mm256_ceil_ps(a.v)};
}
/// c where a < b, else d.
inline Float8 where_less(Float8 a, Float8 b, Float8 c, Float8 d) noexcept {
  return {_mm256_blendv_ps(d.v, c.v, _mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ))};
}

struct Int8 {
  __m256i v;

  static Int8 load(const void* p) noexcept { return {_mm256_load_si256(static_cast<const __m256i*>(p))}; }
  static Int8 all(std::uint32_t x) noexcept { return {_mm256_set1_epi32(static_cast<int>(x))}; }
  /// Of whole numbers.
  static Int8 of(Float8 a) noexcept { return {_mm256_cvttps_epi32(a.v)}; }
  void store(void* p) const noexcept { _mm256_storeu_si256(static_cast<__m256i*>(p), v); }
};

inline Int8 picked(Int8 a, Int8 lanes) noexcept {
  return {_mm256_permutevar8x32_epi32(a.v, lanes.v)};
}
inline Float8 picked(Float8 a, Int8 lanes) noexcept {
  return {_mm256_permutevar8x32_ps(a.v, lanes.v)};
}
/// c where a < b, else d.
inline Int8 where_less(Float8 a, Float8 b, Int8 c, Int8 d) noexcept {
  const __m256 less = _mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ);
  return {_mm256_castps_si256(_mm256_blendv_ps(_mm256_castsi256_ps(d.v), _mm256_castsi256_ps(c.v), less))};
}
inline LaneMask lanes_equal(Int8 a, std::uint32_t b) noexcept {
  const __m256i equal = _mm256_cmpeq_epi32(a.v, _mm256_set1_epi32(static_cast<int>(b)));
  return static_cast<LaneMask>(_mm256_movemask_ps(_mm256_castsi256_ps(equal)));
}

/// Eight small numbers in one word, the first in its lowest byte.
using PackedLanes = std::uint64_t;

/// By octant and mask: the lanes of the mask, in ascending order of lane ^ octant.
inline constexpr auto kLanesInOrder = [] {
  std::array<std::array<PackedLanes, 256>, 8> table{};
  for (std::size_t octant = 0; octant != 8; ++octant) {
    for (std::size_t mask = 0; mask != 256; ++mask) {
      int size = 0;
      for (std::size_t j = 0; j != 8; ++j) {
        const std::size_t lane = j ^ octant;
        if ((mask >> lane & 1) != 0) table[octant][mask] |= static_cast<PackedLanes>(lane) << (8 * size++);
      }
    }
  }
  return table;
}();

/// The lanes of a mask in ascending order of lane ^ octant; zeros behind them.
inline Int8 lanes_in_order(LaneMask mask, unsigned octant) noexcept {
  const auto packed = static_cast<std::int64_t>(kLanesInOrder[octant][mask]);
  return {_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(packed))};
}

/// Four lanes of double: x, y, z and one to spare, or one quantity of four rays.
struct Double4 {
  __m256d v;

  static Double4 load(const double* p) noexcept { return {_mm256_loadu_pd(p)}; }
  static Double4 load(const Lanes& a) noexcept { return load(a.at); }
  static Double4 all(double x) noexcept { return {_mm256_set1_pd(x)}; }
  static Double4 of(double a, double b, double c, double d) noexcept { return {_mm256_setr_pd(a, b, c, d)}; }
  static Double4 of(const Vec3& p) noexcept { return of(p.x, p.y, p.z, 1); }
  Double4 size() const noexcept { return {_mm256_andnot_pd(_mm256_set1_pd(-0.0), v)}; }
  void store(Lanes& a) const noexcept { _mm256_storeu_pd(a.at, v); }
  /// Rounds to nearest and writes four.
  void store(float* p) const noexcept { _mm_storeu_ps(p, _mm256_cvtpd_ps(v)); }
};

inline Double4 operator+(Double4 a, Double4 b) noexcept {
  return {_mm256_add_pd(a.v, b.v)};
}
inline Double4 operator-(Double4 a, Double4 b) noexcept {
  return {_mm256_sub_pd(a.v, b.v)};
}
inline Double4 operator*(Double4 a, Double4 b) noexcept {
  return {_mm256_mul_pd(a.v, b.v)};
}
inline Double4 operator/(Double4 a, Double4 b) noexcept {
  return {_mm256_div_pd(a.v, b.v)};
}
inline Double4 operator-(Double4 a) noexcept {
  return {_mm256_xor_pd(a.v, _mm256_set1_pd(-0.0))};
}
inline Double4 sqrt(Double4 a) noexcept {
  return {_mm256_sqrt_pd(a.v)};
}
/// As std::min(a, b) and std::max(a, b), of 0 and -0 too.
inline Double4 min(Double4 a, Double4 b) noexcept {
  return {_mm256_min_pd(b.v, a.v)};
}
inline Double4 max(Double4 a, Double4 b) noexcept {
  return {_mm256_max_pd(b.v, a.v)};
}
/// a b - c, rounded once.
inline Double4 fused_less(Double4 a, Double4 b, Double4 c) noexcept {
  return {_mm256_fmsub_pd(a.v, b.v, c.v)};
}
/// c - a b, rounded once.
inline Double4 fused_minus(Double4 a, Double4 b, Double4 c) noexcept {
  return {_mm256_fnmadd_pd(a.v, b.v, c.v)};
}

/// Lanes of Double4 for which something holds: by their sign bits.
struct Mask4 {
  __m256d v;

  LaneMask bits() const noexcept { return static_cast<LaneMask>(_mm256_movemask_pd(v)); }
};

inline Mask4 operator<(Double4 a, Double4 b) noexcept {
  return {_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ)};
}
inline Mask4 operator&(Mask4 a, Mask4 b) noexcept {
  return {_mm256_and_pd(a.v, b.v)};
}
inline Mask4 operator|(Mask4 a, Mask4 b) noexcept {
  return {_mm256_or_pd(a.v, b.v)};
}
inline Mask4 operator!(Mask4 a) noexcept {
  return {_mm256_xor_pd(a.v, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)))};
}
/// a in the lanes of `mask`, else b.
inline Double4 where(Mask4 mask, Double4 a, Double4 b) noexcept {
  return {_mm256_blendv_pd(b.v, a.v, mask.v)};
}
/// Whether numbers >= 0 are whole, and small enough for Whole4.
inline Mask4 are_small_wholes(Double4 a) noexcept {
  return Mask4{_mm256_cmp_pd(_mm256_floor_pd(a.v), a.v, _CMP_EQ_OQ)} & (a < Double4::all(0x1p31));
}

/// Four whole numbers >= 0.
struct Whole4 {
  __m256i v;

  static Whole4 of(Double4 a) noexcept { return {_mm256_cvtepi32_epi64(_mm256_cvttpd_epi32(a.v))}; }
};

inline bool any(Whole4 a) noexcept {
  return _mm256_testz_si256(a.v, a.v) == 0;
}
inline Mask4 are_odd(Whole4 a) noexcept {
  return {_mm256_castsi256_pd(_mm256_slli_epi64(a.v, 63))};
}
inline Whole4 halved(Whole4 a) noexcept {
  return {_mm256_srli_epi64(a.v, 1)};
}

inline Double4 clamp(Double4 a, double farthest) noexcept {
  return {_mm256_max_pd(_mm256_set1_pd(-farthest), _mm256_min_pd(a.v, _mm256_set1_pd(farthest)))};
}
/// a where `chooser` is negative, -0 too, else b.
inline Double4 where_negative(Double4 chooser, Double4 a, Double4 b) noexcept {
  return {_mm256_blendv_pd(b.v, a.v, chooser.v)};
}
/// Bits of the lanes that are negative, -0 too.
inline LaneMask negative_lanes(Double4 a) noexcept {
  return static_cast<LaneMask>(_mm256_movemask_pd(a.v));
}

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#endif
