// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "render/scene_data.h"

// What the renderer refuses. Readers call these for each thing they read and put the place in front.
namespace tessera::render {

/// Longest side of a picture, in pixels.
inline constexpr std::uint32_t kMaxImageSide = 65536;
/// Most samples per pixel, a square.
inline constexpr std::uint32_t kMaxSamples = 65536;

/// Largest colour, weight or shininess: their products must be numbers.
inline constexpr double kLargestWeight = 1e30;

/// The reason why a thing cannot be rendered ("radius must be >= 0 (it is -1)"), or nullopt where it can.
std::optional<std::string> problem_with(const Material& material);
std::optional<std::string> problem_with(const Sphere& sphere);
std::optional<std::string> problem_with(const Plane& plane);
std::optional<std::string> problem_with(const Light& light);
std::optional<std::string> problem_with(const Camera& camera);
std::optional<std::string> problem_with(const Environment& environment);
std::optional<std::string> problem_with(const ImageSettings& image);

/// The scene as a whole: its lengths may not span more than kLargestSpan of scale.h.
std::optional<std::string> problem_with_span(const SceneData& scene);

}  // namespace tessera::render
