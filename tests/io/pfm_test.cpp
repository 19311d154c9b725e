// SPDX-License-Identifier: BSD-3-Clause
#include "io/pfm.h"

#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "io/random_image.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using render::Image;
using render::PixelFormat;
using test::error_of;
using test::random_image;

std::vector<float> samples_of(const Image& image) {
  std::vector<float> samples(image.bytes.size() / sizeof(float));
  std::memcpy(samples.data(), image.bytes.data(), image.bytes.size());
  return samples;
}

std::string problem_of(std::string_view pfm) {
  const auto error = error_of([&] { decode_pfm(pfm, "a.pfm"); });
  if (!error) return "none";
  BOOST_TEST((error->kind() == ErrorKind::bad_scene));
  return error->what();
}

// 1, 2 and 3 in either byte order
const std::string kLittle("\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40", 12);
const std::string kBig("\x3f\x80\0\0\x40\0\0\0\x40\x40\0\0", 12);
const std::vector<float> kOneTwoThree{1, 2, 3};

}  // namespace

BOOST_AUTO_TEST_SUITE(Pfm)

BOOST_AUTO_TEST_CASE(reads_back_what_it_wrote) {
  const Image image = random_image(7, 3, PixelFormat::rgb32f);
  const std::string pfm = encode_pfm(image);
  BOOST_TEST(pfm == encode_pfm(image));
  const Image back = decode_pfm(pfm, "a.pfm");
  BOOST_TEST(back.width == 7u);
  BOOST_TEST(back.height == 3u);
  BOOST_TEST((back.format == PixelFormat::rgb32f));
  BOOST_TEST((back.bytes == image.bytes));
}

BOOST_AUTO_TEST_CASE(grey_is_read_back_as_three_equal_channels) {
  const std::vector<float> grey{1, 2, 3, 4, 5, std::numeric_limits<float>::infinity()};
  const Image back = decode_pfm(encode_pfm(3, 2, grey), "a.pfm");
  BOOST_TEST(back.width == 3u);
  BOOST_TEST(back.height == 2u);
  const std::vector<float> samples = samples_of(back);
  for (std::size_t i = 0; i != samples.size(); ++i) BOOST_TEST(samples[i] == grey[i / 3]);
}

BOOST_AUTO_TEST_CASE(is_little_endian_with_the_bottom_row_first) {
  Image image(1, 2, PixelFormat::rgb32f);
  const float pixels[] = {-1e30f, 0, 5, 1, 2, 3};  // the second row is the bottom
  std::memcpy(image.bytes.data(), pixels, sizeof pixels);
  const std::string pfm = encode_pfm(image);
  BOOST_TEST(pfm.starts_with("PF\n1 2\n-1.0\n" + kLittle));
  BOOST_TEST(pfm.size() == 12u + 24u);
}

BOOST_AUTO_TEST_CASE(reads_both_byte_orders) {
  BOOST_TEST(samples_of(decode_pfm("PF 1 1 -1\n" + kLittle, "a")) == kOneTwoThree);
  BOOST_TEST(samples_of(decode_pfm("PF 1 1 1.0\n" + kBig, "a")) == kOneTwoThree);
}

BOOST_AUTO_TEST_CASE(grey_becomes_three_equal_channels) {
  const std::vector<float> expected{1, 1, 1, 2, 2, 2, 3, 3, 3};
  BOOST_TEST(samples_of(decode_pfm("Pf 3 1 -1\n" + kLittle, "a")) == expected);
  const std::vector<float> upside_down{3, 3, 3, 2, 2, 2, 1, 1, 1};
  BOOST_TEST(samples_of(decode_pfm("Pf 1 3 -1\n" + kLittle, "a")) == upside_down);
}

BOOST_AUTO_TEST_CASE(every_truncation_and_any_excess_is_an_error) {
  const std::string pfm = encode_pfm(random_image(3, 2, PixelFormat::rgb32f));
  for (std::size_t size = 0; size < pfm.size(); ++size) {
    BOOST_TEST(problem_of(pfm.substr(0, size)) != "none", "no error at length " << size);
  }
  BOOST_TEST(problem_of(pfm + "x").starts_with("a.pfm: the file's length does not fit its header"));
}

BOOST_AUTO_TEST_CASE(junk_headers_are_errors) {
  BOOST_TEST(problem_of("PG 1 1 -1\n" + kLittle) == "a.pfm: not a PFM (it must begin with PF or Pf)");
  for (const std::string scale : {"0", "nan", "inf", "-x", "1e"}) {
    BOOST_TEST(problem_of("PF 1 1 " + scale + "\n" + kLittle) ==
               "a.pfm: bad PFM header (the scale must be a number other than 0)");
  }
}

BOOST_AUTO_TEST_CASE(integer_pixels_are_refused) {
  BOOST_CHECK_THROW(encode_pfm(Image(1, 1, PixelFormat::rgb8)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
