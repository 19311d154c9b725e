// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_file.h"

#include <boost/test/unit_test.hpp>
#include <optional>
#include <string>

#include "io/error.h"
#include "io/random_image.h"
#include "io/temp_folder.h"

namespace tessera::io {

using render::Image;
using render::PixelFormat;
using test::error_of;
using test::random_image;

BOOST_AUTO_TEST_SUITE(ImageFile)

BOOST_AUTO_TEST_CASE(format_follows_the_ending_in_any_case) {
  BOOST_TEST((image_format_of("a.png") == ImageFormat::png));
  BOOST_TEST((image_format_of("some/dir.pfm/a.PPM") == ImageFormat::ppm));
  BOOST_TEST((image_format_of("a.b.Pfm") == ImageFormat::pfm));
  for (const char* name : {"a", "a.jpg", "png", ".png", "a.png/", "a.pngx", ""}) {
    BOOST_TEST((image_format_of(name) == std::nullopt), name);
  }
}

BOOST_AUTO_TEST_CASE(pixels_follow_format_and_bits) {
  BOOST_TEST((pixel_format_for(ImageFormat::png, BitDepth::eight) == PixelFormat::rgb8));
  BOOST_TEST((pixel_format_for(ImageFormat::ppm, BitDepth::sixteen) == PixelFormat::rgb16));
  BOOST_TEST((pixel_format_for(ImageFormat::pfm, BitDepth::eight) == PixelFormat::rgb32f));
}

BOOST_AUTO_TEST_CASE(content_decides_what_is_read) {
  const test::TempFolder folder;
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::ppm, ImageFormat::pfm}) {
    const Image image = random_image(4, 3, pixel_format_for(format, BitDepth::eight));
    const auto path = folder.write("misnamed.txt", encode_image(format, image, render::Transfer::none, {}));
    const Image back = read_image(path);
    BOOST_TEST((back.format == image.format));
    BOOST_TEST((back.bytes == image.bytes));
  }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_read_is_named) {
  const test::TempFolder folder;
  const auto missing = error_of([&] { read_image(folder / "none.png"); });
  BOOST_TEST_REQUIRE(missing.has_value());
  BOOST_TEST((missing->kind() == ErrorKind::input_missing));
  BOOST_TEST(missing->what() == (folder / "none.png").string() + ": cannot open (No such file or directory)");

  for (const char* junk : {"", "P", "GIF89a", "P3\n1 1\n255\n1 2 3"}) {
    const auto path = folder.write("junk.png", junk);
    const auto error = error_of([&] { read_image(path); });
    BOOST_TEST_REQUIRE(error.has_value());
    BOOST_TEST((error->kind() == ErrorKind::bad_scene));
    BOOST_TEST(std::string(error->what()).starts_with(path.string() + ": not a picture we can read ("));
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
