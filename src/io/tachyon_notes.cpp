// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_notes.h"

#include <utility>

namespace tessera::io {
namespace {

struct Phrase {
  std::string_view what_we_do;
  std::string_view one;
  std::string_view many;
};

// In the order of Inexact.
constexpr std::array<Phrase, kInexactCount> kPhrases{{
    {"not drawn themselves, they still shine", "light with RAD > 0", "lights with RAD > 0"},
    {"shining without fall-off", "light with ATTENUATION", "lights with ATTENUATION"},
    {"shining to all sides", "spotlight", "spotlights"},
    {"ignored", "sky light", "sky lights"},
    {"ignored, direct light not rescaled", "AMBIENT_OCCLUSION block", "AMBIENT_OCCLUSION blocks"},
    {"drawn with full shading", "SHADER_MODE below FULL", "SHADER_MODEs below FULL"},
    {"drawn as opaque", "texture with OPACITY < 1", "textures with OPACITY < 1"},
    {"drawn in the plain COLOR", "texture with TEXFUNC > 0", "textures with TEXFUNC > 0"},
    {"drawn as PLASTIC", "texture with PHONG METAL", "textures with PHONG METAL"},
    {"drawn without outline", "texture with OUTLINE", "textures with OUTLINE"},
    {"clamped to 0 ... 1", "SPECULAR", "SPECULARs"},
    {"drawn as a pure mirror, without AMBIENT, DIFFUSE and PHONG", "texture with SPECULAR 1",
     "textures with SPECULAR 1"},
    {"ignored", "FOG", "FOGs"},
    {"drawn as the plain BACKGROUND", "BACKGROUND_GRADIENT", "BACKGROUND_GRADIENTs"},
    {"drawn unclipped", "clip group", "clip groups"},
}};

std::string counted(std::uint64_t n, std::string_view one, std::string_view many) {
  return std::to_string(n) + " " + std::string(n == 1 ? one : many);
}

}  // namespace

void TachyonNotes::count(const InexactSet& what) noexcept {
  for (std::size_t i = 0; i < kInexactCount; ++i) counts_[i] += what[i];
}

std::string TachyonNotes::skipped() const {
  std::string line;
  for (const auto& [singular, n] : skipped_) {
    const std::string plural = std::string(singular) + (singular.ends_with('x') ? "es" : "s");
    line += (line.empty() ? "skipped " : ", ") + counted(n, singular, plural);
  }
  return line;
}

std::vector<std::string> TachyonNotes::lines() const {
  std::vector<std::string> lines;
  if (std::string line = skipped(); !line.empty()) lines.push_back(std::move(line));
  for (std::size_t i = 0; i < kInexactCount; ++i) {
    const Phrase& phrase = kPhrases[i];
    if (counts_[i])
      lines.push_back(std::string(phrase.what_we_do) + ": " + counted(counts_[i], phrase.one, phrase.many));
  }
  return lines;
}

}  // namespace tessera::io
