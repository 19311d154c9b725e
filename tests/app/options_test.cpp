// SPDX-License-Identifier: BSD-3-Clause
#include "app/options.h"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <vector>

#include "app/exit_code.h"

using namespace tessera;
using namespace tessera::app;

namespace {

Command parse(std::vector<const char*> words) {
  words.insert(words.begin(), "tessera");
  return parse_command_line(static_cast<int>(words.size()), words.data());
}

RenderOptions parse_render(std::vector<const char*> words) {
  words.insert(words.begin(), {"render", "scene.toml"});
  return std::get<RenderOptions>(parse(words));
}

/// What the program complains about, or "" where it doesn't.
std::string complaint(const std::vector<const char*>& words) {
  try {
    parse(words);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(Options)

BOOST_AUTO_TEST_CASE(a_render_needs_only_its_input) {
  const RenderOptions options = parse_render({});
  BOOST_TEST(options.input == "scene.toml");
  BOOST_TEST(options.output == "scene.png");
  BOOST_TEST(!options.tile.has_value());
  BOOST_TEST(!options.costs.has_value());
  BOOST_TEST((options.policy == scheduler::Policy::dynamic));
  BOOST_TEST(!options.resolution.has_value());
}

BOOST_AUTO_TEST_CASE(the_default_output_is_in_the_current_folder) {
  const auto options = std::get<RenderOptions>(parse({"render", "some/where/balls.dat"}));
  BOOST_TEST(options.output == "balls.png");
}

BOOST_AUTO_TEST_CASE(every_render_option_is_understood) {
  const RenderOptions options = parse_render(
      {"-o",          "a.ppm", "--bits",     "16",        "-r",           "64x48",     "-s",         "4",
       "-b",          "0",     "--crop",     "1,2,30,40", "--transfer",   "none",      "--shade",    "blinn",
       "--tile-size", "7x5",   "--schedule", "guided",    "--master",     "dedicated", "--prefetch", "3",
       "--kernel",    "brute", "--stats",    "-",         "--tile-stats", "t.csv",     "--progress", "plain",
       "--trace",     "-",     "--cost-map", "c.png",     "--owner-map",  "o.png",     "-q",         "-v",
       "--costs",     "c.csv", "--journal",  "a.journal", "--resume"});
  BOOST_TEST(options.output == "a.ppm");
  BOOST_TEST(options.bits == 16u);
  BOOST_TEST(options.resolution->width == 64u);
  BOOST_TEST(options.resolution->height == 48u);
  BOOST_TEST(options.samples.value() == 4u);
  BOOST_TEST(options.max_bounces.value() == 0u);
  BOOST_TEST((*options.crop == render::Rect{1, 2, 30, 40}));
  BOOST_TEST((options.transfer == render::Transfer::none));
  BOOST_TEST((options.shade == render::Shade::blinn));
  BOOST_TEST(options.tile->width == 7u);
  BOOST_TEST(options.tile->height == 5u);
  BOOST_TEST((options.policy == scheduler::Policy::guided));
  BOOST_TEST((options.master == scheduler::MasterRole::dedicated));
  BOOST_TEST(options.prefetch.value() == 3u);
  BOOST_TEST((options.kernel == render::Kernel::brute));
  BOOST_TEST(options.journal.value() == "a.journal");
  BOOST_TEST(options.resume);
  BOOST_TEST(options.stats.value() == "-");
  BOOST_TEST(options.tile_stats.value() == "t.csv");
  BOOST_TEST(options.costs.value() == "c.csv");
  BOOST_TEST(options.trace.value() == "-");
  BOOST_TEST(options.cost_map.value() == "c.png");
  BOOST_TEST(options.owner_map.value() == "o.png");
  BOOST_TEST((options.progress == ProgressStyle::plain));
  BOOST_TEST(options.quiet);
  BOOST_TEST(options.verbose);
}

BOOST_AUTO_TEST_CASE(one_number_makes_square_tiles) {
  const RenderOptions options = parse_render({"--tile-size", "32"});
  BOOST_TEST(options.tile->width == 32u);
  BOOST_TEST(options.tile->height == 32u);
}

BOOST_AUTO_TEST_CASE(every_schedule_has_its_name) {
  for (const char* name : {"dynamic", "static-bands", "cyclic-rows", "self", "guided", "factoring", "trapezoid"}) {
    BOOST_TEST(name_of(parse_render({"--schedule", name}).policy) == name);
  }
}

BOOST_AUTO_TEST_CASE(auto_is_a_tile_size) {
  BOOST_TEST(!parse_render({"--tile-size", "auto"}).tile.has_value());
  BOOST_TEST(contains(complaint({"render", "s.toml", "--tile-size", "Auto"}), "--tile-size"));
}

BOOST_AUTO_TEST_CASE(a_size_must_be_whole_positive_numbers) {
  for (const char* size : {"0", "-4", "x", "16x", "x16", "16x0", "1e2", "16x16x16", "99999999999", " 16"}) {
    BOOST_TEST(contains(complaint({"render", "s.toml", "--tile-size", size}), "--tile-size"), size);
  }
  for (const char* size : {"0x1", "640", "640*480", "-1x5"}) {
    BOOST_TEST(contains(complaint({"render", "s.toml", "--resolution", size}), "--resolution"), size);
  }
}

BOOST_AUTO_TEST_CASE(an_empty_argument_is_refused_whatever_it_is_for) {
  BOOST_TEST(contains(complaint({"render", "s.toml", "--tile-size", ""}), "argument 4 is empty"));
  BOOST_TEST(contains(complaint({"render", "s.toml", "", "-q"}), "argument 3 is empty"));
}

BOOST_AUTO_TEST_CASE(counts_must_be_whole_numbers) {
  for (const char* option : {"--spp", "--max-bounces", "--prefetch"}) {
    for (const char* count : {"-1", "1.5", "x", "99999999999"}) {
      BOOST_TEST(contains(complaint({"render", "s.toml", option, count}), option), option << " " << count);
    }
  }
  BOOST_TEST(contains(complaint({"compare", "a.png", "b.png", "--tolerance", "nan"}), "--tolerance"));
  BOOST_TEST(contains(complaint({"compare", "a.png", "b.png", "--tolerance", "inf"}), "--tolerance"));
}

BOOST_AUTO_TEST_CASE(a_lease_is_seconds_or_off) {
  BOOST_TEST(parse_render({}).lease_s == 1);
  BOOST_TEST(parse_render({"--lease", "2.5"}).lease_s == 2.5);
  BOOST_TEST(parse_render({"--lease", "off"}).lease_s == std::numeric_limits<double>::infinity());
  for (const char* lease : {"0", "-1", "0.001", "inf", "nan", "1s", "x"}) {
    BOOST_TEST(contains(complaint({"render", "s.toml", "--lease", lease}), "--lease"), lease);
  }
}

BOOST_AUTO_TEST_CASE(asking_back_can_be_switched_off) {
  BOOST_TEST(parse_render({}).ask_back);
  BOOST_TEST(!parse_render({"--ask-back", "off"}).ask_back);
}

BOOST_AUTO_TEST_CASE(a_crop_must_be_four_numbers_of_a_non_empty_part) {
  for (const char* crop : {"1,2,3", "1,2,3,4,5", "a,b,c,d", "0,0,0,5", "0,0,5,0", "-1,0,5,5"}) {
    BOOST_TEST(contains(complaint({"render", "s.toml", "--crop", crop}), "--crop"), crop);
  }
}

BOOST_AUTO_TEST_CASE(a_mistyped_name_gets_a_suggestion) {
  BOOST_TEST(contains(complaint({"render", "s.toml", "--schedule", "dynamc"}), "did you mean \"dynamic\""));
  BOOST_TEST(contains(complaint({"render", "s.toml", "--tile-sise", "16"}), "did you mean \"--tile-size\""));
  BOOST_TEST(contains(complaint({"rendr", "s.toml"}), "did you mean \"render\""));
}

BOOST_AUTO_TEST_CASE(what_is_missing_or_too_much_is_named) {
  BOOST_TEST(contains(complaint({}), "a command is missing"));
  BOOST_TEST(contains(complaint({"render"}), "INPUT"));
  BOOST_TEST(contains(complaint({"compare", "a.png"}), "B"));
  BOOST_TEST(contains(complaint({"render", "a.toml", "b.toml"}), "b.toml"));
  BOOST_TEST(contains(complaint({"render", "a.toml", "--resume"}), "--journal FILE --resume"));
  BOOST_TEST(contains(complaint({"render", "a.toml", "--journal", "-"}), "--journal"));
  BOOST_TEST(contains(complaint({"compare", "a.png", "b.png", "--tolerance", "-1"}), "tolerance"));
}

BOOST_AUTO_TEST_CASE(a_conversion_needs_input_and_output) {
  const auto options = std::get<ConvertOptions>(parse({"convert", "a.toml", "-o", "b.dat", "-q"}));
  BOOST_TEST(options.input == "a.toml");
  BOOST_TEST(options.output == "b.dat");
  BOOST_TEST(options.quiet);
  BOOST_TEST(!std::get<ConvertOptions>(parse({"convert", "a.toml", "--output", "b.dat"})).quiet);
  BOOST_TEST(contains(complaint({"convert", "a.toml"}), "output"));
  BOOST_TEST(contains(complaint({"convert", "-o", "b.dat"}), "INPUT"));
  BOOST_TEST(contains(complaint({"convert", "a.toml", "b.dat", "-o", "c.dat"}), "b.dat"));
  BOOST_TEST(contains(complaint({"covert", "a.toml"}), "did you mean \"convert\""));
}

BOOST_AUTO_TEST_CASE(help_and_version_are_texts_not_errors) {
  BOOST_TEST(contains(std::get<TextRequest>(parse({"--help"})).text, "render"));
  BOOST_TEST(contains(std::get<TextRequest>(parse({"render", "--help"})).text, "--tile-size"));
  BOOST_TEST(contains(std::get<TextRequest>(parse({"--version"})).text, "tessera 0."));
}

BOOST_AUTO_TEST_SUITE_END()
