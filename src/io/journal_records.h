// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/image.h"
#include "render/ray_counts.h"

// A journal as bytes: which picture it is about, then a record for each rectangle of pixels that is done. Numbers are
// little-endian. Each part carries a checksum of its own, which begins from the header's, so that a record fits one
// journal only.
//
//   header  48 B  "TESSJRNL", version, bytes per pixel, area, picture, checksum
//   record  48 B  checksum, rectangle, ray counts; the rectangle's pixels follow, layer by layer, row by row
namespace tessera::io {

/// The pixels that a journal is about.
struct JournalSubject {
  std::uint64_t picture = 0;  ///< hash of all that decides a pixel
  render::Rect area;
  std::uint32_t bytes_per_pixel = 0;  ///< of all layers together
};

struct JournalRecord {
  render::Rect tile;
  render::RayCounts rays;
  std::span<const std::byte> pixels;
};

inline constexpr std::size_t kJournalHeaderBytes = 48;

std::array<std::byte, kJournalHeaderBytes> encode_journal_header(const JournalSubject& subject);

/// Appends a record to `bytes`; `fill` puts the pixels in their place.
/// requires: tile is not empty and lies in the subject's area
void append_journal_record(std::vector<std::byte>& bytes, const JournalSubject& subject, const render::Rect& tile,
                           const render::RayCounts& rays, const std::function<void(std::span<std::byte>)>& fill);

/// Goes through the records of a journal up to the first that is cut off or damaged; nothing after it is believed.
class JournalReader {
 public:
  /// `bytes` must outlive this; `name` is the file's, for messages. A header that is cut off is a journal without
  /// records.
  /// throws:  Error(bad_scene) where the bytes are no journal, or one of another subject
  JournalReader(std::span<const std::byte> bytes, const JournalSubject& subject, const std::string& name);

  /// The next record, whose pixels lie in the journal's bytes, or nullopt after the last good one.
  std::optional<JournalRecord> next();

  /// Bytes up to the end of what was read and is good: where to go on writing. 0 where the header is cut off.
  std::size_t good_bytes() const noexcept { return good_bytes_; }

 private:
  std::span<const std::byte> bytes_;
  JournalSubject subject_;
  std::uint64_t seed_ = 0;
  std::size_t good_bytes_ = 0;
};

}  // namespace tessera::io
