// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

// A file that appears whole or not at all.
namespace tessera::io {

/// Where a path leads, symbolic links followed, whether something is there or not.
std::filesystem::path destination_of(std::filesystem::path path);

/// The name that a file has while it is written.
std::filesystem::path partial_name_of(std::filesystem::path destination);

/// Opens NAME.part at once, so that an unwritable place is known before the work starts; commit() renames it to NAME.
/// Until then a file that is there already stays as it is, and without a commit nothing is left behind. What is
/// neither a plain file nor missing (a device, a pipe) is written directly.
class OutputFile {
 public:
  /// throws:  Error(cannot_create) with the system's reason
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends bytes.
  /// throws:  Error(io_failure), for instance where the disk is full
  void write(std::string_view bytes);

  /// Gives the file its name. Nothing can be written after it.
  /// throws:  Error(io_failure)
  void commit();

  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  bool is_renamed() const noexcept { return written_to_ != target_; }

  std::filesystem::path path_;        // as the caller named it, for messages
  std::filesystem::path target_;      // path_ with symbolic links followed
  std::filesystem::path written_to_;  // target_ + ".part", or target_ itself for a device
  int descriptor_ = -1;
};

}  // namespace tessera::io
