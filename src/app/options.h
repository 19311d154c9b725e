// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "render/image.h"
#include "render/scene.h"
#include "render/scene_data.h"
#include "render/tile_renderer.h"
#include "scheduler/plan.h"

// What the command line says, as data.
namespace tessera::app {

struct Size {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

enum class ProgressStyle : std::uint8_t { automatic, bar, plain, none };

/// Whatever a scene may say too is optional here: given, it wins.
struct RenderOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::uint32_t bits = 8;
  std::optional<Size> resolution;
  std::optional<std::uint32_t> samples;
  std::optional<std::uint32_t> max_bounces;
  std::optional<render::Rect> crop;
  std::optional<render::Transfer> transfer;
  std::optional<render::Shade> shade;

  std::optional<Size> tile;  ///< none: what suits the picture and the ranks
  std::optional<std::filesystem::path> costs;
  scheduler::Policy policy = scheduler::Policy::dynamic;
  scheduler::MasterRole master = scheduler::MasterRole::automatic;
  std::optional<unsigned> prefetch;
  bool ask_back = true;
  double lease_s = 1;
  render::Kernel kernel = render::Kernel::automatic;
  render::Tracer tracer = render::Tracer::fast;

  std::optional<std::filesystem::path> journal;
  bool resume = false;  ///< only with a journal
  std::optional<std::filesystem::path> signature;
  std::optional<std::filesystem::path> error;
  std::optional<std::filesystem::path> stats;       ///< "-" is stdout
  std::optional<std::filesystem::path> tile_stats;  ///< "-" is stdout
  std::optional<std::filesystem::path> trace;       ///< "-" is stdout
  std::optional<std::filesystem::path> cost_map;
  std::optional<std::filesystem::path> owner_map;
  ProgressStyle progress = ProgressStyle::automatic;
  bool quiet = false;
  bool verbose = false;
};

struct CompareOptions {
  std::filesystem::path a;
  std::filesystem::path b;
  double tolerance = 0;                           ///< largest max_abs that still counts as equal
  std::vector<std::filesystem::path> signatures;  ///< of a and of b, or none
  bool json = false;
};

struct InfoOptions {
  std::filesystem::path input;
};

struct ConvertOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  bool quiet = false;
};

/// Text asked for instead of a command: --help or --version.
struct TextRequest {
  std::string text;
};

using Command = std::variant<RenderOptions, CompareOptions, InfoOptions, ConvertOptions, TextRequest>;

/// throws:  UsageError
Command parse_command_line(int argc, const char* const* argv);

}  // namespace tessera::app
