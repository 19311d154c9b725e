// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/signature.h"

namespace tessera::render {

/// The signatures of a picture's pixels.
/// shapes:  pixels holds height rows of width, top row first
struct SignatureImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Signature> pixels;
};

/// Pixels of two renders that decided something else.
struct SignatureDifference {
  std::size_t first = 0;     ///< met another surface first
  std::size_t surfaces = 0;  ///< met other surfaces somewhere on their way, first or later
  std::size_t lights = 0;    ///< met the same surfaces, but other lights reached them
};

/// requires: equal sizes
SignatureDifference difference_between(const SignatureImage& a, const SignatureImage& b);

}  // namespace tessera::render
