// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_texture.h"

#include <algorithm>

#include "render/check.h"

namespace tessera::io {
namespace {

// What stands between AMBIENT and COLOR: the weights as Tachyon means them.
TachyonTexture read_weights(TachyonTokens& in) {
  TachyonTexture texture;
  render::Material& material = texture.material;
  const auto note = [&texture](Inexact what) { texture.inexact.set(static_cast<std::size_t>(what)); };

  material.ambient = in.number();
  in.expect("DIFFUSE");
  material.diffuse = in.number();
  in.expect("SPECULAR");
  material.reflection = in.number();
  in.expect("OPACITY");
  if (in.number() < 1) note(Inexact::opacity);
  if (in.take("TRANSMODE")) in.word("a transparency mode");
  if (in.take("OUTLINE")) {
    if (in.number() > 0) note(Inexact::outline);
    in.expect("OUTLINE_WIDTH");
    in.number();
  }
  if (in.take("PHONG")) {
    const std::string_view kind = in.word("METAL or PLASTIC");
    const bool is_metal = is_keyword(kind, "METAL");
    if (!is_metal && !is_keyword(kind, "PLASTIC")) in.fail("expected METAL or PLASTIC (found " + in_quotes(kind) + ")");
    material.specular = in.number();
    if (is_metal && material.specular > 0) note(Inexact::metal);
    in.expect("PHONG_SIZE");
    material.shininess = in.number();
  }
  return texture;
}

// From an added mirror to a mixed one.
void divide_local_weights(TachyonTexture& texture) {
  render::Material& material = texture.material;
  const double k = std::clamp(material.reflection, 0.0, 1.0);
  if (k != material.reflection) texture.inexact.set(static_cast<std::size_t>(Inexact::specular_out_of_range));
  material.reflection = k;
  if (k < 1) {
    material.ambient /= 1 - k;
    material.diffuse /= 1 - k;
    material.specular /= 1 - k;
  } else if (material.ambient > 0 || material.diffuse > 0 || material.specular > 0) {
    texture.inexact.set(static_cast<std::size_t>(Inexact::local_terms_lost));
  }
}

// TEXFUNC n and what belongs to it: 1-6 are patterns in space, 7-10 picture files.
bool read_texfunc(TachyonTokens& in) {
  in.expect("TEXFUNC");
  const std::int64_t function = in.integer();
  if (function < 1 || function > 10) return function != 0;
  if (function >= 7) in.word("a picture file");
  const int vectors = function <= 8 ? 3 : static_cast<int>(function) - 4;
  constexpr std::string_view kVectors[] = {"CENTER", "ROTATE", "SCALE", "UAXIS", "VAXIS", "WAXIS"};
  for (int i = 0; i < vectors; ++i) {
    in.expect(kVectors[i]);
    in.vector();
  }
  return true;
}

}  // namespace

TachyonTexture read_texture_body(TachyonTokens& in) {
  in.expect("AMBIENT");
  const TachyonTokens::Mark mark = in.mark();
  TachyonTexture texture = read_weights(in);
  in.expect("COLOR");
  texture.material.color = in.color();
  if (read_texfunc(in)) texture.inexact.set(static_cast<std::size_t>(Inexact::texfunc));

  divide_local_weights(texture);
  if (const auto problem = problem_with(texture.material)) in.fail(mark, *problem);
  return texture;
}

void skip_vertex_color_body(TachyonTokens& in) {
  in.expect("AMBIENT");
  read_weights(in);
  in.expect("VCST");
}

}  // namespace tessera::io
