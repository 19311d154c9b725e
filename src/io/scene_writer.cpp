// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_writer.h"

#include <string>

#include "io/lower_case.h"
#include "io/pov_writer.h"
#include "io/tachyon_writer.h"

namespace tessera::io {

std::optional<SceneFormat> scene_format_of(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  if (ending == ".pov") return SceneFormat::pov;
  if (ending == ".dat") return SceneFormat::tachyon;
  return std::nullopt;
}

WrittenScene write_scene(SceneFormat format, const render::SceneData& scene) {
  return format == SceneFormat::pov ? write_pov(scene) : write_tachyon(scene);
}

}  // namespace tessera::io
