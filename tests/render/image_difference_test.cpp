// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_difference.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace tessera::render;

namespace {

template <class Number>
Image image_of(std::uint32_t width, PixelFormat format, const std::vector<Number>& numbers) {
  Image image(width, static_cast<std::uint32_t>(numbers.size()) / 3 / width, format);
  BOOST_REQUIRE(image.bytes.size() == numbers.size() * sizeof(Number));
  std::memcpy(image.bytes.data(), numbers.data(), image.bytes.size());
  return image;
}

Image in_8_bits(const std::vector<std::uint8_t>& numbers) {
  return image_of(1, PixelFormat::rgb8, numbers);
}
Image in_floats(const std::vector<float>& numbers) {
  return image_of(1, PixelFormat::rgb32f, numbers);
}

bool is_near(double a, double b) {
  return std::abs(a - b) <= 1e-14 * std::abs(b);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(image_difference)

BOOST_AUTO_TEST_CASE(channels_run_from_zero_to_one_but_floats_are_as_they_are) {
  BOOST_TEST(channel_value(in_8_bits({0, 51, 255}), 1) == 0.2);
  BOOST_TEST(channel_value(in_8_bits({0, 51, 255}), 2) == 1);
  BOOST_TEST(channel_value(image_of<std::uint16_t>(1, PixelFormat::rgb16, {0, 13107, 65535}), 1) == 0.2);
  BOOST_TEST(channel_value(image_of<std::uint16_t>(1, PixelFormat::rgb16, {0, 13107, 65535}), 2) == 1);
  BOOST_TEST(channel_value(in_floats({0, 0.25, 7.5}), 2) == 7.5);
}

BOOST_AUTO_TEST_CASE(equal_pictures_do_not_differ) {
  const Image image = in_8_bits({1, 2, 3, 250, 251, 252});
  const ImageDifference d = difference_between(image, image);
  BOOST_TEST(d.max_abs == 0);
  BOOST_TEST(d.rmse == 0);
  BOOST_TEST(d.rel_mse == 0);
  BOOST_TEST(d.psnr_db == std::numeric_limits<double>::infinity());
  BOOST_TEST(d.off_share == 0);
  BOOST_TEST(d.off_pixels == 0U);
}

// Differences 0.5, 0, 0, 0, 0, -1 in 6 channels: mean square 1.25 / 6.
BOOST_AUTO_TEST_CASE(rmse_and_psnr_follow_from_the_mean_square) {
  const ImageDifference d = difference_between(in_floats({0.5, 1, 1, 0, 0, 1}), in_floats({0, 1, 1, 0, 0, 2}));
  BOOST_TEST(d.max_abs == 1);
  BOOST_TEST(is_near(d.rmse, std::sqrt(1.25 / 6)));
  BOOST_TEST(is_near(d.psnr_db, -10 * std::log10(1.25 / 6)));
}

// The same: (0.25 / (0 + 0.01) + 1 / (4 + 0.01)) / 6; the second picture is the reference.
BOOST_AUTO_TEST_CASE(relative_error_is_weighed_by_the_second_picture) {
  const Image a = in_floats({0.5, 1, 1, 0, 0, 1});
  const Image b = in_floats({0, 1, 1, 0, 0, 2});
  BOOST_TEST(is_near(difference_between(a, b).rel_mse, (0.25 / 0.01 + 1 / 4.01) / 6));
  BOOST_TEST(is_near(difference_between(b, a).rel_mse, (0.25 / 0.26 + 1 / 1.01) / 6));
}

// Of four pixels one is off by 1/255 in two channels; 1/512 is below the limit of 1/510.
BOOST_AUTO_TEST_CASE(pixels_off_by_more_than_half_an_eight_bit_step_are_counted_once) {
  const ImageDifference d = difference_between(in_8_bits({0, 0, 0, 5, 5, 5, 9, 9, 9, 7, 7, 7}),
                                               in_8_bits({0, 0, 0, 5, 4, 6, 9, 9, 9, 7, 7, 7}));
  BOOST_TEST(d.off_pixels == 1U);
  BOOST_TEST(d.off_share == 0.25);
  BOOST_TEST(difference_between(in_floats({1.0F / 512, 0, 0}), in_floats({0, 0, 0})).off_pixels == 0U);
  BOOST_TEST(difference_between(in_floats({1.0F / 509, 0, 0}), in_floats({0, 0, 0})).off_pixels == 1U);
}

BOOST_AUTO_TEST_CASE(pictures_of_different_formats_can_be_compared) {
  const Image eight = in_8_bits({0, 51, 255});
  const Image sixteen = image_of<std::uint16_t>(1, PixelFormat::rgb16, {0, 13107, 65535});
  BOOST_TEST(difference_between(eight, sixteen).max_abs == 0);
  BOOST_TEST(difference_between(eight, in_floats({0, 0.5, 1})).max_abs == 0.3, boost::test_tools::tolerance(1e-15));
}

// Black and white: rmse 1, 0 dB.
BOOST_AUTO_TEST_CASE(black_and_white_are_zero_decibels_apart) {
  const ImageDifference d = difference_between(in_8_bits({0, 0, 0}), in_8_bits({255, 255, 255}));
  BOOST_TEST(d.rmse == 1);
  BOOST_TEST(std::abs(d.psnr_db) == 0);
  BOOST_TEST(d.off_share == 1);
}

BOOST_AUTO_TEST_SUITE_END()
