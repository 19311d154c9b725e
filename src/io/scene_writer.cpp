// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_writer.h"

#include <string>

#include "io/lower_case.h"
#include "io/pov_writer.h"
#include "io/tachyon_writer.h"
#include "io/toml_writer.h"

namespace tessera::io {

std::optional<SceneFormat> scene_format_of(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  if (ending == ".toml") return SceneFormat::toml;
  if (ending == ".pov") return SceneFormat::pov;
  if (ending == ".dat") return SceneFormat::tachyon;
  return std::nullopt;
}

std::filesystem::path sphere_table_beside(const std::filesystem::path& path) {
  std::filesystem::path table = path;
  return table.replace_extension(".spheres.txt");
}

WrittenScene write_scene(SceneFormat format, const render::SceneData& scene, const std::filesystem::path& path) {
  if (format == SceneFormat::toml) return write_toml(scene, sphere_table_beside(path.filename()).string());
  return format == SceneFormat::pov ? write_pov(scene) : write_tachyon(scene);
}

}  // namespace tessera::io
