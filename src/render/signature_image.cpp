// SPDX-License-Identifier: BSD-3-Clause
#include "render/signature_image.h"

namespace tessera::render {

SignatureDifference difference_between(const SignatureImage& a, const SignatureImage& b) {
  SignatureDifference difference;
  for (std::size_t i = 0; i != a.pixels.size(); ++i) {
    const Signature& left = a.pixels[i];
    const Signature& right = b.pixels[i];
    const bool same_surfaces = left.surfaces == right.surfaces && left.hits == right.hits;
    difference.first += left.first != right.first;
    difference.surfaces += !same_surfaces;
    difference.lights += same_surfaces && left.lights != right.lights;
  }
  return difference;
}

}  // namespace tessera::render
