// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_reader.h"

#include <map>
#include <system_error>
#include <utility>

#include "io/default_lights.h"
#include "io/error.h"
#include "io/lower_case.h"
#include "io/place.h"
#include "io/sphere_table.h"
#include "io/suggest.h"
#include "io/tachyon_scene.h"
#include "io/toml_scene.h"
#include "render/camera.h"

namespace tessera::io {
namespace {

/// A table alone: no camera, so that the renderer frames it, and light to go with that.
ReadScene read_table_scene(const std::filesystem::path& path) {
  MaterialSet materials;
  auto [spheres, notes] = read_sphere_table(path, {}, materials);
  ReadScene read;
  read.scene.spheres = std::move(spheres);
  read.scene.materials = materials.take();
  read.scene.lights = default_lights(-render::kDefaultEyeDirection);
  read.notes = std::move(notes);
  return read;
}

using Reader = ReadScene (*)(const std::filesystem::path&);

const std::map<std::string, Reader> kReaders{{".toml", read_toml_scene},
                                             {".dat", read_tachyon},
                                             {".txt", read_table_scene},
                                             {".csv", read_table_scene},
                                             {".bin", read_table_scene}};

[[noreturn]] void refuse_ending(const std::filesystem::path& path, const std::string& ending) {
  std::vector<std::string> known;
  std::string list;
  for (const auto& [name, reader] : kReaders) {
    known.push_back(name);
    list += " " + name;
  }
  throw Error(ErrorKind::bad_scene, path.string() + ": unknown ending " + in_quotes(ending) + " (known:" + list + ")" +
                                        did_you_mean(ending, known));
}

}  // namespace

ReadScene read_scene(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw Error(ErrorKind::input_missing, path.string() + ": no such file");
  }
  if (std::filesystem::is_directory(status)) {
    throw Error(ErrorKind::input_missing, path.string() + ": it is a directory, not a scene file");
  }

  const std::string ending = path.extension().string();
  const auto reader = kReaders.find(lower_case(ending));
  if (reader == kReaders.end()) refuse_ending(path, ending);
  return reader->second(path);
}

}  // namespace tessera::io
