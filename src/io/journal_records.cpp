// SPDX-License-Identifier: BSD-3-Clause
#include "io/journal_records.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

#include "io/checksum.h"
#include "io/error.h"

namespace tessera::io {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are in memory");

constexpr std::array<char, 8> kMagic{'T', 'E', 'S', 'S', 'J', 'R', 'N', 'L'};
constexpr std::uint32_t kVersion = 1;

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t bytes_per_pixel;
  render::Rect area;
  std::uint64_t picture;
  std::uint64_t checksum;
};
static_assert(std::has_unique_object_representations_v<Header> && sizeof(Header) == kJournalHeaderBytes);

/// In front of a record's pixels. The checksum is of all that follows it.
struct RecordHeader {
  std::uint64_t checksum;
  render::Rect tile;
  render::RayCounts rays;
};
static_assert(std::has_unique_object_representations_v<RecordHeader> && sizeof(RecordHeader) == 48);

std::uint64_t header_checksum(const Header& header) noexcept {
  return checksum_of(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, checksum)));
}

Header header_of(const JournalSubject& subject) noexcept {
  Header header{
      .bytes_per_pixel = subject.bytes_per_pixel, .area = subject.area, .picture = subject.picture, .checksum = 0};
  header.checksum = header_checksum(header);
  return header;
}

bool contains(const render::Rect& area, const render::Rect& tile) noexcept {
  const auto lies_in = [](std::uint64_t outer, std::uint64_t outer_length, std::uint64_t inner, std::uint64_t length) {
    return length > 0 && inner >= outer && inner + length <= outer + outer_length;
  };
  return lies_in(area.x, area.width, tile.x, tile.width) && lies_in(area.y, area.height, tile.y, tile.height);
}

std::string text_of(const render::Rect& area) {
  return std::to_string(area.width) + "x" + std::to_string(area.height) + " pixels at " + std::to_string(area.x) + "," +
         std::to_string(area.y);
}

[[noreturn]] void refuse(const std::string& name, const std::string& problem) {
  throw Error(ErrorKind::bad_scene, name + ": " + problem);
}

/// throws:  Error(bad_scene) where `found` is the beginning of another file than one that begins with `wanted`
void check_header(std::span<const std::byte> found, const Header& wanted, const std::string& name) {
  const auto expected = std::as_bytes(std::span(&wanted, 1));
  if (std::equal(found.begin(), found.end(), expected.begin())) return;
  if (found.size() < sizeof(Header) || std::memcmp(found.data(), kMagic.data(), kMagic.size()) != 0) {
    refuse(name, "no journal (it does not begin like one) choose another name for --journal");
  }
  Header other;
  std::memcpy(&other, found.data(), sizeof other);
  if (other.version != kVersion) {
    refuse(name, "a journal of version " + std::to_string(other.version) + " (this program reads version " +
                     std::to_string(kVersion) + ") remove it to start anew");
  }
  if (other.checksum != header_checksum(other)) {
    refuse(name, "a damaged journal (its header's checksum is wrong) remove it to start anew");
  }
  const std::string reason = other.area == wanted.area
                                 ? "the scene, the image options or the program's version differ"
                                 : "it holds " + text_of(other.area) + ", not " + text_of(wanted.area);
  refuse(name, "a journal of another picture (" + reason + ") go on with the same command, or remove it to start anew");
}

}  // namespace

std::array<std::byte, kJournalHeaderBytes> encode_journal_header(const JournalSubject& subject) {
  return std::bit_cast<std::array<std::byte, kJournalHeaderBytes>>(header_of(subject));
}

void append_journal_record(std::vector<std::byte>& bytes, const JournalSubject& subject, const render::Rect& tile,
                           const render::RayCounts& rays, const std::function<void(std::span<std::byte>)>& fill) {
  RecordHeader header{.checksum = 0, .tile = tile, .rays = rays};
  const std::size_t begin = bytes.size();
  bytes.resize(begin + sizeof header + tile.pixels() * subject.bytes_per_pixel);
  const auto record = std::span(bytes).subspan(begin);
  std::memcpy(record.data(), &header, sizeof header);
  fill(record.subspan(sizeof header));
  header.checksum = checksum_of(record.subspan(sizeof header.checksum), header_of(subject).checksum);
  std::memcpy(record.data(), &header.checksum, sizeof header.checksum);
}

JournalReader::JournalReader(std::span<const std::byte> bytes, const JournalSubject& subject, const std::string& name)
    : bytes_(bytes), subject_(subject) {
  const Header header = header_of(subject);
  check_header(bytes.first(std::min(bytes.size(), sizeof header)), header, name);
  seed_ = header.checksum;
  if (bytes.size() >= sizeof header) good_bytes_ = sizeof header;
}

std::optional<JournalRecord> JournalReader::next() {
  const auto rest = bytes_.subspan(good_bytes_);
  RecordHeader header;
  if (good_bytes_ == 0 || rest.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, rest.data(), sizeof header);
  if (!contains(subject_.area, header.tile)) return std::nullopt;
  const std::size_t pixel_bytes = header.tile.pixels() * subject_.bytes_per_pixel;
  if (rest.size() - sizeof header < pixel_bytes) return std::nullopt;
  const auto record = rest.first(sizeof header + pixel_bytes);
  if (header.checksum != checksum_of(record.subspan(sizeof header.checksum), seed_)) return std::nullopt;
  good_bytes_ += record.size();
  return JournalRecord{header.tile, header.rays, record.subspan(sizeof header)};
}

}  // namespace tessera::io
