// SPDX-License-Identifier: BSD-3-Clause
#include "app/convert_command.h"

#include <cstdio>
#include <string>
#include <vector>

#include "app/framing.h"
#include "app/shared_names.h"
#include "io/output_file.h"
#include "io/scene_reader.h"
#include "io/scene_writer.h"

namespace tessera::app {
namespace {

io::SceneFormat format_of(const std::filesystem::path& output) {
  const auto format = io::scene_format_of(output);
  if (!format) {
    throw UsageError("-o: \"" + output.string() + "\" has no ending that we write, use " +
                     std::string(io::kSceneEndings));
  }
  return *format;
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) std::fprintf(stderr, "note: %s\n", note.c_str());
}

/// throws:  UsageError where the table would take the scene's place
void write_table(const std::string& text, const ConvertOptions& options) {
  const std::filesystem::path path = io::sphere_table_beside(options.output);
  refuse_shared_names({{"INPUT", options.input}, {"-o", options.output}, {"the table of its spheres", path}});
  io::OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace

ExitCode run_convert(const ConvertOptions& options) {
  const io::SceneFormat format = format_of(options.output);
  refuse_shared_names({{"INPUT", options.input}, {"-o", options.output}});
  io::OutputFile file(options.output);

  auto [scene, read_notes] = io::read_scene(options.input);
  if (format != io::SceneFormat::toml) require_camera(scene, options.input);
  const io::WrittenScene written = write_scene(format, scene, options.output);
  file.write(written.text);
  if (!written.sphere_table.empty()) write_table(written.sphere_table, options);
  file.commit();
  if (options.quiet) return ExitCode::success;
  print_notes(read_notes);
  print_notes(written.notes);
  return ExitCode::success;
}

}  // namespace tessera::app
