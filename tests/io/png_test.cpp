// SPDX-License-Identifier: BSD-3-Clause
#include "io/png.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/error.h"
#include "io/random_image.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using render::Image;
using render::PixelFormat;
using render::Transfer;
using test::error_of;
using test::random_image;

// Type and content of each chunk, in order.
std::vector<std::pair<std::string, std::string>> chunks_of(const std::string& png) {
  std::vector<std::pair<std::string, std::string>> chunks;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(png[at + i]);
    chunks.emplace_back(png.substr(at + 4, 4), png.substr(at + 8, size));
    at += 12 + size;
  }
  return chunks;
}

std::string names_of(const std::string& png) {
  std::string names;
  for (const auto& [name, content] : chunks_of(png)) names += name + " ";
  return names;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(Png)

BOOST_AUTO_TEST_CASE(reads_back_what_it_wrote) {
  for (const PixelFormat format : {PixelFormat::rgb8, PixelFormat::rgb16}) {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {7u, 3u}, {64u, 65u}}) {
      const Image image = random_image(width, height, format);
      const Image back = decode_png(encode_png(image, Transfer::srgb, {}), "a.png");
      BOOST_TEST(back.width == width);
      BOOST_TEST(back.height == height);
      BOOST_TEST((back.format == format));
      BOOST_TEST((back.bytes == image.bytes));
    }
  }
}

BOOST_AUTO_TEST_CASE(same_picture_gives_same_bytes_without_a_date) {
  const Image image = random_image(30, 20, PixelFormat::rgb8);
  const PngText text{{"Software", "tessera"}};
  const std::string png = encode_png(image, Transfer::srgb, text);
  BOOST_TEST((png == encode_png(image, Transfer::srgb, text)));
  BOOST_TEST(names_of(png).find("tIME") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(rows_in_any_pieces_give_the_same_bytes) {
  for (const PixelFormat format : {PixelFormat::rgb8, PixelFormat::rgb16}) {
    const Image image = random_image(200, 90, format);
    const std::span<const std::byte> pixels = image.bytes;
    const std::size_t row = 200 * bytes_per_pixel(format);
    const std::string whole = encode_png(image, Transfer::srgb, {});
    for (const std::size_t piece : {1u, 7u, 89u, 90u}) {
      PngEncoder encoder({200, 90, format, Transfer::srgb}, {});
      for (std::size_t y = 0; y < 90; y += piece) {
        encoder.add_rows({});
        encoder.add_rows(pixels.subspan(y * row, std::min(piece, 90 - y) * row));
      }
      BOOST_TEST((std::move(encoder).finish() == whole));
    }
  }
}

BOOST_AUTO_TEST_CASE(refuses_rows_that_are_missing_broken_or_too_many) {
  const PngHeader header{4, 3, PixelFormat::rgb8, Transfer::none};
  const std::vector<std::byte> rows(5 * 12);
  PngEncoder encoder(header, {});
  BOOST_CHECK_THROW(encoder.add_rows(std::span(rows).first(11)), std::invalid_argument);
  BOOST_CHECK_THROW(encoder.add_rows(std::span(rows).first(4 * 12)), std::invalid_argument);
  encoder.add_rows(std::span(rows).first(2 * 12));
  BOOST_CHECK_THROW(encoder.add_rows(std::span(rows).first(2 * 12)), std::invalid_argument);
  BOOST_CHECK_THROW(std::move(encoder).finish(), std::logic_error);
}

BOOST_AUTO_TEST_CASE(transfer_decides_about_srgb_and_gama) {
  const Image image = random_image(2, 2, PixelFormat::rgb8);
  BOOST_TEST(names_of(encode_png(image, Transfer::srgb, {})) == "IHDR gAMA sRGB IDAT IEND ");
  BOOST_TEST(names_of(encode_png(image, Transfer::none, {})) == "IHDR IDAT IEND ");
  const auto chunks = chunks_of(encode_png(image, Transfer::srgb, {}));
  BOOST_TEST((chunks[1].second == std::string("\0\0\xb1\x8f", 4)));  // 45455
}

BOOST_AUTO_TEST_CASE(text_is_latin_or_international) {
  const Image image = random_image(2, 2, PixelFormat::rgb8);
  const std::string png = encode_png(image, Transfer::none, {{"Comment", "plain"}, {"Source", "caf\u00e9.toml"}});
  BOOST_TEST(names_of(png) == "IHDR tEXt iTXt IDAT IEND ");
  BOOST_TEST((chunks_of(png)[1].second == std::string("Comment\0plain", 13)));
  BOOST_TEST((chunks_of(png)[2].second == std::string("Source\0\0\0\0\0caf\xc3\xa9.toml", 21)));
}

BOOST_AUTO_TEST_CASE(every_truncation_is_an_error) {
  const std::string png = encode_png(random_image(9, 5, PixelFormat::rgb16), Transfer::srgb, {{"Comment", "x"}});
  for (std::size_t size = 0; size < png.size(); ++size) {
    const auto error = error_of([&] { decode_png(std::string_view(png).substr(0, size), "cut.png"); });
    BOOST_TEST_REQUIRE(error.has_value(), "no error at length " << size);
    BOOST_TEST((error->kind() == ErrorKind::bad_scene));
    BOOST_TEST(error->what() == "cut.png: not a readable PNG (the file ends too early)");
  }
}

BOOST_AUTO_TEST_CASE(a_changed_byte_never_crashes) {
  const std::string png = encode_png(random_image(9, 5, PixelFormat::rgb8), Transfer::srgb, {});
  for (std::size_t at = 0; at < png.size(); ++at) {
    std::string junk = png;
    junk[at] = static_cast<char>(junk[at] ^ 0x41);
    (void)error_of([&] { decode_png(junk, "junk.png"); });
  }
}

BOOST_AUTO_TEST_CASE(a_header_that_promises_too_much_is_refused_before_memory_is_taken) {
  // 100,000 x 100,000 pixels in a file of 57 bytes: IHDR with a right checksum, an empty IDAT and IEND
  const std::string png(
      "\x89PNG\r\n\x1a\n"
      "\0\0\0\x0dIHDR\0\x01\x86\xa0\0\x01\x86\xa0\x08\x02\0\0\0'0\x9c\x9f"
      "\0\0\0\0IDAT\x35\xaf\x06\x1e\0\0\0\0IEND\xae\x42\x60\x82",
      57);
  const auto error = error_of([&] { decode_png(png, "bomb.png"); });
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST(error->what() == "bomb.png: not a readable PNG (the file ends too early)");
}

BOOST_AUTO_TEST_CASE(float_pixels_and_empty_pictures_are_refused) {
  BOOST_CHECK_THROW(encode_png(Image(1, 1, PixelFormat::rgb32f), Transfer::none, {}), std::invalid_argument);
  const auto error = error_of([] { encode_png(Image(0, 1, PixelFormat::rgb8), Transfer::none, {}); });
  BOOST_TEST_REQUIRE(error.has_value());
  BOOST_TEST((error->kind() == ErrorKind::io_failure));
}

BOOST_AUTO_TEST_CASE(grey_palette_and_alpha_become_rgb) {
  struct OnePixel {
    const char* what;
    const char* chunks;  // hexadecimal, what follows the signature
    std::vector<int> samples;
  };
  const OnePixel files[] = {
      {"grey of 8 bits",
       "0000000d49484452000000010000000108000000003a7e9b550000000a49444154789c636800000082008177cd72b600000000"
       "49454e44ae426082",
       {0x80, 0x80, 0x80}},
      {"grey of 1 bit",
       "0000000d4948445200000001000000010100000000376ef9240000000a49444154789c636800000082008177cd72b600000000"
       "49454e44ae426082",
       {255, 255, 255}},
      {"palette",
       "0000000d494844520000000100000001080300000028cb34bb00000003504c54450102030d8764d50000000a49444154789c63"
       "6000000002000148afa4710000000049454e44ae426082",
       {1, 2, 3}},
      {"palette with transparency",
       "0000000d494844520000000100000001080300000028cb34bb00000003504c54450102030d8764d50000000174524e530040e6"
       "d8660000000a49444154789c636000000002000148afa4710000000049454e44ae426082",
       {1, 2, 3}},
      {"RGB and alpha",
       "0000000d49484452000000010000000108060000001f15c4890000000d49444154789c63606165630000003000108395427300"
       "00000049454e44ae426082",
       {4, 5, 6}},
      {"grey of 16 bits and alpha",
       "0000000d4948445200000001000000011004000000e58cd0410000000d49444154789c6310326160000000e90047fcf664d700"
       "00000049454e44ae426082",
       {0x1234, 0x1234, 0x1234}},
  };
  for (const OnePixel& file : files) {
    std::string png = "\x89PNG\r\n\x1a\n";
    for (const char* digit = file.chunks; *digit; digit += 2) {
      png += static_cast<char>(std::stoi(std::string(digit, 2), nullptr, 16));
    }
    const Image image = decode_png(png, file.what);
    const bool is_deep = image.format == PixelFormat::rgb16;
    std::vector<int> samples;
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint16_t deep = 0;
      if (is_deep) std::memcpy(&deep, image.bytes.data() + 2 * i, 2);
      samples.push_back(is_deep ? deep : std::to_integer<int>(image.bytes[i]));
    }
    BOOST_TEST(samples == file.samples, file.what);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
