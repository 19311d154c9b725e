// SPDX-License-Identifier: BSD-3-Clause
#include "app/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include "app/exit_code.h"
#include "app/version.h"
#include "io/scene_writer.h"
#include "io/suggest.h"

namespace tessera::app {
namespace {

/// All of `text` as a whole number, or nullopt.
std::optional<std::uint32_t> whole_number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

std::uint32_t count_of(const std::string& option, const std::string& text, std::uint32_t least) {
  const auto value = whole_number(text);
  if (!value || *value < least) {
    throw UsageError(option + ": \"" + text + "\" is not a whole number >= " + std::to_string(least));
  }
  return *value;
}

std::uint32_t positive(const std::string& option, std::string_view text, const std::string& whole) {
  const auto value = whole_number(text);
  if (!value || *value == 0) throw UsageError(option + ": \"" + whole + "\" is not a size (whole numbers >= 1)");
  return *value;
}

Size size_of(const std::string& option, const std::string& text) {
  const auto parts = split(text, 'x');
  if (parts.size() != 2) throw UsageError(option + ": \"" + text + "\" is not WIDTHxHEIGHT, for example 1280x720");
  return {positive(option, parts[0], text), positive(option, parts[1], text)};
}

Size tile_size_of(const std::string& option, const std::string& text) {
  if (text.find('x') != std::string::npos) return size_of(option, text);
  const std::uint32_t side = count_of(option, text, 1);
  return {side, side};
}

double lease_of(const std::string& option, const std::string& text) {
  if (text == "off") return std::numeric_limits<double>::infinity();
  double seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(seconds) || seconds < 0.01) {
    throw UsageError(option + ": \"" + text + "\" is neither a number of seconds >= 0.01 nor off");
  }
  return seconds;
}

render::Rect crop_of(const std::string& option, const std::string& text) {
  const auto parts = split(text, ',');
  std::vector<std::uint32_t> numbers;
  for (const std::string_view part : parts) {
    if (const auto number = whole_number(part)) numbers.push_back(*number);
  }
  if (parts.size() != 4 || numbers.size() != 4 || numbers[2] == 0 || numbers[3] == 0) {
    throw UsageError(option + ": \"" + text + "\" is not X,Y,WIDTH,HEIGHT in pixels, for example 100,50,320,200");
  }
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

/// Adds an option whose value is one of a few names.
template <class Value>
void add_choice(CLI::App& app, const std::string& option, std::vector<std::pair<std::string, Value>> choices,
                const std::string& help, std::function<void(Value)> set) {
  std::string names;
  for (const auto& [name, value] : choices) names += (names.empty() ? "" : "|") + name;
  const auto choose = [=](const std::string& text) {
    std::vector<std::string> known;
    for (const auto& [name, value] : choices) {
      if (name == text) return set(value);
      known.push_back(name);
    }
    throw UsageError(option + ": unknown value \"" + text + "\"" + io::did_you_mean(text, known) + " (one of " + names +
                     ")");
  };
  app.add_option_function<std::string>(option, choose, help)->type_name(names);
}

void add_picture_options(CLI::App& app, RenderOptions& options) {
  const auto group = app.add_option_group("Picture", "what to render; given here, these win over the scene");
  group
      ->add_option_function<std::string>(
          "-r,--resolution", [&](const std::string& text) { options.resolution = size_of("--resolution", text); },
          "width and height in pixels")
      ->type_name("WxH");
  group
      ->add_option_function<std::string>(
          "-s,--spp", [&](const std::string& text) { options.samples = count_of("--spp", text, 1); },
          "samples per pixel, a square number")
      ->type_name("N");
  group
      ->add_option_function<std::string>(
          "-b,--max-bounces",
          [&](const std::string& text) { options.max_bounces = count_of("--max-bounces", text, 0); }, "mirror bounces")
      ->type_name("N");
  group
      ->add_option_function<std::string>(
          "--crop", [&](const std::string& text) { options.crop = crop_of("--crop", text); },
          "render this part of the picture only")
      ->type_name("X,Y,W,H");
  add_choice<std::uint32_t>(*group, "--bits", {{"8", 8}, {"16", 16}}, "bits per channel of PNG and PPM",
                            [&](std::uint32_t bits) { options.bits = bits; });
  add_choice<render::Transfer>(
      *group, "--transfer", {{"srgb", render::Transfer::srgb}, {"none", render::Transfer::none}},
      "curve from linear to the picture's numbers", [&](auto value) { options.transfer = value; });
  add_choice<render::Shade>(*group, "--shade", {{"phong", render::Shade::phong}, {"blinn", render::Shade::blinn}},
                            "highlight by R.V or by the half vector", [&](auto value) { options.shade = value; });
}

void add_schedule_options(CLI::App& app, RenderOptions& options) {
  using scheduler::MasterRole;
  using scheduler::Policy;
  const auto group = app.add_option_group("Schedule", "how ranks share the work; the picture stays the same");
  group
      ->add_option_function<std::string>(
          "--tile-size",
          [&](const std::string& text) {
            options.tile = text == "auto" ? std::nullopt : std::optional(tile_size_of("--tile-size", text));
          },
          "tile side in pixels, or width and height [auto: by area, samples and ranks, or by --costs; bands where "
          "tiles are not worth handing out]")
      ->type_name("auto|N|WxH");
  group
      ->add_option(
          "--costs", options.costs,
          "what --tile-stats wrote in an earlier run, of this picture or one like it, at any resolution of the "
          "same aspect: the dearest tiles come first and, without a --tile-size, tiles are cut by cost; a "
          "wrong one never changes the picture [none]")
      ->type_name("FILE");
  std::vector<std::pair<std::string, Policy>> policies;
  for (const Policy policy : {Policy::dynamic, Policy::static_bands, Policy::cyclic_rows, Policy::self_scheduling,
                              Policy::guided, Policy::factoring, Policy::trapezoid}) {
    policies.emplace_back(name_of(policy), policy);
  }
  add_choice<Policy>(*group, "--schedule", policies, "who renders which tiles [dynamic]",
                     [&](Policy policy) { options.policy = policy; });
  add_choice<MasterRole>(
      *group, "--master",
      {{"auto", MasterRole::automatic}, {"dedicated", MasterRole::dedicated}, {"rendering", MasterRole::rendering}},
      "whether rank 0 renders too [auto: while that pays]", [&](MasterRole role) { options.master = role; });
  group
      ->add_option_function<std::string>(
          "--prefetch",
          [&](const std::string& text) {
            options.prefetch = text == "auto" ? std::nullopt : std::optional<unsigned>(count_of("--prefetch", text, 1));
          },
          "tiles that a worker holds, 1: none ahead [auto: enough to cover the way to rank 0]")
      ->type_name("auto|N");
  add_choice<bool>(*group, "--ask-back", {{"on", true}, {"off", false}},
                   "whether idle ranks get tiles that others hold and have not begun [on]",
                   [&](bool on) { options.ask_back = on; });
  group
      ->add_option_function<std::string>(
          "--lease", [&](const std::string& text) { options.lease_s = lease_of("--lease", text); },
          "seconds after which a silent rank's tiles go to others [1]")
      ->type_name("SECONDS|off");
  add_choice<render::Kernel>(*group, "--kernel",
                             {{"auto", render::Kernel::automatic},
                              {"scalar", render::Kernel::scalar},
                              {"avx2", render::Kernel::avx2},
                              {"brute", render::Kernel::brute}},
                             "how spheres are searched [auto]", [&](auto kernel) {
                               if (!is_supported(kernel))
                                 throw UsageError("--kernel: this machine has no AVX2 and FMA instructions");
                               options.kernel = kernel;
                             });
}

void add_accuracy_options(CLI::App& app, RenderOptions& options) {
  const auto group = app.add_option_group("Accuracy", "how exact the picture is");
  group->add_flag_callback(
      "--reference", [&] { options.tracer = render::Tracer::reference; },
      "trace in quad precision by brute force: for small scenes");
  group->add_option("--signature", options.signature, "write what each pixel saw and what lit it, for compare")
      ->type_name("FILE");
  group
      ->add_option(
          "--error", options.error,
          "write a bound on the error of each pixel's linear channels before they are rounded to the picture's "
          "numbers, inf where an edge may be off: .pfm")
      ->type_name("FILE");
}

void add_fault_options(CLI::App& app, RenderOptions& options) {
  const auto group = app.add_option_group("Faults", "what an interrupted run leaves to the next");
  group
      ->add_option("--journal", options.journal,
                   "keep what is rendered in this file until all outputs are written, then delete it")
      ->type_name("FILE");
  group->add_flag("--resume", options.resume,
                  "go on from the journal of a run that did not end; ranks, tiles and schedule may differ");
}

void check_fault_options(const RenderOptions& options) {
  if (options.resume && !options.journal) throw UsageError("--resume needs a journal: --journal FILE --resume");
  if (options.journal == "-") throw UsageError("--journal: \"-\" is not a file (a journal is read again)");
}

void add_report_options(CLI::App& app, RenderOptions& options) {
  const auto group = app.add_option_group("Report", "\"-\" as FILE is standard output");
  group->add_option("--stats", options.stats, "write times, rays and load balance as JSON")->type_name("FILE");
  group->add_option("--tile-stats", options.tile_stats, "write each tile's rank and times as CSV")->type_name("FILE");
  group->add_option("--trace", options.trace, "write who did what when, for ui.perfetto.dev or chrome://tracing")
      ->type_name("FILE");
  group->add_option("--cost-map", options.cost_map, "paint each tile by its seconds per pixel: .png")
      ->type_name("FILE");
  group->add_option("--owner-map", options.owner_map, "paint each tile in the color of its rank: .png")
      ->type_name("FILE");
  add_choice<ProgressStyle>(*group, "--progress",
                            {{"auto", ProgressStyle::automatic},
                             {"bar", ProgressStyle::bar},
                             {"plain", ProgressStyle::plain},
                             {"none", ProgressStyle::none}},
                            "how progress is shown [auto]", [&](ProgressStyle style) { options.progress = style; });
  group->add_flag("-q,--quiet", options.quiet, "no progress, report or notes; errors always");
  group->add_flag("-v,--verbose", options.verbose, "report every rank, however many");
}

/// The names of all options of a command, as a person types them.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const CLI::App* group : app.get_subcommands([](const CLI::App* sub) { return sub->get_name().empty(); })) {
    const auto inner = option_names(*group);
    names.insert(names.end(), inner.begin(), inner.end());
  }
  return names;
}

[[noreturn]] void refuse_extras(const CLI::App& app, const std::vector<std::string>& extras) {
  const std::string& word = extras.front();
  const bool is_option = word.size() > 1 && word.front() == '-';
  const std::string hint = is_option ? io::did_you_mean(word, option_names(app)) : "";
  throw UsageError((is_option ? "unknown option \"" : "unexpected argument \"") + word + "\"" + hint +
                   " (see tessera " + app.get_name() + " --help)");
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    // Usually a variable that a script did not set.
    if (*argv[i] == '\0') throw UsageError("argument " + std::to_string(i) + " is empty (a variable that is not set?)");
  }
  RenderOptions render;
  CompareOptions compare;
  InfoOptions info;
  ConvertOptions convert;

  CLI::App app{"Tessera renders scenes of spheres on every core that mpirun gives it.", "tessera"};
  app.set_version_flag("--version", std::string("tessera ") + kVersion);
  app.require_subcommand(0, 1);
  app.get_formatter()->column_width(30);

  CLI::App& render_app = *app.add_subcommand("render", "render a scene to a picture");
  render_app.add_option("INPUT", render.input, "scene: .toml, Tachyon .dat, sphere table .txt .csv .bin")->required();
  render_app.add_option("-o,--output", render.output, "picture: .png .ppm .pfm [INPUT's stem + .png]")
      ->type_name("FILE");
  add_picture_options(render_app, render);
  add_schedule_options(render_app, render);
  add_accuracy_options(render_app, render);
  add_fault_options(render_app, render);
  add_report_options(render_app, render);

  CLI::App& compare_app = *app.add_subcommand("compare", "measure how far two pictures are apart");
  compare_app.add_option("A", compare.a, "picture")->required();
  compare_app.add_option("B", compare.b, "picture to compare with")->required();
  compare_app.add_option("--tolerance", compare.tolerance, "largest difference of a channel that is fine [0]");
  compare_app
      .add_option("--signatures", compare.signatures,
                  "count too the pixels that saw or were lit otherwise; the exit code tells of the pictures alone")
      ->expected(2)
      ->type_name("A.sig B.sig");
  compare_app.add_flag("--json", compare.json, "print JSON");

  CLI::App& info_app = *app.add_subcommand("info", "say what a scene holds and what it takes");
  info_app.add_option("INPUT", info.input, "scene")->required();

  CLI::App& convert_app = *app.add_subcommand("convert", "write a scene for another renderer");
  convert_app.add_option("INPUT", convert.input, "scene")->required();
  convert_app.add_option("-o,--output", convert.output, "scene: " + std::string(io::kSceneEndings))
      ->required()
      ->type_name("FILE");
  convert_app.add_flag("-q,--quiet", convert.quiet, "no notes; errors always");

  for (CLI::App* command : {&app, &render_app, &compare_app, &info_app, &convert_app}) command->allow_extras();
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    for (CLI::App* command : app.get_subcommands()) return TextRequest{command->help("tessera")};
    return TextRequest{app.help()};
  } catch (const CLI::CallForVersion&) {
    return TextRequest{std::string("tessera ") + kVersion + "\n"};
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }

  for (const CLI::App* command : {&render_app, &compare_app, &info_app, &convert_app}) {
    if (command->parsed() && !command->remaining().empty()) refuse_extras(*command, command->remaining());
  }
  if (!app.remaining().empty()) {
    const std::string word = app.remaining().front();
    throw UsageError("unknown command \"" + word + "\"" +
                     io::did_you_mean(word, {"render", "compare", "info", "convert"}) + " (see tessera --help)");
  }
  if (compare_app.parsed() && (!std::isfinite(compare.tolerance) || compare.tolerance < 0))
    throw UsageError("--tolerance must be a finite number >= 0");
  if (compare_app.parsed()) return compare;
  if (info_app.parsed()) return info;
  if (convert_app.parsed()) return convert;
  if (!render_app.parsed())
    throw UsageError("a command is missing: tessera render SCENE -o out.png, or see tessera --help");
  check_fault_options(render);
  if (render.output.empty()) render.output = render.input.stem().concat(".png");
  return render;
}

}  // namespace tessera::app
