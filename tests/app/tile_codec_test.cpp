// SPDX-License-Identifier: BSD-3-Clause
#include "app/tile_codec.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

using namespace tessera;
using namespace tessera::app;
using scheduler::Bytes;

namespace {

constexpr std::size_t kPixels = 32 * 32;
constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();

/// A tile's layers with memory of their own.
struct Tile {
  std::vector<std::byte> colors;
  std::vector<render::Signature> signatures;
  std::vector<float> errors;

  render::TilePixels pixels() { return {colors, signatures, errors}; }
};

Tile tile_of_one_color(render::PixelFormat format) {
  Tile tile;
  for (std::size_t i = 0; i != kPixels * bytes_per_pixel(format); ++i) {
    tile.colors.push_back(static_cast<std::byte>(200 + i % bytes_per_pixel(format)));
  }
  return tile;
}

/// Half of it one colour, the other half another.
Tile simple_tile(render::PixelFormat format) {
  Tile tile = tile_of_one_color(format);
  std::fill(tile.colors.begin() + static_cast<std::ptrdiff_t>(tile.colors.size() / 2), tile.colors.end(), std::byte{9});
  return tile;
}

Tile noise(render::PixelFormat format) {
  std::mt19937 random(5);
  Tile tile = tile_of_one_color(format);
  for (std::byte& byte : tile.colors) byte = static_cast<std::byte>(random());
  return tile;
}

bool is_equal(std::span<const std::byte> a, std::span<const std::byte> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tile_codec)

BOOST_AUTO_TEST_CASE(a_tile_survives_its_way_in_every_form) {
  for (const auto format : {render::PixelFormat::rgb8, render::PixelFormat::rgb16, render::PixelFormat::rgb32f}) {
    for (const Packing packing : {Packing::never, Packing::where_shorter}) {
      for (const render::RayCounts& rays :
           {render::RayCounts{7, 0, 0}, {7, 127, 0}, {7, 0, 128}, {7, kMost, kMost - 1}}) {
        for (Tile tile : {tile_of_one_color(format), simple_tile(format), noise(format)}) {
          TileCodec codec(format, {}, packing);
          const Bytes delivered = codec.encode(rays, tile.pixels());
          const DeliveredTile arrived = codec.decode(delivered, kPixels);
          BOOST_TEST(arrived.shadow_rays == rays.shadow);
          BOOST_TEST(arrived.mirror_rays == rays.mirror);
          const bool is_one_color = tile.colors == tile_of_one_color(format).colors;
          BOOST_TEST(arrived.has_one_color == is_one_color);
          const auto expected = std::span(tile.colors);
          BOOST_TEST(is_equal(arrived.colors, is_one_color ? expected.first(bytes_per_pixel(format)) : expected));
          BOOST_TEST(arrived.signatures.empty());
          BOOST_TEST(arrived.errors.empty());
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(layers_follow_colors_of_every_form) {
  const auto format = render::PixelFormat::rgb8;
  for (Tile tile : {tile_of_one_color(format), simple_tile(format), noise(format)}) {
    for (std::size_t i = 0; i != kPixels; ++i) {
      tile.signatures.push_back({.hits = static_cast<std::uint32_t>(i)});
      tile.errors.push_back(static_cast<float>(i));
    }
    for (const Packing packing : {Packing::never, Packing::where_shorter}) {
      TileCodec codec(format, {.signatures = true, .errors = true}, packing);
      const Bytes delivered = codec.encode({1, 2, 3}, tile.pixels());
      const DeliveredTile arrived = codec.decode(delivered, kPixels);
      BOOST_TEST(is_equal(arrived.signatures, std::as_bytes(std::span(tile.signatures))));
      BOOST_TEST(is_equal(arrived.errors, std::as_bytes(std::span(tile.errors))));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_tile_of_one_color_takes_a_few_bytes) {
  // 8 bits a channel: one for the form, three for the colour, and two for 256 shadow rays.
  const auto format = render::PixelFormat::rgb8;
  for (const Packing packing : {Packing::never, Packing::where_shorter}) {
    const TileCodec codec(format, {}, packing);
    BOOST_TEST(codec.encode({kPixels, 0, 0}, tile_of_one_color(format).pixels()).size() == 4U);
    BOOST_TEST(codec.encode({kPixels, 256, 0}, tile_of_one_color(format).pixels()).size() == 6U);
  }
}

BOOST_AUTO_TEST_CASE(the_shortest_form_travels) {
  const auto format = render::PixelFormat::rgb8;
  const std::size_t raw = 1 + 3 * kPixels;
  const TileCodec plain(format, {}, Packing::never);
  const TileCodec packing(format, {}, Packing::where_shorter);
  BOOST_TEST(plain.encode({}, simple_tile(format).pixels()).size() == raw);
  BOOST_TEST(packing.encode({}, simple_tile(format).pixels()).size() < raw / 20);
  BOOST_TEST(packing.encode({}, noise(format).pixels()).size() == raw);
}

BOOST_AUTO_TEST_CASE(a_single_pixel_is_of_one_color) {
  TileCodec codec(render::PixelFormat::rgb8, {}, Packing::where_shorter);
  std::vector<std::byte> colors{std::byte{1}, std::byte{2}, std::byte{3}};
  const Bytes delivered = codec.encode({}, {colors});
  BOOST_TEST(delivered.size() == 4U);
  BOOST_TEST(is_equal(codec.decode(delivered, 1).colors, colors));
}

BOOST_AUTO_TEST_CASE(a_delivery_cut_off_or_lengthened_anywhere_is_refused) {
  const auto format = render::PixelFormat::rgb8;
  for (Tile tile : {tile_of_one_color(format), simple_tile(format), noise(format)}) {
    TileCodec codec(format, {}, Packing::where_shorter);
    Bytes delivered = codec.encode({9, 300, 70'000}, tile.pixels());
    for (std::size_t size = 0; size != delivered.size(); ++size) {
      BOOST_CHECK_THROW(codec.decode(std::span(delivered).first(size), kPixels), std::runtime_error);
    }
    delivered.push_back({});
    BOOST_CHECK_THROW(codec.decode(delivered, kPixels), std::runtime_error);
  }
}

BOOST_AUTO_TEST_CASE(junk_is_refused_or_read_within_its_bounds) {
  // Under the address sanitizer, a byte read or written out of bounds ends this test.
  std::mt19937 random(11);
  TileCodec codec(render::PixelFormat::rgb8, {.signatures = false, .errors = true}, Packing::where_shorter);
  Tile tile = simple_tile(render::PixelFormat::rgb8);
  tile.errors.resize(kPixels);
  const Bytes good = codec.encode({9, 300, 70'000}, tile.pixels());
  int refused = 0;
  for (int i = 0; i != 20'000; ++i) {
    Bytes junk(random() % 200);
    for (std::byte& byte : junk) byte = static_cast<std::byte>(random());
    if (!junk.empty() && i % 2 == 0) junk[0] &= std::byte{0x0F};
    if (i % 4 == 1) {
      // A good one with a few wrong bytes.
      junk = good;
      for (int wrong = 0; wrong != 3; ++wrong) junk[random() % 60] = static_cast<std::byte>(random());
    }
    try {
      const DeliveredTile arrived = codec.decode(Bytes(junk), kPixels);
      BOOST_TEST(arrived.errors.size() == kPixels * sizeof(float));
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  BOOST_TEST(refused > 15'000);
}

BOOST_AUTO_TEST_CASE(numbers_that_no_64_bits_hold_are_refused) {
  TileCodec codec(render::PixelFormat::rgb8, {});
  Bytes delivered(14, std::byte{0xFF});
  delivered[0] = std::byte{1 | 4};
  BOOST_CHECK_THROW(codec.decode(delivered, kPixels), std::runtime_error);
  // 2^64 - 1 is right, twice as much is not.
  delivered = codec.encode({0, kMost, 0}, tile_of_one_color(render::PixelFormat::rgb8).pixels());
  BOOST_TEST(codec.decode(delivered, kPixels).shadow_rays == kMost);
  delivered[10] = std::byte{3};
  BOOST_CHECK_THROW(codec.decode(delivered, kPixels), std::runtime_error);
}

BOOST_AUTO_TEST_SUITE_END()
