// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "io/journal_records.h"

namespace tessera::io {

/// What to do with a journal that is there already.
enum class ExistingJournal : std::uint8_t {
  refuse,  ///< unless nothing is in it
  resume,  ///< keep its good records and append to them
};

/// A journal on disk. What is appended reaches the file 0.2 s later, or when there is 1 MB of it, in one write, so that
/// a process that is killed at any moment leaves a file whose records are good up to a last one that may be torn. The
/// file is locked against other runs while this lives. A journal without records goes away with this.
class Journal {
 public:
  /// Opens or creates the file; a torn end is cut off.
  /// throws:  Error(cannot_create) where that is not possible, another run has the file, or it is there against the
  ///          caller's wish; Error(bad_scene) as JournalReader
  Journal(const std::filesystem::path& path, const JournalSubject& subject, ExistingJournal existing);
  /// Writes out what is left, as far as possible.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Goes through the good records that were in the file when it was opened.
  /// throws:  Error(io_failure)
  void replay(const std::function<void(const JournalRecord&)>& take) const;

  /// Whether the file was there already.
  bool is_resumed() const noexcept { return is_resumed_; }
  bool has_records() const noexcept { return end_ + buffer_.size() > kJournalHeaderBytes; }

  /// Appends a record; `fill` puts the tile's pixels in their place.
  /// throws:  Error(io_failure)
  void append(const render::Rect& tile, const render::RayCounts& rays,
              const std::function<void(std::span<std::byte>)>& fill);

  /// To be called often: writes out what has waited long enough. Where nothing has, it moves the file's time of change
  /// forward twice a second, so that others see that this process is alive.
  /// throws:  Error(io_failure)
  void tick();

  /// Writes out all.
  /// throws:  Error(io_failure)
  void flush();

  /// Deletes the file; what was appended is needed no more.
  /// throws:  Error(io_failure)
  void remove();

 private:
  using Clock = std::chrono::steady_clock;

  void open(ExistingJournal existing);
  void lock();
  void keep_good_records();
  void write(std::span<const std::byte> bytes);

  std::filesystem::path path_;
  JournalSubject subject_;
  int descriptor_ = -1;
  bool is_resumed_ = false;
  std::uint64_t end_ = 0;         ///< bytes in the file
  std::uint64_t replay_end_ = 0;  ///< bytes that were in it when it was opened
  std::vector<std::byte> buffer_;
  Clock::time_point last_sign_;  ///< of life: a write or a touch
};

}  // namespace tessera::io
