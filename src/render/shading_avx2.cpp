// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "render/shading.h"
#include "render/vec3_avx2.h"

#if defined(__x86_64__)
TESSERA_BEGIN_AVX2
namespace tessera::render::avx2 {
namespace {

static_assert(kLanes == 4);

/// Calls visit(lane) for every lane of a mask.
template <class Visit>
void visit_lanes(LaneMask mask, Visit&& visit) noexcept {
  for (std::size_t lane = 0; mask != 0; mask >>= 1, ++lane) {
    if ((mask & 1) != 0) visit(lane);
  }
}

/// Those of group number i that are vertices.
LaneMask lanes_in_use(const Vertices& vertices, std::size_t i) noexcept {
  return (LaneMask{1} << std::min<std::size_t>(vertices.size() - i * kLanes, kLanes)) - 1;
}

struct Rgb4 {
  Double4 r;
  Double4 g;
  Double4 b;
};

/// A vector of length 1, or 0 in lanes where it is not plain: there lengths have to be scaled.
struct Normalized4 {
  Vec3x4 unit;
  Mask4 is_plain;
};
Normalized4 normalized(const Vec3x4& a) noexcept {
  const Double4 squared = dot(a, a);
  const Mask4 is_plain = are_squarable(squared);
  return {a / where(is_plain, sqrt(squared), Double4::all(std::numeric_limits<double>::infinity())), is_plain};
}

/// By squaring, as power.cpp has it.
Double4 whole_power(Double4 base, Whole4 exponent) noexcept {
  Double4 result = Double4::all(1);
  for (Double4 square = base; any(exponent); exponent = halved(exponent), square = square * square) {
    result = where(are_odd(exponent), result * square, result);
  }
  return result;
}

/// What a light adds, and in which lanes that holds.
struct Reflected4 {
  Rgb4 light;
  Mask4 is_plain;
};

/// As reflected_light of phong.h, four at a time.
template <Shade shade>
Reflected4 reflected_light(const VertexLanes& vertices, const Rgb& intensity, const Vec3x4& normal,
                           const Normalized4& to_light) noexcept {
  const Double4 zero = Double4::all(0);
  const Double4 n_l = dot(normal, to_light.unit);
  const Double4 weight = Double4::load(vertices.diffuse) * n_l;
  const Vec3x4 color = Vec3x4::load(vertices.color);
  Rgb4 sum{color.x * weight, color.y * weight, color.z * weight};
  Mask4 is_plain = to_light.is_plain;

  const Double4 specular = Double4::load(vertices.specular);
  const Mask4 is_lit = zero < n_l;
  const Mask4 is_glossy = is_lit & (zero < specular);
  if (is_glossy.bits() != 0) {
    const Vec3x4 to_viewer = Vec3x4::load(vertices.to_viewer);
    Double4 cosine;
    if constexpr (shade == Shade::phong) {
      cosine = Double4::all(2) * n_l * dot(normal, to_viewer) - dot(to_light.unit, to_viewer);
    } else {
      const Normalized4 half = normalized(to_light.unit + to_viewer);
      cosine = dot(normal, half.unit);
      is_plain = is_plain & (half.is_plain | !is_glossy);
    }
    const Mask4 gleams = is_glossy & (zero < cosine);
    const Double4 base = where(gleams, min(cosine, Double4::all(1)), Double4::all(1));
    const Double4 shininess = Double4::load(vertices.shininess);
    const Mask4 is_whole = are_small_wholes(shininess);
    is_plain = is_plain & (is_whole | !gleams);
    const Double4 highlight = specular * whole_power(base, Whole4::of(where(is_whole & gleams, shininess, zero)));
    sum.r = where(gleams, sum.r + highlight, sum.r);
    sum.g = where(gleams, sum.g + highlight, sum.g);
    sum.b = where(gleams, sum.b + highlight, sum.b);
  }
  const auto lit = [&](double of_light, Double4 of_surface) {
    return where(is_lit, Double4::all(of_light) * of_surface, zero);
  };
  return {{lit(intensity.r, sum.r), lit(intensity.g, sum.g), lit(intensity.b, sum.b)}, is_plain};
}

template <Shade shade>
void light_up(const Light& light, const Vertices& vertices, std::span<LightLanes> shares) noexcept {
  const Double4 zero = Double4::all(0);
  const Vec3x4 position = Vec3x4::all(light.vector);
  for (std::size_t i = 0; i != shares.size(); ++i) {
    const VertexLanes& at = vertices.lanes()[i];
    LightLanes& to = shares[i];
    const Vec3x4 normal = Vec3x4::load(at.normal);
    const Vec3x4 way = light.kind == LightKind::point ? position - Vec3x4::load(at.point) : -position;
    const Mask4 shows = (zero < Double4::load(at.diffuse)) | (zero < Double4::load(at.specular));
    const LaneMask shines = (shows & (zero < dot(normal, way))).bits() & lanes_in_use(vertices, i);
    for (unsigned lane = 0; lane != kLanes; ++lane) to.shines[lane] = shines >> lane & 1;
    if (shines == 0) continue;
    const auto [share, is_plain] = reflected_light<shade>(at, light.color, normal, normalized(way));
    way.store(to.way);
    Vec3x4{share.r, share.g, share.b}.store(to.share);
    visit_lanes(shines & ~is_plain.bits(), [&](std::size_t lane) { render::light_up(light, shade, at, lane, to); });
  }
}

}  // namespace

[[gnu::flatten]] void turn_to_viewers(Vertices& vertices) noexcept {
  for (std::size_t i = 0; i != vertices.lanes().size(); ++i) {
    VertexLanes& at = vertices.lanes()[i];
    const auto [unit, is_plain] = normalized(-Vec3x4::load(at.to_viewer));
    visit_lanes(~is_plain.bits() & lanes_in_use(vertices, i), [&](std::size_t lane) { turn_to_viewer(at, lane); });
    where(is_plain, unit, Vec3x4::load(at.to_viewer)).store(at.to_viewer);
  }
}

[[gnu::flatten]] void light_up(const Light& light, Shade shade, const Vertices& vertices,
                               std::span<LightLanes> shares) noexcept {
  return shade == Shade::phong ? light_up<Shade::phong>(light, vertices, shares)
                               : light_up<Shade::blinn>(light, vertices, shares);
}

}  // namespace tessera::render::avx2
TESSERA_END_AVX2
#else

namespace tessera::render::avx2 {

// Never called: no such kernel is supported here.
void turn_to_viewers(Vertices&) noexcept {}
void light_up(const Light&, Shade, const Vertices&, std::span<LightLanes>) noexcept {}

}  // namespace tessera::render::avx2
#endif
