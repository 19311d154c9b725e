// SPDX-License-Identifier: BSD-3-Clause
#include "io/journal_records.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <string>
#include <vector>

#include "io/error.h"
#include "io/temp_folder.h"

namespace tessera::io {
namespace {

using test::error_of;
using Bytes = std::vector<std::byte>;

constexpr JournalSubject kSubject{.picture = 0x0123456789abcdef, .area = {3, 4, 20, 10}, .bytes_per_pixel = 3};

struct Record {
  render::Rect tile;
  render::RayCounts rays;
  Bytes pixels;

  friend bool operator==(const Record&, const Record&) = default;
};

Record record_of(const render::Rect& tile, std::uint64_t number) {
  Record record{tile, {number, 2 * number, 3 * number}, Bytes(tile.pixels() * kSubject.bytes_per_pixel)};
  for (std::size_t i = 0; i != record.pixels.size(); ++i) record.pixels[i] = static_cast<std::byte>(31 * i + number);
  return record;
}

// Corners of the area, one pixel, all of it.
std::vector<Record> some_records() {
  return {record_of({3, 4, 7, 5}, 1), record_of({22, 13, 1, 1}, 2), record_of(kSubject.area, 3),
          record_of({10, 9, 13, 5}, 4)};
}

Bytes header() {
  const auto bytes = encode_journal_header(kSubject);
  return {bytes.begin(), bytes.end()};
}

/// Appends a record and returns the journal's size.
std::size_t append(Bytes& journal, const Record& record) {
  append_journal_record(journal, kSubject, record.tile, record.rays, [&](std::span<std::byte> pixels) {
    BOOST_TEST_REQUIRE(pixels.size() == record.pixels.size());
    std::copy(record.pixels.begin(), record.pixels.end(), pixels.begin());
  });
  return journal.size();
}

struct Read {
  std::vector<Record> records;
  std::size_t good_bytes = 0;
};

Read read(std::span<const std::byte> journal, const JournalSubject& subject = kSubject) {
  JournalReader reader(journal, subject, "a.journal");
  Read result;
  while (const auto record = reader.next()) {
    result.records.push_back({record->tile, record->rays, Bytes(record->pixels.begin(), record->pixels.end())});
  }
  BOOST_TEST(!reader.next().has_value());
  result.good_bytes = reader.good_bytes();
  return result;
}

std::string problem_with(std::span<const std::byte> journal, const JournalSubject& subject = kSubject) {
  const auto error = error_of([&] { read(journal, subject); });
  if (!error) return "none";
  BOOST_TEST((error->kind() == ErrorKind::bad_scene));
  return error->what();
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(JournalRecords)

BOOST_AUTO_TEST_CASE(records_come_back_in_their_order) {
  Bytes journal = header();
  BOOST_TEST(read(journal).records.empty());
  for (const Record& record : some_records()) append(journal, record);
  const Read all = read(journal);
  BOOST_TEST((all.records == some_records()));
  BOOST_TEST(all.good_bytes == journal.size());
}

BOOST_AUTO_TEST_CASE(a_journal_cut_off_anywhere_keeps_the_records_before) {
  Bytes journal = header();
  std::vector<std::size_t> ends{journal.size()};
  for (const Record& record : some_records()) ends.push_back(append(journal, record));
  for (std::size_t size = 0; size <= journal.size(); ++size) {
    const Read part = read(std::span(journal).first(size));
    const auto whole = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), size) - ends.begin());
    const std::size_t records = whole == 0 ? 0 : whole - 1;
    BOOST_TEST_REQUIRE(part.records.size() == records);
    BOOST_TEST(std::equal(part.records.begin(), part.records.end(), some_records().begin()));
    BOOST_TEST(part.good_bytes == (whole == 0 ? 0 : ends[records]));
  }
}

// The flipped record and all after it are not believed, whatever the bit: length, place, count, pixel or checksum.
BOOST_AUTO_TEST_CASE(a_flipped_bit_is_never_accepted) {
  Bytes journal = header();
  std::vector<std::size_t> ends{journal.size()};
  for (const Record& record : some_records()) ends.push_back(append(journal, record));
  for (std::size_t bit = 0; bit != 8 * journal.size(); ++bit) {
    journal[bit / 8] ^= std::byte{1} << bit % 8;
    if (bit / 8 < kJournalHeaderBytes) {
      BOOST_TEST(problem_with(journal) != "none");
    } else {
      const auto damaged = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), bit / 8) - ends.begin());
      const Read part = read(journal);
      BOOST_TEST_REQUIRE(part.records.size() == damaged - 1);
      BOOST_TEST(std::equal(part.records.begin(), part.records.end(), some_records().begin()));
      BOOST_TEST(part.good_bytes == ends[damaged - 1]);
    }
    journal[bit / 8] ^= std::byte{1} << bit % 8;
  }
}

BOOST_AUTO_TEST_CASE(junk_after_the_records_is_no_record) {
  Bytes journal = header();
  const std::size_t end = append(journal, some_records()[0]);
  for (const std::byte filling : {std::byte{0}, std::byte{0xff}, std::byte{'x'}}) {
    journal.resize(end);
    journal.resize(end + 10'000, filling);
    BOOST_TEST(read(journal).good_bytes == end);
  }
}

BOOST_AUTO_TEST_CASE(a_record_fits_no_other_journal) {
  Bytes journal = header();
  append(journal, some_records()[0]);
  JournalSubject other = kSubject;
  other.picture += 1;
  const auto other_header = encode_journal_header(other);
  std::copy(other_header.begin(), other_header.end(), journal.begin());
  BOOST_TEST(read(journal, other).records.empty());
}

BOOST_AUTO_TEST_CASE(a_journal_of_another_picture_is_refused_with_the_reason) {
  Bytes journal = header();
  append(journal, some_records()[0]);
  JournalSubject other = kSubject;
  other.picture ^= 1;
  BOOST_TEST(
      problem_with(journal, other) ==
      "a.journal: a journal of another picture (the scene, the image options or the program's version differ) go "
      "on with the same command, or remove it to start anew");
  other = kSubject;
  other.area.width = 21;
  BOOST_TEST(says(problem_with(journal, other), "(it holds 20x10 pixels at 3,4, not 21x10 pixels at 3,4)"));
  other = kSubject;
  other.bytes_per_pixel = 6;
  BOOST_TEST(says(problem_with(journal, other), "image options"));
}

BOOST_AUTO_TEST_CASE(what_is_no_journal_is_refused) {
  const auto bytes_of = [](std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return Bytes(bytes.begin(), bytes.end());
  };
  BOOST_TEST(says(problem_with(bytes_of("a few notes")), "a.journal: no journal (it does not begin like one)"));
  BOOST_TEST(says(problem_with(Bytes(1000)), "no journal"));
  Bytes newer = header();
  newer[8] = std::byte{2};
  BOOST_TEST(says(problem_with(newer), "a journal of version 2 (this program reads version 1)"));
  Bytes damaged = header();
  damaged[40] ^= std::byte{1};
  BOOST_TEST(says(problem_with(damaged), "damaged"));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace tessera::io
