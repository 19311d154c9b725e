// SPDX-License-Identifier: BSD-3-Clause
// Renders a scene of ours with Embree's spheres, on one thread: what scripts/compare_peers.py measures us against.
// Prints one JSON object: build_s is filling Embree's buffers and building its tree, render_s the pixel loop up to
// linear floats; neither holds reading, encoding or writing.
//   embree_render scenes/sphereflake.toml --mode packets -o flake.png
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "embree_paths.h"
#include "embree_scene.h"
#include "io/image_file.h"
#include "io/output_file.h"
#include "io/scene_reader.h"
#include "render/camera.h"
#include "render/check.h"
#include "render/encode.h"
#include "render/scale.h"

namespace {

using namespace tessera;

struct Options {
  std::filesystem::path input;
  std::string output;
  std::string resolution;
  embree::Mode mode = embree::Mode::packets;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The scene as the renderer traces it: at unit scale and with a camera.
render::SceneData read_scene(const Options& options) {
  render::SceneData scene = io::read_scene(options.input).scene;
  render::ImageSettings& image = scene.image;
  if (!options.resolution.empty() &&
      std::sscanf(options.resolution.c_str(), "%ux%u", &image.width, &image.height) != 2) {
    throw std::runtime_error("--resolution must be WxH");
  }
  if (const auto problem = problem_with(image)) throw std::runtime_error(*problem);
  scene = unit_scaled(std::move(scene));
  if (!scene.camera) scene.camera = framed_camera(bounds_of(scene), image.width, image.height);
  return scene;
}

void write_picture(const std::filesystem::path& path, const embree::Picture& picture,
                   const render::ImageSettings& settings) {
  const auto format = io::image_format_of(path);
  if (!format) throw std::runtime_error("-o must end in " + std::string(io::kImageEndings));
  render::Image image(settings.width, settings.height, io::pixel_format_for(*format, io::BitDepth::eight));
  std::byte* pixel = image.bytes.data();
  for (const auto& color : picture.pixels) {
    encode_pixel({color.x, color.y, color.z}, image.format, settings.transfer, pixel);
    pixel += bytes_per_pixel(image.format);
  }
  io::OutputFile file(path);
  file.write(io::encode_image(*format, image, settings.transfer, {}));
  file.commit();
}

void run(const Options& options) {
  const render::SceneData data = read_scene(options);
  const auto start_of_build = std::chrono::steady_clock::now();
  const embree::Scene scene = embree::build_scene(data);
  const double build_s = seconds_since(start_of_build);

  const render::ImageSettings& image = data.image;
  const render::CameraRays camera(*data.camera, image.width, image.height);
  const auto start_of_render = std::chrono::steady_clock::now();
  const embree::Picture picture = draw(scene, camera, image.width, image.height, options.mode);
  const double render_s = seconds_since(start_of_render);

  if (!options.output.empty()) write_picture(options.output, picture, image);
  const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf(
      "{\"build_s\": %.6f, \"render_s\": %.6f, \"rays\": {\"primary\": %llu, \"shadow\": %llu, \"mirror\": %llu}}\n",
      build_s, render_s, count(picture.rays.primary), count(picture.rays.shadow), count(picture.rays.mirror));
}

}  // namespace

int main(int argc, char** argv) {
  if (__builtin_cpu_supports("avx2") == 0 || __builtin_cpu_supports("fma") == 0) {
    std::fprintf(stderr, "embree_render: this processor has no AVX2 (the program is compiled for it)\n");
    return 1;
  }
  Options options;
  CLI::App app{"Renders a scene with Embree on one thread and prints the times as JSON"};
  app.add_option("INPUT", options.input, "a scene that tessera reads")->required();
  app.add_option("-o,--output", options.output, "where the picture goes (" + std::string(io::kImageEndings) + ")");
  app.add_option("-r,--resolution", options.resolution, "WxH instead of the scene's own");
  app.add_option("--mode", options.mode, "single or packets (default)")
      ->transform(CLI::Transformer(
          std::map<std::string, embree::Mode>{{"single", embree::Mode::single}, {"packets", embree::Mode::packets}}));
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "embree_render: %s\n", error.what());
    return 1;
  }
  return 0;
}
