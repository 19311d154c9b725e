// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/tachyon_notes.h"
#include "io/tachyon_tokens.h"
#include "render/scene_data.h"

// A Tachyon texture is a material. Tachyon adds the mirror (local + k mirrored), we mix it ((1 - k) local + k
// mirrored): so the local weights are divided by 1 - k.
namespace tessera::io {

struct TachyonTexture {
  render::Material material;
  InexactSet inexact;  ///< what of it we draw in another way
};

/// Reads `AMBIENT f DIFFUSE f SPECULAR f OPACITY f … COLOR c TEXFUNC n …`, what follows TEXTURE or TEXDEF name.
/// throws:  Error(bad_scene), also for weights that cannot be drawn
TachyonTexture read_texture_body(TachyonTokens& in);

/// Reads the body of a vertex-coloured triangle, which ends in VCST where the others have COLOR.
/// throws:  Error(bad_scene)
void skip_vertex_color_body(TachyonTokens& in);

}  // namespace tessera::io
