// SPDX-License-Identifier: BSD-3-Clause
#include "io/signature_file.h"

#include <boost/test/unit_test.hpp>
#include <string>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using render::Cell;
using render::Signature;
using render::SignatureImage;
using render::surface_id;
using test::error_of;

/// Every pixel another signature.
SignatureImage random_signatures(std::uint32_t width, std::uint32_t height) {
  SignatureImage image{width, height, std::vector<Signature>(std::size_t{width} * height)};
  for (std::size_t i = 0; i != image.pixels.size(); ++i) {
    image.pixels[i].meet(surface_id(i), Cell::even);
    image.pixels[i].light(i % 2 == 0);
  }
  return image;
}

std::string problem_of(std::string_view bytes) {
  const auto error = error_of([&] { decode_signatures(bytes, "a.sig"); });
  if (!error) return "none";
  BOOST_TEST((error->kind() == ErrorKind::bad_scene));
  return error->what();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(SignatureFile)

BOOST_AUTO_TEST_CASE(reads_back_what_it_wrote) {
  const SignatureImage image = random_signatures(7, 3);
  const SignatureImage back = decode_signatures(encode_signatures(image), "a.sig");
  BOOST_TEST(back.width == 7u);
  BOOST_TEST(back.height == 3u);
  BOOST_TEST((back.pixels == image.pixels));
}

BOOST_AUTO_TEST_CASE(refuses_what_it_cannot_have_written) {
  const std::string bytes = encode_signatures(random_signatures(5, 4));
  for (std::size_t size = 0; size != bytes.size(); ++size) {
    BOOST_TEST(problem_of(std::string_view(bytes).substr(0, size)).starts_with("a.sig: "), size);
  }
  BOOST_TEST(problem_of(bytes + "x").find("length") != std::string::npos);
  BOOST_TEST(problem_of("PF\n1 1\n-1.0\n").find("--signature") != std::string::npos);
  BOOST_TEST(problem_of("TS\n1 1\n2\n" + std::string(24, 'x')).find("version") != std::string::npos);
  BOOST_TEST(problem_of(bytes) == "none");
}

BOOST_AUTO_TEST_CASE(differences_are_counted_once_each) {
  const SignatureImage a = random_signatures(4, 1);
  SignatureImage b = a;
  b.pixels[0] = {};
  b.pixels[0].meet(surface_id(9), Cell::even);
  b.pixels[1].meet(surface_id(9), Cell::even);
  b.pixels[2].light(true);
  const auto difference = difference_between(a, b);
  BOOST_TEST(difference.first == 1u);
  BOOST_TEST(difference.surfaces == 2u);
  BOOST_TEST(difference.lights == 1u);
  BOOST_TEST(difference_between(a, a).surfaces == 0u);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
