// SPDX-License-Identifier: BSD-3-Clause
#include "render/encode.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstring>
#include <vector>

#include "render/random.h"

using namespace tessera::render;
using namespace tessera::render::test;

namespace {

/// The three numbers of an encoded pixel.
template <class Number>
struct Encoded {
  Number channel[3];

  Encoded(const Rgb& linear, PixelFormat format, Transfer transfer = Transfer::none) {
    std::byte bytes[sizeof channel];
    BOOST_REQUIRE(sizeof channel == bytes_per_pixel(format));
    encode_pixel(linear, format, transfer, bytes);
    std::memcpy(channel, bytes, sizeof channel);
  }
};

int in_8_bits(double value, Transfer transfer = Transfer::none) {
  return Encoded<std::uint8_t>({0, value, 0}, PixelFormat::rgb8, transfer).channel[1];
}
int in_16_bits(double value, Transfer transfer = Transfer::none) {
  return Encoded<std::uint16_t>({0, 0, value}, PixelFormat::rgb16, transfer).channel[2];
}

}  // namespace

BOOST_AUTO_TEST_SUITE(encode)

BOOST_AUTO_TEST_CASE(channels_are_stored_in_the_order_r_g_b) {
  const Encoded<std::uint8_t> pixel({0, 0.2, 1}, PixelFormat::rgb8);
  BOOST_TEST(pixel.channel[0] == 0);
  BOOST_TEST(pixel.channel[1] == 51);
  BOOST_TEST(pixel.channel[2] == 255);
}

// floor(255 x + 0.5): the step from n to n + 1 is at (n + 1/2) / 255.
BOOST_AUTO_TEST_CASE(eight_bits_round_half_up) {
  BOOST_TEST(in_8_bits(0.5) == 128);
  for (int n = 0; n != 255; ++n) {
    const double step = (n + 0.5) / 255;
    BOOST_TEST(in_8_bits(step - 1e-12) == n);
    BOOST_TEST(in_8_bits(step + 1e-12) == n + 1);
    BOOST_TEST(in_8_bits(n / 255.0) == n);
  }
}

BOOST_AUTO_TEST_CASE(sixteen_bits_round_half_up) {
  BOOST_TEST(in_16_bits(0.5) == 32768);
  for (int n = 0; n < 65535; n += 97) {
    const double step = (n + 0.5) / 65535;
    BOOST_TEST(in_16_bits(step - 1e-13) == n);
    BOOST_TEST(in_16_bits(step + 1e-13) == n + 1);
  }
}

BOOST_AUTO_TEST_CASE(values_outside_of_zero_to_one_are_clamped) {
  for (const Transfer transfer : {Transfer::none, Transfer::srgb}) {
    for (const double high : {1.0, 1.0000001, 2.0, 1e30, 1e300}) {
      BOOST_TEST(in_8_bits(high, transfer) == 255);
      BOOST_TEST(in_16_bits(high, transfer) == 65535);
    }
    for (const double low : {0.0, -0.0, -1e-300, -5.0}) {
      BOOST_TEST(in_8_bits(low, transfer) == 0);
      BOOST_TEST(in_16_bits(low, transfer) == 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(floats_are_linear_and_unclamped) {
  for (const Transfer transfer : {Transfer::none, Transfer::srgb}) {
    const Encoded<float> pixel({2.5, 0.1, 1e30}, PixelFormat::rgb32f, transfer);
    BOOST_TEST(pixel.channel[0] == 2.5F);
    BOOST_TEST(pixel.channel[1] == 0.1F);
    BOOST_TEST(pixel.channel[2] == 1e30F);
  }
}

// IEC 61966-2-1: 12.92 c up to 0.0031308, 1.055 c^(1/2.4) - 0.055 above. 188 is the well-known half grey.
BOOST_AUTO_TEST_CASE(srgb_curve_has_its_known_values) {
  BOOST_TEST(srgb_from_linear(0) == 0);
  BOOST_TEST(std::abs(srgb_from_linear(1) - 1) <= 1e-15);
  BOOST_TEST(std::abs(srgb_from_linear(0.001) - 0.01292) <= 1e-16);
  BOOST_TEST(std::abs(srgb_from_linear(0.5) - 0.7353569830524495) <= 1e-15);
  BOOST_TEST(std::abs(srgb_from_linear(0.18) - 0.4613561295004) <= 1e-13);
  BOOST_TEST(in_8_bits(0.5, Transfer::srgb) == 188);
  BOOST_TEST(in_8_bits(0.18, Transfer::srgb) == 118);
  BOOST_TEST(in_16_bits(0.5, Transfer::srgb) == 48192);
}

// Number n begins where the curve is (n - 1/2) / top: at every step and right below it, and wherever a number's
// leading 14 bits change.
BOOST_AUTO_TEST_CASE(srgb_numbers_change_at_their_steps_alone) {
  const auto wrong_numbers = [](int top, auto&& number_of) {
    std::vector<double> steps;
    for (int n = 1; n <= top; ++n) steps.push_back(linear_from_srgb((n - 0.5) / top));
    int wrong = 0;
    for (int n = 1; n <= top; ++n) {
      const double step = steps[static_cast<std::size_t>(n - 1)];
      wrong += number_of(std::nextafter(step, 0)) != n - 1;
      wrong += number_of(step) != n;
      wrong += number_of(std::nextafter(step, 1)) != n;
    }
    for (int exponent = -30; exponent != 0; ++exponent) {
      for (int i = 0; i != 1 << 13; ++i) {
        const double start = std::ldexp(1 + std::ldexp(i, -13), exponent);
        for (const double x : {std::nextafter(start, 0), start}) {
          wrong += number_of(x) != std::upper_bound(steps.begin(), steps.end(), x) - steps.begin();
        }
      }
    }
    return wrong;
  };
  BOOST_TEST(wrong_numbers(255, [](double x) { return in_8_bits(x, Transfer::srgb); }) == 0);
  BOOST_TEST(wrong_numbers(65535, [](double x) { return in_16_bits(x, Transfer::srgb); }) == 0);
  for (const double small : {0.0, 5e-324, 1e-300, 0x1p-22}) {
    BOOST_TEST(in_8_bits(small, Transfer::srgb) == 0);
    BOOST_TEST(in_16_bits(small, Transfer::srgb) == 0);
  }
}

BOOST_AUTO_TEST_CASE(srgb_curve_has_no_visible_jump_and_never_falls) {
  BOOST_TEST(std::abs(srgb_from_linear(0.00313079) - srgb_from_linear(0.00313081)) <= 1e-6);
  double last = -1;
  for (int i = 0; i <= 20000; ++i) {
    const double value = srgb_from_linear(i / 20000.0);
    BOOST_REQUIRE(value > last);
    last = value;
  }
}

// Every code of a file's "#rrggbb" comes back: encode(decode(n)) = n.
BOOST_AUTO_TEST_CASE(linear_from_srgb_is_the_inverse) {
  for (int n = 0; n != 256; ++n) BOOST_TEST(in_8_bits(linear_from_srgb(n / 255.0), Transfer::srgb) == n);
  Random random(101);
  double worst = 0;
  for (int i = 0; i != 20000; ++i) {
    const double x = random.uniform();
    if (std::abs(x - 0.0031308) > 1e-5) worst = std::max(worst, std::abs(linear_from_srgb(srgb_from_linear(x)) - x));
  }
  BOOST_TEST(worst <= 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()
