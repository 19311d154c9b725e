// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_builder.h"

#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <limits>

#include "render/random.h"

namespace tessera::io {
namespace {

std::string text_of(double value) {
  TextBuilder out({"", " ", ""});
  out << value;
  return out.take();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(TextBuilding)

BOOST_AUTO_TEST_CASE(numbers_are_short_and_never_integers) {
  BOOST_TEST(text_of(0) == "0.0");
  BOOST_TEST(text_of(-0.0) == "-0.0");
  BOOST_TEST(text_of(0.1) == "0.1");
  BOOST_TEST(text_of(5) == "5.0");
  BOOST_TEST(text_of(1e22) == "1e+22");
  BOOST_TEST(text_of(12345678901234567890.0) == "12345678901234567168.0");
}

BOOST_AUTO_TEST_CASE(numbers_read_back_as_they_were) {
  render::test::Random random(1);
  using Limits = std::numeric_limits<double>;
  for (const double value : {Limits::min(), Limits::max(), Limits::denorm_min(), Limits::epsilon()}) {
    BOOST_TEST(std::strtod(text_of(value).c_str(), nullptr) == value);
  }
  for (int i = 0; i < 100'000; ++i) {
    const double value = random.over_decades(1e-300, 1e300) * (random.flip() ? 1 : -1);
    if (std::strtod(text_of(value).c_str(), nullptr) != value) BOOST_ERROR("differs: " << text_of(value));
  }
}

BOOST_AUTO_TEST_CASE(three_numbers_take_the_style_that_was_set_last) {
  TextBuilder out({"<", ", ", ">"});
  out << render::Vec3{1, 2, 3} << " " << std::uint64_t{7} << TripleStyle{"", " ", ";"} << render::Rgb{0, 0.5, 1};
  BOOST_TEST(out.take() == "<1.0, 2.0, 3.0> 70.0 0.5 1.0;");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
