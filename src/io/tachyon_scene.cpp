// SPDX-License-Identifier: BSD-3-Clause
#include "io/tachyon_scene.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/error.h"
#include "io/suggest.h"
#include "io/tachyon_camera.h"
#include "io/tachyon_materials.h"
#include "io/tachyon_notes.h"
#include "io/tachyon_skip.h"
#include "io/tachyon_tokens.h"
#include "render/check.h"

namespace tessera::io {
namespace {

class TachyonReader {
 public:
  ReadScene read(const std::filesystem::path& path);

 private:
  using Statement = void (TachyonReader::*)(TachyonTokens& in);
  static const std::pair<std::string_view, Statement> kStatements[];

  bool read_statements(TachyonTokens& in);
  void read_statement(std::string_view keyword, TachyonTokens& in);

  void read_sphere(TachyonTokens& in);
  void read_plane(TachyonTokens& in);
  void read_texture_definition(TachyonTokens& in) { materials_.read_definition(in, notes_); }
  void read_texture_alias(TachyonTokens& in) { materials_.read_alias(in); }
  void read_camera_block(TachyonTokens& in);
  void read_light(TachyonTokens& in);
  void read_spotlight(TachyonTokens& in);
  void read_directional_light(TachyonTokens& in);
  void read_sky_light(TachyonTokens& in);
  void read_background(TachyonTokens& in);
  void read_background_gradient(TachyonTokens& in);
  void read_fog(TachyonTokens& in);
  void read_shader_mode(TachyonTokens& in);
  void read_clip_group(TachyonTokens& in);
  void read_clip_group_end(TachyonTokens&) {}
  void read_include(TachyonTokens& in);

  render::Light read_place_of_light(TachyonTokens& in);
  void read_attenuation(TachyonTokens& in);
  void read_color_of_light(TachyonTokens& in, render::Light light);

  render::SceneData scene_;
  TachyonNotes notes_;
  std::vector<std::string> camera_notes_;
  TachyonMaterials materials_;
  int include_depth_ = 0;
};

constexpr int kDeepestInclude = 16;

// The most frequent first.
const std::pair<std::string_view, TachyonReader::Statement> TachyonReader::kStatements[] = {
    {"SPHERE", &TachyonReader::read_sphere},
    {"TEXDEF", &TachyonReader::read_texture_definition},
    {"PLANE", &TachyonReader::read_plane},
    {"TEXALIAS", &TachyonReader::read_texture_alias},
    {"LIGHT", &TachyonReader::read_light},
    {"DIRECTIONAL_LIGHT", &TachyonReader::read_directional_light},
    {"SPOTLIGHT", &TachyonReader::read_spotlight},
    {"SKY_LIGHT", &TachyonReader::read_sky_light},
    {"CAMERA", &TachyonReader::read_camera_block},
    {"BACKGROUND", &TachyonReader::read_background},
    {"BACKGROUND_GRADIENT", &TachyonReader::read_background_gradient},
    {"FOG", &TachyonReader::read_fog},
    {"SHADER_MODE", &TachyonReader::read_shader_mode},
    {"START_CLIPGROUP", &TachyonReader::read_clip_group},
    {"END_CLIPGROUP", &TachyonReader::read_clip_group_end},
    {"INCLUDE", &TachyonReader::read_include},
};

ReadScene TachyonReader::read(const std::filesystem::path& path) {
  TachyonTokens in(path);
  in.expect("BEGIN_SCENE");
  in.expect("RESOLUTION");
  const TachyonTokens::Mark mark = in.mark();
  const auto side = [&in] {
    return static_cast<std::uint32_t>(
        std::clamp<std::int64_t>(in.integer(), 0, std::numeric_limits<std::uint32_t>::max()));
  };
  scene_.image.width = side();
  scene_.image.height = side();
  scene_.image.transfer = render::Transfer::none;
  if (const auto problem = problem_with(scene_.image)) in.fail(mark, *problem);

  if (!read_statements(in)) in.fail("END_SCENE is missing (the file ends here) is the file complete?");
  if (scene_.spheres.empty() && scene_.planes.empty()) {
    const std::string skipped = notes_.skipped();
    throw Error(ErrorKind::bad_scene, path.string() + ": nothing to draw (no sphere and no plane" +
                                          (skipped.empty() ? ")" : "; " + skipped + ")"));
  }
  scene_.materials = materials_.take();
  std::vector<std::string> notes = notes_.lines();
  notes.insert(notes.end(), camera_notes_.begin(), camera_notes_.end());
  return {std::move(scene_), std::move(notes)};
}

// Whether END_SCENE was there; if not, the file ended.
bool TachyonReader::read_statements(TachyonTokens& in) {
  while (true) {
    const std::string_view keyword = in.next();
    if (keyword.empty()) return false;
    if (is_keyword(keyword, "END_SCENE")) return true;
    read_statement(keyword, in);
  }
}

void TachyonReader::read_statement(std::string_view keyword, TachyonTokens& in) {
  for (const auto& [name, statement] : kStatements) {
    if (is_keyword(keyword, name)) return (this->*statement)(in);
  }
  const TachyonTokens::Mark mark = in.mark();
  if (skip_shape(keyword, in, notes_)) return;

  std::string problem = "unknown keyword " + in_quotes(keyword);
  if (keyword.starts_with('#')) in.fail(mark, problem + " (a comment's # stands alone) put a blank after it");
  std::vector<std::string> known = shape_keywords();
  for (const auto& [name, statement] : kStatements) known.emplace_back(name);
  const std::string hint = did_you_mean(keyword, known);
  in.fail(mark, problem + (hint.empty() ? " (not a Tachyon statement)" : hint));
}

void TachyonReader::read_sphere(TachyonTokens& in) {
  render::Sphere sphere;
  in.expect("CENTER");
  sphere.center = in.vector();
  in.expect("RAD");
  sphere.radius = in.number();
  if (const auto problem = problem_with(sphere)) in.fail(*problem);
  sphere.material = materials_.read(in, notes_);
  scene_.spheres.push_back(sphere);
}

void TachyonReader::read_plane(TachyonTokens& in) {
  render::Plane plane;
  in.expect("CENTER");
  plane.point = in.vector();
  in.expect("NORMAL");
  const TachyonTokens::Mark mark = in.mark();
  plane.normal = in.vector();
  if (const auto problem = problem_with(plane)) in.fail(mark, *problem);
  plane.material = materials_.read(in, notes_);
  scene_.planes.push_back(plane);
}

void TachyonReader::read_camera_block(TachyonTokens& in) {
  TachyonCamera camera = read_camera(in, scene_.image);
  scene_.camera = camera.camera;
  scene_.image.max_bounces = camera.max_bounces;
  camera_notes_ = std::move(camera.notes);  // the last camera counts
}

render::Light TachyonReader::read_place_of_light(TachyonTokens& in) {
  in.expect("CENTER");
  const render::Light light{render::LightKind::point, in.vector(), {}};
  in.expect("RAD");
  if (in.number() > 0) notes_.count(Inexact::visible_light);
  return light;
}

void TachyonReader::read_attenuation(TachyonTokens& in) {
  if (!in.take("ATTENUATION")) return;
  read_past(in, "CONSTANT 1 LINEAR 1 QUADRATIC 1");
  notes_.count(Inexact::attenuated_light);
}

void TachyonReader::read_color_of_light(TachyonTokens& in, render::Light light) {
  in.expect("COLOR");
  const TachyonTokens::Mark mark = in.mark();
  light.color = in.color();
  if (const auto problem = problem_with(light)) in.fail(mark, *problem);
  scene_.lights.push_back(light);
}

void TachyonReader::read_light(TachyonTokens& in) {
  const render::Light light = read_place_of_light(in);
  read_attenuation(in);
  read_color_of_light(in, light);
}

void TachyonReader::read_spotlight(TachyonTokens& in) {
  const render::Light light = read_place_of_light(in);
  read_past(in, "DIRECTION 3 FALLOFF_START 1 FALLOFF_END 1");
  notes_.count(Inexact::spotlight);
  read_attenuation(in);
  read_color_of_light(in, light);
}

void TachyonReader::read_directional_light(TachyonTokens& in) {
  in.expect("DIRECTION");
  const TachyonTokens::Mark mark = in.mark();
  const render::Light light{render::LightKind::directional, in.vector(), {}};
  if (const auto problem = problem_with(light)) in.fail(mark, *problem);
  read_color_of_light(in, light);
}

void TachyonReader::read_sky_light(TachyonTokens& in) {
  read_past(in, "NUMSAMPLES 1 COLOR 3");
  notes_.count(Inexact::sky_light);
}

void TachyonReader::read_background(TachyonTokens& in) {
  const TachyonTokens::Mark mark = in.mark();
  scene_.environment.background = in.color();
  if (const auto problem = problem_with(scene_.environment)) in.fail(mark, *problem);
}

void TachyonReader::read_background_gradient(TachyonTokens& in) {
  read_past(in, "word UPDIR 3 TOPVAL 1 BOTTOMVAL 1 TOPCOLOR 3 BOTTOMCOLOR 3");
  notes_.count(Inexact::background_gradient);
}

void TachyonReader::read_fog(TachyonTokens& in) {
  if (!is_keyword(in.word("a kind of fog"), "OFF")) notes_.count(Inexact::fog);
  read_past(in, "START 1 END 1 DENSITY 1 COLOR 3");
}

void TachyonReader::read_shader_mode(TachyonTokens& in) {
  if (!is_keyword(in.word("a shader mode"), "FULL")) notes_.count(Inexact::lower_shader_mode);
  // The switches inside are about transparency and ambient occlusion, none of which is ours
  while (!in.take("END_SHADER_MODE")) {
    if (is_keyword(in.word("END_SHADER_MODE"), "AMBIENT_OCCLUSION")) notes_.count(Inexact::ambient_occlusion);
  }
}

void TachyonReader::read_clip_group(TachyonTokens& in) {
  read_past(in, "NUMPLANES n*4");
  notes_.count(Inexact::clip_group);
}

void TachyonReader::read_include(TachyonTokens& in) {
  const std::filesystem::path name = in.word("a file's name");
  const std::string place = text_of(in.place_of(in.mark()));
  if (include_depth_ == kDeepestInclude) {
    throw Error(ErrorKind::bad_scene, place + "INCLUDEs are nested too deep (more than " +
                                          std::to_string(kDeepestInclude) + ") does a file include itself?");
  }
  ++include_depth_;
  try {
    TachyonTokens included(in.path().parent_path() / name);
    read_statements(included);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::bad_scene) throw;
    throw Error(error.kind(), place + "cannot INCLUDE a file (" + error.what() + ")");
  }
  --include_depth_;
}

}  // namespace

ReadScene read_tachyon(const std::filesystem::path& path) {
  return TachyonReader().read(path);
}

}  // namespace tessera::io
