// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "render/color.h"
#include "render/vec3.h"

// Text in one growing buffer, for scenes of millions of spheres.
namespace tessera::io {

/// How a language writes three numbers: "<1.0, 2.0, 3.0>" or "1.0 2.0 3.0".
struct TripleStyle {
  std::string_view open;
  std::string_view separator;
  std::string_view close;
};

/// Numbers go in as the shortest decimals that read back as the same double, always with a point or an exponent.
class TextBuilder {
 public:
  explicit TextBuilder(const TripleStyle& style) : style_(style) {}

  TextBuilder& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  TextBuilder& operator<<(double value);
  TextBuilder& operator<<(std::uint64_t value);
  TextBuilder& operator<<(const render::Vec3& v) { return triple(v.x, v.y, v.z); }
  TextBuilder& operator<<(const render::Rgb& color) { return triple(color.r, color.g, color.b); }

  /// Changes the style of what follows.
  TextBuilder& operator<<(const TripleStyle& style) {
    style_ = style;
    return *this;
  }

  void reserve(std::size_t bytes) { text_.reserve(bytes); }
  std::string take() { return std::move(text_); }

 private:
  TextBuilder& triple(double a, double b, double c);

  TripleStyle style_;
  std::string text_;
};

}  // namespace tessera::io
