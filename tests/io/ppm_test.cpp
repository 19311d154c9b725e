// SPDX-License-Identifier: BSD-3-Clause
#include "io/ppm.h"

#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/error.h"
#include "io/random_image.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using render::Image;
using render::PixelFormat;
using test::error_of;
using test::random_image;

std::string problem_of(std::string_view ppm) {
  const auto error = error_of([&] { decode_ppm(ppm, "a.ppm"); });
  if (!error) return "none";
  BOOST_TEST((error->kind() == ErrorKind::bad_scene));
  return error->what();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(Ppm)

BOOST_AUTO_TEST_CASE(reads_back_what_it_wrote) {
  for (const PixelFormat format : {PixelFormat::rgb8, PixelFormat::rgb16}) {
    const Image image = random_image(7, 3, format);
    const std::string ppm = encode_ppm(image);
    BOOST_TEST(ppm == encode_ppm(image));
    const Image back = decode_ppm(ppm, "a.ppm");
    BOOST_TEST(back.width == 7u);
    BOOST_TEST(back.height == 3u);
    BOOST_TEST((back.format == format));
    BOOST_TEST((back.bytes == image.bytes));
  }
}

BOOST_AUTO_TEST_CASE(header_is_plain_and_16_bits_are_big_endian) {
  Image image(1, 1, PixelFormat::rgb16);
  const std::uint16_t pixel[3] = {0x4142, 0x4344, 0x4546};
  std::memcpy(image.bytes.data(), pixel, sizeof pixel);
  BOOST_TEST(encode_ppm(image) == "P6\n1 1\n65535\nABCDEF");
  Image small(1, 1, PixelFormat::rgb8);
  std::memcpy(small.bytes.data(), "abc", 3);
  BOOST_TEST(encode_ppm(small) == "P6\n1 1\n255\nabc");
}

BOOST_AUTO_TEST_CASE(header_may_have_comments_and_any_blanks) {
  const Image image = decode_ppm("P6 # made by hand\n#\n 2\t1\r\n# largest\n255\n\n# abc", "a.ppm");
  BOOST_TEST(image.width == 2u);
  // After the header one blank is skipped and no more: the pixels may begin with blanks and #
  BOOST_TEST((std::memcmp(image.bytes.data(), "\n# abc", 6) == 0));
}

BOOST_AUTO_TEST_CASE(every_truncation_and_any_excess_is_an_error) {
  const std::string ppm = encode_ppm(random_image(3, 2, PixelFormat::rgb16));
  for (std::size_t size = 0; size < ppm.size(); ++size) {
    BOOST_TEST(problem_of(ppm.substr(0, size)) != "none", "no error at length " << size);
  }
  BOOST_TEST(problem_of(ppm + "x") ==
             "a.ppm: the file's length does not fit its header (3 x 2 pixels announced, 37 bytes found)");
}

BOOST_AUTO_TEST_CASE(junk_headers_are_errors) {
  BOOST_TEST(problem_of("P5\n1 1\n255\nabc") == "a.ppm: not a binary PPM (it must begin with P6)");
  BOOST_TEST(problem_of("P6\n1 1\n31\nabc") == "a.ppm: cannot read this PPM (its largest value must be 255 or 65535)");
  BOOST_TEST(problem_of("P6\n-1 1\n255\nabc") == "a.ppm: bad picture header (no valid width)");
  BOOST_TEST(problem_of("P6\n1 0\n255\nabc") == "a.ppm: bad picture header (no valid height)");
  BOOST_TEST(problem_of("P6\n1x 1\n255\nabc") == "a.ppm: bad picture header (no valid width)");
  BOOST_TEST(problem_of("P6\n1 99999999999\n255\nabc") == "a.ppm: bad picture header (no valid height)");
  // 3 (2^31 - 1)^2 does not fit in 64 bits
  BOOST_TEST(problem_of("P6\n2147483647 2147483647\n255\nabc").starts_with("a.ppm: the file's length"));
}

BOOST_AUTO_TEST_CASE(float_pixels_are_refused) {
  BOOST_CHECK_THROW(encode_ppm(Image(1, 1, PixelFormat::rgb32f)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
